#include "harness/observe/gas_restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// What becomes of a body that nothing disturbs.
struct Slide {
  Vector3 velocity;  ///< v^s [m/s]
  double distance;   ///< s [m]
};

Slide slide_out(const Sphere& sphere, double deceleration, const BodyState& state) {
  const Vector3 u = slip_velocity(state, sphere.radius);
  const double one_plus_A = 1 + sphere.inverse_shape_factor();
  const Vector3 v = state.velocity - u / one_plus_A;
  const double time = deceleration > 0 ? u.norm() / (one_plus_A * deceleration) : 0;
  return {v, 0.5 * (state.velocity + v).norm() * time};
}

}  // namespace

GasRestitution::GasRestitution(const Scene& scene, std::size_t collisions_in_window,
                               double resting_slip)
    : scene_(&scene),
      window_(collisions_in_window),
      resting_slip_(resting_slip),
      way_(scene.bodies.size(), 0),
      following_(scene.bodies.size(), kNone) {}

bool GasRestitution::slides(const Frame& frame, std::size_t i) const {
  return slip_velocity(frame.bodies[i], scene_->bodies[i].radius).norm() > resting_slip_;
}

void GasRestitution::end(Followed& collision, const Frame& frame, bool interrupted) {
  const Vector3 dv =
      frame.bodies[collision.first].velocity - frame.bodies[collision.second].velocity;
  collision.end = collision.n.dot(dv);
  collision.interrupted = interrupted;
  collision.ended = true;
  following_[collision.first] = following_[collision.second] = kNone;
}

void GasRestitution::start(double time, const Frame& frame, const Touch& touch) {
  const auto i = static_cast<std::size_t>(touch.first), j = static_cast<std::size_t>(touch.second);
  // What either body was still doing ends here, with the velocities before.
  for (const std::size_t body : {i, j})
    if (following_[body] != kNone) end(collisions_[following_[body]], before_, true);

  Followed collision;
  collision.time = time;
  collision.first = i;
  collision.second = j;
  collision.n =
      scene_->to_nearest_image(frame.bodies[i].position - frame.bodies[j].position).normalized();
  collision.before = collision.n.dot(before_.bodies[i].velocity - before_.bodies[j].velocity);
  collision.after = collision.n.dot(frame.bodies[i].velocity - frame.bodies[j].velocity);
  const auto left_alone = [&](std::size_t body) {
    return slide_out(scene_->bodies[body],
                     scene_->on_substrate(body).kinetic_friction * scene_->gravity,
                     frame.bodies[body]);
  };
  const Slide one = left_alone(i), other = left_alone(j);
  collision.isolated = collision.n.dot(one.velocity - other.velocity);
  collision.sliding_distance = 0.5 * (one.distance + other.distance);
  collision.free_path = 0.5 * (way_[i] + way_[j]);
  way_[i] = way_[j] = 0;
  following_[i] = following_[j] = collisions_.size();
  open_.push_back(collisions_.size());
  collisions_.push_back(collision);
}

void GasRestitution::take(double time, const Frame& frame) {
  if (!before_.bodies.empty())
    for (std::size_t i = 0; i < way_.size(); ++i)
      way_[i] += (frame.bodies[i].position - before_.bodies[i].position).norm();
  for (const Touch& touch : frame.touches)
    if (is_body(touch.second) && !before_.bodies.empty()) start(time, frame, touch);
  std::erase_if(open_, [&](std::size_t k) {
    Followed& collision = collisions_[k];
    if (!collision.ended && !slides(frame, collision.first) && !slides(frame, collision.second))
      end(collision, frame, false);
    return collision.ended;
  });
  before_.bodies = frame.bodies;
}

std::vector<GasWindow> GasRestitution::windows() const {
  std::vector<GasWindow> windows;
  for (std::size_t begin = 0; begin + window_ <= collisions_.size(); begin += window_) {
    GasWindow w;
    double before = 0, after = 0, isolated = 0, effective = 0;
    for (std::size_t k = begin; k < begin + window_; ++k) {
      const Followed& c = collisions_[k];
      if (!c.ended) continue;
      ++w.collisions;
      w.time += c.time;
      before -= c.before;
      after += c.after;
      isolated += c.isolated;
      effective += c.end;
      w.sliding_distance += c.sliding_distance;
      w.free_path += c.free_path;
      w.uninterrupted += c.interrupted ? 0 : 1;
    }
    if (w.collisions < 2 || !(before > 0)) continue;
    const auto n = static_cast<double>(w.collisions);
    w.time /= n;
    w.restitution = after / before;
    w.isolated = isolated / before;
    w.effective = effective / before;
    w.sliding_distance /= n;
    w.free_path /= n;
    w.uninterrupted /= n;
    // Of a ratio of two means, with what each collision leaves over.
    double square = 0;
    for (std::size_t k = begin; k < begin + window_; ++k) {
      const Followed& c = collisions_[k];
      if (!c.ended) continue;
      const double rest = c.end + w.effective * c.before;
      square += rest * rest;
    }
    w.effective_error = std::sqrt(square) / before;
    windows.push_back(w);
  }
  return windows;
}

}  // namespace slipcheck
