#include "app/print_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return printable(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_array()) {
    std::string text;
    for (const auto& item : value) text += (text.empty() ? "" : ", ") + cell(item);
    return text;
  }
  return value.dump();
}

}  // namespace

void print_list(const Json& list) {
  std::vector<std::string> columns;
  for (const auto& row : list)
    for (const auto& [key, value] : row.items())
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) columns.push_back(key);
  std::vector<std::size_t> widths;
  for (const std::string& column : columns) {
    std::size_t width = column.size();
    for (const auto& row : list)
      if (row.contains(column)) width = std::max(width, cell(row[column]).size());
    widths.push_back(width);
  }
  const auto print_row = [&](const auto& text_of) {
    std::string line;
    for (std::size_t c = 0; c < columns.size(); ++c)
      line += fmt::format("{:<{}}  ", text_of(columns[c]), widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  };
  print_row([](const std::string& column) { return column; });
  for (const auto& row : list)
    print_row([&](const std::string& column) {
      return row.contains(column) ? cell(row[column]) : std::string();
    });
}

}  // namespace slipcheck
