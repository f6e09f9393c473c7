#include "reference/piles/pile_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/thread_team.h"
#include "physics/numbers.h"
#include "reference/events/event_solver.h"
#include "reference/near_pairs.h"
#include "reference/piles/pile_law.h"
#include "reference/piles/pile_loop.h"
#include "reference/piles/pile_rest.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

/// Gaps up to this part of a radius are none: positions are typed.
constexpr double kTypedGap = 1e-5;

bool is_autonomous(const Scene& scene) {
  return scene.motion.is_still() && std::ranges::all_of(scene.surfaces, [](const Surface& each) {
           return each.motion.is_still();
         });
}

/// Bodies that touch another one, the substrate or a surface from the start, within kTypedGap.
std::vector<bool> carried_bodies(const Scene& scene, std::span<const PileBody> bodies) {
  std::vector<bool> carried(bodies.size());
  double largest = 0;
  for (const PileBody& b : bodies) largest = std::max(largest, b.radius);
  const auto sphere = [&](std::size_t i) {
    return NearSphere{bodies[i].position, bodies[i].radius};
  };
  for (const auto& [i, j] :
       near_pairs({bodies.size(), sphere}, 2 * kTypedGap * largest, scene.periodic)) {
    const double reach = bodies[i].radius + bodies[j].radius;
    if (scene.to_nearest_image(bodies[i].position - bodies[j].position).norm() <=
        (1 + kTypedGap) * reach)
      carried[i] = carried[j] = true;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PileBody& b = bodies[i];
    const double reach = (1 + kTypedGap) * b.radius;
    if (scene.has_substrate && b.position.z() <= reach) carried[i] = true;
    for (const Surface& surface : scene.surfaces)
      if (surface.nearest(0, b.position).distance <= reach) carried[i] = true;
  }
  return carried;
}

}  // namespace

class PileSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial, const PileSettings& settings)
      : scene_(&scene),
        settings_(settings),
        laws_(scene,
              settings.collision_time > 0 ? settings.collision_time : pile_collision_time(scene),
              settings.least_restitution),
        loop_(make_pile_loop(laws_, scene, settings.general, settings.ordered_from)) {
    const std::size_t n = initial.size();
    if (settings.threads != 1 && n >= settings.ordered_from)
      world_.team = &team_.emplace(settings.threads);
    world_.scene = &scene;
    world_.laws = &laws_;
    world_.gravity = scene.hard.gravity_vector();
    const double shortest = laws_.shortest_contact();
    if (settings.step > 0)
      world_.step = settings.step;
    else if (std::isfinite(shortest))
      world_.step = shortest / settings.steps_per_contact;
    else
      throw Unsupported(
          "steps of fixed length need a contact to be measured by, and nothing moves");
    world_.bodies.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Sphere& sphere = scene.hard.bodies[i];
      PileBody& body = world_.add();
      body.radius = sphere.radius;
      body.mass = sphere.mass;
      body.inertia = sphere.moment_of_inertia();
      body.position = initial[i].position;
      body.velocity = initial[i].velocity;
      body.angular_velocity = initial[i].angular_velocity;
    }
    if (settings.prepare && starts_at_rest()) failure_ = prepare();
  }

  /// look: called between two frames.
  SolvedRun run(const RunEnd& end, FrameSink* sink, const std::function<void()>& look) {
    SolvedRun run;
    run.failed = !failure_.empty();
    run.reason = failure_;
    try {
      if (!run.failed && has_ended(end, sink, look))
        run.reached = true;
      else if (!run.failed)
        run.stop_at_limit(end.until);
    } catch (const StepTooLong& too_long) {
      run.failed = true;
      run.reason = failure_ = too_long.what();
    }
    run.end_time = world_.time();
    run.steps = world_.n;
    run.events = run.collisions = world_.collisions;
    run.balance = balance();
    return run;
  }

  std::vector<BodyState> states() {
    if (failure_.empty()) loop_->find_forces(world_);
    std::vector<BodyState> all;
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) all.push_back(world_.state(i));
    return all;
  }

  EnergyBalance balance() {
    EnergyBalance balance;
    balance.energy = energy();
    balance.initial = initial_energy_.value_or(balance.energy);
    balance.dissipated = world_.ledger.dissipated;
    balance.work = world_.ledger.work;
    balance.scale = std::max(
        {largest_kinetic_, initial_elastic_, std::abs(balance.dissipated), std::abs(balance.work)});
    return balance;
  }

  std::vector<std::string> features() const {
    std::vector<std::string> told = loop_->features();
    if (laws_.has_hard())
      told.push_back("hard contacts as linear ones that last, with springs against sliding");
    if (is_prepared_) told.push_back("weights put on slowly before the start");
    return told;
  }

  void exchange(StateArchive& archive) {
    archive(failure_, is_prepared_, initial_energy_, initial_elastic_, largest_kinetic_,
            quiet_since_, next_meeting_, watch_, next_look_);
    archive(world_.step, world_.n, world_.started, world_.bodies, world_.place, world_.ledger,
            world_.collisions, world_.slid);
    loop_->exchange(archive);
    goes_on_ = archive.reads();
  }

  double step() const { return world_.step; }
  double now() const { return world_.time(); }
  double collision_time() const { return laws_.has_hard() ? laws_.collision_time() : 0; }

 private:
  static constexpr double kLoadingTime = 200, kSettlingTime = 3000;  // collisions
  static constexpr double kDragPerTime = 0.2;
  static constexpr double kMostMoved = 1e-2;  // radii
  static constexpr double kStillFalls = 10;
  /// Steps between two looks at whether the run may end.
  static constexpr std::uint64_t kLook = 64;

  double kinetic_energy() {
    double energy = 0;
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      const BodyState s = world_.state(i);
      energy += 0.5 * world_.body(i).mass * s.velocity.squaredNorm() +
                0.5 * world_.body(i).inertia * s.angular_velocity.squaredNorm();
    }
    return energy;
  }

  double energy() {
    if (failure_.empty()) loop_->find_forces(world_);
    const double kinetic = kinetic_energy();
    largest_kinetic_ = std::max(largest_kinetic_, kinetic);
    double energy = kinetic + loop_->elastic_energy();
    for (std::size_t i = 0; i < world_.bodies.size(); ++i)
      energy -= world_.body(i).mass * world_.gravity.dot(world_.body(i).position);
    return energy;
  }

  bool starts_at_rest() const {
    return !world_.gravity.isZero(0) && is_autonomous(scene_->hard) &&
           std::ranges::all_of(world_.bodies, [](const PileBody& b) {
             return b.velocity.isZero(0) && b.angular_velocity.isZero(0);
           });
  }

  /// The largest acceleration that the carried bodies are left with.
  double unrest() const {
    double most = 0;
    for (const PileBody& b : world_.bodies)
      if (b.load > 0)
        most = std::max({most, (b.force / b.mass + world_.gravity).norm(),
                         b.radius * b.torque.norm() / b.inertia});
    return most;
  }

  bool has_moved(std::span<const Vector3> from) const {
    for (std::size_t i = 0; i < from.size(); ++i)
      if ((world_.body(i).position - from[i]).norm() > kMostMoved * world_.body(i).radius)
        return true;
    return false;
  }

  /// Puts the weights on slowly; says why that fails, or nothing.
  std::string prepare() {
    constexpr double kLeft = 1e-8;  // of gravity
    const std::vector<bool> carried = carried_bodies(scene_->hard, world_.bodies);
    if (std::ranges::none_of(carried, [](bool each) { return each; })) return {};
    is_prepared_ = true;
    std::vector<Vector3> from;
    for (std::size_t i = 0; i < carried.size(); ++i) {
      world_.body(i).load = carried[i] ? 1 : 0;
      from.push_back(world_.body(i).position);
    }
    const Vector3 gravity = world_.gravity;
    const double unit =
        std::max(laws_.has_hard() ? laws_.collision_time() : 0.0, laws_.shortest_contact());
    world_.drag = kDragPerTime / unit;
    world_.dilates = true;
    const auto per_unit = static_cast<std::size_t>(std::ceil(unit / world_.step));
    try {
      for (int k = 1; k <= kLoadingTime + kSettlingTime && !has_moved(from); ++k) {
        world_.gravity = std::min(1.0, k / kLoadingTime) * gravity;
        loop_->advance(world_, per_unit);
        loop_->find_forces(world_);
        if (k > kLoadingTime && unrest() <= kLeft * gravity.norm()) break;
      }
    } catch (const StepTooLong& too_long) {
      return too_long.what();
    }
    std::vector<Touch> unused;
    loop_->take_touches(unused);
    world_.gravity = gravity;
    world_.drag = 0;
    world_.dilates = false;
    for (PileBody& b : world_.bodies) {
      b.load = 1;
      for (Vector3* each : {&b.velocity, &b.angular_velocity, &b.change, &b.turn_change, &b.turned})
        each->setZero();
    }
    world_.n = 0;
    world_.started = false;
    world_.ledger = {};
    world_.collisions = 0;
    return {};
  }

  void show(FrameSink* sink) {
    if (!sink) return;
    Frame frame;  // not kept: until the next one searches have its memory
    frame.bodies = states();
    loop_->take_touches(frame.touches);
    sink->take(world_.time(), frame);
  }

  /// Goes on to the end; whether it came there before the limit.
  bool has_ended(const RunEnd& end, FrameSink* sink, const std::function<void()>& look) {
    world_.watched = sink != nullptr;
    if (!std::exchange(goes_on_, false)) begin(sink);
    const auto last =
        static_cast<std::uint64_t>(std::ceil(end.last() / world_.step * (1 - 4 * kEpsilon)));
    const std::uint64_t chunk = sink ? settings_.steps_per_frame : kLook;
    const bool may_rest = settings_.skip_rest && is_autonomous(scene_->hard);
    while (true) {
      if (world_.n >= next_look_) {
        next_look_ = world_.n + kLook;
        largest_kinetic_ = std::max(largest_kinetic_, kinetic_energy());
        if (end.until == Run::Until::rolling && rolls_for_ever(end.limit)) return true;
        if (may_rest && watch_.sees_rest(world_.time(), world_.bodies)) {
          if (end.until != Run::Until::time) return true;
          skip_to(last, sink);
          return true;
        }
      }
      if (world_.n >= last) return end.until == Run::Until::time;
      loop_->advance(world_, std::min(chunk, last - world_.n));
      loop_->find_forces(world_);
      show(sink);
      look();
    }
  }

  void begin(FrameSink* sink) {
    loop_->find_forces(world_);
    if (!initial_energy_) {
      world_.ledger = {};  // what touches from the start came with its energy
      initial_energy_ = energy();
      initial_elastic_ = loop_->elastic_energy();
    }
    show(sink);
    watch_ = PileRest(rest_window());
    next_look_ = world_.n;
  }

  /// Longer than an unstable equilibrium takes to grow from rounding to what is seen, and than what
  /// contacts still have takes to die out.
  double rest_window() const {
    const double g = world_.gravity.norm();
    double largest = 0;
    for (const PileBody& b : world_.bodies) largest = std::max(largest, b.radius);
    const double falls = g > 0 ? kStillFalls * std::sqrt(largest / g) : 0;
    return std::max(falls, 100 * settings_.steps_per_contact * world_.step);
  }

  void skip_to(std::uint64_t last, FrameSink* sink) {
    if (world_.n >= last) return;
    loop_->wait(static_cast<double>(last - world_.n) * world_.step);
    world_.n = last;
    show(sink);
  }

  bool rolls_for_ever(double limit) {
    const Scene& hard = scene_->hard;
    const bool slid = std::exchange(world_.slid, false);
    if (slid) quiet_since_ = world_.time();
    constexpr double kQuiet = 20;  // contacts
    if (world_.time() - quiet_since_ < kQuiet * settings_.steps_per_contact * world_.step)
      return false;
    if (!hard.surfaces.empty() || !hard.has_substrate || !hard.motion.is_still() ||
        !hard.downhill.isZero(0) || loop_->bodies_touch() ||
        !loop_->rolls_on_substrate(world_.bodies.size()) || world_.time() < next_meeting_)
      return false;
    std::vector<BodyState> ahead = states();
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      ahead[i].position.z() = world_.body(i).radius;
      ahead[i].velocity.z() = 0;
    }
    const double meeting = EventSolver(hard, ahead).next_collision(limit - world_.time(), 0);
    next_meeting_ = world_.time() + meeting;
    return meeting == kNever;
  }

  const ContactScene* scene_;
  PileSettings settings_;
  PileLaws laws_;
  std::unique_ptr<PileLoop> loop_;
  std::optional<ThreadTeam> team_;
  PileWorld world_;
  std::string failure_;
  bool is_prepared_ = false;
  std::optional<double> initial_energy_;
  double initial_elastic_ = 0, largest_kinetic_ = 0;
  double quiet_since_ = 0, next_meeting_ = 0;
  PileRest watch_;
  std::uint64_t next_look_ = 0;
  bool goes_on_ = false;  ///< behind a frame that was shown
};

PileSolver::PileSolver(const ContactScene& scene, std::span<const BodyState> initial,
                       const PileSettings& settings)
    : impl_(std::make_unique<Impl>(scene, initial, settings)) {}
PileSolver::~PileSolver() = default;
PileSolver::PileSolver(PileSolver&&) noexcept = default;

SolvedRun PileSolver::run(const RunEnd& end, FrameSink* sink) {
  return impl_->run(end, sink, [this] { look_between_frames(); });
}
void PileSolver::exchange(StateArchive& archive) { impl_->exchange(archive); }
std::vector<BodyState> PileSolver::states() const { return impl_->states(); }
double PileSolver::now() const { return impl_->now(); }
std::vector<std::string> PileSolver::features() const { return impl_->features(); }
double PileSolver::step() const { return impl_->step(); }
double PileSolver::collision_time() const { return impl_->collision_time(); }
EnergyBalance PileSolver::balance() const { return impl_->balance(); }

}  // namespace slipcheck
