#include <algorithm>
#include <cmath>

#include "reference/events/planar_world.h"

namespace slipcheck {

// What PlanarWorld shows of its bodies, in the scene's order and coordinates.

BodyState PlanarWorld::state_at(std::size_t body, double now) const {
  const std::uint32_t i = place_[body];
  const Body& b = bodies_[i];
  const double dt = now - b.time;
  const double x = b.x + b.vx * dt + matter_[i].image_x * grid_.period().x;
  const double y = b.y + (b.vy - 0.5 * gravity_ * dt) * dt + matter_[i].image_y * grid_.period().y;
  const double vy = b.vy - gravity_ * dt;
  if (upright_) return {{x, 0, y}, {b.vx, 0, vy}, {0, -matter_[i].spin, 0}};
  return {{x, y, radii_[i]}, {b.vx, vy, 0}, {0, 0, matter_[i].spin}};
}

void PlanarWorld::note_touch(std::uint32_t i, std::uint32_t j, const PlanarImpulse& impulse) {
  const auto [first, second] = std::minmax(body_at_[i], body_at_[j]);
  touches_.push_back({static_cast<int>(first), static_cast<int>(second),
                      std::hypot(impulse.normal, impulse.tangential)});
}

void PlanarWorld::show(double now, FrameSink& sink) {
  frame_.bodies.resize(size());
  for (std::size_t i = 0; i < size(); ++i) frame_.bodies[i] = state_at(i, now);
  frame_.touches = touches_;
  if (!upright_)
    for (std::size_t i = 0; i < size(); ++i) frame_.touches.push_back(substrate_touch(i));
  frame_.collisions = collisions_;
  sink.take(now, frame_);
}

/// The bodies of a collision, before it or after; all of them where more may yet be drawn in.
void PlanarWorld::show_changed(double now, bool is_all_known) {
  shown_.clear();
  states_.clear();
  frame_.touches = touches_;
  for (const std::uint32_t at : changed_) {
    const std::size_t i = shown_.emplace_back(body_at_[at]);
    states_.push_back(state_at(i, now));
    frame_.touches.push_back(substrate_touch(i));
  }
  const auto state_of = [this, now](std::size_t i) { return state_at(i, now); };
  if (!is_all_known || !sink_->take_partial(now, {shown_, states_, frame_.touches, state_of}))
    show(now, *sink_);
  touches_.clear();
}

}  // namespace slipcheck
