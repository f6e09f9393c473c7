#pragma once

#include <string>
#include <vector>

namespace slipcheck {

/// How a table looks on the terminal.
struct TableStyle {
  bool colour = false;           ///< ANSI colours; symbols say the same without them
  int width = 80;                ///< columns of the terminal, > 0
  bool all_observables = false;  ///< also what has no tolerance
};

/// What a piece of text stands for, hence its colour.
enum class Tone { plain, good, doubtful, bad, faint, strong };

/// The text in its colour, where the style has colours.
std::string inked(const std::string& text, Tone ink, const TableStyle& style);

struct Column {
  std::string header;
  bool right = false;  ///< aligned to the right, for numbers
  int spare = 0;       ///< left out if there is no room, the highest first; 0 never
};

struct Cell {
  std::string text;
  Tone ink = Tone::plain;
};

/// Lines of aligned columns. Where there is no room, spare columns go first, and then the first
/// column is shortened. Every row has a cell for each column.
std::string aligned(std::vector<Column> columns, std::vector<std::vector<Cell>> rows,
                    const TableStyle& style, std::size_t indent);

/// A paragraph under a head of that ink, each line indented to behind it; two blanks before all.
std::string paragraph(const std::string& head, const std::string& text, Tone ink,
                      const TableStyle& style);

}  // namespace slipcheck
