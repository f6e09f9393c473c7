#include "reference/reference_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"
#include "reference/events/planar_solver.h"
#include "reference/events/surface_world.h"
#include "reference/forces/contact_solver.h"
#include "reference/forces/instant_collision.h"
#include "reference/forces/soft_box_solver.h"
#include "reference/initial_contacts.h"
#include "reference/lasting_contacts.h"
#include "reference/piles/pile_law.h"
#include "reference/piles/pile_solver.h"
#include "reference/run_variation.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_length.h"
#include "reference/steps/step_solver.h"
#include "reference/steps/steps_as_events.h"

namespace slipcheck {
namespace {

/// A state that is no number stays so: the last ones tell. `solved` fails where there is one.
SolvedRun checked(SolvedRun solved, const std::vector<BodyState>& states) {
  const auto is_finite = [](const BodyState& state) {
    return state.position.allFinite() && state.velocity.allFinite() &&
           state.angular_velocity.allFinite();
  };
  const auto lost = std::ranges::find_if_not(states, is_finite);
  if (lost == states.end()) return solved;
  solved.failed = true;
  solved.reached = false;
  solved.reason = fmt::format("the state of body {} is not finite at {:.9g} s",
                              lost - states.begin(), solved.end_time);
  return solved;
}

EventSettings event_settings(const ReferenceSettings& asked, double cut_offs = 1) {
  EventSettings settings;
  settings.most_events = asked.most_events;
  settings.general = asked.general;
  settings.collapse_fraction *= cut_offs;
  settings.landing_fraction *= cut_offs;
  return settings;
}

PlanarSettings planar_settings(const ReferenceSettings& asked, double cut_offs) {
  PlanarSettings settings;
  settings.most_events = asked.most_events;
  settings.general = asked.general;
  settings.collapse_fraction *= cut_offs;
  settings.landing_fraction *= cut_offs;
  return settings;
}

/// EventSolver would look for neighbours in cells.
bool needs_cells(const Scene& scene) {
  return scene.bodies.size() > EventSettings{}.most_without_cells ||
         scene.periodic != Vector2::Zero();
}

/// Contacts last that no other solver knows. Beside surfaces hard ones are tried as instants where
/// nothing else is asked for; what then lasts shows (SolvedRun::lasting).
bool needs_piles(const ContactScene& scene, bool automatic) {
  if (scene.has_memory() || (scene.is_hard() && rests_on_bodies(scene.hard))) return true;
  if (scene.hard.surfaces.empty()) return false;
  return !automatic || !scene.is_hard() || !EventSolver::can_solve(scene.hard);
}

/// Steps in the shortest contact of a scene in which none was asked for: hard contacts that last
/// have an error of their own, soft ones are what is to be solved.
constexpr double kStepsPerHard = 40, kStepsPerSoft = 200;
/// Between two frames of a scene with hard contacts alone, and of one of many bodies, which cost as
/// much to be looked at as to be stepped.
constexpr std::size_t kStepsPerFrame = 8, kStepsPerFrameOfMany = 40;

/// Bodies go straight on from collision to collision, and the rule for collapse is the one that
/// PlanarSolver and EventSolver share.
bool goes_straight(const Scene& scene) {
  return needs_cells(scene) && EventSolver::is_exact(scene) &&
         PlanarWorld::is_planar(scene, scene.initial) &&
         scene.collapse.model == CollapseRule::Model::slowest_rebound;
}

}  // namespace

bool has_exact_phases(const Scene& scene) {
  return scene.surfaces.empty() && EventSolver::can_solve(scene) && EventSolver::is_exact(scene);
}

bool runs_in_phases(const Scene& scene) {
  return EventSolver::can_solve(scene) &&
         (EventSolver::is_exact(scene) || needs_cells(scene) || !scene.extents.empty());
}

// --- the choice ----------------------------------------------------------------------------------

ReferenceSolver::ReferenceSolver(const ContactScene& scene, const ReferenceSettings& settings)
    : scene_(&scene), settings_(settings) {
  scene.hard.box ? choose_in_box() : choose_on_plane();
  if (scene.own && !is_stepped() && !is_piled())
    throw Unsupported(
        "bodies of so many sizes that each two have a contact of their own are solved in steps "
        "alone, and not in a container; compare.reference may be steps");
}

void ReferenceSolver::choose_in_box() {
  if (settings_.asked == Compare::Reference::steps)
    throw Unsupported("a container has no steps of fixed length; compare.reference may be contact");
  if (scene_->has_memory())
    throw Unsupported(
        "a container has no contacts with memory (the tangential models spring and mindlin, and "
        "rolling)");
  resolved_ = settings_.asked == Compare::Reference::contact ||
              (settings_.asked == Compare::Reference::automatic && !scene_->is_hard());
  phases_ = !resolved_;
  if (resolved_)
    SoftBoxSolver(*scene_, scene_->hard.initial);  // throws
  else if (!scene_->is_hard())
    harden();
}

/// What is solved has no contact that lasts; on a plane its collisions are the limit of those that
/// do.
void ReferenceSolver::harden() {
  made_ = with_hard_contacts(scene_->hard);
  made_->warnings = scene_->warnings;
  if (!scene_->hard.box) made_->hard.laws = instant_collisions(*scene_);
}

void ReferenceSolver::choose_on_plane() {
  const ContactScene& scene = *scene_;
  const bool soft = !scene.is_hard();
  const bool automatic = settings_.asked == Compare::Reference::automatic;
  const bool periodic = !scene.hard.periodic.isZero(0);
  if (settings_.asked == Compare::Reference::event && scene.has_memory())
    throw Unsupported(
        "event has no contacts with memory (the tangential models spring and mindlin, and "
        "rolling); "
        "compare.reference may be contact or steps");
  if (settings_.asked == Compare::Reference::event && !scene.hard.surfaces.empty())
    if (const std::string obstacle = SurfaceWorld::obstacle(scene.hard); !obstacle.empty())
      throw Unsupported("event knows no " + obstacle +
                        " beside surfaces; compare.reference may be contact");
  const bool stepped =
      settings_.asked == Compare::Reference::steps ||
      (automatic && soft && (periodic || scene.hard.bodies.size() > kMostIntegrated));
  if (settings_.asked != Compare::Reference::event && needs_piles(scene, automatic) &&
      !(stepped && grain_refusal(scene, scene.hard.initial).empty())) {
    choose_piles();
    return;
  }
  resolved_ = stepped || settings_.asked == Compare::Reference::contact || (automatic && soft);
  if (resolved_ && !scene.hard.extents.empty())
    throw Unsupported(
        "only spheres have contacts that last; compare.reference may be event for a block or a "
        "cylinder");
  if (!resolved_ && soft) {
    if (!initial_contacts(scene, scene.hard.initial).empty())
      throw Unsupported("bodies that overlap at the start can only be solved with soft contacts");
    harden();
  }
  if (automatic && !soft && has_lasting_contacts(scene.hard)) {
    collision_time_ = short_collision_time(scene.hard);
    made_ = with_lasting_contacts(scene.hard, collision_time_);
    resolved_ = made_.has_value();
  }
  phases_ = !resolved_ && runs_in_phases(scene.hard);
  straight_ = phases_ && !hardens() && goes_straight(scene.hard);
  if (!stepped && !phases_ && periodic)
    throw Unsupported(
        "the integrator knows no images across a periodic plane's edges; compare.reference may be "
        "steps, or event where every contact is hard");
  if (!stepped) return;
  const double collision = std::min(shortest_collision(scene), shortest_at_surfaces(scene));
  if (collision == kNever)
    throw Unsupported(
        "steps of fixed length need a collision to be measured by: no two bodies have a soft "
        "contact and move");
  step_ = collision / settings_.steps_per_contact;
  StepSolver(scene, scene.hard.initial, {.step = step_, .general = settings_.general});  // throws
}

void ReferenceSolver::choose_piles() {
  resolved_ = piled_ = true;
  const double shortest = shortest_collision(*scene_);
  // What a soft contact presses onto the substrate is to find it hard.
  constexpr double kHarder = 0.2;
  collision_time_ = std::min(pile_collision_time(*scene_), kHarder * shortest);
  const PileLaws laws(*scene_, collision_time_);  // throws
  if (settings_.asked == Compare::Reference::steps)
    step_ = laws.shortest_contact() / settings_.steps_per_contact;
  if (!laws.has_hard()) collision_time_ = 0;
}

std::vector<SpringSpeeds> ReferenceSolver::spring_speeds(double softness) const {
  if (!is_piled()) return {};
  return PileLaws(*scene_, collision_time_ > 0 ? softness * collision_time_ : 1).spring_speeds();
}

bool ReferenceSolver::shares_steps() const {
  const Scene& hard = scene_->hard;
  if (is_piled()) return hard.bodies.size() >= PileSettings{}.ordered_from;
  const StepSettings two = {.general = settings_.general, .threads = 2};
  return is_stepped() && sharing_threads(*scene_, hard.initial, two) > 1;
}

std::vector<std::string> ReferenceSolver::loop() const {
  return at_start(scene(), {}, {})->features();
}

// --- what runs -----------------------------------------------------------------------------------

namespace {

/// The length of a step near `step` [s], such that the last one ends where the run does.
double ends_on(const RunEnd& end, double step) {
  if (end.until != Run::Until::time || end.time == 0) return step;
  return end.time / std::max(1.0, std::round(end.time / step));
}

}  // namespace

/// `scene` at time 0; `end` sets the length of its steps. `prepares`: as of PileSettings.
std::unique_ptr<Solver> ReferenceSolver::at_start(const ContactScene& scene,
                                                  const SolverAccuracy& accuracy, const RunEnd& end,
                                                  bool prepares) const {
  const std::vector<BodyState>& initial = scene.hard.initial;
  if (is_piled()) {
    PileSettings settings;
    settings.collision_time = accuracy.softness * collision_time_;
    settings.least_restitution = accuracy.softness * PileLaws::kLeastRestitution;
    settings.general = settings_.general;
    settings.threads = settings_.threads;
    settings.prepare = prepares;
    const double per_contact = is_stepped()      ? settings_.steps_per_contact
                               : scene.is_hard() ? kStepsPerHard
                                                 : kStepsPerSoft;
    if (scene.is_hard()) settings.steps_per_frame = kStepsPerFrame;
    if (shares_steps()) settings.steps_per_frame = kStepsPerFrameOfMany;
    const PileLaws laws(scene, settings.collision_time > 0 ? settings.collision_time : 1,
                        settings.least_restitution);
    settings.step = ends_on(end, accuracy.step * laws.shortest_contact() / per_contact);
    return std::make_unique<PileSolver>(scene, initial, settings);
  }
  if (is_stepped())
    return std::make_unique<StepSolver>(scene, initial,
                                        StepSettings{.step = ends_on(end, accuracy.step * step_),
                                                     .general = settings_.general,
                                                     .threads = settings_.threads});
  if (scene.hard.box && resolved_) return std::make_unique<SoftBoxSolver>(scene, initial);
  if (scene.hard.box || straight_)
    return std::make_unique<PlanarSolver>(scene.hard, initial,
                                          planar_settings(settings_, accuracy.cut_offs));
  if (phases_)
    return std::make_unique<EventSolver>(scene.hard, initial,
                                         event_settings(settings_, accuracy.cut_offs));
  ContactSettings settings;
  settings.tolerance = accuracy.tolerance;
  settings.cut_offs = accuracy.cut_offs;
  return std::make_unique<ContactSolver>(scene, initial, settings);
}

SolvedRun ReferenceSolver::run_varied(const RunEnd& end, FrameSink* sink,
                                      SolverAccuracy accuracy) const {
  ContactScene varied = scene();
  Scene& hard = varied.hard;
  std::optional<ReverseSink> reversing;
  if (accuracy.reversed) {
    reverse_bodies(hard);
    if (sink) reversing.emplace(*sink);
  }
  if (accuracy.other_rule) hard.collapse = other_rule(hard.collapse);
  accuracy.reversed = accuracy.other_rule = false;
  return ReferenceSolver(varied, settings_).run(end, reversing ? &*reversing : sink, accuracy);
}

namespace {

/// Reads a state where there is one, and has it kept from then on.
void keep_on_its_way(KeptSolver& solver, StepsAsEvents* events, RunKeeper& keeper) {
  const auto exchange = [&solver, events](StateArchive& archive) {
    archive(solver);
    if (events) archive(*events);
  };
  if (StateArchive* archive = keeper.resumed()) {
    exchange(*archive);
    archive->finish();
  }
  solver.set_between_frames([&keeper, exchange] {
    if (keeper.is_due()) keeper.keep(exchange);
  });
}

}  // namespace

SolvedRun ReferenceSolver::run(const RunEnd& end, FrameSink* sink, const SolverAccuracy& accuracy,
                               RunKeeper* keeper, const std::function<void()>& started) const {
  if (accuracy.reversed || accuracy.other_rule) return run_varied(end, sink, accuracy);
  std::optional<ContactScene> softer;
  if (softened_to() > 0 && !is_piled() && accuracy.softness != 1)
    softer = with_lasting_contacts(scene_->hard, accuracy.softness * collision_time_);
  if (hardens() && accuracy.softness != 1) {
    softer = scene();
    if (!softer->hard.laws.empty())
      softer->hard.laws = instant_collisions(*scene_, accuracy.softness);
  }
  std::optional<StepsAsEvents> events;
  if (is_stepped() && !is_piled() && sink && !sink->next_look()) events.emplace(*sink);
  const std::unique_ptr<Solver> solver =
      at_start(softer ? *softer : scene(), accuracy, end, !(keeper && keeper->resumed()));
  if (started) started();
  if (keeper)
    keep_on_its_way(dynamic_cast<KeptSolver&>(*solver), events ? &*events : nullptr, *keeper);
  SolvedRun solved = solver->run(end, events ? &*events : sink);
  if (is_stepped() && solved.failed) return solved;
  const std::vector<BodyState> states = solver->states();
  return checked(std::move(solved), states);
}

std::vector<std::vector<BodyState>> ReferenceSolver::states_along(std::span<const double> times,
                                                                  double tolerance) const {
  // Steps keep their length, whatever instants are asked for: between two of them bodies go
  // straight on, which is off by half a step of acceleration.
  const std::unique_ptr<Solver> solver = at_start(scene(), {.tolerance = tolerance}, {});
  std::vector<std::vector<BodyState>> along;
  along.reserve(times.size());
  for (const double time : times) {
    if (!solver->run(until_time(time), nullptr).reached) break;
    std::vector<BodyState>& states = along.emplace_back(solver->states());
    const double beyond = solver->now() - time;
    if (beyond == 0) continue;
    for (BodyState& state : states) state.position -= beyond * state.velocity;
  }
  return along;
}

// --- what looks ahead ----------------------------------------------------------------------------

namespace {

EventSettings looking_from(double start, double slowest) {
  EventSettings settings;
  settings.start = start;
  settings.slowest_rebound = 1e-2 * slowest;  // a cascade of weaker ones would never be it
  return settings;
}

}  // namespace

/// Bodies that are in these states at `start` [s].
std::unique_ptr<LookingSolver> ReferenceSolver::looking(std::span<const BodyState> states,
                                                        double start, double tolerance,
                                                        double slowest) const {
  if (runs_in_phases(scene().hard))
    return std::make_unique<EventSolver>(scene().hard, states, looking_from(start, slowest));
  ContactSettings settings;
  settings.tolerance = tolerance;
  settings.start = start;
  return std::make_unique<ContactSolver>(scene(), states, settings);
}

double ReferenceSolver::first_contact(double limit, double tolerance) const {
  const Scene& hard = scene().hard;
  if (hard.box) return kNever;
  if (!initial_contacts(scene(), hard.initial).empty()) return 0;
  return looking(hard.initial, 0, tolerance)->first_contact(limit);
}

double ReferenceSolver::next_collision(std::span<const BodyState> states, double start,
                                       double limit, double slowest) const {
  constexpr double kTolerance = 1e-8;  // engines are further off
  const Scene& hard = scene().hard;
  if (!hard.surfaces.empty()) {
    if (!EventSolver::can_solve(hard)) return start;
    try {
      return EventSolver(hard, states, looking_from(start, slowest)).next_impact(limit, slowest);
    } catch (const LastingContacts&) {
      return start;
    }
  }
  return looking(states, start, kTolerance, slowest)->next_collision(limit, slowest);
}

std::vector<BodyState> ReferenceSolver::states_at(double time) const {
  const Scene& hard = scene().hard;
  if (time == 0) return hard.initial;
  std::unique_ptr<Solver> solver;
  if (hard.box)
    solver = at_start(scene(), {}, {});
  else if (initial_contacts(scene(), hard.initial).empty())
    solver = looking(hard.initial, 0, SolverAccuracy{}.tolerance);
  else
    solver = std::make_unique<ContactSolver>(scene(), hard.initial);
  solver->run(until_time(time), nullptr);
  return solver->states();
}

}  // namespace slipcheck
