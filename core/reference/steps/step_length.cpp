#include "reference/steps/step_length.h"

#include <algorithm>

#include "physics/contact/elastic_pair.h"
#include "physics/numbers.h"
#include "reference/forces/contact_solver.h"
#include "reference/initial_contacts.h"
#include "scene/impact.h"

namespace slipcheck {

std::vector<std::vector<std::size_t>> lightest_two(const Scene& scene) {
  std::vector<std::vector<std::size_t>> of_row(scene.row_count());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::vector<std::size_t>& least = of_row[scene.row_of(i)];
    const auto heavier = std::ranges::upper_bound(
        least, scene.bodies[i].mass, {}, [&](std::size_t k) { return scene.bodies[k].mass; });
    least.insert(heavier, i);
    if (least.size() > 2) least.pop_back();
  }
  return of_row;
}

double shortest_collision(const ContactScene& scene) {
  const double speed = speed_scale(scene);
  double shortest = kNever;
  if (!(speed > 0)) return shortest;
  const auto lightest = lightest_two(scene.hard);
  for (std::size_t m = 0; m < lightest.size(); ++m)
    for (std::size_t n = 0; n <= m; ++n) {
      if (lightest[n].empty() || lightest[m].size() < (m == n ? 2u : 1u)) continue;
      const std::size_t i = lightest[m][0], j = lightest[n][m == n ? 1 : 0];
      const std::optional<SoftContact> soft = scene.contact_of(i, j);
      if (!soft) continue;
      const double reduced = effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]);
      shortest = std::min(shortest, impact(soft->normal, reduced, speed, soft->end, 1e-6).duration);
    }
  return shortest;
}

double shortest_at_surfaces(const ContactScene& scene) {
  const double speed = speed_scale(scene);
  double shortest = kNever;
  if (!(speed > 0)) return shortest;
  for (const std::vector<std::size_t>& lightest : lightest_two(scene.hard)) {
    if (lightest.empty()) continue;
    for (std::size_t s = 0; s < scene.hard.surfaces.size(); ++s) {
      const std::optional<SoftContact>& soft = scene.on_surface(lightest[0], s);
      if (!soft) continue;
      const double mass = scene.hard.bodies[lightest[0]].mass;
      shortest = std::min(shortest, impact(soft->normal, mass, speed, soft->end, 1e-6).duration);
    }
  }
  return shortest;
}

}  // namespace slipcheck
