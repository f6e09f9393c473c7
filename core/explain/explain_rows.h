#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/rows/quantity.h"

namespace slipcheck {

/// One line of an explanation: a number with its symbol and meaning, or a name and what is said of
/// it, or the remark alone.
struct ExplainRow {
  std::string label;                ///< "t_col"
  std::vector<std::string> values;  ///< "25.50 µs"; one for each column, none beside a name
  std::string remark;               ///< "duration of a collision"
};

struct ExplainColumn {
  std::string head;
  std::size_t width = 14;  ///< [columns of a terminal]
};

/// Lines beneath a title.
struct ExplainSection {
  std::string title = {};
  std::size_t label_width = 12;  ///< [columns of a terminal]
  bool is_part = false;          ///< of the section before
  std::vector<ExplainColumn> columns = {};
  std::size_t gap = 2;  ///< blanks before each value
  std::vector<ExplainRow> rows = {};

  void add(std::string symbol, std::string value, std::string meaning) {
    rows.push_back({std::move(symbol), {std::move(value)}, std::move(meaning)});
  }
  void add(std::string name, std::string remark) {
    rows.push_back({std::move(name), {}, std::move(remark)});
  }
  void add(std::string line) { add({}, std::move(line)); }
};
using ExplainSections = std::vector<ExplainSection>;

/// A number in an SI unit that takes no prefixes, "1.9993e+06 N/m".
inline std::string in_unit(double value, std::string_view unit) {
  return std::isinf(value) ? "∞" : fmt::format("{:.5g} {}", value, unit);
}

/// A pure number with five digits.
inline std::string pure(double value) { return fmt::format("{:.5g}", value); }

}  // namespace slipcheck
