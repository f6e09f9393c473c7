#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/rows/text_table.h"

namespace slipcheck {

/// Text as it may stand in an element or a quoted attribute: whatever a scene or an engine says, it
/// cannot become markup.
std::string escaped(std::string_view text);

/// A paragraph with a bold head, both escaped; nothing for an empty text. Head and class may be
/// empty.
std::string html_paragraph(std::string_view css_class, std::string_view head,
                           std::string_view text);

/// The class of what has this tone; empty where it looks like the text about it.
const char* class_of(Tone tone);

/// A table that scrolls by itself where it is wider than the screen, also by keyboard. The first
/// cell of a row is its head. Numbers are in `data-value` too, by which the page's script sorts.
std::string html_table(const TextTable& table);

/// A list under a bold head, all escaped; nothing without items.
std::string html_list(std::string_view css_class, std::string_view head,
                      const std::vector<std::string>& items);

/// HTML that opens at a click on its summary, which is escaped; nothing without content.
std::string html_details(std::string_view summary, std::string_view content);

}  // namespace slipcheck
