#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// UDUNITS-2 loses the name in a unit that it cannot parse ("7 /0kg"), some bytes of a file that is
/// refused; LeakSanitizer asks for this.
extern "C" [[gnu::used]] const char* __lsan_default_suppressions() { return "leak:libudunits2\n"; }

/// What the targets share. Each is one function that libFuzzer calls with bytes; what it lets
/// escape — any exception but those that the reader promises — ends the run and keeps the input.
namespace slipcheck::fuzz {

/// The bytes as the text of a file.
inline std::string text(const std::uint8_t* data, std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t k = 0; k < size; ++k) text[k] = static_cast<char>(data[k]);
  return text;
}

/// Ends the run as a crash does where something that must hold does not.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace slipcheck::fuzz
