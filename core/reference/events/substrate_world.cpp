#include "reference/events/substrate_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/contact/collision.h"
#include "physics/numbers.h"
#include "physics/safe_root.h"
#include "reference/events/cluster.h"
#include "reference/events/path_collision.h"

namespace slipcheck {
namespace {

/// Collisions that do not dissipate, as the TC model has them.
const PairContact kElastic{};
/// Part of the sum of two radii that no pair which touches is apart: a search for a collision that
/// gives up does so farther away.
constexpr double kTouching = 1e-9;

}  // namespace

template <class Phase, class Near>
SubstrateWorld<Phase, Near>::SubstrateWorld(const Scene& scene, std::span<const BodyState> initial,
                                            const LeastSpeeds& least, double now)
    : scene_(&scene),
      least_(least),
      near_(scene, initial),
      bodies_(initial.size()),
      phases_(initial.size()),
      partial_(kShowsPart ? initial.size() : 0) {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    BodyState state = initial[i];
    const Sphere& sphere = scene.bodies[i];
    bodies_[i].radius = sphere.radius;
    const bool touches = state.position.z() <= sphere.radius * (1 + 4 * kEpsilon);
    if (touches && state.velocity.z() < 0 && !scene.confined) land_body(i, state, now);
    set_state(i, state, now);
  }
}

template <class Phase, class Near>
Phase SubstrateWorld<Phase, Near>::phase_of(std::uint32_t i, const BodyState& state,
                                            double now) const {
  const Scene& scene = *scene_;
  if constexpr (kIsStill)
    return Phase(scene.bodies[i], scene.on_substrate(i), scene.gravity, state, scene.confined);
  else
    return Phase(scene.bodies[i], scene.on_substrate(i), scene.gravity, scene.downhill,
                 scene.motion, now, state, scene.confined);
}

template <class Phase, class Near>
Vector3 SubstrateWorld<Phase, Near>::substrate_velocity(double now) const {
  if constexpr (kIsStill)
    return Vector3::Zero();
  else
    return scene_->motion.velocity(now);
}

template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::count(std::uint32_t i, bool is_there) {
  const Kind kind = phases_[i].kind();
  const std::size_t slips = kind == Kind::flying || kind == Kind::sliding ? 1 : 0;
  const std::size_t moves = bodies_[i].is_at_rest ? 0 : 1;
  slipping_ = is_there ? slipping_ + slips : slipping_ - slips;
  moving_ = is_there ? moving_ + moves : moving_ - moves;
}

template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::set_state(std::uint32_t i, BodyState state, double now) {
  if constexpr (kHasCells) near_.start_path(i, state.position);
  Body& body = bodies_[i];
  count(i, false);
  Phase& phase = phases_[i];
  phase = phase_of(i, state, now);
  const BodyState& start = phase.start();
  body.position = start.position;
  body.velocity = start.velocity;
  body.start = now;
  body.end = now + phase.duration();
  body.is_parabola = phase.is_parabola();
  body.is_at_rest = phase.is_at_rest();
  body.acceleration = body.is_parabola ? phase.acceleration() : Vector3::Zero();
  if (!body.is_parabola) {
    if constexpr (kIsStill)
      body.bound =
          scene_->gravity * scene_->on_substrate(i).rolling.largest_up_to(start.velocity.norm());
    else
      body.bound = phase.largest_acceleration();
  } else {
    body.bound = body.acceleration.norm();
  }
  count(i, true);
}

template <class Phase, class Near>
PathPoint SubstrateWorld<Phase, Near>::on_path(std::uint32_t i, double now) const {
  const Body& body = bodies_[i];
  const double t = now - body.start;
  if (body.is_parabola)
    return {body.position + t * (body.velocity + (0.5 * t) * body.acceleration),
            body.velocity + t * body.acceleration};
  const BodyState state = phases_[i].at(t);
  return {state.position, state.velocity};
}

template <class Phase, class Near>
BodyState SubstrateWorld<Phase, Near>::state_at(std::uint32_t i, double now) const {
  BodyState state = path_state(i, now);
  if constexpr (kHasCells) near_.unfold(i, state.position);
  return state;
}

template <class Phase, class Near>
double SubstrateWorld<Phase, Near>::own_event_time(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  if constexpr (kHasCells) {
    const PathPoint at = on_path(i, now);
    double after;
    if (body.is_parabola)
      after = near_.time_to_leave(i, at.position, at.velocity, body.acceleration);
    else  // rolling on a still plane a body keeps to a line and never gets faster
      after = near_.least_time_to_leave(i, at.position, at.velocity, kIsStill ? 0 : body.bound);
    body.leaves_cell = now + after < body.end;
    if (body.leaves_cell) return now + after;
  }
  return body.end;
}

