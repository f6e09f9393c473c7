#include "harness/observe/observables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "physics/frame.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

/// An observable's name and where its value is.
template <class Owner, class Value>
struct Named {
  const char* name;
  Value Owner::*value;
};
using ScalarOfBody = Named<BodyObservables, double>;
using VectorOfBody = Named<BodyObservables, Vector3>;
using ScalarOfPair = Named<PairObservables, double>;

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

constexpr std::array kPairScalars = {
    ScalarOfPair{"restitution", &PairObservables::restitution},
    ScalarOfPair{"tangential_restitution", &PairObservables::tangential_restitution},
    ScalarOfPair{"effective_restitution", &PairObservables::effective_restitution},
    ScalarOfPair{"contact_time", &PairObservables::contact_time},
    ScalarOfPair{"max_overlap", &PairObservables::max_overlap},
    ScalarOfPair{"sliding_onset", &PairObservables::sliding_onset},
};

constexpr std::size_t kOfBody = kScalars.size() + 4 * kVectors.size();

/// What a body's values are called, in the order of flat_values().
std::vector<ObservableKey> keys_of_body() {
  std::vector<ObservableKey> keys;
  for (const auto& scalar : kScalars) keys.push_back({"", scalar.name});
  for (const auto& vector : kVectors) {
    keys.push_back({"", vector.name});
    for (const char component : kComponents) keys.push_back({"", vector.name, component});
  }
  return keys;
}

std::vector<ObservableKey> keys_of_pair() {
  std::vector<ObservableKey> keys;
  for (const auto& scalar : kPairScalars) keys.push_back({"", scalar.name});
  return keys;
}

/// Their places in the order of their texts.
std::vector<std::size_t> order_of(const std::vector<ObservableKey>& keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t k) { return keys[k].text(); });
  return order;
}

/// Of a pair of these bodies.
std::string owner_of(const PairObservables& pair, const Observables& observables,
                     const std::vector<std::string>& body_names) {
  const auto second = [&]() -> std::string_view {
    if (pair.second == kSubstrate) return "substrate";
    if (pair.second >= 0) return body_names[static_cast<std::size_t>(pair.second)];
    return body_names[observables.bodies.size() + touched_surface(pair.second)];
  };
  return pair_owner(body_names[static_cast<std::size_t>(pair.first)], second());
}

}  // namespace

std::string value_name(const Observables& observables, const std::vector<std::string>& body_names,
                       std::size_t index) {
  std::string name;
  write_value_name(observables, body_names, index, name);
  return name;
}

void write_value_name(const Observables& observables, const std::vector<std::string>& body_names,
                      std::size_t index, std::string& name) {
  static const std::vector<ObservableKey> kKeys = keys_of_body();
  const std::size_t of_bodies = kOfBody * observables.bodies.size();
  if (index < of_bodies) return kKeys[index % kOfBody].of(body_names[index / kOfBody]).write(name);
  const std::size_t left = index - of_bodies;
  if (left == kPairScalars.size() * observables.pairs.size())
    return ObservableKey{"all", "height"}.write(name);
  const PairObservables& pair = observables.pairs[left / kPairScalars.size()];
  ObservableKey{owner_of(pair, observables, body_names),
                kPairScalars[left % kPairScalars.size()].name}
      .write(name);
}

const BodyObservables* body_of_value(const Observables& observables, std::size_t index) {
  const std::size_t body = index / kOfBody;
  return body < observables.bodies.size() ? &observables.bodies[body] : nullptr;
}

std::vector<std::size_t> order_of_names(const Observables& observables,
                                        const std::vector<std::string>& body_names) {
  static const std::vector<std::size_t> kOrderOfBody = order_of(keys_of_body());
  static const std::vector<std::size_t> kOrderOfPair = order_of(keys_of_pair());
  static const std::vector<std::size_t> kAlone = {0};
  struct Owner {
    std::string name;  // up to its dot, which no name of a body has
    std::size_t first;
    const std::vector<std::size_t>* order;
  };
  std::vector<Owner> owners;
  owners.reserve(observables.bodies.size() + observables.pairs.size() + 1);
  std::size_t first = 0;
  const auto add = [&](std::string name, const std::vector<std::size_t>& order) {
    owners.push_back({std::move(name += '.'), first, &order});
    first += order.size();
  };
  for (std::size_t k = 0; k < observables.bodies.size(); ++k) add(body_names[k], kOrderOfBody);
  for (const PairObservables& pair : observables.pairs)
    add(owner_of(pair, observables, body_names), kOrderOfPair);
  add("all", kAlone);
  std::ranges::sort(owners, {}, &Owner::name);
  std::vector<std::size_t> places;
  places.reserve(first);
  for (const Owner& owner : owners)
    for (const std::size_t k : *owner.order) places.push_back(owner.first + k);
  return places;
}

std::vector<double> flat_values(const Observables& observables) {
  std::vector<double> values;
  values.reserve(kOfBody * observables.bodies.size() +
                 kPairScalars.size() * observables.pairs.size() + 1);
  for (const BodyObservables& body : observables.bodies) {
    for (const auto& scalar : kScalars) values.push_back(body.*scalar.value);
    for (const auto& vector : kVectors) {
      const Vector3& v = body.*vector.value;
      values.insert(values.end(), {v.norm(), v.x(), v.y(), v.z()});
    }
  }
  for (const PairObservables& pair : observables.pairs)
    for (const auto& scalar : kPairScalars) values.push_back(pair.*scalar.value);
  values.push_back(observables.height);
  return values;
}

void share_within_vectors(const Observables& observables, std::vector<double>& values) {
  constexpr std::ptrdiff_t kParts = 4;  // its length and components
  auto body = values.begin();
  for (std::size_t i = 0; i < observables.bodies.size(); ++i, body += kOfBody)
    for (auto part = body + kScalars.size(); part != body + kOfBody; part += kParts) {
      double largest = 0;
      for (auto each = part; each != part + kParts; ++each)
        if (std::isfinite(*each)) largest = std::max(largest, *each);
      for (auto each = part; each != part + kParts; ++each)
        if (std::isfinite(*each)) *each = largest;
    }
}

std::map<std::string, double> named_values(const Observables& observables,
                                           const std::vector<std::string>& body_names) {
  const std::vector<double> values = flat_values(observables);
  std::map<std::string, double> named;
  for (const std::size_t k : order_of_names(observables, body_names))
    if (!std::isnan(values[k]))
      named.emplace_hint(named.end(), value_name(observables, body_names, k), values[k]);
  return named;
}

Observables aligned(const Observables& observables, const Observables& like) {
  Observables result;
  result.bodies = observables.bodies;
  result.height = observables.height;
  result.bodies.resize(like.bodies.size());
  result.pairs.reserve(like.pairs.size());
  for (const PairObservables& wanted : like.pairs) {
    const auto bodies_of = [](const PairObservables& pair) {
      return std::pair(pair.first, pair.second);
    };
    const auto found =
        std::ranges::lower_bound(observables.pairs, bodies_of(wanted), {}, bodies_of);
    const bool is_there =
        found != observables.pairs.end() && bodies_of(*found) == bodies_of(wanted);
    result.pairs.push_back(
        is_there ? *found : PairObservables{.first = wanted.first, .second = wanted.second});
  }
  return result;
}

}  // namespace slipcheck
