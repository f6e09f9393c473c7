#include "report/files/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace slipcheck {
namespace {

std::string lattice_keys(const Scenario& scenario, const RecordedMotion& motion) {
  const auto* substrate = std::get_if<Substrate>(&scenario.surroundings);
  if (!substrate || !substrate->periodic) return "pbc=\"F F F\"";
  double height = 0;
  for (const MotionFrame& frame : motion.frames)
    for (std::size_t i = 0; i < frame.bodies.size(); ++i)
      height = std::max(height, frame.bodies[i].position.z() + scenario.bodies[i].sphere.radius);
  const Vector2& cell = *substrate->periodic;
  return fmt::format("Lattice=\"{} 0 0 0 {} 0 0 0 {}\" pbc=\"T T F\"", cell.x(), cell.y(), height);
}

void add(std::string& text, const Vector3& vector) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", vector.x(), vector.y(), vector.z());
}

}  // namespace

std::string xyz_of(const Scenario& scenario, const RecordedMotion& motion) {
  const std::string lattice = lattice_keys(scenario, motion);
  std::string text;
  for (const MotionFrame& frame : motion.frames) {
    fmt::format_to(std::back_inserter(text),
                   "{}\n{} Properties=species:S:1:pos:R:3:velo:R:3:angular_velocity:R:3:radius:R:1 "
                   "Time={} Scene={} Role={} Units=SI\n",
                   frame.bodies.size(), lattice, frame.time, scenario.name, motion.role);
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const BodyState& body = frame.bodies[i];
      text += 'X';
      add(text, body.position);
      add(text, body.velocity);
      add(text, body.angular_velocity);
      fmt::format_to(std::back_inserter(text), " {}\n", scenario.bodies[i].sphere.radius);
    }
  }
  return text;
}

}  // namespace slipcheck
