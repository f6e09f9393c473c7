#include "harness/run/phase_run.h"

#include <cmath>
#include <limits>
#include <utility>

#include "harness/observe/observer.h"
#include "harness/run/box_reference.h"
#include "harness/run/engine_state.h"
#include "reference/events/planar_solver.h"
#include "reference/initial_contacts.h"

namespace slipcheck {

PhaseRun::PhaseRun(const EnsembleTask& task, double step, double start, double fastest)
    : solver_(*task.solver),
      scene_(task.solver->scene().hard),
      end_(run_end(*task.scenario)),
      fastest_(fastest),
      step_(step),
      start_(start),
      watch_(task.watch) {}

void PhaseRun::take(const Frame& frame) {
  if (ended_ && !wants_more()) return;
  const double time = start_ + (static_cast<double>(steps_) + frame.part) * step_;
  if (frame.part == 1) ++steps_;
  if (watch_) watch_->take(time, frame);
  if (ended_) return;
  // Falling adds to what the bodies bring with them.
  std::string fault = fault_of_state(frame, time, fastest_ + scene_.gravity * time);
  if (!fault.empty()) throw Unstable{std::move(fault)};
  ended_ = look(time, frame);
}

namespace {

class PlaneRun final : public PhaseRun {
 public:
  PlaneRun(const EnsembleTask& task, double step, double start,
           const std::vector<BodyState>& states)
      : PhaseRun(task, step, start, speed_scale(task.solver->scene())),
        names_(body_names(*task.scenario)),
        observer_(scene(), step, speed_scale(task.solver->scene()), task.solver->is_resolved()) {
    Frame frame;
    for (std::size_t i = 0; i < scene().bodies.size(); ++i)
      if (scene().has_substrate &&
          scene().initial[i].position.z() <= scene().bodies[i].radius * (1 + 1e-12))
        frame.touches.push_back({static_cast<int>(i), kSubstrate, 1});
    frame.bodies = scene().initial;
    observer_.take(0, frame);
    if (start == 0) return;
    frame.bodies = states;
    observer_.take(start, frame);
  }

  std::map<std::string, double> values() const override {
    return named_values(observer_.finish(end_time_), names_);
  }

 private:
  bool look(double time, const Frame& frame) override {
    observer_.take(time, frame);
    end_time_ = time;
    if (end().until == Run::Until::time) {
      end_time_ = end().time;
      return come_to_end(time >= end().time);
    }
    if (observer_.anything_collides()) return time >= end().limit;
    if (end().until == Run::Until::rest && observer_.everything_rests()) {
      end_time_ = observer_.last_stop();
      return come_to_end(true);
    }
    if (end().until == Run::Until::rolling && !observer_.anything_slides_or_flies() &&
        !collides_again(time, frame)) {
      end_time_ = observer_.last_slide_end();
      return come_to_end(true);
    }
    return time >= end().limit;
  }

  /// Whether bodies that all roll now will meet or come to a surface: the reference's solver looks
  /// ahead.
  bool collides_again(double time, const Frame& frame) {
    if (time <= next_look_) return true;
    next_look_ = solver().next_collision(observer_.rolling(time, frame.bodies), time, end().limit,
                                         2 * observer_.weakest_collision());
    return std::isfinite(next_look_);
  }

  std::vector<std::string> names_;
  Observer observer_;
  double end_time_ = 0;
  double next_look_ = -std::numeric_limits<double>::infinity();
};

class BoxRun final : public PhaseRun {
 public:
  BoxRun(const EnsembleTask& task, double step, double start, const std::vector<BodyState>& states)
      : PhaseRun(task, step, start,
                 planar_speed_scale(task.solver->scene().hard, task.solver->scene().hard.initial)),
        observer_(scene(), box_sampling(*task.scenario)) {
    Frame frame;
    frame.bodies = states;
    observer_.take(start, frame);
  }

  std::map<std::string, double> values() const override {
    std::map<std::string, double> values;
    for (const auto& [name, mean] : box_means(observer_.finish()))
      if (!std::isnan(mean.mean)) values.emplace(name, mean.mean);
    return values;
  }

 private:
  bool look(double time, const Frame& frame) override {
    observer_.take(time, frame);
    return come_to_end(time >= end().time);
  }

  BoxObserver observer_;
};

}  // namespace

std::unique_ptr<PhaseRun> make_phase_run(const EnsembleTask& task, double step, double start,
                                         const std::vector<BodyState>& states) {
  if (task.watch) task.watch->begin(start, states);
  if (task.solver->scene().hard.box) return std::make_unique<BoxRun>(task, step, start, states);
  return std::make_unique<PlaneRun>(task, step, start, states);
}

}  // namespace slipcheck
