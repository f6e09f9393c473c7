#include "harness/observe/energy_budget.h"

#include <algorithm>

namespace slipcheck {

EnergyBudget energy_budget(const Assembly& assembly) {
  EnergyBudget budget;
  if (assembly.states.empty()) return budget;
  budget.first = assembly.states.front().energy();
  budget.last = assembly.states.back().energy();
  double lowest = budget.first, moving = 0;
  double low = assembly.states.front().weight_energy, high = low;
  for (const AssemblyState& state : assembly.states) {
    lowest = std::min(lowest, state.energy());
    budget.rise = std::max(budget.rise, state.energy() - lowest);
    moving = std::max(moving, state.energy() - state.weight_energy);
    low = std::min(low, state.weight_energy);
    high = std::max(high, state.weight_energy);
  }
  budget.scale = moving + high - low;
  return budget;
}

bool is_left_alone(const Scene& scene) {
  return (!scene.has_substrate || scene.motion.is_still()) && !scene.box &&
         std::ranges::all_of(scene.surfaces,
                             [](const Surface& each) { return each.motion.is_still(); });
}

}  // namespace slipcheck
