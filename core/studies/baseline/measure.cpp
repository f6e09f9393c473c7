#include "studies/baseline/measure.h"

#include <cmath>

#include "scenario/observable_names.h"

namespace slipcheck {
namespace {

/// "i.final_velocity.x" is final_velocity.x of "i".
std::string owner_of(const std::string& full_name) {
  return full_name.substr(0, full_name.find('.'));
}
std::string observable_of(const std::string& full_name) {
  return full_name.substr(full_name.find('.') + 1);
}

Vector3 start_of(const Scenario& scenario, const std::string& body) {
  for (const Body& each : scenario.bodies)
    if (each.name == body) return each.initial.position;
  return Vector3::Zero();
}

}  // namespace

double scale_of(const Scenario& scenario, const ReferenceValues& reference,
                const std::string& full_name) {
  const std::string name = observable_of(full_name);
  const ObservableName* observable = find_observable(name);
  if (observable == nullptr || !observable->is_vector) {
    const auto found = reference.find(full_name);
    return found == reference.end() ? 0 : std::abs(found->second.value);
  }
  const std::string owner = owner_of(full_name);
  Vector3 vector = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto found = reference.find(owner + '.' + std::string(observable->name) + '.' + "xyz"[k]);
    if (found != reference.end()) vector[k] = found->second.value;
  }
  if (observable->name == "final_position") vector -= start_of(scenario, owner);
  return vector.norm();
}

bool is_pure_number(const std::string& full_name) {
  const ObservableName* observable = find_observable(observable_of(full_name));
  return observable != nullptr && observable->dimension.si[0] == '\0';
}

}  // namespace slipcheck
