#include "harness/run/reference_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>

#include "harness/compare/closed_form_values.h"
#include "harness/observe/assembly_observer.h"
#include "harness/observe/observer.h"
#include "harness/run/cpu_time.h"
#include "reference/initial_contacts.h"
#include "reference/lasting_contacts.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

/// Restores the rounding mode on leaving. To set the one that holds would cost as much as another.
class RoundingMode {
 public:
  explicit RoundingMode(int mode) : before_(std::fegetround()), mode_(mode) { change(mode); }
  ~RoundingMode() { change(before_); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;

 private:
  void change(int mode) const {
    if (mode_ != before_) std::fesetround(mode);
  }

  int before_;
  int mode_;
};

/// Shows several the same frames; all or none of a partial one.
class EachSink final : public FrameSink {
 public:
  explicit EachSink(std::vector<FrameSink*> sinks) : sinks_(std::move(sinks)) {}
  void take(double time, const Frame& frame) override {
    for (FrameSink* sink : sinks_) sink->take(time, frame);
  }

 private:
  std::vector<FrameSink*> sinks_;
};

/// Whether a run tells its CPU time: two calls to the system, a good part of what the run of two
/// bodies takes.
enum class Timed : bool { no, yes };

/// What is run several times.
struct RunTask {
  const ReferenceSolver& solver;
  const RunEnd& end;
  double speed;                       ///< speed_scale() of its scene
  ReferenceKeeper* keeper = nullptr;  ///< what keeps it on its way, where it keeps_state()
};

/// extras: null, or whose samples are taken.
ObservedRun solve(const RunTask& task, int rounding, const SolverAccuracy& accuracy,
                  const ReferenceExtras* extras = nullptr, Timed timed = Timed::no) {
  const ReferenceSolver& solver = task.solver;
  ReferenceKeeper* const keeper = task.keeper;
  if (keeper)
    if (const ObservedRun* before = keeper->next()) return *before;
  const RoundingMode mode(rounding);
  const Scene& scene = solver.scene().hard;
  const bool whole = extras && extras->whole;
  std::optional<Observer> observer;
  if (!whole)
    observer.emplace(scene, 0, task.speed, solver.is_resolved(),
                     solver.spring_speeds(accuracy.softness));
  std::optional<AssemblyObserver> assembly;
  if (extras) assembly.emplace(solver.scene(), task.end.last(), extras->samples, extras->states);
  std::vector<FrameSink*> sinks;
  if (observer) sinks.push_back(&*observer);
  if (assembly) sinks.push_back(&*assembly);
  EachSink each(sinks);
  FrameSink& sink = sinks.size() > 1 ? static_cast<FrameSink&>(each) : *sinks.front();
  if (keeper)
    keeper->begin([&](StateArchive& archive) {
      if (observer) archive(*observer);
      if (assembly) archive(*assembly);
      if (assembly && extras->exchange_states) extras->exchange_states(archive);
    });
  ObservedRun solved;
  const double begin = timed == Timed::yes ? thread_cpu_seconds() : 0;
  solved.run = solver.run(task.end, &sink, accuracy, keeper,
                          extras ? extras->started : std::function<void()>());
  if (timed == Timed::yes)
    solved.cpu_seconds = thread_cpu_seconds() - begin + (keeper ? keeper->cpu_before() : 0);
  // The last of what made bodies slide may be the contact of two that roll at its end.
  if (observer && task.end.until == Run::Until::rolling && solved.run.reached && !solver.is_piled())
    observer->end_collisions();
  if (observer) solved.seen = observer->finish(solved.run.end_time);
  if (assembly) solved.assembly = assembly->assembly();
  if (keeper) keeper->finish(solved);
  return solved;
}

const char* name_of(CollapseRule::Model model) {
  switch (model) {
    case CollapseRule::Model::slowest_rebound:
      return "slowest_rebound: 1e-6 of the hardest impact";
    case CollapseRule::Model::contact_time:
      return "contact_time";
    case CollapseRule::Model::largest_velocity:
      return "largest_velocity";
  }
  return "";
}

/// What is not known of the value `index`, called `name`, where its instants are known to `time`: a
/// time has a frame at either end, and so has the way that a body slides, whatever other steps
/// happen to agree with it.
double change_within(double time, const std::string& name, const Observables& seen,
                     std::size_t index) {
  const ObservableName& observable = *observable_key(name).known();
  if (observable.dimension.name == std::string_view(kTime.name)) return time;
  if (observable.name != "sliding_distance") return 0;
  const BodyObservables& body = *body_of_value(seen, index);
  // Either may be NaN, as where there was no collision.
  const double fastest =
      std::fmax(body.velocity_after_collision.norm(), body.rolling_velocity.norm());
  return time * std::fmax(fastest, 0);
}

/// The same of the speed to which a body slides, where springs let it move so much [m/s], by body,
/// before a slide is seen.
double change_by_springs(const std::vector<SpringSpeeds>& springs, const std::string& name,
                         const Observables& seen, std::size_t index) {
  const std::string_view observable = observable_key(name).observable;
  if (observable != "rolling_velocity" && observable != "momentum_change_sliding") return 0;
  return springs[static_cast<std::size_t>(body_of_value(seen, index) - seen.bodies.data())].slip;
}

/// Where in a step contacts begin and end scatters the error, and two runs may have the same by
/// chance: so many other lengths of step show it.
constexpr std::array kOtherSteps = {2.0, 1.37, 1.71};

/// The run that the values come from and those that tell their uncertainty.
struct SolvedRuns {
  ObservedRun value;
  std::vector<Observables> others;
};

SolvedRuns solve_all(const RunTask& task, double tolerance, const ReferenceExtras* extras) {
  const ReferenceSolver& solver = task.solver;
  SolvedRuns runs;
  if (solver.is_exact()) {
    runs.others.push_back(solve(task, FE_UPWARD, {tolerance, 1.5}).seen);
    runs.others.push_back(solve(task, FE_DOWNWARD, {tolerance, 0.5}).seen);
    if (solver.hardens())
      runs.others.push_back(
          solve(task, FE_TONEAREST, {.tolerance = tolerance, .softness = 2}).seen);
  } else if (solver.is_piled()) {
    for (const double factor : kOtherSteps)
      runs.others.push_back(solve(task, FE_TONEAREST, {.step = factor}).seen);
    if (solver.softened_to() > 0)
      runs.others.push_back(solve(task, FE_TONEAREST, {.softness = 2}).seen);
  } else if (solver.is_stepped()) {
    for (const double factor : kOtherSteps)
      runs.others.push_back(solve(task, FE_TONEAREST, {tolerance, 1, factor}).seen);
  } else {
    runs.others.push_back(
        solve(task, FE_TONEAREST, {.tolerance = 10 * tolerance, .cut_offs = 1.5, .softness = 2})
            .seen);
  }
  runs.value = solve(task, FE_TONEAREST, {tolerance, 1}, extras, Timed::yes);
  if (runs.value.run.collapses == 0) return runs;
  // Where a rule took part, its size, another rule and another order of what comes at one instant
  // tell what it decided; and so do contacts that last, which need none, where friction with the
  // substrate presses bodies together.
  const SolverAccuracy other{.tolerance = tolerance, .cut_offs = 10, .other_rule = true};
  const SolverAccuracy reversed{.tolerance = tolerance, .reversed = true};
  for (const SolverAccuracy& accuracy : {other, reversed})
    runs.others.push_back(solve(task, FE_TONEAREST, accuracy).seen);
  const Scene& scene = solver.scene().hard;
  const auto lasting = is_rubbed(scene) ? with_lasting_contacts(scene) : std::nullopt;
  if (lasting) {
    // Piles, which know surfaces, let hard contacts last by themselves, for no shorter than is
    // needed.
    const ContactScene& shown = scene.surfaces.empty() ? *lasting : solver.scene();
    const ReferenceSolver resolved(shown, Compare::Reference::contact);
    RunEnd soon = task.end;  // what lasts may creep, and never roll
    soon.limit = std::min(soon.limit, 2 * runs.value.run.end_time);
    const RunTask lasts{resolved, soon, speed_scale(resolved.scene())};
    runs.others.push_back(solve(lasts, FE_TONEAREST, {.tolerance = 1e-8}).seen);
  }
  return runs;
}

constexpr const char* kNoSamples =
    "no samples of the whole: only scenes of soft contacts between all bodies, in steps, have them";

/// Every two bodies that meet push each other by a law that their states tell.
bool is_soft_assembly(const ReferenceSolver& solver) { return no_whole_reason(solver, {}).empty(); }

/// Of each of these values, which may be NaN. Takes the other runs apart: of many bodies they are
/// large.
std::vector<double> uncertainty_of(const std::vector<double>& values, const ReferenceSolver& solver,
                                   SolvedRuns& runs) {
  // An error of first order is as large as the difference to twice the step or the contact;
  // scattered ones were found up to 2.6 times as large.
  const bool is_of_first_order =
      solver.is_stepped() || solver.is_piled() || solver.softened_to() > 0 || solver.hardens();
  const double safety = is_of_first_order ? 3 : 1;
  std::vector<double> uncertainties;
  uncertainties.reserve(values.size());
  for (const double value : values)
    uncertainties.push_back(2 * std::numeric_limits<double>::epsilon() * std::abs(value));
  for (; !runs.others.empty(); runs.others.pop_back()) {
    const std::vector<double> other = flat_values(aligned(runs.others.back(), runs.value.seen));
    for (std::size_t k = 0; k < values.size(); ++k)
      uncertainties[k] = std::isnan(other[k])
                             ? std::numeric_limits<double>::infinity()
                             : std::max(uncertainties[k], safety * std::abs(other[k] - values[k]));
  }
  if (is_of_first_order) share_within_vectors(runs.value.seen, uncertainties);
  return uncertainties;
}

}  // namespace

