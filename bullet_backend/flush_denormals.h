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
  explicit FlushDenormals(bool wanted) : wanted_(wanted) {
    if (!wanted) return;
    constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
    before_ = _mm_getcsr();
    _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero);
  }
  ~FlushDenormals() {
    if (wanted_) _mm_setcsr(before_);
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  bool wanted_;
  unsigned before_ = 0;
#else
  explicit FlushDenormals(bool) {}
#endif
};

}  // namespace slipcheck::bullet
