#include "studies/precision/reference_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "harness/compare/comparison.h"
#include "harness/observe/observer.h"
#include "physics/numbers.h"
#include "reference/initial_contacts.h"
#include "reference/steps/step_length.h"
#include "reference/steps/step_solver.h"
#include "reference/steps/steps_as_events.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

using Kind = MethodCurve::Kind;
using Named = std::map<std::string, double>;

/// Every so many of the path's points a trajectory is looked at: 32 times.
constexpr std::size_t kPathStride = 16;
/// Runs of a fixed step, by where in a step the first contact falls.
constexpr std::size_t kStepPhases = 4;
/// Of one run of a fixed step: some tenths of a second with its observer.
constexpr double kMostSteps = 1e6;
/// Of the reference's run: what has not come to its end by then is not waited for.
constexpr double kPatience = 1.5;

const ReferenceSolver& solver_of(const PreparedScene& scene) { return scene.solver; }

/// A solver's runs on one scene turned into points.
class Curves {
 public:
  Curves(const PreparedScene& scene, const TravelledPath& path)
      : scene_(scene), path_(path), end_(patient_end(scene)) {
    for (std::size_t k = kPathStride; k <= path.centres.size(); k += kPathStride) {
      times_.push_back(path.times[k - 1]);
      expected_.push_back(path.centres[k - 1]);
    }
  }

  MethodCurve event() const;
  MethodCurve contact(std::span<const double> tolerances) const;
  MethodCurve fixed_step(std::span<const double> steps_per_contact) const;

 private:
  static MethodCurve skipped(MethodCurve curve, std::string reason) {
    WorkPrecision point;
    point.reason = std::move(reason);
    curve.points.push_back(std::move(point));
    return curve;
  }

  WorkPrecision point_of(double knob, const std::vector<Named>& seen,
                         const std::vector<double>& distances) const {
    WorkPrecision point;
    point.knob = knob;
    point.status = RunStatus::ok;
    point.phases = seen.size();
    point.errors =
        phase_errors(deviations(scene_.scenario, scene_.reference, ensemble_values(seen)));
    point.errors[kTrajectory] = trajectory_errors(distances, path_.length);
    if (path_.centres.size() < path_.times.size()) {
      point.errors[kTrajectory] = {};
      point.errors[kTrajectory].reason = "the reference gave up before the end";
    }
    return point;
  }

  WorkPrecision exact_point() const;
  WorkPrecision solved_point(const ReferenceSolver& solver, double tolerance) const;
  WorkPrecision stepped_point(double step) const;
  double shortest_contact() const;

  const PreparedScene& scene_;
  const TravelledPath& path_;
  RunEnd end_;
  std::vector<double> times_;
  std::vector<Centres> expected_;
};

WorkPrecision Curves::exact_point() const {
  Named seen;
  for (const auto& [name, value] : scene_.reference.observables)
    seen.emplace(name, value.value + value.uncertainty);
  WorkPrecision point = point_of(0, {seen}, {0});
  point.errors[kTrajectory] = {};
  point.errors[kTrajectory].reason = "the others are held against this one";
  return point;
}

WorkPrecision Curves::solved_point(const ReferenceSolver& solver, double tolerance) const {
  const Scene& hard = solver.scene().hard;
  Observer observer(hard, 0, speed_scale(solver.scene()), solver.is_resolved());
  const SolvedRun run = solver.run(end_, &observer, {tolerance, 1});
  if (run.failed) {
    WorkPrecision point;
    point.knob = tolerance;
    point.status = RunStatus::unstable;
    point.reason = run.reason;
    return point;
  }
  std::vector<Centres> centres;
  for (const auto& states : solver.states_along(times_, tolerance))
    centres.push_back(centres_of(states));
  return point_of(tolerance,
                  {named_values(observer.finish(run.end_time), body_names(scene_.scenario))},
                  {largest_distance(centres, expected_)});
}

MethodCurve Curves::event() const {
  MethodCurve curve;
  curve.kind = Kind::event;
  const ReferenceSolver& truth = solver_of(scene_);
  if (truth.is_exact() && !truth.hardens()) {
    curve.points.push_back(exact_point());
    return curve;
  }
  try {
    const ReferenceSolver solver(*scene_.contact,
                                 {Compare::Reference::event, scene_.scenario.run.most_events});
    if (!solver.is_exact())
      return skipped(curve, "phases between the collisions are integrated: see contact");
    curve.points.push_back(solved_point(solver, 0));
  } catch (const std::exception& error) {
    return skipped(curve, error.what());
  }
  return curve;
}