template <class Phase, class Near>
BodyChange SubstrateWorld<Phase, Near>::do_own_event(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  if constexpr (kHasCells) {
    if (body.leaves_cell) {
      if (!body.is_parabola && !near_.is_at_side(i, on_path(i, now).position))
        return BodyChange::nothing;
      near_.cross(i);
      return BodyChange::cell;
    }
  }
  ++events_;
  BodyState state = phases_[i].at_end();
  const std::array<std::uint32_t, 1> changed = {i};
  if (phases_[i].kind() == Kind::flying) {
    show_changed(changed, now);
    last_impact_speed_ = -state.velocity.z();
    land_body(i, state, now);
    if (sink_ && state.velocity.z() > 0) frame_.touches.push_back(substrate_touch(i));
    ++landings_;
  }
  set_state(i, state, now);
  show_changed(changed, now);
  return BodyChange::path;
}

template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::land_body(std::uint32_t i, BodyState& state, double now) {
  const Vector3 frame = substrate_velocity(now);
  state.velocity -= frame;
  land(scene_->bodies[i], scene_->on_substrate(i), least_.landing, state);
  state.velocity += frame;
}

template <class Phase, class Near>
double SubstrateWorld<Phase, Near>::collision_time(std::uint32_t i, std::uint32_t j, double now,
                                                   const CellGrid::Shift& shift) const {
  const Body& a = bodies_[i];
  const Body& b = bodies_[j];
  if (a.is_at_rest && b.is_at_rest) return kNever;
  // The phases' own ends may come a rounding error late; a collision there must not be lost.
  const double end = std::min(a.end, b.end);
  const double horizon = end - now + 4 * kEpsilon * (std::isfinite(end) ? end : 0);
  if (!a.is_parabola || !b.is_parabola) return least_time_to_touch(i, j, now, horizon, shift);
  const PathPoint at_a = on_path(i, now), at_b = on_path(j, now);
  Vector3 dx = at_a.position - at_b.position;
  if constexpr (kHasCells) {
    dx.x() -= shift.x;
    dx.y() -= shift.y;
  }
  return now + time_to_touch(dx, at_a.velocity - at_b.velocity, a.acceleration - b.acceleration,
                             a.radius + b.radius, horizon);
}

/// The same where a path is not a parabola.
template <class Phase, class Near>
double SubstrateWorld<Phase, Near>::least_time_to_touch(std::uint32_t i, std::uint32_t j,
                                                        double now, double horizon,
                                                        const CellGrid::Shift& shift) const {
  const auto apart = [&](double t) {
    const PathPoint at_a = on_path(i, now + t), at_b = on_path(j, now + t);
    Vector3 dx = at_a.position - at_b.position;
    if constexpr (kHasCells) {
      dx.x() -= shift.x;
      dx.y() -= shift.y;
    }
    return std::pair<Vector3, Vector3>(dx, at_a.velocity - at_b.velocity);
  };
  return now + stepping_time_to_touch(apart, bodies_[i].bound + bodies_[j].bound,
                                      bodies_[i].radius + bodies_[j].radius, horizon);
}

/// What leads from x_j to the image of it that is near x_i.
template <class Phase, class Near>
Vector3 SubstrateWorld<Phase, Near>::to_near(const Vector3& x_i, const Vector3& x_j) const {
  if constexpr (kHasCells) {
    const CellGrid::Shift shift = near_.nearest_image(x_i, x_j);
    return {shift.x, shift.y, 0};
  } else {
    return Vector3::Zero();
  }
}

template <class Phase, class Near>
std::span<const std::uint32_t> SubstrateWorld<Phase, Near>::collide(std::uint32_t i,
                                                                    std::uint32_t j, double now) {
  changed_.assign({std::min(i, j), std::max(i, j)});
  states_.clear();
  for (std::uint32_t k : changed_) states_.push_back(path_state(k, now));
  if (!bodies_[i].is_parabola || !bodies_[j].is_parabola) {
    const Vector3 &x = states_[0].position, &y = states_[1].position;
    const double contact = bodies_[i].radius + bodies_[j].radius;
    if ((x - y - to_near(x, y)).norm() > (1 + kTouching) * contact) return changed_;
  }
  ++events_;
  const bool is_quick = is_in_quick_succession(i, now) || is_in_quick_succession(j, now);
  const bool is_cluster =
      is_quick && scene_->collapse.model == CollapseRule::Model::largest_velocity;
  show_changed(changed_, now, !is_cluster);
  if (is_cluster) {
    ++collapses_;
    resolve_cluster(now);
  } else {
    exchange_impulse(0, 1, is_quick, now);
    if (is_quick || was_altered_) ++collapses_;
  }
  for (std::size_t k = 0; k < changed_.size(); ++k) {
    bodies_[changed_[k]].last_collision = now;
    set_state(changed_[k], states_[k], now);
  }
  show_changed(changed_, now);
  return changed_;
}

