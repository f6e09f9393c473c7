#include "harness/observables.h"

#include <array>
#include <cmath>

#include "physics/frame.h"

namespace slipcheck {
namespace {

struct ScalarOfBody {
  const char* name;
  double BodyObservables::*value;
};
constexpr std::array kScalars = {
    ScalarOfBody{"sliding_time", &BodyObservables::sliding_time},
    ScalarOfBody{"sliding_distance", &BodyObservables::sliding_distance},
    ScalarOfBody{"energy_change_sliding", &BodyObservables::energy_change_sliding},
    ScalarOfBody{"momentum_change_sliding", &BodyObservables::momentum_change_sliding},
    ScalarOfBody{"stopping_time", &BodyObservables::stopping_time},
    ScalarOfBody{"stopping_distance", &BodyObservables::stopping_distance},
    ScalarOfBody{"spin_stopping_time", &BodyObservables::spin_stopping_time},
    ScalarOfBody{"lift_off_speed", &BodyObservables::lift_off_speed},
    ScalarOfBody{"jump_height", &BodyObservables::jump_height},
    ScalarOfBody{"flight_time", &BodyObservables::flight_time},
};

struct VectorOfBody {
  const char* name;
  Vector3 BodyObservables::*value;
};
constexpr std::array kVectors = {
    VectorOfBody{"velocity_after_collision", &BodyObservables::velocity_after_collision},
    VectorOfBody{"slip_after_collision", &BodyObservables::slip_after_collision},
    VectorOfBody{"angular_velocity_after_collision",
                 &BodyObservables::angular_velocity_after_collision},
    VectorOfBody{"rolling_velocity", &BodyObservables::rolling_velocity},
    VectorOfBody{"final_position", &BodyObservables::final_position},
    VectorOfBody{"final_velocity", &BodyObservables::final_velocity},
    VectorOfBody{"final_angular_velocity", &BodyObservables::final_angular_velocity},
};

struct ScalarOfPair {
  const char* name;
  double PairObservables::*value;
};
constexpr std::array kPairScalars = {
    ScalarOfPair{"restitution", &PairObservables::restitution},
    ScalarOfPair{"tangential_restitution", &PairObservables::tangential_restitution},
    ScalarOfPair{"effective_restitution", &PairObservables::effective_restitution},
};

}  // namespace

std::map<std::string, double> named_values(const Observables& observables,
                                           const std::vector<std::string>& body_names) {
  std::map<std::string, double> values;
  const auto add = [&](std::string name, double value) {
    if (!std::isnan(value)) values.emplace(std::move(name), value);
  };
  for (std::size_t i = 0; i < observables.bodies.size(); ++i) {
    const BodyObservables& body = observables.bodies[i];
    const std::string prefix = body_names[i] + ".";
    for (const auto& scalar : kScalars) add(prefix + scalar.name, body.*scalar.value);
    for (const auto& vector : kVectors) {
      const Vector3& v = body.*vector.value;
      add(prefix + vector.name, v.norm());
      for (int k = 0; k < 3; ++k) add(prefix + vector.name + "." + "xyz"[k], v[k]);
    }
  }
  for (const PairObservables& pair : observables.pairs) {
    const auto name_of = [&](int k) {
      return k == kSubstrate ? std::string("substrate") : body_names[static_cast<std::size_t>(k)];
    };
    const std::string prefix = name_of(pair.first) + "-" + name_of(pair.second) + ".";
    for (const auto& scalar : kPairScalars) add(prefix + scalar.name, pair.*scalar.value);
  }
  return values;
}

}  // namespace slipcheck