MethodCurve Curves::contact(std::span<const double> tolerances) const {
  MethodCurve curve;
  curve.kind = Kind::contact;
  try {
    const ReferenceSolver solver(*scene_.contact,
                                 {Compare::Reference::contact, scene_.scenario.run.most_events});
    for (const double tolerance : tolerances)
      curve.points.push_back(solved_point(solver, tolerance));
  } catch (const std::exception& error) {
    return skipped(std::move(curve), error.what());
  }
  return curve;
}

/// [s]; infinite where no two bodies have a contact that lasts.
double Curves::shortest_contact() const {
  double shortest = kNever;
  for (const auto& [name, value] : scene_.reference.observables)
    if (observable_key(name).observable == "contact_time" && value.value > 0)
      shortest = std::min(shortest, value.value);
  // None ended in the run: those of collisions along the line of centres.
  return std::isfinite(shortest) ? shortest : shortest_collision(*scene_.contact);
}

WorkPrecision Curves::stepped_point(double step) const {
  WorkPrecision point;
  point.knob = step;
  const double end = scene_.reference.run.end_time;
  if (end / step > kMostSteps) {
    point.reason = fmt::format("takes {:.2g} steps, more than {:.2g}", end / step, kMostSteps);
    return point;
  }
  const Scene& hard = scene_.contact->hard;
  const double first = scene_.reference.first_contact;
  std::vector<Named> seen;
  std::vector<double> distances;
  for (std::size_t p = 0; p < kStepPhases; ++p) {
    double h = step;
    if (std::isfinite(first) && first > 0)
      h = first / (std::ceil(first / step) +
                   (static_cast<double>(p) + 0.5) / static_cast<double>(kStepPhases));
    Observer observer(hard, 0, speed_scale(*scene_.contact), true);
    StepsAsEvents events(observer);
    SampledPath path(times_, &events);
    StepSolver solver(*scene_.contact, hard.initial, {h});
    const SolvedRun run = solver.run(end_, &path);
    path.stop_telling();
    const bool goes_on = !run.failed && path.centres.size() < times_.size();
    const SolvedRun last = goes_on ? solver.run(until_time(times_.back()), &path) : run;
    if (last.failed) {
      point.status = RunStatus::unstable;
      point.reason = last.reason;
      return point;
    }
    // The end as an engine's run has it.
    const double ended = !run.reached                        ? run.end_time
                         : end_.until == Run::Until::time    ? end_.time
                         : end_.until == Run::Until::rolling ? observer.last_slide_end()
                                                             : observer.last_stop();
    seen.push_back(named_values(observer.finish(ended), body_names(scene_.scenario)));
    distances.push_back(largest_distance(path.centres, expected_));
    if (!std::isfinite(first)) break;
  }
  return point_of(step, seen, distances);
}

MethodCurve Curves::fixed_step(std::span<const double> steps_per_contact) const {
  MethodCurve curve;
  curve.kind = Kind::fixed_step;
  const double contact = shortest_contact();
  try {
    // Says what it cannot do before anything else is decided.
    [[maybe_unused]] const StepSolver one(*scene_.contact, scene_.contact->hard.initial, {1});
    if (!std::isfinite(contact)) return skipped(curve, "no contact of bodies sets a step");
    for (const double count : steps_per_contact)
      curve.points.push_back(stepped_point(contact / count));
  } catch (const std::exception& error) {
    return skipped(std::move(curve), error.what());
  }
  return curve;
}

}  // namespace

std::map<std::string, PhaseErrors> phase_errors(
    const std::map<std::string, Deviation>& deviations) {
  std::map<std::string, PhaseErrors> errors;
  for (const auto& [name, each] : deviations)
    if (observable_key(name).component == '\0' || each.tolerance)
      errors[name] = {each.max, each.median, each.rms, each.absolute, each.tolerance, each.reason};
  return errors;
}

RunEnd patient_end(const PreparedScene& scene) {
  RunEnd end = run_end(scene.scenario);
  if (end.until != Run::Until::time)
    end.limit = std::min(end.limit, kPatience * scene.reference.run.end_time);
  return end;
}

std::vector<MethodCurve> reference_curves(const PreparedScene& scene, const TravelledPath& path,
                                          const PrecisionGrid& grid) {
  const Curves curves(scene, path);
  return {curves.event(), curves.contact(grid.tolerances),
          curves.fixed_step(grid.steps_per_contact)};
}

}  // namespace slipcheck
