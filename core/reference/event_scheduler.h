#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/numbers.h"
#include "reference/calendar_queue.h"

namespace slipcheck {

/// What an event of one body alone has changed.
enum class BodyChange {
  nothing,  ///< only its next own event is to be found again
  cell,     ///< it has new neighbours
  path,     ///< it moves differently from here
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
template <class World, class Queue = CalendarQueue>
class EventScheduler {
 public:
  /// Plans for all bodies, which are as at time `now` [s]. The world must outlive this.
  EventScheduler(World& world, double now)
      : world_(&world), now_(now), plans_(world.size()), queue_(world.size()) {
    for (std::uint32_t i = 0; i < plans_.size(); ++i) plan_own_event(i);
    for (std::uint32_t i = 0; i < plans_.size(); ++i) plan_collision(i);
  }

  /// The same plans for a copy of the world.
  EventScheduler(const EventScheduler& other, World& world) : EventScheduler(other) {
    world_ = &world;
  }

  double now() const { return now_; }  ///< of the last event [s]
  double next_time() { return queue_.first().time; }

  /// Performs the next event; there must be one at a finite time. Some only mend a plan.
  void step() {
    const auto [time, i] = queue_.first();
    // A root may lie a rounding error before the last event; time never runs back.
    now_ = std::max(now_, time);
    // At one instant a body's own event comes first.
    if (plans_[i].own <= plans_[i].collision) return do_own_event(i);
    const std::uint32_t j = plans_[i].partner;
    if (plans_[j].partner != i) {
      forget_collision(i);
      plan_collision(i);
    } else if (plans_[j].own <= now_) {
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
    return plans_[i].collision < kNever && plans_[plans_[i].partner].partner == i;
  }
  /// Of the body's plan, holding or not [s].
  double collision_time(std::uint32_t i) const { return plans_[i].collision; }
  double own_time(std::uint32_t i) const { return plans_[i].own; }
  std::uint32_t partner(std::uint32_t i) const { return plans_[i].partner; }

 private:
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};

  struct Plan {
    double collision = kNever;
    double own = kNever;
    std::uint32_t partner = kNobody;
  };

  void queue(std::uint32_t i) { queue_.set(i, std::min(plans_[i].own, plans_[i].collision)); }
  void plan_own_event(std::uint32_t i) { plans_[i].own = world_->own_event_time(i, now_); }
  void forget_collision(std::uint32_t i) {
    plans_[i].collision = kNever;
    plans_[i].partner = kNobody;
  }
  void do_own_event(std::uint32_t i) {
    const BodyChange change = world_->do_own_event(i, now_);
    if (change == BodyChange::path) forget_collision(i);
    plan_own_event(i);
    if (change == BodyChange::path)
      plan_collision(i);
    else if (change == BodyChange::cell)
      plan_collision_with(i, [&](auto look) { world_->for_each_newly_near(i, look); });
    else
      queue(i);
  }
  void plan_collision(std::uint32_t i) {
    plan_collision_with(i, [&](auto look) { world_->for_each_near(i, look); });
  }

  template <class Visit>
  void plan_collision_with(std::uint32_t i, Visit visit) {
    double earliest = plans_[i].collision;
    std::uint32_t partner = kNobody;
    visit([&](std::uint32_t j, const auto& shift) {
      const double t = world_->collision_time(i, j, now_, shift);
      if (t < earliest && t < plans_[j].collision) {
        earliest = t;
        partner = j;
      }
    });
    if (partner != kNobody) {
      plans_[i].collision = plans_[partner].collision = earliest;
      plans_[i].partner = partner;
      plans_[partner].partner = i;
      queue(partner);
    }
    queue(i);
  }

  World* world_;
  double now_;
  std::vector<Plan> plans_;
  Queue queue_;
};

}  // namespace slipcheck
