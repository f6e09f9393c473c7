#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/events/calendar_queue.h"
#include "reference/events/prefetch.h"

namespace slipcheck {

/// What an event of one body alone has changed.
enum class BodyChange {
  nothing,  ///< only its next own event is to be found again
  cell,     ///< it has new neighbours
  path,     ///< it moves differently from here
};

/// What a body has before it.
struct EventPlan {
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};

  double collision = kNever;        ///< [s], absolute
  double own = kNever;              ///< [s], absolute
  std::uint32_t partner = kNobody;  ///< in the collision
  std::uint32_t own_kind = 0;       ///< what its own event is, in numbers of the world's
};

/// The neighbours that a search for a collision looks at.
enum class Neighbourhood { all, since_cell_changed };

/// A world that keeps the plans beside its bodies and looks for collisions itself: both need little
/// more than one cache line of each neighbour.
template <class World>
concept KeepsPlans = requires(World& world, std::uint32_t i, double time) {
  { world.plan(i) } -> std::same_as<EventPlan&>;
  { world.first_collision(i, time, time, Neighbourhood::all) } -> std::same_as<EventPlan>;
};

/// Event-driven molecular dynamics after Lubachevsky (1991), as L Sec. III A: every body has one
/// planned collision and one planned event of its own (a wall, the end of a phase, a cell border),
/// the queue holds the earlier of the two, and only the bodies of an event are touched.
///
/// A body whose partner has been taken by an earlier collision, or has changed its path, keeps the
/// time of its plan; nothing else can happen to it before, and then it looks for a new one.
///
/// World tells the physics:
///   size_t size();
///   double own_event_time(i, now);            plans it; absolute [s], maybe infinite
///   BodyChange do_own_event(i, now);              performs it
///   double collision_time(i, j, now, shift);  absolute [s], >= now, or infinite
///   span<const uint32_t> collide(i, j, now);  performs it; the bodies that changed
///   for_each_near(i, f), for_each_newly_near(i, f): f(j, shift) for all bodies that may collide
///     with i before either changes its cell; of the latter, those since its cell changed.
/// A world that KeepsPlans has in place of the last two
///   EventPlan& plan(i);                       only kept there
///   EventPlan first_collision(i, now, before, neighbourhood): the earliest collision of i that
///     comes before `before` and before that of the partner, or nobody.
template <class World, class Queue = CalendarQueue>
class EventScheduler {
 public:
  /// Plans for all bodies, which are as at time `now` [s]. The world must outlive this.
  EventScheduler(World& world, double now) : world_(&world), now_(now), queue_(world.size()) {
    if constexpr (!KeepsPlans<World>) plans_.resize(world.size());
    const auto n = static_cast<std::uint32_t>(world.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      heed_stop();
      forget_collision(i);
      plan_own_event(i);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      heed_stop();
      plan_collision(i);
    }
  }

  /// The same plans for a copy of the world.
  EventScheduler(const EventScheduler& other, World& world) : EventScheduler(other) {
    world_ = &world;
  }

  double now() const { return now_; }  ///< of the last event [s]
  double next_time() { return queue_.first().time; }

  /// Performs the next event; there must be one at a finite time. Some only mend a plan.
  /// Heeds stops, as the constructor does.
  void step() {
    heed_stop();
    const auto [time, i] = queue_.first();
    if constexpr (kLooksAhead) look_ahead();
    // A root may lie a rounding error before the last event; time never runs back.
    now_ = std::max(now_, time);
    // At one instant a body's own event comes first.
    const EventPlan& of_i = plan(i);
    if (of_i.own <= of_i.collision) return do_own_event(i);
    const std::uint32_t j = of_i.partner;
    if (plan(j).partner != i) {
      forget_collision(i);
      plan_collision(i);
    } else if (plan(j).own <= now_) {
      do_own_event(j);
    } else {
      replan(world_->collide(i, j, now_));
    }
  }

  /// Plans again for bodies whose paths were changed from outside.
  void replan(std::span<const std::uint32_t> changed) {
    for (std::uint32_t i : changed) {
      forget_collision(i);
      plan_own_event(i);
    }
    for (std::uint32_t i : changed) plan_collision(i);
  }

