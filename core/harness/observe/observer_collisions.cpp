#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/observe/observer.h"
#include "reference/initial_contacts.h"

namespace slipcheck {
namespace {

std::size_t index(int body) { return static_cast<std::size_t>(body); }

/// Velocity of the first body at the contact point relative to the second; n from the second.
Vector3 contact_velocity(const Sphere& a, const BodyState& sa, const Sphere& b, const BodyState& sb,
                         const Vector3& n) {
  return sa.velocity - sb.velocity -
         (a.radius * sa.angular_velocity + b.radius * sb.angular_velocity).cross(n);
}

}  // namespace

Vector3 Observer::apart(const BodyState& a, const BodyState& b) const {
  return scene_->to_nearest_image(a.position - b.position);
}

auto Observer::second_of(const Pair& pair, double t, const std::vector<BodyState>& states) const
    -> Side {
  if (is_body(pair.second)) return {scene_->bodies[index(pair.second)], states[index(pair.second)]};
  // A point of infinite mass.
  const NearestPoint near = nearest(pair.second, t, states[index(pair.first)]);
  BodyState place;
  place.position = near.point;
  place.velocity =
      pair.second == kSubstrate
          ? scene_->motion.velocity(t)
          : scene_->surfaces[touched_surface(pair.second)].motion.velocity(t, near.point);
  return {{0, std::numeric_limits<double>::infinity()}, place};
}

double Observer::overlap(const Pair& pair, double t, const std::vector<BodyState>& states) const {
  const Side second = second_of(pair, t, states);
  return scene_->bodies[index(pair.first)].radius + second.sphere.radius -
         apart(states[index(pair.first)], second.state).norm();
}

std::size_t Observer::pair_of(int first, int second) {
  const auto [known, is_new] = pair_numbers_.try_emplace(pair_key(first, second), pairs_.size());
  if (is_new) {
    Pair& pair = pairs_.emplace_back();
    pair.first = first;
    pair.second = second;
  }
  return known->second;
}

/// Bodies that overlap in the first frame, which have no approach.
void Observer::begin_overlaps(double time, const Frame& frame) {
  for (const auto& [i, j, overlap] : overlapping_pairs(*scene_, frame.bodies)) {
    const BodyState &si = frame.bodies[i], &sj = frame.bodies[j];
    touching_.push_back(pair_of(static_cast<int>(i), static_cast<int>(j)));
    Pair& pair = pairs_[touching_.back()];
    pair.touched_now = pair.colliding = pair.from_start = true;
    pair.n = (si.position - sj.position).normalized();
    pair.approach = kNotObserved;
    const Vector3 u = contact_velocity(scene_->bodies[i], si, scene_->bodies[j], sj, pair.n);
    pair.tangential = u - pair.n.dot(u) * pair.n;
    pair.begin_time = time;
    pair.max_overlap = overlap;
    pair.slid_before = bodies_[i].sliding || bodies_[j].sliding;
    for (std::size_t k : {i, j}) {
      bodies_[k].collision_begin = time;
      bodies_[k].collision_height = frame.bodies[k].position.z();
    }
  }
}

void Observer::note_touches(double t0, double t1, const Frame& frame) {
  settling_.clear();
  for (const std::size_t k : touching_) {
    pairs_[k].touched_before = true;
    pairs_[k].touched_now = false;
  }
  for (const Touch& touch : frame.touches) {
    const bool carries =
        touch.second == (on_surfaces_ ? bodies_[index(touch.first)].base : kSubstrate);
    if (carries) continue;
    const std::size_t number = pair_of(touch.first, touch.second);
    Pair& pair = pairs_[number];
    if (!pair.touched_before && !pair.touched_now) touching_.push_back(number);
    // Where its law does not act the contact has not begun anew when it acts again.
    if (touch.normal_impulse == 0)
      pair.touched_now = true;
    else
      note_collision(pair, touch, t0, t1, frame);
  }
  std::erase_if(touching_, [&](std::size_t k) {
    Pair& pair = pairs_[k];
    pair.touched_before = false;
    if (pair.touched_now) return false;
    pair.colliding = pair.from_start = false;
    settling_.push_back(k);
    return true;
  });
}

bool Observer::continues_or_begins(Pair& pair, const Touch& touch, double t0, double t1,
                                   const Frame& frame) {
  pair.touched_now = true;
  // The reference's contact is a collision or none from its beginning on.
  if ((step_ == 0 || pair.from_start) && pair.touched_before) return pair.colliding;

  const std::size_t i = index(pair.first);
  const BodyState& si = last_.bodies[i];
  const Sphere& a = scene_->bodies[i];
  const auto [b, sj] = second_of(pair, t0, last_.bodies);
  const Vector3 n = apart(si, sj).normalized();
  const double approach = -n.dot(si.velocity - sj.velocity);

  const double weakest = std::max(kOfPairsFastest * pair.fastest, kOfSceneSpeed * closing_scale_);
  // A blow that passes through a row of bodies in one step finds this pair without an approach;
  // what sliding bodies that lean on each other push in a step is none.
  const double blow = 0.5 * touch.normal_impulse * (1 / a.mass + 1 / b.mass);
  const auto rubs = [&](int k) {
    return is_body(k) ? scene_->on_substrate(index(k)).kinetic_friction : 0;
  };
  const double leaning =
      ((rubs(pair.first) + rubs(pair.second)) * scene_->gravity + scene_->downhill.norm()) * step_;
  const double least_blow = weakest + leaning;
  const bool collides = approach > weakest || (step_ > 0 && blow > least_blow);
  if (pair.colliding) {
    // One that lasts is at its deepest when it neither closes nor parts, and pushes most; bodies
    // that rest on each other push and go no faster. Of a contact that lasts here and in the
    // reference what pushes while they part belongs to it, however little.
    const double parting =
        n.dot(frame.bodies[i].velocity - second_of(pair, t1, frame.bodies).state.velocity);
    const double lasted = pair.end_time - pair.begin_time;
    const double steady = kOfMeanForce * pair.blows / lasted * (t1 - t0);
    const bool lasts = resolved_ && lasted > 2.5 * (t1 - t0);
    if (collides || (lasts && -approach > weakest) || 0.5 * (parting + approach) > steady) {
      pair.blows += blow;
      return true;
    }
    // What else acts may outweigh the push of a slow one, but not for as long as it has lasted.
    pair.colliding = t1 - pair.end_time < lasted;
    return false;
  }
  if (!collides) return false;

  pair.colliding = true;
  pair.n = n;
  pair.approach = approach > weakest ? approach : kNotObserved;
  pair.fastest = std::max({pair.fastest, approach, blow > least_blow ? blow : 0});
  pair.blows = blow;
  const Vector3 u = contact_velocity(a, si, b, sj, n);
  pair.tangential = u - n.dot(u) * n;
  pair.begin_time = t0;
  pair.max_overlap = std::max(0.0, overlap(pair, t0, last_.bodies));
  pair.slid_before = false;
  pair.sliding_onset = kNotObserved;
  for_bodies_of(pair, [&](std::size_t k) {
    pair.slid_before = pair.slid_before || bodies_[k].sliding;
    bodies_[k].collision_begin = t0;
    bodies_[k].collision_height = level(bodies_[k], last_.bodies[k]);
  });
  return true;
}

/// What a collision shows that lasts.
void Observer::resolve(Pair& pair, double t0, double t1, const Frame& frame) {
  pair.contact_time = t1 - pair.begin_time;
  pair.max_overlap = std::max(pair.max_overlap, overlap(pair, t1, frame.bodies));
  if (pair.slid_before || !std::isnan(pair.sliding_onset)) return;
  for_bodies_of(pair, [&](std::size_t k) {
    if (on_surfaces_) look_at_ground_of(k, t0, t1, frame.bodies[k]);
    if (touches_substrate(k, t1, frame) && !slips(k, last_.bodies[k], ground0_) &&
        slips(k, frame.bodies[k], ground1_))
      pair.sliding_onset = t0 - pair.begin_time;
  });
}

void Observer::note_collision(Pair& pair, const Touch& touch, double t0, double t1,
                              const Frame& frame) {
  if (!continues_or_begins(pair, touch, t0, t1, frame)) return;
  if (resolved_) resolve(pair, t0, t1, frame);

  const std::size_t i = index(pair.first);
  const Sphere& a = scene_->bodies[i];
  const BodyState& after_i = frame.bodies[i];
  const auto [b, after_j] = second_of(pair, t1, frame.bodies);
  // The line of centres turns while a contact lasts; an engine's instant has the one before it.
  const Vector3 tangential = pair.tangential;
  Vector3 direction = tangential;
  if (t1 > pair.begin_time && (step_ == 0 || (resolved_ && t0 > pair.begin_time))) {
    const Vector3 line = apart(after_i, after_j).normalized();
    // Soft bodies may pass through each other: that is no rebound.
    pair.n = line.dot(pair.n) < 0 ? Vector3(-line) : line;
    direction -= pair.n.dot(direction) * pair.n;
    if (direction.squaredNorm() > 0) direction *= tangential.norm() / direction.norm();
  }
  pair.collided = true;
  pair.end_time = t1;
  const double parting = pair.n.dot(after_i.velocity - after_j.velocity);
  pair.restitution = parting / pair.approach;
  // What comes later is weighed against what it began with.
  if (pair.from_start) pair.fastest = std::max(pair.fastest, parting);
  const double before2 = tangential.squaredNorm();
  pair.tangential_restitution =
      std::sqrt(before2) > kEngineNoise * speed_scale_
          ? contact_velocity(a, after_i, b, after_j, pair.n).dot(direction) / before2
          : kNotObserved;
  pair.effective = kNotObserved;
  // A body that collides again never shows what its earlier collision would have come to.
  for_bodies_of(pair, [&](std::size_t k) {
    if (bodies_[k].last_pair != kNone) pairs_[bodies_[k].last_pair].awaits_rolling = false;
    bodies_[k].last_pair = static_cast<std::uint32_t>(&pair - pairs_.data());
  });
  pair.awaits_rolling = true;
  for_bodies_of(pair, [&](std::size_t k) {
    Body& body = bodies_[k];
    if (on_surfaces_) look_at_ground_of(k, t0, t1, frame.bodies[k]);
    body.collided = body.collided_now = true;
    body.away = k == i ? pair.n : Vector3(-pair.n);
    body.after = frame.bodies[k];
    body.slip_after = slip_of(k, body.after, ground1_);
    body.origin_time = t1;
    body.origin = position_over(body.after, ground1_);
    body.slide_time = 0;
    body.slide.setZero();
    body.slide_end = t1;
    body.rolling_velocity = kVectorNotObserved;
    body.stop_time = body.spin_stop_time = kNotObserved;
    body.resting = false;
    body.spun = std::abs(spin(body, frame.bodies[k])) > body.zero.spin;
    body.spinning = body.spun;
    body.jumping = false;
    body.lift_off_speed = body.flight_time = kNotObserved;
  });
}

bool Observer::anything_collides() const {
  // What overlaps from the start on may stay so for good.
  return std::ranges::any_of(
      touching_, [this](std::size_t k) { return pairs_[k].colliding && !pairs_[k].from_start; });
}

void Observer::end_collisions() {
  for (const std::size_t k : touching_) pairs_[k].colliding = pairs_[k].from_start = false;
  for (Pair& pair : pairs_)
    if (has_settled(pair)) settle_effective_restitution(pair, time_, time_, last_);
}

bool Observer::has_settled(const Pair& pair) const {
  if (!pair.awaits_rolling || pair.colliding) return false;
  bool all_roll = true;
  for_bodies_of(pair, [&](std::size_t k) { all_roll = all_roll && rolls(bodies_[k]); });
  return all_roll;
}

void Observer::settle_effective_restitution(Pair& pair, double t0, double t1, const Frame& frame) {
  double both = -std::numeric_limits<double>::infinity();
  for_bodies_of(pair, [&](std::size_t k) { both = std::max(both, bodies_[k].slide_end); });
  const auto velocity_then = [&](int k) -> Vector3 {
    const std::size_t i = index(k);
    const Body& body = bodies_[i];
    const Vector3& now = frame.bodies[i].velocity;
    // A slide's end is a kink; after it the body goes on as it rolls.
    const bool kink = body.slide_end > t0;
    if (body.slide_end == both || (kink && both >= t1)) return body.rolling_velocity;
    if (t1 <= t0 || both <= time_before_ || both >= t1) return now;
    const double begin = kink ? body.slide_end : t0;
    const Vector3& before = kink ? body.rolling_velocity : last_.bodies[i].velocity;
    return before + (both - begin) / (t1 - begin) * (now - before);
  };
  const Vector3 other = is_body(pair.second) ? velocity_then(pair.second)
                                             : second_of(pair, both, frame.bodies).state.velocity;
  const Vector3 dv = velocity_then(pair.first) - other;
  pair.effective = pair.n.dot(dv) / pair.approach;
  pair.awaits_rolling = false;
}

}  // namespace slipcheck
