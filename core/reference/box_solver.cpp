#include "reference/box_solver.h"

#include <limits>

#include "reference/forces/soft_box_solver.h"

namespace slipcheck {
namespace {

/// Tells with each frame how many collisions there have been.
template <class Solver>
class CountingSink final : public FrameSink {
 public:
  CountingSink(const Solver& solver, FrameSink* sink, std::uint64_t* count)
      : solver_(solver), sink_(sink), count_(count) {}

  void take(double time, const Frame& frame) override {
    if constexpr (requires { solver_.world(); })
      *count_ = solver_.world().collisions();
    else
      *count_ = solver_.collisions();
    sink_->take(time, frame);
  }

 private:
  const Solver& solver_;
  FrameSink* sink_;
  std::uint64_t* count_;
};

template <class Solver>
auto run_counting(Solver& solver, const RunEnd& end, double interval, FrameSink* sink,
                  std::uint64_t* count) {
  if (!sink || !count) return solver.run(end, sink, interval);
  CountingSink<Solver> counting(solver, sink, count);
  return solver.run(end, &counting, interval);
}

}  // namespace

BoxSolver::BoxSolver(const ContactScene& scene, const ReferenceSettings& settings)
    : scene_(&scene),
      settings_(settings),
      resolved_(settings.asked == Compare::Reference::contact ||
                (settings.asked == Compare::Reference::automatic && !scene.is_hard())) {
  if (settings.asked == Compare::Reference::steps)
    throw Unsupported("a container has no steps of fixed length; compare.reference may be contact");
  if (resolved_) SoftBoxSolver(scene, scene.hard.initial);  // throws
}

std::vector<std::string> BoxSolver::loop() const {
  if (resolved_) return {"free flight, and steps for bodies that touch"};
  std::vector<std::string> loop = {"bodies on parabolas between walls"};
  for (const std::string& left : planar_solver().left_out()) loop.push_back("without " + left);
  return loop;
}

PlanarSolver BoxSolver::planar_solver() const {
  PlanarSettings settings;
  settings.most_events = settings_.most_events;
  settings.general = settings_.general;
  return PlanarSolver(scene_->hard, scene_->hard.initial, settings);
}

BoxRun BoxSolver::run(const RunEnd& end, double sample_interval, FrameSink* sink,
                      std::uint64_t* collisions) const {
  const Scene& hard = scene_->hard;
  if (resolved_) {
    SoftBoxSolver solver(*scene_, hard.initial);
    const SoftBoxRun run = run_counting(solver, end, sample_interval, sink, collisions);
    return {run.end_time,
            run.reached,
            run.reason,
            0,
            run.steps,
            run.collisions,
            0,
            run.energy_error,
            std::numeric_limits<double>::quiet_NaN()};
  }
  PlanarSolver solver = planar_solver();
  const PlanarRun run = run_counting(solver, end, sample_interval, sink, collisions);
  return {run.end_time,   run.reached,   run.reason,       run.events,        0,
          run.collisions, run.collapses, run.energy_error, run.momentum_error};
}

std::vector<BodyState> BoxSolver::states_at(double time) const {
  const RunEnd end{Run::Until::time, time, time};
  if (resolved_) {
    SoftBoxSolver solver(*scene_, scene_->hard.initial);
    solver.run(end, nullptr, 0);
    return solver.states();
  }
  PlanarSolver solver = planar_solver();
  solver.run(end, nullptr, 1);
  return solver.states();
}

}  // namespace slipcheck
