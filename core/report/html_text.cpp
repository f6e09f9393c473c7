#include "report/html_text.h"

#include <fmt/format.h>

#include "report/text.h"

namespace slipcheck {
namespace {

std::string opening(const char* tag, const HtmlCell& cell, const char* attributes = "") {
  return cell.css_class.empty()
             ? fmt::format("<{}{}>", tag, attributes)
             : fmt::format("<{}{} class=\"{}\">", tag, attributes, escaped(cell.css_class));
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
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" aria-label=\"{}\" tabindex=\"0\"><table><thead><tr>",
      escaped(label));
  for (const HtmlCell& header : headers)
    html += opening("th", header, " scope=\"col\"") + escaped(header.text) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      html += c == 0 ? opening("th", row[c], " scope=\"row\"") : opening("td", row[c]);
      html += escaped(row[c].text) + (c == 0 ? "</th>" : "</td>");
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace slipcheck
