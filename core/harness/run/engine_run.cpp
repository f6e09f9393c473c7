#include "harness/run/engine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stop_scope.h"
#include "harness/compare/comparison.h"
#include "harness/observe/observer.h"
#include "harness/run/engine_state.h"
#include "harness/run/phases.h"
#include "reference/initial_contacts.h"

namespace slipcheck {
namespace {

/// A state of an engine that no comparison can be made with.
struct Unstable {
  std::string reason;
};

/// Follows one run of an engine and decides when it has ended.
class PhaseRun {
 public:
  PhaseRun(const EnsembleTask& task, double step, double start)
      : solver_(*task.solver),
        scene_(task.solver->scene().hard),
        end_(run_end(*task.scenario)),
        scale_(speed_scale(task.solver->scene())),
        step_(step),
        start_(start),
        watch_(task.watch),
        observer_(scene_, step, scale_, task.solver->is_resolved()) {
    Frame frame;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (scene_.initial[i].position.z() <= scene_.bodies[i].radius * (1 + 1e-12))
        frame.touches.push_back({static_cast<int>(i), kSubstrate, 1});
    frame.bodies = scene_.initial;
    observer_.take(0, frame);
    if (start > 0) {
      frame.bodies = solver_.states_at(start);
      observer_.take(start, frame);
    }
    if (watch_) watch_->begin(start, frame.bodies);
  }

  /// The end of one more step, or an instant inside it.
  void take(const Frame& frame) {
    if (ended_ && !wants_more()) return;
    time_ = start_ + (static_cast<double>(steps_) + frame.part) * step_;
    if (frame.part == 1) ++steps_;
    if (watch_) watch_->take(time_, frame);
    if (ended_) return;
    check(frame);
    observer_.take(time_, frame);
    ended_ = has_ended(frame);
  }

  bool ended() const { return ended_; }
  /// Whether somebody still looks after the end.
  bool wants_more() const { return watch_ && watch_->wants_more(); }
  bool reached() const { return reached_; }
  double time() const { return time_; }
  Observables observables() const { return observer_.finish(end_time_); }

 private:
  void check(const Frame& frame) const {
    // Falling adds to what the bodies bring with them.
    std::string fault = fault_of_state(frame, time_, scale_ + scene_.gravity * time_);
    if (!fault.empty()) throw Unstable{std::move(fault)};
  }

  bool has_ended(const Frame& frame) {
    if (end_.until == Run::Until::time) {
      end_time_ = end_.time;
      reached_ = time_ >= end_.time;
      return reached_;
    }
    if (end_.until == Run::Until::rest && observer_.everything_rests()) {
      end_time_ = observer_.last_stop();
      return reached_ = true;
    }
    if (end_.until == Run::Until::rolling && !observer_.anything_slides_or_flies() &&
        !collides_again(frame)) {
      end_time_ = observer_.last_slide_end();
      return reached_ = true;
    }
    end_time_ = time_;
    return time_ >= end_.limit;
  }

  /// Whether bodies that all roll now will meet: the reference's solver looks ahead.
  bool collides_again(const Frame& frame) {
    if (time_ <= next_look_) return true;
    std::vector<BodyState> states = frame.bodies;
    const Vector3 frame_velocity = scene_.motion.velocity(time_);
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].position.z() = scene_.bodies[i].radius;
      states[i].velocity.z() = 0;
      const double spin = states[i].angular_velocity.z();
      states[i].angular_velocity =
          rolling_angular_velocity(states[i].velocity - frame_velocity, scene_.bodies[i].radius);
      states[i].angular_velocity.z() = spin;
    }
    next_look_ =
        solver_.next_collision(states, time_, end_.limit, 2 * observer_.weakest_collision());
    return std::isfinite(next_look_);
  }

  const ReferenceSolver& solver_;
  const Scene& scene_;
  RunEnd end_;
  double scale_, step_, start_;
  PhaseWatch* watch_;
  Observer observer_;
  std::size_t steps_ = 0;
  double time_ = 0, end_time_ = 0;
  double next_look_ = -std::numeric_limits<double>::infinity();
  bool ended_ = false, reached_ = false;
};

/// Few enough steps for little waste after the end, many enough for few messages.
std::size_t steps_at_once(double expected_time, double step) {
  return static_cast<std::size_t>(std::clamp(expected_time / step / 16, 16.0, 4096.0));
}

}  // namespace

std::vector<PhaseShare> phase_shares(std::size_t phases, std::size_t count) {
  std::vector<PhaseShare> shares(std::clamp<std::size_t>(count, 1, phases));
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k].first = phases * k / shares.size();
    shares[k].last = phases * (k + 1) / shares.size();
  }
  return shares;
}

void run_phases(RemoteEngine& engine, const EnsembleTask& task, const EngineRecord& record,
                PhaseShare& share) {
  const double step = 1 / record.rate;
  share.version = engine.info().version;
  share.applied = engine.configure(task.solver->scene().hard, record.settings, step);

  const auto names = body_names(*task.scenario);
  const auto starts = phase_starts(task.reference->first_contact, step, task.phases);
  const std::size_t chunk = steps_at_once(task.reference->run.end_time, step);
  try {
    for (std::size_t p = share.first; p < std::min(share.last, starts.size()); ++p) {
      const StopScope limit(task.time_limit);
      PhaseRun run(task, step, starts[p]);
      engine.start(task.solver->states_at(starts[p]), starts[p]);
      while (!run.ended() || run.wants_more()) {
        share.cpu_seconds += engine.advance(chunk, [&](const Frame& frame) { run.take(frame); });
        share.steps += chunk;
      }
      if (!run.reached()) ++share.unfinished;
      share.seen.push_back(named_values(run.observables(), names));
    }
  } catch (const Unstable& unstable) {
    share.unstable = unstable.reason;
  }
}

void finish_ensemble(const EnsembleTask& task, const std::vector<PhaseShare>& shares,
                     EngineRecord& record) {
  const double step = 1 / record.rate, first_contact = task.reference->first_contact;
  const std::size_t phases = phase_starts(first_contact, step, task.phases).size();
  std::vector<std::map<std::string, double>> seen;
  std::size_t unfinished = 0;
  record.version = shares.front().version;
  record.applied = shares.front().applied;
  for (const PhaseShare& share : shares) {
    record.cpu_seconds += share.cpu_seconds;
    record.steps += share.steps;
    unfinished += share.unfinished;
    seen.insert(seen.end(), share.seen.begin(), share.seen.end());
    record.phases = seen.size();
    if (!share.unstable.empty()) {
      record.status = EngineRecord::Status::unstable;
      record.reason = share.unstable;
      return;
    }
    if (seen.size() < std::min(share.last, phases)) return;  // the worker failed
  }
  record.status = EngineRecord::Status::ok;
  record.observables = ensemble_values(seen);
  record.errors = deviations(*task.scenario, *task.reference, record.observables);
  if (unfinished > 0)
    record.warnings.push_back(fmt::format("{} of {} phases had not ended at the limit of {} s",
                                          unfinished, seen.size(), task.scenario->run.limit));
  if (first_contact == 0)
    record.warnings.push_back("the first contact is there from the start: it has one phase only");
  else if (std::isfinite(first_contact) && first_contact < step)
    record.warnings.push_back(
        "the first contact falls inside the first step: its phases cover a part of a step only");
}

}  // namespace slipcheck
