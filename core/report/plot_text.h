#pragma once

#include <string>
#include <string_view>

namespace slipcheck {

/// What stands in an SVG text element for a formula's text: `_` and `^` lower and raise the next
/// character or group in braces, as in "t^s", "v_{rel}", "u_i^f". Everything else is escaped.
std::string plot_text(std::string_view text);

/// About how wide that is, in units of the font's size.
double plot_text_width(std::string_view text);

/// The same for HTML.
std::string html_plot_text(std::string_view text);

/// The same for places that show plain text: without the braces.
std::string plain_plot_text(std::string_view text);

}  // namespace slipcheck
