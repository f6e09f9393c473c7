#include "report/html/html_text.h"

#include <fmt/format.h>

#include "report/terminal/text.h"

namespace slipcheck {
namespace {

std::string opening(const char* tag, const HtmlCell& cell) {
  return cell.css_class.empty() ? fmt::format("<{}>", tag)
                                : fmt::format("<{} class=\"{}\">", tag, escaped(cell.css_class));
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
  std::string html = opening("p", {"", std::string(css_class)});
  if (!head.empty()) html += "<strong>" + escaped(head) + "</strong> ";
  return html + escaped(text) + "</p>\n";
}

std::string html_table(std::string_view label, const std::vector<HtmlCell>& headers,
                       const std::vector<std::vector<HtmlCell>>& rows) {
  std::string numbers;
  for (std::size_t c = 0; c < headers.size(); ++c)
    if (headers[c].css_class == "n")
      numbers += fmt::format("{}n{}", numbers.empty() ? "" : " ", c + 1);
  std::string html = "<div class=\"table\" tabindex=\"0\"";
  if (!label.empty()) html += fmt::format(" role=\"region\" aria-label=\"{}\"", escaped(label));
  html += numbers.empty() ? "><table>" : fmt::format("><table class=\"{}\">", numbers);
  html += "<thead><tr>";
  for (const HtmlCell& header : headers) html += "<th>" + escaped(header.text) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      html += opening(c == 0 ? "th" : "td", row[c]);
      html += escaped(row[c].text) + (c == 0 ? "</th>" : "</td>");
    }
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
