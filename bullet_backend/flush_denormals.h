#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace slipcheck::bullet {

/// Denormal results become zero for as long as this lives, where asked for and where the processor
/// can. A world that comes to rest fills with them, and each costs a hundred cycles.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  explicit FlushDenormals(bool wanted) : before_(_mm_getcsr()) {
    constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
    if (wanted) _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero);
  }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#else
  explicit FlushDenormals(bool) {}
#endif
};

}  // namespace slipcheck::bullet
