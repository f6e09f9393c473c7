#include "report/files/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "report/rows/csv_rows.h"

namespace slipcheck {
std::vector<double>& Table::add(std::string name, std::vector<double> values) {
  return columns_.emplace_back(Column{std::move(name), std::move(values)}).values;
}

const std::vector<double>& Table::operator[](std::string_view name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const Column& column) { return column.name == name; });
  assert(found != columns_.end());
  return found->values;
}

std::string csv_text(const Table& table) {
  std::string text;
  std::size_t rows = 0;
  for (const Table::Column& column : table.columns()) {
    if (&column != &table.columns().front()) text += ",";
    text += csv_field(column.name);
    rows = std::max(rows, column.values.size());
  }
  text += "\n";
  for (std::size_t r = 0; r < rows; ++r) {
    for (const Table::Column& column : table.columns()) {
      if (&column != &table.columns().front()) text += ",";
      if (r < column.values.size() && std::isfinite(column.values[r]))
        text += fmt::format("{:.12g}", column.values[r]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace slipcheck
