#include "app/explain/explain_bodies.h"

#include <fmt/format.h>

#include <vector>

#include "app/explain/explain_rows.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostRows = 20;
constexpr double kRounding = 1e-12;  ///< of the speed: slip below it is none

using Cells = std::vector<std::string>;

Cells cells_of(const Scene& scene, std::size_t i) {
  const Sphere& s = scene.bodies[i];
  const BodyState& state = scene.initial[i];
  const double speed = state.velocity.norm();
  Cells cells{quantity(s.radius, kLength), quantity(s.mass, kMass),
              in_unit(s.moment_of_inertia(), "kg m²"),
              fmt::format("{:.4g}", s.inverse_shape_factor()), quantity(speed, kVelocity)};
  if (!scene.box) {
    const double slip = (slip_velocity(state, s.radius) - scene.motion.velocity(0)).norm();
    cells.push_back(quantity(slip > kRounding * speed ? slip : 0, kVelocity));
  }
  return cells;
}

void print_cells(const std::string& name, const Cells& cells) {
  constexpr std::size_t kWidths[] = {11, 12, 20, 12, 13, 13};
  std::string line = padded(shortened(name, 14), 14);
  for (std::size_t c = 0; c < cells.size(); ++c) line += padded(cells[c], kWidths[c], true);
  fmt::print("    {}\n", line);
}

}  // namespace

void explain_bodies(const Scenario& scenario, const Scene& scene) {
  fmt::print("\n  Bodies\n");
  Cells head{"R", "m", "I", "A = mR²/I", "speed"};
  if (!scene.box) head.emplace_back("slip");
  print_cells("", head);
  const std::size_t count = scene.bodies.size();
  std::size_t rows = 0, first = 0;
  for (; first < count && rows < kMostRows; ++rows) {
    const Cells cells = cells_of(scene, first);
    std::size_t last = first;
    while (last + 1 < count && cells_of(scene, last + 1) == cells) ++last;
    const std::string& name = scenario.bodies[first].name;
    print_cells(last == first ? name : name + " … " + scenario.bodies[last].name, cells);
    first = last + 1;
  }
  if (first < count) fmt::print("    and {} more\n", count - first);
}

}  // namespace slipcheck
