#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"

namespace slipcheck {

/// Filled up with blanks to a display width, at the end or, `right`, at the beginning.
std::string padded(std::string_view text, std::size_t width, bool right = false);

/// Broken at blanks into lines of at most `width` columns (longer words stay whole). Never empty.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

}  // namespace slipcheck
