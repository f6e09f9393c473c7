#include "report/html/html_text.h"

#include <fmt/format.h>

#include <cmath>

#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// With a blank before it; nothing for an empty value.
std::string attribute(const char* name, std::string_view value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(value));
}

std::string html_cell(const char* tag, const Cell& cell) {
  const std::string symbol = cell.symbol.empty() ? "" : cell.symbol + " ";
  // Six digits: what agrees in them keeps its order.
  const std::string value = std::isfinite(cell.value) ? fmt::format("{:.6g}", cell.value) : "";
  std::string text = escaped(symbol + cell.text);
  if (!cell.link.empty()) text = fmt::format("<a{}>{}</a>", attribute("href", cell.link), text);
  return fmt::format(
      "<{0}{1}{2}{3}>{4}</{0}>", tag, std::string_view(tag) == "th" ? " scope=\"row\"" : "",
      attribute("class", cell.css_class.empty() ? class_of(cell.tone) : cell.css_class),
      attribute("data-value", value), text);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : printable(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string html_paragraph(std::string_view css_class, std::string_view head,
                           std::string_view text) {
  if (text.empty()) return {};
  std::string html = "<p" + attribute("class", css_class) + ">";
  if (!head.empty()) html += "<strong>" + escaped(head) + "</strong> ";
  return html + escaped(text) + "</p>\n";
}

const char* class_of(Tone tone) {
  // In the order of Tone.
  constexpr const char* kClasses[] = {"", "good", "bad", "bad", "faint", ""};
  return kClasses[static_cast<std::size_t>(tone)];
}

std::string html_table(const TextTable& table) {
  std::string numbers;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].right) numbers += fmt::format("{}n{}", numbers.empty() ? "" : " ", c + 1);
  std::string html = "<div class=\"table\" tabindex=\"0\"";
  if (!table.title.empty()) html += " role=\"region\"" + attribute("aria-label", table.title);
  html += "><table" + attribute("class", numbers) + ">";
  if (!table.title.empty()) html += "<caption>" + escaped(table.title) + "</caption>";
  html += "<thead><tr>";
  for (const Column& column : table.columns)
    html += column.header.empty() ? "<td></td>"
                                  : "<th scope=\"col\">" + escaped(column.header) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const Cell& cell : row) html += html_cell(&cell == &row.front() ? "th" : "td", cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_list(std::string_view css_class, std::string_view head,
                      const std::vector<std::string>& items) {
  if (items.empty()) return {};
  std::string html =
      fmt::format("<div class=\"{}\"><strong>{}</strong><ul>", escaped(css_class), escaped(head));
  for (const std::string& item : items) html += "<li>" + escaped(item) + "</li>";
  return html + "</ul></div>\n";
}

std::string html_details(std::string_view summary, std::string_view content) {
  if (content.empty()) return {};
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(summary), content);
}

}  // namespace slipcheck
