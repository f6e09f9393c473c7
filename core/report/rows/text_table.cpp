#include "report/rows/text_table.h"

namespace slipcheck {

TextTable TextTable::with(const std::vector<std::size_t>& chosen) const {
  const auto pick = [&](const auto& from) {
    std::decay_t<decltype(from)> result;
    for (const std::size_t c : chosen) result.push_back(from[c]);
    return result;
  };
  TextTable table{pick(columns), {}, title, notes};
  for (const auto& row : rows) table.rows.push_back(pick(row));
  return table;
}

Cell count_cell(std::size_t count, Tone tone, Tone none) {
  return count > 0 ? Cell{std::to_string(count), tone, static_cast<double>(count)}
                   : Cell{"·", none};
}

}  // namespace slipcheck
