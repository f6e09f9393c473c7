#include "reference/steps/step_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"
#include "reference/events/path_collision.h"
#include "reference/meeting_tree.h"
#include "reference/overlaps.h"
#include "reference/steps/step_kernel.h"

namespace slipcheck {
namespace {

StepKind make_kind(const Scene& scene, std::size_t i, bool general) {
  const Sphere& sphere = scene.bodies[i];
  StepKind kind;
  kind.sphere = sphere;
  kind.contact = &scene.on_substrate(i);
  kind.inverse_mass = 1 / sphere.mass;
  kind.inverse_inertia = 1 / sphere.moment_of_inertia();
  kind.weight = sphere.mass * scene.gravity;
  kind.inverse_radius = 1 / sphere.radius;
  kind.share = 1 / (1 + sphere.inverse_shape_factor());
  kind.turn = sphere.inverse_shape_factor() / sphere.radius;
  kind.coulomb_alone = !general && is_coulomb_alone(*kind.contact);
  return kind;
}

bool is_alike(const Sphere& a, const Sphere& b) {
  return a.radius == b.radius && a.mass == b.mass && a.shape_factor == b.shape_factor &&
         a.shape == b.shape;
}

/// The place among `kinds` of that of body i, which is added where it is none of the last.
std::uint32_t kind_of(const Scene& scene, std::size_t i, bool general,
                      std::vector<StepKind>& kinds) {
  constexpr std::size_t kLooked = 8;  // where radii are drawn each body is of its own kind
  for (std::size_t k = kinds.size(), looked = 0; k > 0 && looked < kLooked; ++looked)
    if (const StepKind& kind = kinds[--k];
        is_alike(kind.sphere, scene.bodies[i]) && kind.contact == &scene.on_substrate(i))
      return static_cast<std::uint32_t>(k);
  kinds.push_back(make_kind(scene, i, general));
  return static_cast<std::uint32_t>(kinds.size() - 1);
}

StepBody make_body(const Scene& scene, std::size_t i, const BodyState& state,
                   double slowest_rebound) {
  const Sphere& sphere = scene.bodies[i];
  StepBody b;
  b.radius = sphere.radius;

  const Vector3 substrate = scene.motion.velocity(0);
  BodyState relative = state;
  relative.velocity -= substrate;
  const bool on_plane = state.position.z() <= sphere.radius * (1 + 4 * kEpsilon);
  if (on_plane && relative.velocity.z() < 0 && !scene.confined)
    land(sphere, scene.on_substrate(i), slowest_rebound, relative);
  b.supported = scene.confined || (on_plane && !(relative.velocity.z() > 0));
  if (b.supported) {
    relative.position.z() = sphere.radius;
    relative.velocity.z() = 0;
    const double slip = slip_velocity(relative, sphere.radius).head<2>().norm();
    const double round_off =
        16 * kEpsilon *
        (state.velocity.norm() + substrate.norm() + sphere.radius * state.angular_velocity.norm());
    b.sticks = slip <= round_off;
  }
  b.position = relative.position;
  b.velocity = relative.velocity + substrate;
  b.angular_velocity = relative.angular_velocity;
  return b;
}

}  // namespace

class StepSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial, const StepSettings& settings)
      : scene_(&scene), kernel_(make_step_kernel(scene, initial, settings)) {
    assert(settings.step > 0 && initial.size() == scene.hard.bodies.size());
    const Scene& hard = scene.hard;
    world_.step = settings.step;
    world_.motion = &hard.motion;
    world_.around.gravity = hard.gravity;
    world_.around.downhill = hard.downhill;
    world_.around.confined = hard.confined;
    world_.around.velocity = hard.motion.velocity(0).head<2>();
    world_.slowest_rebound = std::max(settings.landing_fraction * speed_scale(hard, initial),
                                      hard.gravity * settings.step);
    std::vector<std::uint32_t> kind(initial.size());
    for (std::size_t i = 0; i < initial.size(); ++i)
      kind[i] = kind_of(hard, i, settings.general, world_.kinds);
    world_.bodies.reserve(initial.size());
    for (std::size_t i = 0; i < initial.size(); ++i) {
      world_.bodies.push_back(make_body(hard, i, initial[i], world_.slowest_rebound));
      world_.bodies.back().kind = &world_.kinds[kind[i]];
    }
  }

  /// look: called between two frames.
  SolvedRun run(const RunEnd& end, FrameSink* sink, const std::function<void()>& look) {
    SolvedRun run;
    try {
      if (has_ended(end, sink, look))
        run.reached = true;
      else
        run.stop_at_limit(end.until);
    } catch (const StepTooLong& too_long) {
      run.failed = true;
      run.reason = too_long.what();
    }
    run.end_time = world_.time();
    run.steps = world_.n;
    run.events = run.collisions = world_.collisions;
    return run;
  }

  std::vector<BodyState> states() {
    kernel_->find_forces(world_);
    kernel_->show(world_, frame_, false);
    return std::move(frame_.bodies);
  }

  void exchange(StateArchive& archive) {
    archive(quiet_from_);
    std::vector<const StepKind*> kinds(world_.bodies.size());  // in the scene's order
    for (std::size_t k = 0; k < kinds.size(); ++k)
      kinds[world_.number_of(k)] = world_.bodies[k].kind;
    kernel_->exchange(archive, world_);
    goes_on_ = archive.reads();
    for (std::size_t k = 0; k < world_.bodies.size(); ++k)  // none where the loop has its own
      world_.bodies[k].kind = kinds[world_.number_of(k)];
  }

  double now() const { return world_.time(); }
  std::vector<std::string> features() const { return kernel_->features(); }

  double energy() {
    const Scene& hard = scene_->hard;
    const std::vector<BodyState> all = states();
    double energy = elastic_energy(*scene_, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const BodyState& s = all[i];
      const Sphere& sphere = hard.bodies[i];
      energy +=
          0.5 * sphere.mass * s.velocity.squaredNorm() +
          0.5 * sphere.moment_of_inertia() * s.angular_velocity.squaredNorm() +
          sphere.mass * (hard.gravity * s.position.z() - hard.downhill.dot(s.position.head<2>()));
    }
    return energy;
  }

 private:
  /// Goes on to the end; whether it came there before the limit.
  bool has_ended(const RunEnd& end, FrameSink* sink, const std::function<void()>& look) {
    const bool to_a_time = end.until == Run::Until::time;
    const auto last =
        static_cast<std::size_t>(std::ceil(end.last() / world_.step * (1 - 4 * kEpsilon)));
    const StepStop wanted = to_a_time                          ? StepStop::never
                            : end.until == Run::Until::rolling ? StepStop::rolling
                                                               : StepStop::rest;
    if (!std::exchange(goes_on_, false)) quiet_from_ = world_.n;
    while (true) {
      kernel_->find_forces(world_);
      if (sink && world_.time() >= sink->next_look().value_or(0)) {
        kernel_->show(world_, frame_, !sink->next_look());
        sink->take(world_.time(), frame_);
        if (sink->next_look()) frame_ = {};  // until then searches have its memory
      }
      if (wanted != StepStop::never && world_.n >= quiet_from_ && kernel_->is_met(world_, wanted)) {
        const double meeting = next_collision(end.limit - world_.time());
        if (meeting == kNever) return true;
        quiet_from_ = world_.n + 1 + static_cast<std::size_t>(meeting / world_.step);
      }
      if (world_.n >= last) return to_a_time;
      const bool is_watched = world_.n >= quiet_from_;
      std::size_t steps = sink ? steps_to_look(*sink, last) : last - world_.n;
      if (!is_watched) steps = std::min(steps, quiet_from_ - world_.n);
      kernel_->advance(world_, steps, is_watched ? wanted : StepStop::never);
      look();
    }
  }

  /// Until it looks again, at least one, and not so many that nothing else is heeded.
  std::size_t steps_to_look(const FrameSink& sink, std::size_t last) const {
    constexpr double kMost = 64;
    const double until = (sink.next_look().value_or(0) - world_.time()) / world_.step;
    return std::min(static_cast<std::size_t>(std::clamp(std::ceil(until), 1.0, kMost)),
                    last - world_.n);
  }

  /// In what time bodies that all roll collide again, or infinity: exact on a level substrate at
  /// rest. Elsewhere straight on, half the time to that collision: all that roll are accelerated
  /// alike, if their shape factors are.
  double next_collision(double limit) {
    const Scene& hard = scene_->hard;
    const std::vector<BodyState> all = states();
    if (hard.motion.is_still() && hard.downhill.isZero(0) && hard.surfaces.empty()) {
      EventSolver ahead(hard, all);
      return ahead.next_collision(limit, 0);
    }
    const auto touch = [&](std::size_t i, std::size_t j, double horizon) {
      return time_to_touch(hard.to_nearest_image(all[i].position - all[j].position),
                           all[i].velocity - all[j].velocity, Vector3::Zero(),
                           hard.bodies[i].radius + hard.bodies[j].radius, horizon);
    };
    const double at_surface = first_at_surface(all);
    if (!hard.periodic.isZero(0))
      return 0.5 * std::min(at_surface, first_in_period(all, limit, touch));
    std::vector<StraightSphere> spheres;
    for (std::size_t i = 0; i < all.size(); ++i)
      spheres.push_back({all[i].position, all[i].velocity, hard.bodies[i].radius});
    const double first = std::min(at_surface, MeetingTree(spheres, false).first(limit, touch));
    return first < limit ? 0.5 * first : kNever;
  }

  /// Before which none comes to a surface straight on [s]: their shapes are convex, so that what
  /// goes away comes to none, and what comes closer does not do so faster.
  double first_at_surface(const std::vector<BodyState>& all) const {
    double first = kNever;
    for (const Surface& surface : scene_->hard.surfaces)
      for (std::size_t i = 0; i < all.size(); ++i) {
        const NearestPoint at = nearest_point(surface.shape, all[i].position);
        const double closing = -at.normal.dot(all[i].velocity);
        const double gap = at.distance - scene_->hard.bodies[i].radius;
        if (closing > 0) first = std::min(first, std::max(gap, 0.0) / closing);
      }
    return first;
  }

  /// The same on a periodic plane, or a time in which none comes far: of images there is no end.
  template <class Touch>
  double first_in_period(const std::vector<BodyState>& all, double limit,
                         const Touch& touch) const {
    Vector3 mean = Vector3::Zero();
    for (const BodyState& state : all) mean += state.velocity / static_cast<double>(all.size());
    const Scene& hard = scene_->hard;
    double fastest = 0, largest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      fastest = std::max(fastest, (all[i].velocity - mean).norm());
      largest = std::max(largest, hard.bodies[i].radius);
    }
    if (fastest == 0) return kNever;
    const double horizon = std::min(limit, largest / fastest);
    double first = horizon < limit ? horizon : kNever;
    for (const auto& [i, j] :
         near_pairs(near_spheres(hard, all), 2 * fastest * horizon, hard.periodic))
      first = std::min(first, touch(i, j, horizon));
    return first;
  }

  const ContactScene* scene_;
  std::unique_ptr<StepKernel> kernel_;
  StepWorld world_;
  Frame frame_;
  std::size_t quiet_from_ = 0;  ///< step; before it bodies are known to collide yet
  bool goes_on_ = false;        ///< behind a frame that was shown
};

StepSolver::StepSolver(const ContactScene& scene, std::span<const BodyState> initial,
                       const StepSettings& settings)
    : impl_(std::make_unique<Impl>(scene, initial, settings)) {}
StepSolver::~StepSolver() = default;
StepSolver::StepSolver(StepSolver&&) noexcept = default;

SolvedRun StepSolver::run(const RunEnd& end, FrameSink* sink) {
  return impl_->run(end, sink, [this] { look_between_frames(); });
}
void StepSolver::exchange(StateArchive& archive) { impl_->exchange(archive); }
std::vector<BodyState> StepSolver::states() const { return impl_->states(); }
double StepSolver::now() const { return impl_->now(); }
double StepSolver::energy() const { return impl_->energy(); }
std::vector<std::string> StepSolver::features() const { return impl_->features(); }

double step_limit(double omega0, double gamma) {
  // √(1 + ε²) − ε without the difference of like numbers.
  const double damping_ratio = gamma / omega0;
  return 2 / (omega0 * (std::hypot(1, damping_ratio) + damping_ratio));
}

}  // namespace slipcheck
