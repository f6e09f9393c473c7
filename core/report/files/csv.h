#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slipcheck {

/// Numbers in columns of equal length.
class Table {
 public:
  struct Column {
    std::string name;  ///< with the unit in brackets, "t^s [ms]", "[-]" for a pure number
    std::vector<double> values;
  };

  /// Adds a column.
  std::vector<double>& add(std::string name, std::vector<double> values = {});
  /// The values under a name that is there.
  const std::vector<double>& operator[](std::string_view name) const;
  const std::vector<Column>& columns() const { return columns_; }

 private:
  std::vector<Column> columns_;
};

/// RFC 4180 with line feeds: a header, then a row for each index; twelve significant digits,
/// nothing for what is not finite.
std::string csv_text(const Table& table);

}  // namespace slipcheck
