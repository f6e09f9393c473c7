#include "studies/stability/rest_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

/// Of the scene's speed: what is faster does not creep but has taken another course, for the
/// observables to tell.
constexpr double kOtherCourse = 0.1;

/// The speed [m/s] up to which a body creeps.
double fastest_creep(const ReferencePath& path, double radius) {
  if (path.fastest(0) > 0) return kOtherCourse * path.fastest(0);
  const double falling = std::sqrt(path.scene().hard.gravity * radius);
  return falling > 0 ? kOtherCourse * falling : std::numeric_limits<double>::infinity();
}

}  // namespace

RestWatch::RestWatch(const ReferencePath& path, const OutcomeCriteria& criteria)
    : path_(&path), criteria_(criteria) {
  const auto& bodies = path.scene().hard.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Resting resting;
    resting.body = i;
    resting.from = path.rests_from(i);
    const double length = path.end() - resting.from;
    if (!(length > 0 && length >= criteria.least_rest * path.end())) continue;
    resting.late = resting.from + 0.5 * length;
    resting.slow = criteria.creep * bodies[i].radius / length;
    resting.fast = fastest_creep(path, bodies[i].radius);
    resting_.push_back(resting);
  }
}

void RestWatch::begin(double time, std::span<const BodyState> states) {
  for (Resting& resting : resting_) resting.stays = false;
  creep_ = creeps_at_ = 0;
  worst_ = 0;
  take(time, states);
}

void RestWatch::take(double time, std::span<const BodyState> states) {
  // What happens after the end of the reference's run it does not know.
  if (time > path_->end()) return;
  const Scene& hard = path_->scene().hard;
  for (Resting& resting : resting_) {
    if (time < resting.from) continue;
    const BodyState& state = states[resting.body];
    const Vector2 place = (state.position - hard.motion.position(time)).head<2>();
    const double over = (state.velocity - hard.motion.velocity(time)).norm();
    if (over > resting.slow && over > resting.fast) {
      resting.stays = false;
      continue;
    }
    if (!resting.stays) {
      if (time < resting.late && over > resting.slow) continue;
      resting.stays = true;
      resting.place = place;
    }
    const double creep = (place - resting.place).norm() / hard.bodies[resting.body].radius;
    if (creep <= creep_) continue;
    if (creep > criteria_.creep && creep_ <= criteria_.creep) creeps_at_ = time;
    creep_ = creep;
    worst_ = resting.body;
  }
}

PhaseOutcome RestWatch::outcome() const {
  if (creep_ <= criteria_.creep) return {};
  return {Outcome::drifting,
          fmt::format("body {} moves {:.3g} radii while it should rest", worst_, creep_),
          creeps_at_};
}

}  // namespace slipcheck