  /// The body's planned collision holds, and both know of it.
  bool has_collision(std::uint32_t i) const {
    return plan(i).collision < kNever && plan(plan(i).partner).partner == i;
  }
  /// Of the body's plan, holding or not [s].
  double collision_time(std::uint32_t i) const { return plan(i).collision; }
  std::uint32_t partner(std::uint32_t i) const { return plan(i).partner; }

 private:
  static constexpr std::uint32_t kNobody = EventPlan::kNobody;

  static constexpr bool kLooksAhead = KeepsPlans<World> && std::is_same_v<Queue, CalendarQueue>;

  /// Asks for what the events of the next stretches of time will need, each from what the stretch
  /// before has brought: the queue's entries, what tells which of them hold, their bodies, these
  /// bodies' partners and the cells around them, and the bodies in these. Changes nothing.
  void look_ahead() {
    if (queue_.stretch() == stretch_ || world_->size() < kManyForCaches) return;
    stretch_ = queue_.stretch();
    queue_.prefetch_entries(4);
    queue_.prefetch_times(3);
    queue_.for_each_in_stretch(2, [&](std::uint32_t i) { world_->prefetch(i); });
    queue_.for_each_in_stretch(1, [&](std::uint32_t i) {
      world_->prefetch_cells(i);
      if (const std::uint32_t j = plan(i).partner; j != kNobody) world_->prefetch(j);
    });
    queue_.for_each_in_stretch(0, [&](std::uint32_t i) { world_->prefetch_neighbours(i); });
  }

  EventPlan& plan(std::uint32_t i) {
    if constexpr (KeepsPlans<World>)
      return world_->plan(i);
    else
      return plans_[i];
  }
  const EventPlan& plan(std::uint32_t i) const {
    if constexpr (KeepsPlans<World>)
      return world_->plan(i);
    else
      return plans_[i];
  }
  void queue(std::uint32_t i) { queue_.set(i, std::min(plan(i).own, plan(i).collision)); }
  void plan_own_event(std::uint32_t i) { plan(i).own = world_->own_event_time(i, now_); }
  void forget_collision(std::uint32_t i) {
    plan(i).collision = kNever;
    plan(i).partner = kNobody;
  }
  void do_own_event(std::uint32_t i) {
    const BodyChange change = world_->do_own_event(i, now_);
    if (change == BodyChange::path) forget_collision(i);
    plan_own_event(i);
    if (change == BodyChange::path)
      plan_collision(i);
    else if (change == BodyChange::cell)
      plan_collision(i, Neighbourhood::since_cell_changed);
    else
      queue(i);
  }
  EventPlan first_collision(std::uint32_t i, Neighbourhood neighbours) {
    if constexpr (KeepsPlans<World>) {
      return world_->first_collision(i, now_, plan(i).collision, neighbours);
    } else {
      EventPlan first{.collision = plan(i).collision};
      const auto look = [&](std::uint32_t j, const auto& shift) {
        const double t = world_->collision_time(i, j, now_, shift);
        if (t < first.collision && t < plan(j).collision) {
          first.collision = t;
          first.partner = j;
        }
      };
      if (neighbours == Neighbourhood::all)
        world_->for_each_near(i, look);
      else
        world_->for_each_newly_near(i, look);
      return first;
    }
  }
  void plan_collision(std::uint32_t i, Neighbourhood neighbours = Neighbourhood::all) {
    const EventPlan first = first_collision(i, neighbours);
    if (const std::uint32_t j = first.partner; j != kNobody) {
      plan(i).collision = plan(j).collision = first.collision;
      plan(i).partner = j;
      plan(j).partner = i;
      if (first.collision < plan(j).own) queue(j);  // else its time stays
    }
    queue(i);
  }

  World* world_;
  double now_;
  std::vector<EventPlan> plans_;  ///< where the world has none
  Queue queue_;
  std::int64_t stretch_ = -1;  ///< that was looked ahead from
};

}  // namespace slipcheck
