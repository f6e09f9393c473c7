#include "reference/initial_contacts.h"

#include <algorithm>
#include <cmath>

#include "physics/contact/elastic_pair.h"
#include "reference/events/event_solver.h"
#include "reference/overlaps.h"
#include "scenario/rules/overlap.h"

namespace slipcheck {
namespace {

/// From so many bodies on they are sorted into cells.
constexpr std::size_t kMany = 16;
/// Of the largest radius, more than what rounding does to an overlap.
constexpr double kRounding = 1e-9;

}  // namespace

std::vector<InitialContact> overlapping_pairs(const Scene& scene,
                                              std::span<const BodyState> states) {
  std::vector<InitialContact> found;
  if (scene.box || !scene.periodic.isZero(0)) return found;
  const auto look_at = [&](std::size_t i, std::size_t j) {
    const double overlap = overlap_of(states[i].position, scene.bodies[i].radius,
                                      states[j].position, scene.bodies[j].radius);
    if (overlap > 0) found.push_back({i, j, overlap});
  };
  if (states.size() < kMany) {
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t j = i + 1; j < states.size(); ++j) look_at(i, j);
    return found;
  }
  double largest = 0;
  for (const Sphere& sphere : scene.bodies) largest = std::max(largest, sphere.radius);
  for (const auto& [i, j] : near_pairs(near_spheres(scene, states), kRounding * largest))
    look_at(i, j);
  return found;
}

std::vector<InitialContact> initial_contacts(const ContactScene& scene,
                                             std::span<const BodyState> states) {
  if (std::ranges::none_of(scene.soft, [](const auto& pair) { return pair.has_value(); }))
    return {};
  std::vector<InitialContact> found = overlapping_pairs(scene.hard, states);
  std::erase_if(found, [&](const InitialContact& pair) {
    const double contact =
        scene.hard.bodies[pair.first].radius + scene.hard.bodies[pair.second].radius;
    return !scene.between(pair.first, pair.second) || pair.overlap <= scene.touching * contact;
  });
  return found;
}

double release_speed(const SoftContact& contact, double overlap, double reduced_mass) {
  const double energy =
      std::visit([&](const auto& law) { return law.energy(overlap); }, contact.normal);
  return std::sqrt(2 * energy / reduced_mass);
}

double release_speed(const ContactScene& scene, std::span<const InitialContact> contacts) {
  double largest = 0;
  for (const InitialContact& c : contacts) {
    const double reduced = effective_mass(scene.hard.bodies[c.first], scene.hard.bodies[c.second]);
    const SoftContact law = *scene.contact_of(c.first, c.second);
    largest = std::max(largest, release_speed(law, c.overlap, reduced));
  }
  return largest;
}

double speed_scale(const ContactScene& scene) {
  const std::vector<BodyState>& initial = scene.hard.initial;
  return std::max(speed_scale(scene.hard, initial),
                  release_speed(scene, initial_contacts(scene, initial)));
}

}  // namespace slipcheck
