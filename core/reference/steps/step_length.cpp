#include "reference/steps/step_length.h"

#include <algorithm>

#include "physics/numbers.h"
#include "reference/forces/contact_solver.h"
#include "reference/initial_contacts.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

/// The two lightest bodies of each material, which collide fastest.
std::vector<std::vector<double>> lightest(const Scene& scene) {
  std::vector<std::vector<double>> masses(scene.substrate.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::vector<double>& least = masses[scene.material[i]];
    least.push_back(scene.bodies[i].mass);
    std::ranges::sort(least);
    if (least.size() > 2) least.pop_back();
  }
  return masses;
}

}  // namespace

double shortest_collision(const ContactScene& scene) {
  const double speed = speed_scale(scene);
  double shortest = kNever;
  if (!(speed > 0)) return shortest;
  const auto masses = lightest(scene.hard);
  for (std::size_t m = 0; m < masses.size(); ++m)
    for (std::size_t n = 0; n <= m; ++n) {
      const auto& soft = scene.soft[m * masses.size() + n];
      if (!soft || masses[n].empty() || masses[m].size() < (m == n ? 2u : 1u)) continue;
      const double first = masses[m][0], second = m == n ? masses[n][1] : masses[n][0];
      const double reduced = first * second / (first + second);
      shortest = std::min(shortest, impact(soft->normal, reduced, speed, soft->end, 1e-6).duration);
    }
  return shortest;
}

}  // namespace slipcheck
