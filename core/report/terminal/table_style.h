#pragma once

#include <string>

#include "report/rows/text_table.h"

namespace slipcheck {

/// How a table looks on the terminal.
struct TableStyle {
  bool colour = false;           ///< ANSI colours; symbols say the same without them
  int width = 80;                ///< columns of the terminal, > 0
  bool is_bound = true;          ///< tables fit the width; else, in a pipe, they have all columns
  bool all_observables = false;  ///< also what has no tolerance
};

/// The text in its colour, where the style has colours.
std::string inked(const std::string& text, Tone tone, const TableStyle& style);

/// Lines of aligned columns, printable. Where there is no room, spare columns go first, of which a
/// line beneath tells, and then the first column is shortened.
std::string terminal_table(TextTable table, const TableStyle& style, std::size_t indent);

/// A paragraph under a head of that tone, each line indented to behind it; two blanks before all.
std::string paragraph(const std::string& head, const std::string& text, Tone tone,
                      const TableStyle& style);

}  // namespace slipcheck
