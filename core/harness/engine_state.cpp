#include "harness/engine_state.h"

#include <fmt/format.h>

namespace slipcheck {
namespace {

/// A body this many times faster than the scene can make it has been blown off.
constexpr double kExploded = 1e3;

}  // namespace

std::string fault_of_state(const Frame& frame, double time, double fastest) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const BodyState& s = frame.bodies[i];
    if (!s.position.allFinite() || !s.velocity.allFinite() || !s.angular_velocity.allFinite())
      return fmt::format("body {} has a state that is not finite at t = {:.6g} s", i, time);
    if (s.velocity.norm() > kExploded * fastest)
      return fmt::format(
          "body {} moves at {:.3g} m/s at t = {:.6g} s, {} times faster than anything in the scene",
          i, s.velocity.norm(), time, kExploded);
  }
  return {};
}

}  // namespace slipcheck