template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::exchange_impulse(std::size_t first, std::size_t second,
                                                   bool elastic, double now) {
  const std::uint32_t i = changed_[first], j = changed_[second];
  BodyState &of_i = states_[first], &of_j = states_[second];
  // Next to each other, and seen from the substrate, which has a part in it.
  const Vector3 image = to_near(of_i.position, of_j.position);
  const Vector3 frame = substrate_velocity(now);
  of_j.position += image;
  of_i.velocity -= frame;
  of_j.velocity -= frame;
  const auto is_supported = [&](std::uint32_t k, const BodyState& state) {
    return phases_[k].is_supported() && state.velocity.z() <= 0;
  };
  const CollisionRule rule{scene_->confined, slowest_rebound(i, j)};
  const CollidingBody a{scene_->bodies[i], scene_->on_substrate(i), of_i, is_supported(i, of_i)};
  const CollidingBody b{scene_->bodies[j], scene_->on_substrate(j), of_j, is_supported(j, of_j)};
  const CollisionResult result =
      elastic ? slipcheck::collide(kElastic, rule, a, b) : scene_->collide(i, j, rule, a, b);
  of_j.position -= image;
  of_i.velocity += frame;
  of_j.velocity += frame;
  ++collisions_;
  last_impact_speed_ = result.impact_speed;
  for (const std::uint32_t k : {i, j})
    bodies_[k].hardest_impact = std::max(bodies_[k].hardest_impact, result.impact_speed);
  was_altered_ = result.altered;
  if (!sink_) return;
  frame_.touches.push_back({static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j)),
                            std::max(result.impulse.norm(), 1e-300)});
  if constexpr (kShowsPart) partial_.note_collision(i, j);
}

/// Bodies that would touch each other within the contact time collide at once.
template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::resolve_cluster(double now) {
  const double soon = now + scene_->collapse.contact_time;
  std::vector<std::array<std::uint32_t, 2>> pairs{{0, 1}};
  for (std::uint32_t k = 0; k < changed_.size(); ++k) {
    const std::uint32_t a = changed_[k];
    near_.for_each_near(a, [&](std::uint32_t b, const CellGrid::Shift& shift) {
      if (!(collision_time(a, b, now, shift) < soon)) return;
      const auto known = std::ranges::find(changed_, b);
      const auto place = static_cast<std::uint32_t>(known - changed_.begin());
      if (known == changed_.end()) {
        changed_.push_back(b);
        states_.push_back(path_state(b, now));
      }
      pairs.push_back({std::min(k, place), std::max(k, place)});
    });
  }
  const auto approach = [&](const std::array<std::uint32_t, 2>& pair) {
    const BodyState &a = states_[pair[0]], &b = states_[pair[1]];
    const Vector3 dx = a.position - b.position - to_near(a.position, b.position);
    return -dx.normalized().dot(a.velocity - b.velocity);
  };
  const auto slowest = [&](const std::array<std::uint32_t, 2>& pair) {
    return slowest_rebound(changed_[pair[0]], changed_[pair[1]]);
  };
  collide_cluster(pairs, approach, slowest,
                  [&](std::uint32_t a, std::uint32_t b) { exchange_impulse(a, b, false, now); });
}

/// That the body touches the substrate; frames of the reference do not say how hard.
template <class Phase, class Near>
Touch SubstrateWorld<Phase, Near>::substrate_touch(std::uint32_t i) const {
  return {static_cast<int>(i), kSubstrate, scene_->bodies[i].mass};
}

/// Shows the state of all bodies now; a touch that is already in the frame stays.
template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::show(double now) {
  if (!sink_) return;
  frame_.bodies.resize(bodies_.size());
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    frame_.bodies[i] = state_at(i, now);
    if (phases_[i].is_supported()) frame_.touches.push_back(substrate_touch(i));
  }
  sink_->take(now, frame_);
  frame_.touches.clear();
  partial_.note_whole();
}

template <class Phase, class Near>
void SubstrateWorld<Phase, Near>::show_changed(std::span<const std::uint32_t> changed, double now,
                                               bool is_all_known) {
  if (!sink_) return;
  if constexpr (kShowsPart) {
    const auto add_touch = [&](std::uint32_t i) {
      if (phases_[i].is_supported()) frame_.touches.push_back(substrate_touch(i));
    };
    if (is_all_known && partial_.show(
                            *sink_, changed, now, frame_.touches,
                            [&](std::uint32_t i) { return state_at(i, now); }, add_touch))
      return;
  }
  show(now);
}

template class SubstrateWorld<SubstratePhase, AllPairs>;
template class SubstrateWorld<SubstratePhase, PlaneCells>;
template class SubstrateWorld<DrivenPhase, AllPairs>;
template class SubstrateWorld<DrivenPhase, PlaneCells>;

}  // namespace slipcheck
