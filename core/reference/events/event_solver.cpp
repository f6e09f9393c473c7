#include "reference/events/event_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "physics/numbers.h"
#include "reference/events/event_scheduler.h"
#include "reference/events/indexed_heap.h"
#include "reference/events/rate_limit.h"
#include "reference/events/scan_queue.h"
#include "reference/events/substrate_world.h"
#include "reference/events/surface_world.h"
#include "reference/lasting_contacts.h"
#include "reference/meeting_tree.h"
#include "scene/ode.h"

namespace slipcheck {
namespace {

LeastSpeeds least_speeds(const Scene& scene, std::span<const BodyState> states,
                         const EventSettings& settings) {
  return {.rebound_fraction = settings.collapse_fraction,
          .rebound = settings.slowest_rebound,
          .landing = settings.landing_fraction * speed_scale(scene, states)};
}

/// Bodies that roll go on to do so, and a tilt or the plane's motion accelerates all of them alike:
/// K (22), with friction enough.
bool are_driven_alike(const Scene& scene) {
  const double A = scene.bodies[0].inverse_shape_factor();
  const double drive = scene.downhill.norm() + scene.motion.largest_acceleration();
  return std::ranges::all_of(
             scene.bodies, [&](const Sphere& each) { return each.inverse_shape_factor() == A; }) &&
         std::ranges::all_of(scene.substrate, [&](const SubstrateContact& each) {
           return each.rolling.is_zero() && !(each.coupled_radius > 0) &&
                  drive <= (1 + A) * each.static_friction * scene.gravity;
         });
}

RateLimit rate_limit(const EventSettings& settings, std::size_t bodies, double now) {
  const std::size_t of_many = bodies > settings.most_without_cells ? 1000 * bodies : 0;
  return {settings.most_events, bodies, settings.burst + of_many, now};
}

}  // namespace

double speed_scale(const Scene& scene, std::span<const BodyState> states) {
  double scale = scene.motion.largest_speed();
  for (const Surface& surface : scene.surfaces) {
    scale = std::max(scale, surface.motion.course().largest_speed());
    for (const Sphere& sphere : scene.bodies)
      scale = std::max({scale, sphere.radius * surface.motion.rate().norm(),
                        std::sqrt(2 * scene.gravity * sphere.radius)});
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    const double radius = scene.bodies[i].radius;
    const double height = std::max(0.0, s.position.z() - radius);
    scale = std::max({scale, s.velocity.norm(), radius * s.angular_velocity.norm(),
                      std::sqrt(2 * scene.gravity * height),
                      std::sqrt(2 * scene.downhill.norm() * radius)});
  }
  return scale;
}

/// A world with its scheduler, whatever kind of both the scene asks for.
class EventSolver::Engine : public LookingSolver {
 public:
  virtual std::unique_ptr<Engine> copy() const = 0;
  virtual double next_impact(double limit, double slowest) = 0;
};

template <class World, class Queue>
class EventSolver::EngineOf final : public Engine {
 public:
  EngineOf(const Scene& scene, std::span<const BodyState> initial, const EventSettings& settings,
           const LeastSpeeds& least, double now)
      : scene_(&scene),
        settings_(settings),
        least_(least),
        now_(now),
        world_(scene, initial, least, now),
        scheduler_(world_, now) {}
  EngineOf(const EngineOf& other)
      : scene_(other.scene_),
        settings_(other.settings_),
        least_(other.least_),
        now_(other.now_),
        world_(other.world_),
        scheduler_(other.scheduler_, world_) {
    world_.set_sink(nullptr);
  }

  std::unique_ptr<Engine> copy() const override { return std::make_unique<EngineOf>(*this); }
  double now() const override { return now_; }
  std::vector<std::string> features() const override {
    if constexpr (kOnSurfaces)
      return world_.features();
    else
      return {World::kIsStill ? "phases on a level, still plane" : "phases on any plane",
              World::kHasCells ? "neighbours in cells, a calendar queue"
                               : "all pairs, a scan for the next event"};
  }
  std::vector<BodyState> states() const override {
    std::vector<BodyState> states(world_.size());
    for (std::uint32_t i = 0; i < states.size(); ++i) states[i] = world_.state_at(i, now_);
    return states;
  }

  double first_contact(double limit) override {
    const std::size_t so_far = world_.collisions() + world_.landings();
    return time_of(
        limit, [&](const World& world) { return world.collisions() + world.landings() != so_far; });
  }
  double next_collision(double limit, double slowest) override {
    if constexpr (World::kHasCells && !kOnSurfaces) {
      if (slowest == 0 && rolls_straight() && !world_.is_any_slipping())
        return first_of_pairs(limit);
    }
    return time_of_hard(limit, slowest, [](const World& world) { return world.collisions(); });
  }
  double next_impact(double limit, double slowest) override {
    return time_of_hard(limit, slowest,
                        [](const World& world) { return world.collisions() + world.landings(); });
  }

