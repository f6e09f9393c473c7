#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slipcheck {

/// Text as it may stand in an element or a quoted attribute: whatever a scene or an engine says, it
/// cannot become markup.
std::string escaped(std::string_view text);

/// A paragraph with a bold head, both escaped; nothing for an empty text. Head and class may be
/// empty.
std::string html_paragraph(std::string_view css_class, std::string_view head,
                           std::string_view text);

/// A cell of a table: escaped text and its class, if any.
struct HtmlCell {
  std::string text;
  std::string css_class;
};

/// A table that scrolls by itself where it is wider than the screen, also by keyboard; `label` is
/// what a screen reader calls it, empty where the heading before it says so. The first cell of a
/// row is its head. Below a head of class "n" stand numbers, to the right.
std::string html_table(std::string_view label, const std::vector<HtmlCell>& headers,
                       const std::vector<std::vector<HtmlCell>>& rows);

/// A list under a bold head, all escaped; nothing without items.
std::string html_list(std::string_view css_class, std::string_view head,
                      const std::vector<std::string>& items);

/// HTML that opens at a click on its summary, which is escaped; nothing without content.
std::string html_details(std::string_view summary, std::string_view content);

}  // namespace slipcheck
