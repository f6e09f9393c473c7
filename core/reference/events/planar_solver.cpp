#include "reference/events/planar_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "physics/numbers.h"
#include "reference/events/rate_limit.h"

namespace slipcheck {

double planar_speed_scale(const Scene& scene, std::span<const BodyState> states) {
  double scale = scene.box && !scene.box->floor.is_still() ? scene.box->floor.largest_speed() : 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double radius = scene.bodies[i].radius;
    const double height = scene.box ? std::max(states[i].position.z() - radius, 0.0) : 0;
    scale = std::max({scale, states[i].velocity.norm(), radius * states[i].angular_velocity.norm(),
                      std::sqrt(2 * scene.gravity * height)});
  }
  return scale;
}

namespace {

LeastSpeeds least_speeds_in_plane(const Scene& scene, std::span<const BodyState> initial,
                                  const PlanarSettings& settings) {
  if (!scene.box) return {.rebound_fraction = settings.collapse_fraction};
  const double scale = planar_speed_scale(scene, initial);
  return {.rebound = settings.collapse_fraction * scale,
          .landing = settings.landing_fraction * scale};
}

}  // namespace

PlanarSolver::PlanarSolver(const Scene& scene, std::span<const BodyState> initial,
                           const PlanarSettings& settings)
    : scene_(&scene),
      settings_(settings),
      world_(scene, initial, least_speeds_in_plane(scene, initial, settings)),
      first_energy_(world_.energy_at(0)),
      first_momentum_(world_.momentum_at(0)) {
  assert(PlanarWorld::is_planar(scene, initial));
  choose_loop();
}

void PlanarSolver::choose_loop() {
  const PlanarFeatures has = PlanarWorld::features(*scene_);
  if (settings_.general || has.radii)
    loop_.emplace<General>(world_);
  else if (has.box)
    loop_.emplace<OneRadius>(world_);
  else if (has.spin)
    loop_.emplace<Plane>(world_);
  else
    loop_.emplace<SmoothPlane>(world_);
}

std::vector<std::string> PlanarSolver::left_out() const {
  return std::visit(
      []<class Chosen>(const Chosen&) {
        std::vector<std::string> out;
        if constexpr (!std::is_same_v<Chosen, std::monostate>) {
          constexpr PlanarFeatures kHas = Chosen::kFeatures;
          if (!kHas.box) out.push_back("gravity and walls");
          if (!kHas.radii) out.push_back("different radii");
          if (!kHas.spin) out.push_back("friction and spin");
        }
        return out;
      },
      loop_);
}

std::vector<std::string> PlanarSolver::features() const {
  std::vector<std::string> features = {scene_->box ? "bodies on parabolas between walls"
                                                   : "bodies on straight lines in a plane"};
  for (const std::string& left : left_out()) features.push_back("without " + left);
  return features;
}

/// On a plane: nothing slides, or nothing moves, as nothing else will then either.
bool PlanarSolver::has_ended(Run::Until until) const {
  if (until == Run::Until::time || scene_->box) return false;
  return std::ranges::all_of(states(), [&](const BodyState& state) {
    return state.velocity.isZero(0) &&
           (until == Run::Until::rolling || state.angular_velocity.isZero(0));
  });
}

SolvedRun PlanarSolver::run(const RunEnd& end, FrameSink* sink) {
  return std::visit(
      [&]<class Chosen>(Chosen& chosen) {
        if constexpr (std::is_same_v<Chosen, std::monostate>)
          return SolvedRun{};
        else
          return run(chosen.scheduler, end, sink);
      },
      loop_);
}

template <class Scheduler>
SolvedRun PlanarSolver::run(Scheduler& scheduler, const RunEnd& end, FrameSink* sink) {
  SolvedRun run;
  const double last = end.last();
  // Looked at over so many events that no harmless burst of collisions counts.
  RateLimit rate(settings_.most_events, world_.size(), 1000 * world_.size() + 1'000'000, now_);
  const double interval = end.sample_interval;
  double samples = interval > 0 ? std::floor(now_ / interval) : 0;
  double next_sample = now_, shown = now_;
  world_.set_sink(scene_->box || interval > 0 ? nullptr : sink);
  run.reached = true;
  bool goes_on = !has_ended(end.until);
  if (!goes_on && sink) world_.show(now_, *sink);
  while (goes_on) {
    const double next = scheduler.next_time();
    while (sink && next_sample <= std::min(next, last)) {
      world_.show(shown = next_sample, *sink);
      next_sample = interval > 0 ? ++samples * interval : kNever;
    }
    goes_on = next <= last;
    if (!goes_on) {
      if (std::isfinite(last)) now_ = last;
      run.stop_at_limit(end.until);
      break;
    }
    scheduler.step();
    now_ = scheduler.now();
    ++run.events;
    if (rate.is_exceeded(now_)) {
      run.reached = false;
      run.reason = rate.reason(now_);
      break;
    }
  }
  world_.set_sink(nullptr);
  run.end_time = now_;
  if (sink && shown < now_) world_.show(now_, *sink);

  run.collisions = world_.collisions();
  if (!scene_->box) run.events = run.collisions;  // to cross from cell to cell is none
  run.collapses = world_.collapses();
  run.contacts = world_.contacts();
  run.balance = {world_.energy_at(now_), first_energy_, world_.dissipated(), world_.work()};
  run.balance->scale = std::abs(first_energy_) + std::abs(world_.work()) + world_.dissipated();
  double mass = 0;
  for (const Sphere& sphere : scene_->bodies) mass += sphere.mass;
  Vector2 given = world_.wall_impulse();
  if (scene_->box) given.y() -= mass * scene_->gravity * now_;
  const double passed_on =
      mass * planar_speed_scale(*scene_, scene_->initial) + world_.wall_impulse().norm();
  run.momentum_error =
      passed_on > 0 ? (world_.momentum_at(now_) - first_momentum_ - given).norm() / passed_on : 0;
  return run;
}

std::vector<BodyState> PlanarSolver::states() const {
  std::vector<BodyState> states(world_.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = world_.state_at(i, now_);
  return states;
}

}  // namespace slipcheck
