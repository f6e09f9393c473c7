#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace slipcheck {

/// Prints to stderr. That nobody can read it, on a full disk for example, is no failure of what it
/// tells of.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace slipcheck
