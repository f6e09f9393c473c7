#include "reference/initial_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "physics/contact/elastic_pair.h"
#include "reference/events/event_solver.h"
#include "scenario/rules/overlap.h"

namespace slipcheck {

std::vector<InitialContact> overlapping_pairs(const Scene& scene,
                                              std::span<const BodyState> states) {
  std::vector<InitialContact> found;
  if (scene.box || !scene.periodic.isZero(0)) return found;
  // Sorted along x, only those whose shadows meet are looked at.
  const auto left = [&](std::size_t i) { return states[i].position.x() - scene.bodies[i].radius; };
  std::vector<std::size_t> order(states.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, left);
  for (std::size_t p = 0; p < order.size(); ++p) {
    const double right = left(order[p]) + 2 * scene.bodies[order[p]].radius;
    for (std::size_t q = p + 1; q < order.size() && left(order[q]) < right; ++q) {
      const auto [i, j] = std::minmax(order[p], order[q]);
      const double overlap = overlap_of(states[i].position, scene.bodies[i].radius,
                                        states[j].position, scene.bodies[j].radius);
      if (overlap > 0) found.push_back({i, j, overlap});
    }
  }
  std::ranges::sort(found, {}, [](const auto& pair) { return std::pair(pair.first, pair.second); });
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
    const SoftContact& law = *scene.between(c.first, c.second);
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
