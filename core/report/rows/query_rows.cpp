#include "report/rows/query_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "report/rows/csv_rows.h"

namespace slipcheck {
namespace {

std::string header_of(const QueryColumn& column) {
  return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

Cell cell_of(const SqliteValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    return {fmt::format("{}", *whole), Tone::plain, static_cast<double>(*whole)};
  if (const auto* number = std::get_if<double>(&value))
    return {fmt::format("{:.6g}", *number), Tone::plain, *number};
  if (const auto* text = std::get_if<std::string>(&value)) return {printable(*text)};
  return {"·", Tone::faint};
}

CsvValue csv_value(const SqliteValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return std::string();
}

nlohmann::ordered_json json_value(const SqliteValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* number = std::get_if<double>(&value); number && std::isfinite(*number))
    return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return valid_utf8(*text);
  return nullptr;
}

bool is_number(const SqliteValue& value) { return value.index() == 1 || value.index() == 2; }

}  // namespace

TextTable query_table(const QueryResult& result) {
  TextTable table;
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const bool right = !result.rows.empty() && is_number(result.rows.front()[c]);
    table.columns.push_back({header_of(result.columns[c]), right, static_cast<int>(c)});
  }
  for (const std::vector<SqliteValue>& row : result.rows) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    for (const SqliteValue& value : row) cells.push_back(cell_of(value));
  }
  return table;
}

std::string query_csv(const QueryResult& result) {
  std::vector<std::string> header;
  for (const QueryColumn& column : result.columns) header.push_back(header_of(column));
  CsvRows rows(header);
  for (const std::vector<SqliteValue>& row : result.rows) {
    std::vector<CsvValue> values;
    for (const SqliteValue& value : row) values.push_back(csv_value(value));
    rows.add(values);
  }
  return rows.text();
}

std::string query_json(const QueryResult& result) {
  nlohmann::ordered_json json = {{"schema", "slipcheck-query/1"}};
  // As arrays from the beginning: what is null and cannot become one for want of memory is broken.
  json["columns"] = nlohmann::ordered_json::array();
  for (const QueryColumn& column : result.columns)
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  json["rows"] = nlohmann::ordered_json::array();
  for (const std::vector<SqliteValue>& row : result.rows) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const SqliteValue& value : row) values.push_back(json_value(value));
    json["rows"].push_back(std::move(values));
  }
  return json.dump(1);
}

}  // namespace slipcheck
