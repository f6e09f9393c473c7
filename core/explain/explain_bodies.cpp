#include <fmt/format.h>

#include <vector>

#include "explain/explain_parts.h"
#include "report/terminal/text.h"

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
    const double slip = (slip_velocity(state, s) - scene.motion.velocity(0)).norm();
    cells.push_back(quantity(slip > kRounding * speed ? slip : 0, kVelocity));
  }
  return cells;
}

}  // namespace

ExplainSection explain_bodies(const Scenario& scenario, const Scene& scene) {
  ExplainSection section{
      .title = "Bodies",
      .label_width = 14,
      .columns = {{"R", 11}, {"m", 12}, {"I", 20}, {"A = mR²/I", 12}, {"speed", 13}},
      .gap = 0};
  if (!scene.box) section.columns.push_back({"slip", 13});
  const std::size_t count = scene.bodies.size();
  std::size_t rows = 0, first = 0;
  for (; first < count && rows < kMostRows; ++rows) {
    const Cells cells = cells_of(scene, first);
    std::size_t last = first;
    while (last + 1 < count && cells_of(scene, last + 1) == cells) ++last;
    const std::string& name = scenario.bodies[first].name;
    const std::string names = last == first ? name : name + " … " + scenario.bodies[last].name;
    section.rows.push_back({shortened(names, section.label_width), cells, {}});
    first = last + 1;
  }
  if (first < count) section.add(fmt::format("and {} more", count - first));
  return section;
}

}  // namespace slipcheck
