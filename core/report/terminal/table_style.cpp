#include "report/terminal/table_style.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kShortestName = 12;
constexpr std::size_t kParagraphIndent = 2;

std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = display_width(table.columns[c].header);
    for (const auto& row : table.rows) width = std::max(width, display_width(row[c].text));
    widths.push_back(width);
  }
  return widths;
}

std::size_t total(const std::vector<std::size_t>& widths, std::size_t indent) {
  std::size_t sum = indent;
  for (std::size_t width : widths) sum += width + kGap;
  return sum - kGap;
}

/// Removes the most spare column and adds its name; false if there is none.
bool leave_one_out(TextTable& table, std::vector<std::string>& left_out) {
  const auto most =
      std::max_element(table.columns.begin(), table.columns.end(),
                       [](const Column& a, const Column& b) { return a.spare < b.spare; });
  if (most->spare == 0) return false;
  const auto at = most - table.columns.begin();
  left_out.insert(left_out.begin(), most->header);
  table.columns.erase(most);
  for (auto& row : table.rows) row.erase(row.begin() + at);
  return true;
}

/// A verdict's symbol has a column of its own, which stays where there is no room for the word;
/// neither needs a head.
void set_symbols_apart(TextTable& table) {
  for (std::size_t c = table.columns.size(); c-- > 0;) {
    if (table.rows.empty() || table.rows[0][c].symbol.empty()) continue;
    const auto at = static_cast<std::ptrdiff_t>(c);
    table.columns[c].header.clear();
    table.columns.insert(table.columns.begin() + at, Column{});
    for (auto& row : table.rows) row.insert(row.begin() + at, Cell{row[c].symbol, row[c].tone});
  }
}

}  // namespace

std::string inked(const std::string& text, Tone tone, const TableStyle& style) {
  if (!style.colour || tone == Tone::plain || text.empty()) return text;
  const char* code = tone == Tone::good       ? "\x1b[32m"
                     : tone == Tone::doubtful ? "\x1b[33m"
                     : tone == Tone::bad      ? "\x1b[31m"
                     : tone == Tone::faint    ? "\x1b[2m"
                                              : "\x1b[1m";
  return code + text + "\x1b[0m";
}

std::string terminal_table(TextTable table, const TableStyle& style, std::size_t indent) {
  set_symbols_apart(table);
  for (auto& row : table.rows)
    for (Cell& cell : row) cell.text = printable(cell.text);
  const std::size_t room = style.is_bound ? static_cast<std::size_t>(std::max(style.width, 1))
                                          : std::numeric_limits<std::size_t>::max();
  std::vector<std::string> left_out;
  while (total(widths_of(table), indent) > room && leave_one_out(table, left_out)) {
  }
  std::vector<std::size_t> widths = widths_of(table);
  if (const std::size_t taken = total(widths, indent); taken > room) {
    const std::size_t excess = std::min(taken - room, widths[0]);
    widths[0] = std::min(widths[0], std::max(kShortestName, widths[0] - excess));
  }

  std::string result;
  const auto add_line = [&](const std::vector<Cell>& cells) {
    std::string line(indent, ' ');
    std::size_t pending = 0;  // blanks, so that no line ends with them
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string text = shortened(cells[c].text, widths[c]);
      const std::size_t blanks = widths[c] - display_width(text);
      if (text.empty()) {
        pending += widths[c] + kGap;
        continue;
      }
      line += std::string(pending + (table.columns[c].right ? blanks : 0), ' ');
      line += inked(text, cells[c].tone, style);
      pending = kGap + (table.columns[c].right ? 0 : blanks);
    }
    result += line + '\n';
  };
  std::vector<Cell> headers;
  for (const Column& column : table.columns) headers.push_back({column.header, Tone::faint});
  add_line(headers);
  for (const auto& row : table.rows) add_line(row);
  std::erase(left_out, "");  // a verdict's word, whose symbol stays, and remarks
  if (!left_out.empty()) {
    const std::string note = fmt::format("… no room for {}: widen the terminal, or COLUMNS=200",
                                         fmt::join(left_out, ", "));
    for (const std::string& line : wrapped(note, room > indent ? room - indent : 1))
      result += std::string(indent, ' ') + inked(line, Tone::faint, style) + '\n';
  }
  return result;
}

std::string paragraph(const std::string& head, const std::string& text, Tone tone,
                      const TableStyle& style) {
  const std::size_t indent = kParagraphIndent + display_width(head);
  const auto width = static_cast<std::size_t>(std::max(style.width, 1));
  std::string result;
  for (const std::string& line : wrapped(printable(text), width > indent ? width - indent : 1)) {
    result += result.empty() ? std::string(kParagraphIndent, ' ') + inked(head, tone, style)
                             : std::string(indent, ' ');
    result += line + '\n';
  }
  return result;
}

}  // namespace slipcheck
