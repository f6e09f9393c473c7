#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/rows/context.h"

namespace slipcheck {

/// Everything of a page before its first element: complete in itself, fit for offline use, light or
/// dark as the reader's system is. `more_css` is of this page alone; `scripts` are the only ones
/// that its policy lets run.
std::string html_head(std::string_view title, std::string_view more_css = {},
                      const std::vector<std::string_view>& scripts = {});

/// The end of a page that html_head() began.
inline constexpr const char* kHtmlEnd = "</body>\n</html>\n";

/// One line of a list of facts; nothing without a value.
std::string html_fact(std::string_view name, std::string_view value);

/// What made results, when, and on what machine, folded. `commands` are what the user typed,
/// `engines` whose results they are, "bullet 3.24".
std::string html_context(const Context& context, const std::vector<std::string>& commands,
                         const std::vector<std::string>& engines);

}  // namespace slipcheck