  SolvedRun run(const RunEnd& end, FrameSink* sink) override {
    SolvedRun run;
    const double last = end.last();
    const std::size_t events = world_.events(), collisions = world_.collisions();
    const std::size_t collapses = world_.collapses();
    RateLimit rate = rate_limit(settings_, world_.size(), now_);
    const std::size_t of_many =
        world_.size() > settings_.most_without_cells ? 1000 * world_.size() : 0;
    // What nothing presses together comes to an end, however long a cascade it is.
    const std::size_t most_collapses = is_rubbed(*scene_) ? settings_.most_collapses + of_many
                                                          : std::numeric_limits<std::size_t>::max();
    world_.set_sink(sink);
    world_.show(now_);
    while (true) {
      if (has_ended(end)) {
        world_.show_the_rest(now_);
        run.reached = true;
        break;
      }
      if (!(scheduler_.next_time() <= last)) {
        if (std::isfinite(last)) now_ = std::max(now_, last);
        world_.show(now_);
        run.stop_at_limit(end.until);
        break;
      }
      scheduler_.step();
      now_ = scheduler_.now();
      if (rate.is_exceeded(now_)) {
        world_.show(now_);
        run.reason = rate.reason(now_);
        break;
      }
      if (world_.collapses() - collapses > most_collapses) {
        world_.show(now_);
        run.reason = fmt::format(
            "bodies stay in contact at {:.9g} s, of which collisions at instants know nothing: "
            "run.collapse has changed {} collisions",
            now_, most_collapses);
        break;
      }
    }
    world_.set_sink(nullptr);
    run.end_time = now_;
    run.events = world_.events() - events;
    run.collisions = world_.collisions() - collisions;
    run.collapses = world_.collapses() - collapses;
    return run;
  }

 private:
  static constexpr bool kOnSurfaces = std::is_base_of_v<SurfaceWorld, World>;

  /// When a copy that runs ahead comes to what `has_come` tells, or infinity where it does not
  /// before `limit` [s].
  template <class HasCome>
  double time_of(double limit, HasCome has_come) const {
    EngineOf ahead = *this;
    RateLimit rate = rate_limit(settings_, world_.size(), now_);
    while (ahead.scheduler_.next_time() <= limit) {
      ahead.scheduler_.step();
      if (has_come(ahead.world_)) return ahead.scheduler_.now();
      if (rate.is_exceeded(ahead.scheduler_.now())) break;
    }
    return kNever;
  }

  /// The same for the first of what is counted that is `slowest` [m/s] or faster.
  template <class Count>
  double time_of_hard(double limit, double slowest, Count count) const {
    std::size_t so_far = count(world_);
    return time_of(limit, [&](const World& world) {
      if (count(world) == so_far) return false;
      so_far = count(world);
      return slowest == 0 || world.last_impact_speed() >= slowest;
    });
  }

  bool has_ended(const RunEnd& end) {
    if (end.until == Run::Until::time) return false;
    if (end.until == Run::Until::rest && world_.is_any_moving()) return false;
    if (world_.is_any_slipping()) return false;
    if (scheduler_.next_time() == kNever) return true;
    return !collides_again(end.limit);
  }

  /// Beside surfaces what rolls may also come to one of them, or over an edge.
  bool collides_again(double limit) {
    if constexpr (kOnSurfaces) {
      if (first_contact(limit) < kNever) return true;
    }
    const std::size_t after_next = world_.collisions() + 1;
    if (certain_collisions_ == after_next) return true;
    if (is_any_planned() || time_of_next(limit) < kNever) certain_collisions_ = after_next;
    return certain_collisions_ == after_next;
  }

  /// A collision planned on exact paths comes, unless another one comes before.
  bool is_any_planned() const {
    for (std::uint32_t i = 0; i < world_.size(); ++i)
      if (scheduler_.has_collision(i) && world_.is_exact_pair(i, scheduler_.partner(i)))
        return true;
    return false;
  }

  /// What rolls on a plane without bounds goes straight on, as seen from all others that roll.
  bool rolls_straight() const {
    if (scene_->periodic != Vector2::Zero()) return false;
    return World::kIsStill || are_driven_alike(*scene_);
  }

  /// When the first two bodies meet, all of which do. (In cells, bodies that fly apart would cross
  /// them for ever.)
  double first_of_pairs(double limit) const {
    using Pairs = SubstrateWorld<typename World::PhaseType, AllPairs>;
    const std::vector<BodyState> all = states();
    std::vector<StraightSphere> spheres;
    for (std::size_t i = 0; i < all.size(); ++i)
      spheres.push_back({all[i].position, all[i].velocity, scene_->bodies[i].radius});
    const bool may_stop = std::ranges::any_of(
        scene_->substrate, [](const auto& contact) { return !contact.rolling.is_zero(); });
    Scene two = *scene_;
    two.bodies.resize(2);
    two.material.resize(2);
    if (!two.extents.empty()) two.extents.resize(2);
    const double time = MeetingTree(spheres, may_stop)
                            .first(limit - now_, [&](std::size_t i, std::size_t j, double horizon) {
                              for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
                                const std::size_t from = k == 0 ? i : j;
                                two.bodies[k] = scene_->bodies[from];
                                two.material[k] = scene_->material[from];
                                if (!two.extents.empty()) two.extents[k] = scene_->extents[from];
                              }
                              const std::array<BodyState, 2> pair = {all[i], all[j]};
                              EngineOf<Pairs, ScanQueue> ahead(two, pair, settings_, least_, now_);
                              return ahead.next_collision(now_ + horizon, 0) - now_;
                            });
    return now_ + time;
  }

