#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slipcheck {

/// Takes one code point off the text; nothing, and one byte, where the text does not begin with a
/// well-formed one: also overlong forms, surrogates and what lies beyond U+10FFFF (Unicode 15,
/// table 3-7). The text must not be empty.
std::optional<char32_t> take_code_point(std::string_view& text);

/// Writes a code point, at most U+10FFFF, as UTF-8 at the end.
void append_code_point(std::string& to, char32_t c);

/// Well-formed UTF-8, with U+FFFD for each byte that is not: JSON and HTML can hold nothing else.
std::string valid_utf8(std::string_view text);

/// The same fit for a terminal or a page: control characters, which could move the cursor or
/// reverse the direction of writing, become U+FFFD, and line breaks and tabs blanks.
std::string printable(std::string_view text);

/// How many columns of a terminal well-formed UTF-8 takes; its inks (ESC [ … m) take none.
std::size_t display_width(std::string_view text);

/// Cut to a display width, with "…" for what is missing.
std::string shortened(std::string_view text, std::size_t width);

}  // namespace slipcheck
