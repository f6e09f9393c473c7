#include "harness/compare/observable_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenario/observable_key.h"

namespace slipcheck {

double observable_scale(const Scenario& scenario, const ReferenceValues& reference,
                        const std::string& full_name) {
  const auto value_of = [&](const std::string& name) {
    const auto found = reference.find(name);
    return found == reference.end() ? 0 : found->second.value;
  };
  const ObservableKey key = observable_key(full_name);
  const ObservableName* observable = key.known();
  if (observable == nullptr || !observable->is_vector) return std::abs(value_of(full_name));
  const auto [x, y, z] = key.components();
  Vector3 vector(value_of(x), value_of(y), value_of(z));
  if (key.observable == "final_position")
    for (const Body& body : scenario.bodies)
      if (body.name == key.owner) vector -= body.initial.position;
  const double length = vector.norm();
  // Squares of finite components may overflow.
  if (std::isfinite(length) || !vector.allFinite()) return length;
  return std::min(vector.stableNorm(), std::numeric_limits<double>::max());
}

}  // namespace slipcheck
