#include "convert/rolling_length.h"

namespace slipcheck {

double rolling_length(const Sphere& sphere, double coefficient) {
  return (1 + sphere.shape_factor) * coefficient * sphere.radius;
}

double rolling_coefficient(const Sphere& sphere, double length) {
  return length / ((1 + sphere.shape_factor) * sphere.radius);
}

}  // namespace slipcheck
