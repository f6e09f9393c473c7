#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace slipcheck {

/// A text as a field of RFC 4180: in quotes where it needs them, and after an apostrophe where it
/// begins with =, +, - or @, which spreadsheets take for a formula.
std::string csv_field(std::string_view text);

/// A field; what is not finite, and an empty text, is an empty field.
using CsvValue = std::variant<double, std::string>;

/// Rows of texts and numbers under a header; RFC 4180 with line feeds, numbers such that they read
/// back as the same double, unless fewer digits are asked for.
class CsvRows {
 public:
  /// `digits`: significant ones of a number, in [1, 17]; 0 for as many as it takes.
  explicit CsvRows(const std::vector<std::string>& header, int digits = 0);

  /// Adds a row; it has as many values as the header.
  void add(const std::vector<CsvValue>& row);
  const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  int digits_;
  std::string text_;
};

}  // namespace slipcheck
