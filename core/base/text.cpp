#include "base/text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace slipcheck {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

using Range = std::pair<char32_t, char32_t>;

template <std::size_t N>
bool is_in(const std::array<Range, N>& ranges, char32_t c) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [c](const Range& r) { return r.first <= c && c <= r.second; });
}

/// C0, DEL and C1; separators of lines; marks, embeddings and isolates of direction; non-characters
/// that XML cannot hold.
constexpr std::array<Range, 5> kControls = {
    {{0x0, 0x1F}, {0x7F, 0x9F}, {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}}};
constexpr std::array<Range, 1> kNonCharacters = {{{0xFFFE, 0xFFFF}}};

/// Take no column: combining marks, joiners, variation selectors.
constexpr std::array<Range, 7> kZeroWidth = {{{0x300, 0x36F},
                                              {0x1AB0, 0x1AFF},
                                              {0x1DC0, 0x1DFF},
                                              {0x200B, 0x200F},
                                              {0x20D0, 0x20FF},
                                              {0xFE00, 0xFE0F},
                                              {0xFE20, 0xFE2F}}};
/// Take two: East Asian wide and full width, pictographs.
constexpr std::array<Range, 9> kWide = {{{0x1100, 0x115F},
                                         {0x2E80, 0xA4CF},
                                         {0xAC00, 0xD7A3},
                                         {0xF900, 0xFAFF},
                                         {0xFE30, 0xFE6F},
                                         {0xFF00, 0xFF60},
                                         {0xFFE0, 0xFFE6},
                                         {0x1F300, 0x1FAFF},
                                         {0x20000, 0x3FFFD}}};

std::size_t columns(char32_t c) {
  if (c < 0x300) return 1;
  if (is_in(kZeroWidth, c)) return 0;
  return is_in(kWide, c) ? 2 : 1;
}

/// One code point off the text, the replacement character for a byte that begins none.
char32_t take_or_replace(std::string_view& text) {
  return take_code_point(text).value_or(kReplacement);
}

}  // namespace

std::optional<char32_t> take_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  char32_t c = length == 1 ? first : first & (0xFFu >> (length + 1));
  bool valid = first < 0x80 || (first >= 0xC2 && first <= 0xF4 && text.size() >= length);
  for (std::size_t i = 1; valid && i < length; ++i) {
    valid = (byte(i) & 0xC0) == 0x80;
    c = (c << 6) | (byte(i) & 0x3Fu);
  }
  valid = valid && !(length == 3 && c < 0x800) && !(length == 4 && c < 0x10000) &&
          !(c >= 0xD800 && c <= 0xDFFF) && c <= 0x10FFFF;
  text.remove_prefix(valid ? length : 1);
  return valid ? std::optional(c) : std::nullopt;
}

void append_code_point(std::string& to, char32_t c) {
  const auto put = [&](char32_t bits) { to += static_cast<char>(bits); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | (c >> 6));
  } else {
    if (c < 0x10000) {
      put(0xE0 | (c >> 12));
    } else {
      put(0xF0 | (c >> 18));
      put(0x80 | ((c >> 12) & 0x3F));
    }
    put(0x80 | ((c >> 6) & 0x3F));
  }
  put(0x80 | (c & 0x3F));
}

std::string valid_utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) append_code_point(result, take_or_replace(text));
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    char32_t c = take_or_replace(text);
    if (c == '\n' || c == '\t' || c == '\r') c = ' ';
    if (is_in(kControls, c) || is_in(kNonCharacters, c)) c = kReplacement;
    append_code_point(result, c);
  }
  return result;
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    if (text.starts_with("\x1b["))  // an ink, to its letter
      text.remove_prefix(std::min(text.find('m'), text.size() - 1) + 1);
    else
      width += columns(take_or_replace(text));
  }
  return width;
}

std::string shortened(std::string_view text, std::size_t width) {
  if (display_width(text) <= width) return std::string(text);
  if (width == 0) return {};
  std::string result;
  std::size_t taken = 0;
  while (!text.empty()) {
    const char32_t c = take_or_replace(text);
    if (taken + columns(c) > width - 1) break;
    taken += columns(c);
    append_code_point(result, c);
  }
  return result + "…";
}

}  // namespace slipcheck
