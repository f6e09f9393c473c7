#include "harness/run/phases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace slipcheck {

std::vector<double> phase_starts(double first_contact, double step, std::size_t count) {
  if (!std::isfinite(first_contact) || first_contact <= 0) return {0.0};
  const double range = std::min(step, first_contact);
  std::mt19937_64 random(20260101);
  std::vector<double> starts(count);
  for (std::size_t k = 0; k < count; ++k) {
    // The library's distributions differ between platforms; 53 random bits do not.
    const double inside = static_cast<double>(random() >> 11) * 0x1p-53;
    starts[k] = range * (static_cast<double>(k) + inside) / static_cast<double>(count);
  }
  return starts;
}

}  // namespace slipcheck
