#include "report/charts/plot_text.h"

#include <fmt/format.h>

#include <vector>

#include "report/html/html_text.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr double kSmall = 0.72;  // size of what is raised or lowered

struct Piece {
  std::string_view text;
  int level = 0;  ///< 1 raised, −1 lowered
};

bool is_special(char c) { return c == '_' || c == '^' || c == '\\' || c == '{' || c == '}'; }

std::vector<Piece> pieces_of(std::string_view text) {
  std::vector<Piece> pieces;
  std::size_t begin = 0;
  const auto close = [&](std::size_t end) {
    if (end > begin) pieces.push_back({text.substr(begin, end - begin), 0});
  };
  for (std::size_t k = 0; k < text.size();) {
    if (text[k] == '\\' && k + 1 < text.size() && is_special(text[k + 1])) {
      close(k);
      begin = k + 1;
      k += 2;
      continue;
    }
    if ((text[k] != '^' && text[k] != '_') || k + 1 == text.size()) {
      ++k;
      continue;
    }
    close(k);
    const int level = text[k] == '^' ? 1 : -1;
    std::size_t first = k + 1, end = first + 1;
    if (text[first] == '{') {
      const std::size_t brace = text.find('}', ++first);
      end = brace == std::string_view::npos ? text.size() : brace;
      begin = end == text.size() ? end : end + 1;
    } else {
      // The whole of a character outside ASCII.
      while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
      begin = end;
    }
    pieces.push_back({text.substr(first, end - first), level});
    k = begin;
  }
  close(text.size());
  return pieces;
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string quoted = "'";
  for (const Piece& piece : pieces_of(text)) {
    if (piece.level != 0) quoted += piece.level > 0 ? "^{" : "_{";
    for (const char c : printable(piece.text)) {
      if (std::string_view("\\^_{}@&~").find(c) != std::string_view::npos) quoted += '\\';
      quoted += c == '\'' ? "''" : std::string(1, c);
    }
    if (piece.level != 0) quoted += '}';
  }
  return quoted + "'";
}

double plot_text_width(std::string_view text) {
  double width = 0;
  for (const Piece& piece : pieces_of(text))
    width += 0.54 * static_cast<double>(display_width(piece.text)) * (piece.level ? kSmall : 1);
  return width;
}

std::string html_plot_text(std::string_view text) {
  std::string html;
  for (const Piece& piece : pieces_of(text)) {
    const char* tag = piece.level > 0 ? "sup" : "sub";
    html += piece.level == 0 ? escaped(piece.text)
                             : fmt::format("<{0}>{1}</{0}>", tag, escaped(piece.text));
  }
  return html;
}

std::string plain_plot_text(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\\' && k + 1 < text.size() && is_special(text[k + 1]))
      plain += text[++k];
    else if (text[k] != '{' && text[k] != '}')
      plain += text[k];
  }
  return plain;
}

std::string plot_literal(std::string_view text) {
  std::string literal;
  for (char c : text) {
    if (is_special(c)) literal += '\\';
    literal += c;
  }
  return literal;
}

}  // namespace slipcheck