  /// The same of any that roll; where some are driven otherwise than others, by all pairs.
  double time_of_next(double limit) {
    if constexpr (World::kHasCells && !kOnSurfaces) {
      if (scene_->periodic == Vector2::Zero() && !rolls_straight()) {
        using Pairs = SubstrateWorld<typename World::PhaseType, AllPairs>;
        EngineOf<Pairs, HeapQueue> ahead(*scene_, states(), settings_, least_, now_);
        return ahead.next_collision(limit, 0);
      }
    }
    return next_collision(limit, 0);
  }

  const Scene* scene_;
  EventSettings settings_;
  LeastSpeeds least_;
  double now_;
  World world_;
  EventScheduler<World, Queue> scheduler_;
  std::size_t certain_collisions_ = 0;  ///< so many there will be before the limit
};

EventSolver::EventSolver(const Scene& scene, std::span<const BodyState> initial,
                         const EventSettings& settings) {
  const bool has_cells =
      scene.bodies.size() > settings.most_without_cells || scene.periodic != Vector2::Zero();
  const LeastSpeeds least = least_speeds(scene, initial, settings);
  const auto make = [&]<class Few, class Many>(
                        std::type_identity<Few>,
                        std::type_identity<Many>) -> std::unique_ptr<Engine> {
    if (has_cells)
      return std::make_unique<EngineOf<Many, CalendarQueue>>(scene, initial, settings, least,
                                                             settings.start);
    return std::make_unique<EngineOf<Few, ScanQueue>>(scene, initial, settings, least,
                                                      settings.start);
  };
  const auto on_plane = [&]<class Phase>(std::type_identity<Phase>) {
    return make(std::type_identity<SubstrateWorld<Phase, AllPairs>>{},
                std::type_identity<SubstrateWorld<Phase, PlaneCells>>{});
  };
  if (!scene.surfaces.empty())
    engine_ = make(std::type_identity<SurfaceWorldOf<AllPairs>>{},
                   std::type_identity<SurfaceWorldOf<PlaneCells>>{});
  else if (is_exact(scene) && !settings.general)
    engine_ = on_plane(std::type_identity<SubstratePhase>{});
  else
    engine_ = on_plane(std::type_identity<DrivenPhase>{});
}

EventSolver::EventSolver(const EventSolver& other) : engine_(other.engine_->copy()) {}
EventSolver& EventSolver::operator=(const EventSolver& other) {
  engine_ = other.engine_->copy();
  return *this;
}
EventSolver::EventSolver(EventSolver&&) noexcept = default;
EventSolver& EventSolver::operator=(EventSolver&&) noexcept = default;
EventSolver::~EventSolver() = default;

bool EventSolver::is_exact(const Scene& scene) {
  if (!scene.surfaces.empty()) return true;  // or integrated phases to their bound
  return scene.motion.is_still() && scene.downhill.isZero(0);
}

bool EventSolver::can_solve(const Scene& scene) {
  if (!scene.surfaces.empty()) return SurfaceWorld::obstacle(scene).empty();
  return !scene.box && std::ranges::all_of(scene.substrate, [](const SubstrateContact& contact) {
    return contact.coupled_radius == 0 &&
           (!contact.rolling_while_sliding || contact.rolling.is_zero());
  });
}

SolvedRun EventSolver::run(const RunEnd& end, FrameSink* sink) {
  try {
    return engine_->run(end, sink);
  } catch (const IntegrationFailure& failure) {  // of a collision that is integrated
    SolvedRun failed;
    failed.end_time = now();
    failed.failed = true;
    failed.reason = failure.what();
    return failed;
  } catch (const LastingContacts& lasting) {
    SolvedRun stopped;
    stopped.end_time = now();
    stopped.lasting = true;
    stopped.reason = lasting.what();
    return stopped;
  }
}
double EventSolver::first_contact(double limit) { return engine_->first_contact(limit); }
double EventSolver::next_collision(double limit, double slowest) {
  return engine_->next_collision(limit, slowest);
}
double EventSolver::next_impact(double limit, double slowest) {
  return engine_->next_impact(limit, slowest);
}
std::vector<BodyState> EventSolver::states() const { return engine_->states(); }
double EventSolver::now() const { return engine_->now(); }
std::vector<std::string> EventSolver::features() const { return engine_->features(); }

}  // namespace slipcheck
