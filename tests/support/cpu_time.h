#pragma once

#include <ctime>

namespace slipcheck::test {

/// How many times as long things may take under sanitizers.
#ifdef SLIPCHECK_SANITIZE
constexpr double kSlower = 10;
#else
constexpr double kSlower = 1;
#endif

/// CPU time since it was made: what else the machine does is not in it.
class CpuTime {
 public:
  /// [s]
  double operator()() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace slipcheck::test