ReferenceResult run_reference(const ReferenceSolver& solver, const RunEnd& end,
                              const std::vector<std::string>& names,
                              const ReferenceExtras& extras) {
  const Scene& scene = solver.scene().hard;
  ReferenceResult result;
  result.solver = solver.name();
  double tolerance = SolverAccuracy{}.tolerance;
  std::optional<ReferenceKeeper> keeping;
  if (extras.checkpoints && solver.keeps_state()) keeping.emplace(*extras.checkpoints);
  ReferenceKeeper* const keeper = keeping ? &*keeping : nullptr;
  const bool samples = extras.samples > 0 && is_soft_assembly(solver) && end.last() > 0;
  const ReferenceExtras* const sampled = samples ? &extras : nullptr;
  result.scales = natural_scales(solver.scene());
  const RunTask task{solver, end, result.scales.speed, keeper};
  SolvedRuns runs = solve_all(task, tolerance, sampled);
  // A scene whose scales lie too far apart for its last digits.
  while (runs.value.run.failed && !solver.is_exact() && !solver.is_piled() && tolerance < 1e-9) {
    tolerance *= 10;
    runs = solve_all(task, tolerance, sampled);
  }
  if (tolerance > SolverAccuracy{}.tolerance)
    result.warnings.push_back("integrated at a relative tolerance of 1e" +
                              std::to_string(std::lround(std::log10(tolerance))));
  const ObservedRun& solved = runs.value;
  result.cpu_seconds = solved.cpu_seconds;
  result.run = solved.run;
  result.assembly = solved.assembly;
  result.scales.time = solved.run.end_time;
  // What the integrator cannot run has no contact to put phases to; the warning below says so.
  result.first_contact = solved.run.failed ? std::numeric_limits<double>::infinity()
                                           : solver.first_contact(result.run.end_time, tolerance);

  // Closed forms are of a body alone, or of two that have met once and not again.
  const bool has_closed_form = result.run.reached && has_exact_phases(scene) &&
                               !solver.is_resolved() &&
                               result.run.collisions + 1 == scene.bodies.size();
  const std::vector<double> values = flat_values(solved.seen);
  const std::vector<double> uncertainties = uncertainty_of(values, solver, runs);
  const std::vector<double> closed =
      has_closed_form ? flat_values(aligned(closed_form_observables(scene), solved.seen))
                      : std::vector<double>(values.size(), kNotObserved);
  const std::vector<SpringSpeeds> springs = solver.spring_speeds();
  std::vector<std::string> not_numbers;
  result.observables.reserve(values.size() + 1);
  if (has_closed_form) result.closed_form.reserve(values.size());
  std::string name;
  for (const std::size_t k : order_of_names(solved.seen, names)) {
    const double value = values[k];
    if (std::isnan(value)) {
      if (!is_not_observed(value)) not_numbers.push_back(value_name(solved.seen, names, k));
      continue;
    }
    write_value_name(solved.seen, names, k, name);
    double least = solver.is_stepped() ? change_within(2 * solver.step(), name, solved.seen, k) : 0;
    if (!springs.empty()) least = std::max(least, change_by_springs(springs, name, solved.seen, k));
    if (!std::isnan(closed[k])) result.closed_form.append(name, closed[k]);
    result.observables.append(name, {value, std::max(least, uncertainties[k])});
  }
  if (!scene.periodic.isZero(0) && result.run.end_time > 0) {
    // Counts scatter by their square root where collisions are independent.
    const auto count = static_cast<double>(result.run.collisions);
    result.observables["all.collision_rate"] = {count / result.run.end_time,
                                                std::sqrt(count) / result.run.end_time};
  }
  fail_because_of_nan(not_numbers, result);
  if (solver.softened_to() > 0)
    result.warnings.push_back(
        fmt::format("bodies stay in contact: hard contacts are taken as linear ones "
                    "that last {:.3g} s; the uncertainty holds what twice that time changes",
                    solver.softened_to()));
  if (solver.hardens())
    result.warnings.emplace_back(
        "event takes soft contacts as instants, in the limit of stiff ones with the same law; "
        "contact "
        "resolves them as they are");
  if (solver.settings().threads != 1 && !solver.shares_steps())
    result.warnings.emplace_back(
        "one thread: only scenes of many bodies in soft contacts are shared between several");
  if (extras.samples > 0 && !samples) result.warnings.emplace_back(kNoSamples);
  if (extras.checkpoints && !keeper)
    result.warnings.emplace_back(
        "no state was kept on the way: only scenes of contacts that last, in steps, can go on");
  if (keeper && !keeper->trouble().empty())
    result.warnings.push_back("its state could not be kept on the way: " + keeper->trouble());
  for (const std::string& warning : solver.scene().warnings) result.warnings.push_back(warning);
  if (!result.run.reached) result.warnings.push_back("the run did not end: " + result.run.reason);
  if (result.run.collapses > 0)
    result.warnings.push_back(
        fmt::format("inelastic collapse: the rule of run.collapse ({}) changed {} of {} collisions",
                    name_of(scene.collapse.model), result.run.collapses, result.run.collisions));
  return result;
}

