#include "report/rows/csv_rows.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "report/terminal/text.h"

namespace slipcheck {

std::string csv_field(std::string_view text) {
  // What a spreadsheet would take for a formula begins with an apostrophe, as OWASP advises.
  const bool is_formula =
      !text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos;
  const std::string apostrophe = is_formula ? "'" : "";
  if (text.find_first_of(",\"\n\r") == std::string_view::npos)
    return apostrophe + std::string(text);
  std::string field = "\"" + apostrophe;
  for (char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

CsvRows::CsvRows(const std::vector<std::string>& header, int digits)
    : columns_(header.size()), digits_(digits) {
  add({header.begin(), header.end()});
}

void CsvRows::add(const std::vector<CsvValue>& row) {
  assert(row.size() == columns_);
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (c > 0) text_ += ',';
    if (const double* number = std::get_if<double>(&row[c])) {
      if (!std::isfinite(*number)) continue;
      text_ += digits_ > 0 ? fmt::format("{:.{}g}", *number, digits_) : fmt::format("{}", *number);
    } else {
      text_ += csv_field(valid_utf8(std::get<std::string>(row[c])));
    }
  }
  text_ += '\n';
}

}  // namespace slipcheck
