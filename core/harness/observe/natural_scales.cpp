#include "harness/observe/natural_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/initial_contacts.h"
#include "scenario/observable_key.h"

namespace slipcheck {

double NaturalScales::of(const std::string& full_name) const {
  const ObservableName* observable = observable_key(full_name).known();
  const Dimension& d = observable ? observable->dimension : kPureNumber;
  const double geometry = d.time < 0 ? std::pow(speed, -d.time) * std::pow(small, d.length + d.time)
                                     : std::pow(large, d.length) * std::pow(time, d.time);
  return std::pow(mass, d.mass) * geometry;
}

bool NaturalScales::is_rounding(const std::string& full_name, double difference) const {
  constexpr double kRounding = 1e-9;
  return difference <= kRounding * of(full_name);
}

NaturalScales natural_scales(const ContactScene& scene) {
  NaturalScales scales{.speed = speed_scale(scene),
                       .small = std::numeric_limits<double>::infinity()};
  for (const Sphere& sphere : scene.hard.bodies) {
    scales.large = std::max(scales.large, sphere.radius);
    scales.small = std::min(scales.small, sphere.radius);
    scales.mass = std::max(scales.mass, sphere.mass);
  }
  return scales;
}

}  // namespace slipcheck