std::string no_whole_reason(const ReferenceSolver& solver, const ReferenceExtras& extras) {
  const bool soft =
      std::ranges::all_of(solver.scene().soft, [](const auto& each) { return each.has_value(); });
  if (!soft) return "--whole needs soft contacts between all bodies, whose states tell the forces";
  if (extras.left_out || solver.keeps_state()) return "";
  return "--whole needs a reference in steps; compare.reference may be steps";
}

ReferenceResult run_reference_whole(const ReferenceSolver& solver, const RunEnd& end,
                                    const ReferenceExtras& extras) {
  ReferenceResult result;
  result.solver = solver.name();
  result.first_contact = std::numeric_limits<double>::infinity();
  if (extras.left_out) {
    result.left_out = true;
    result.run.reason = "it was left out";
    return result;
  }
  std::optional<ReferenceKeeper> keeping;
  if (extras.checkpoints) keeping.emplace(*extras.checkpoints);
  ReferenceKeeper* const keeper = keeping ? &*keeping : nullptr;
  // Nothing is observed of bodies, and no speed is asked for.
  const ObservedRun solved = solve({solver, end, 0, keeper}, FE_TONEAREST, {}, &extras, Timed::yes);
  result.cpu_seconds = solved.cpu_seconds;
  result.run = solved.run;
  result.assembly = solved.assembly;
  result.warnings = solver.scene().warnings;
  if (keeper && !keeper->trouble().empty())
    result.warnings.push_back("its state could not be kept on the way: " + keeper->trouble());
  if (!result.run.reached) result.warnings.push_back("the run did not end: " + result.run.reason);
  return result;
}

void fail_because_of_nan(const std::vector<std::string>& names, ReferenceResult& result) {
  if (names.empty()) return;
  if (!result.run.failed) {  // else the solver has said more
    result.run.reason = "NaN in " + names.front();
    if (names.size() > 1)
      result.run.reason += fmt::format(" and {} more observables", names.size() - 1);
  }
  result.run.failed = true;
  result.run.reached = false;
  result.first_contact = std::numeric_limits<double>::infinity();
  result.observables.clear();
  result.closed_form.clear();
  result.box.reset();
}

RunEnd run_end(const Scenario& scenario) {
  return {scenario.run.until, scenario.run.time, scenario.run.limit};
}

std::vector<std::string> body_names(const Scenario& scenario) {
  std::vector<std::string> names;
  names.reserve(scenario.bodies.size());
  for (const Body& body : scenario.bodies) names.push_back(body.name);
  for (const NamedSurface& surface : scenario.surfaces) names.push_back(surface.name);
  return names;
}

}  // namespace slipcheck
