#include "report/files/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace slipcheck {
namespace {

std::string lattice_keys(const Scenario& scenario, double top) {
  const auto* substrate = std::get_if<Substrate>(&scenario.surroundings);
  if (!substrate || !substrate->periodic) return "pbc=\"F F F\"";
  const Vector2& cell = *substrate->periodic;
  return fmt::format("Lattice=\"{} 0 0 0 {} 0 0 0 {}\" pbc=\"T T F\"", cell.x(), cell.y(), top);
}

void add(std::string& text, const Vector3& vector) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", vector.x(), vector.y(), vector.z());
}

}  // namespace

double top_of(const Scenario& scenario, const std::vector<BodyState>& bodies) {
  double top = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    top = std::max(top, bodies[i].position.z() + scenario.bodies[i].sphere.radius);
  return top;
}

std::string xyz_frame_of(const Scenario& scenario, double time,
                         const std::vector<BodyState>& bodies, const std::string& role,
                         double top) {
  std::string text = fmt::format(
      "{}\n{} Properties=species:S:1:pos:R:3:velo:R:3:angular_velocity:R:3:radius:R:1 "
      "Time={} Scene={} Role={} Units=SI\n",
      bodies.size(), lattice_keys(scenario, top), time, scenario.name, role);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyState& body = bodies[i];
    text += 'X';
    add(text, body.position);
    add(text, body.velocity);
    add(text, body.angular_velocity);
    fmt::format_to(std::back_inserter(text), " {}\n", scenario.bodies[i].sphere.radius);
  }
  return text;
}

std::string xyz_of(const Scenario& scenario, const RecordedMotion& motion) {
  double top = 0;
  for (const MotionFrame& frame : motion.frames)
    top = std::max(top, top_of(scenario, frame.bodies));
  std::string text;
  for (const MotionFrame& frame : motion.frames)
    text += xyz_frame_of(scenario, frame.time, frame.bodies, motion.role, top);
  return text;
}

}  // namespace slipcheck
