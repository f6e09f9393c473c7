#pragma once

#include <string>
#include <string_view>

namespace slipcheck {

// Texts of charts are formulas: `_` and `^` lower and raise the next character or group in braces,
// as in "t^s", "v_{rel}", "u_i^f"; after a backslash they are themselves.

/// A formula in gnuplot's single quotes, enhanced: nothing else of it is markup or is run.
std::string gnuplot_text(std::string_view text);

/// About how wide that is, in units of the font's size.
double plot_text_width(std::string_view text);

/// The same for HTML.
std::string html_plot_text(std::string_view text);

/// The same for places that show plain text: without braces and backslashes.
std::string plain_plot_text(std::string_view text);

/// A text that is no formula, such as a file's name, for all of these.
std::string plot_literal(std::string_view text);

}  // namespace slipcheck
