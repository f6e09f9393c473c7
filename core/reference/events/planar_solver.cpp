#include "reference/events/planar_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

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

PlanarSolver::PlanarSolver(const Scene& scene, std::span<const BodyState> initial,
                           const PlanarSettings& settings)
    : scene_(&scene),
      settings_(settings),
      world_(scene, initial, settings.collapse_fraction * planar_speed_scale(scene, initial),
             settings.landing_fraction * planar_speed_scale(scene, initial)),
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

void PlanarSolver::show(double time, FrameSink* sink) {
  if (!sink) return;
  frame_.bodies.resize(world_.size());
  for (std::size_t i = 0; i < world_.size(); ++i) frame_.bodies[i] = world_.state_at(i, time);
  sink->take(time, frame_);
}

PlanarRun PlanarSolver::run(const RunEnd& end, FrameSink* sink, double sample_interval) {
  return std::visit(
      [&]<class Chosen>(Chosen& chosen) {
        if constexpr (std::is_same_v<Chosen, std::monostate>)
          return PlanarRun{};
        else
          return run(chosen.scheduler, end, sink, sample_interval);
      },
      loop_);
}

template <class Scheduler>
PlanarRun PlanarSolver::run(Scheduler& scheduler, const RunEnd& end, FrameSink* sink,
                            double sample_interval) {
  PlanarRun run;
  const double last = end.last();
  // Looked at over so many events that no harmless burst of collisions counts.
  RateLimit rate(settings_.most_events, world_.size(), 1000 * world_.size() + 1'000'000, now_);
  std::size_t samples = 0;
  double next_sample = 0;
  run.reached = true;
  while (true) {
    const double next = scheduler.next_time();
    while (sink && next_sample <= std::min(next, last)) {
      show(next_sample, sink);
      next_sample = static_cast<double>(++samples) * sample_interval;
    }
    if (!(next <= last)) break;
    scheduler.step();
    now_ = scheduler.now();
    ++run.events;
    if (rate.is_exceeded(now_)) {
      run.reached = false;
      run.reason = rate.reason(now_);
      break;
    }
  }
  if (run.reached && std::isfinite(last)) now_ = last;
  run.end_time = now_;
  if (sink && static_cast<double>(samples - 1) * sample_interval < now_) show(now_, sink);

  run.collisions = world_.collisions();
  run.collapses = world_.collapses();
  run.contacts = world_.contacts();
  run.energy = world_.energy_at(now_);
  run.work = world_.work();
  run.dissipated = world_.dissipated();
  const double sum = std::abs(first_energy_) + std::abs(run.work) + run.dissipated;
  run.energy_error =
      sum == 0 ? 0 : std::abs(run.energy - first_energy_ - run.work + run.dissipated) / sum;
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
