#pragma once

#include <cstddef>

namespace slipcheck {

/// Caches hold what the events of fewer bodies ask for without help (slipcheck_bench).
inline constexpr std::size_t kManyForCaches = 20'000;

/// Asks for a cache line, to be there when it is read. Changes nothing.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
  // GCC takes a function that only prefetches for one without effect, and drops calls of it.
  asm volatile("");
#else
  static_cast<void>(address);
#endif
}

}  // namespace slipcheck
