#include "harness/run/engine_state.h"

#include <fmt/format.h>

namespace slipcheck {

std::string fault_of_state(const Frame& frame, double time, double fastest, double times) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const BodyState& s = frame.bodies[i];
    if (!s.position.allFinite() || !s.velocity.allFinite() || !s.angular_velocity.allFinite())
      return fmt::format("body {} has a state that is not finite at t = {:.6g} s", i, time);
    if (s.velocity.norm() > times * fastest)
      return fmt::format(
          "body {} moves at {:.3g} m/s at t = {:.6g} s, {} times faster than anything in the scene",
          i, s.velocity.norm(), time, times);
  }
  return {};
}

}  // namespace slipcheck
