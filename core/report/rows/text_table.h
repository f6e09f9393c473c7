#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace slipcheck {

/// What a piece of text stands for, hence its colour.
enum class Tone { plain, good, doubtful, bad, faint, strong };

struct Column {
  std::string header;
  bool right = false;  ///< aligned to the right, for numbers
  int spare = 0;       ///< left out where a terminal has no room, the highest first; 0 never
};

struct Cell {
  std::string text;
  Tone tone = Tone::plain;
  /// Of what begins with a number, the number, by which the page sorts [SI]; else NaN.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string symbol = {};     ///< of a verdict, before its word
  std::string css_class = {};  ///< on the page, where the tone does not say it
  std::string link = {};       ///< on the page, where it leads to; empty: nowhere
};

/// What is said of a row beneath its table; of no row where there is no name.
struct TableNote {
  std::string name, text;
};

/// A table for people, made once of what it shows: terminal_table(), html_table() and
/// markdown_table() set it.
struct TextTable {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows = {};  ///< a cell for each column
  std::string title = {};  ///< for screen readers; empty where the heading before it says so
  std::vector<TableNote> notes = {};

  /// The same with these columns alone, in this order.
  TextTable with(const std::vector<std::size_t>& chosen) const;
};

/// A number of things; "·" for none.
Cell count_cell(std::size_t count, Tone tone = Tone::plain, Tone none = Tone::faint);

}  // namespace slipcheck
