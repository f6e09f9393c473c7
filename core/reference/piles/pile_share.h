#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/flatten.h"
#include "base/state_archive.h"
#include "physics/numbers.h"
#include "reference/piles/pile_contacts.h"
#include "reference/piles/pile_lanes.h"
#include "reference/piles/pile_slabs.h"
#include "reference/piles/pile_step.h"

namespace slipcheck {

/// Of the ways that two may come nearer before the lists change, what is left [m].
struct PileBudget {
  double bodies = 0;    ///< of two bodies
  double surfaces = 0;  ///< of a body and the substrate or a surface

  bool is_left() const { return bodies > 0 && surfaces > 0; }
};

/// The contacts within a slab and with the next, and what they do in a step. kLinear: all normal
/// forces are linear; kTurns: rolling or drilling is resisted; kLanes: pairs that last are taken on
/// several at once. spheres: the bodies as of PileSlabs.
///
/// Those that may touch are looked at when the way that they had between them may be used up: of
/// all the few for which that is soon are gone through in a step. What acts on bodies is added in
/// the order of the slab's list.
template <bool kLinear, bool kTurns, bool kLanes>
class PileShare {
 public:
  using Step = PileStep<kLinear, kTurns>;
  using Contact = PileContact<kTurns>;
  using List = std::vector<PileNear>;

  void exchange(StateArchive& archive) {
    archive(contacts_);
    if constexpr (kLanes) archive(lanes_);
  }

  const typename Step::Sum& sum() const { return sum_; }
  void begin_sum(const PileLedger& ledger) { sum_ = {.ledger = ledger}; }

  /// Adds the forces of now, which is `time` [s].
  SLIPCHECK_FLATTEN void find_forces(PileWorld& world, double time,
                                     std::span<const NearSphere> spheres, List& list,
                                     const PileLawTable& laws,
                                     std::span<const PileLaneLaw> lane_laws,
                                     const PileBudget& budget) {
    // The thread's own, for whichever share it takes: they stay in its cache.
    thread_local std::vector<PileLaneForce> forces;
    if constexpr (kLanes) lanes_.begin_step(forces);
    meeting_.clear();
    look_at_far(world, time, spheres, list, budget);
    meeting_.push_back(kNone);
    after_.clear();
    auto next = meeting_.begin();
    for (const Known& known : known_) {
      while (*next < known.entry) act(world, time, laws, list, *next++);
      if constexpr (kLanes)
        if (known.second >= 0 && lasts(world, lane_laws, known.contact)) {
          push(world, known, lanes_.force(known.contact));
          after_.push_back(known);
          continue;
        }
      act(world, time, laws, list, known.entry);
    }
    while (*next != kNone) act(world, time, laws, list, *next++);
    known_.swap(after_);
    // No sooner: lanes that hold one are not taken on in the step in which it begins.
    for (const auto& [k, contact] : begun_) {
      keep(list[k], contact, laws);
      far_above(list[k], k) = -kNever;
      std::ranges::lower_bound(known_, k, {}, &Known::entry)->contact = list[k].contact;
    }
    begun_.clear();
  }

  /// As the contact of an entry of the list.
  void keep(PileNear& near, const Contact& contact, const PileLawTable& laws) {
    of(*this, near, [&](auto& contacts) { contacts.keep(near, contact, laws); });
  }

  /// After the list, found with that skin [m], or its contacts have changed.
  void index(const List& list, double skin) {
    known_.clear();
    at_surface_.clear();
    soon_step_ = kSoonPart * skin;
    soon_down_to_ = kNever;
    far_above_.assign(list.size(), kNever);
    for (std::uint32_t k = 0; k < list.size(); ++k) {
      if (list[k].second < 0) {
        at_surface_.push_back({k, kNever});
        far_above_[k] = -kNever;
      }
      if (list[k].contact == PileNear::kNone) continue;
      known_.push_back(known(list, k));
      far_above(list[k], k) = -kNever;
    }
  }

  void set_law(const PileNear& near, const PileLawTable& laws) {
    of(*this, near, [&](auto& contacts) { contacts.set_law(near, laws); });
  }
  bool touches(const PileNear& near) const {
    return of(*this, near, [&](const auto& all) { return all.touches(near.contact); });
  }
  double impulse(const PileNear& near) const {
    return of(*this, near, [&](const auto& all) { return all.impulse(near.contact); });
  }
  Contact get(const PileNear& near, const PileLaw& law) const {
    return of(*this, near, [&](const auto& all) { return Contact(all.get(near.contact, law)); });
  }

  /// Calls visit(near) for those that touch, or have touched and are to be told.
  template <class Visit>
  void for_each(const List& list, const Visit& visit) const {
    // A step that failed may have dropped some.
    for (const Known& known : known_)
      if (const PileNear& near = list[known.entry]; near.contact != PileNear::kNone) visit(near);
  }
  /// Lets `what` change those that touch.
  template <class What>
  void change_touching(const List& list, const PileLawTable& laws, const What& what) {
    for (const Known& known : known_)
      if (const PileNear& near = list[known.entry]; touches(near)) change(near, laws, what);
  }

  /// Calls tell(near, impulse) for those that have one, and takes it from them.
  template <class Tell>
  void take_impulses(List& list, const PileLawTable& laws, const Tell& tell) {
    after_.clear();
    for (const Known& known : known_) {
      PileNear& near = list[known.entry];
      if (const double had = impulse(near); had > 0) {
        tell(near, had);
        change(near, laws, [](Contact& c) { c.impulse = 0; });
      }
      if (touches(near))
        after_.push_back(known);
      else
        drop(near, known.entry);
    }
    known_.swap(after_);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// A body and a surface.
  struct AtSurface {
    std::uint32_t entry;  ///< of the list
    double far_above;     ///< do not touch before the budget of surfaces is so small [m]
  };

  /// Has a contact: an entry of the list, with what it says.
  struct Known {
    std::uint32_t entry, first;
    int second;
    std::uint32_t contact;
  };
  static Known known(const List& list, std::uint32_t k) {
    return {k, list[k].first, list[k].second, list[k].contact};
  }

  /// What keeps the contact of `near`.
  template <class Share, class Use>
  static decltype(auto) of(Share& share, const PileNear& near, const Use& use) {
    if constexpr (kLanes)
      if (near.second >= 0) return use(share.lanes_);
    return use(share.contacts_);
  }
  template <class What>
  void change(const PileNear& near, const PileLawTable& laws, const What& what) {
    of(*this, near, [&](auto& contacts) { contacts.change(near, laws, what); });
  }

  void drop(PileNear& near, std::uint32_t k) {
    of(*this, near, [&](auto& contacts) { contacts.drop(near); });
    far_above(near, k) = kNever;
    if (near.second < 0) return;
    const auto at = std::ranges::lower_bound(soon_, k);
    if (at == soon_.end() || *at != k) soon_.insert(at, k);
  }

  /// The budget above which the two of an entry of the list do not touch [m].
  double& far_above(const PileNear& near, std::uint32_t k) {
    if (near.second >= 0) return far_above_[k];
    return std::ranges::lower_bound(at_surface_, k, {}, &AtSurface::entry)->far_above;
  }

  // --- a body and another one, or a surface ------------------------------------------------------

  struct Apart {
    Vector3 by;
    double reach = 0;
    double distance2 = 0;
  };

  /// Of bodies, or of their spheres.
  template <class Body>
  static Apart apart(const PileWorld& world, const Body& a, const Body& b, const PileNear& near,
                     double offset) {
    const Vector2& periodic = world.scene->hard.periodic;
    Vector3 by = a.position - b.position;
    if (!periodic.isZero(0))
      by.head<2>() -= Vector2(near.across_x * periodic.x(), near.across_y * periodic.y());
    return {by, a.radius + b.radius + offset, by.squaredNorm()};
  }

  static NearestPoint nearest(const PileWorld& world, double time, const PileNear& near,
                              const Vector3& x) {
    if (near.second == kSubstrate) return {.point = {x.x(), x.y(), 0}, .distance = x.z()};
    return world.scene->hard.surfaces[touched_surface(near.second)].nearest(time, x);
  }

  /// Looks at those whose way may be used up. Who they are is no branch, and where they lie is
  /// asked for ahead of it.
  void look_at_far(const PileWorld& world, double time, std::span<const NearSphere> spheres,
                   const List& list, const PileBudget& budget) {
    for (AtSurface& each : at_surface_)
      if (budget.surfaces <= each.far_above)
        look_at_surface(world, time, spheres, list[each.entry], each, budget.surfaces);
    const auto of_surfaces = static_cast<std::ptrdiff_t>(meeting_.size());
    constexpr std::size_t kEntries = 16, kSpheres = 8;  // ahead
    if (budget.bodies < soon_down_to_) find_soon(budget.bodies);
    far_.resize(soon_.size() + kEntries);
    std::size_t count = 0;
    for (const std::uint32_t k : soon_) {
      far_[count] = k;
      count += budget.bodies <= far_above_[k];
    }
    for (std::size_t i = count; i < count + kEntries; ++i) far_[i] = 0;
    for (std::size_t i = 0; i < count; ++i) {
      __builtin_prefetch(&list[far_[i + kEntries]]);
      const PileNear& ahead = list[far_[i + kSpheres]];
      __builtin_prefetch(&spheres[ahead.first]);
      __builtin_prefetch(&spheres[static_cast<std::size_t>(std::max(ahead.second, 0))]);
      look(world, spheres, list[far_[i]], far_[i], budget.bodies);
    }
    std::inplace_merge(meeting_.begin(), meeting_.begin() + of_surfaces, meeting_.end());
  }

  void find_soon(double budget) {
    // At first nothing is known of any of them, and after that step of all.
    soon_down_to_ = soon_down_to_ == kNever ? budget : budget - soon_step_;
    soon_.resize(far_above_.size());
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < far_above_.size(); ++k) {
      soon_[count] = k;
      count += soon_down_to_ <= far_above_[k];
    }
    soon_.resize(count);
  }

  /// Two bodies that did not touch: do they now, or when may they?
  void look(const PileWorld& world, std::span<const NearSphere> spheres, const PileNear& near,
            std::uint32_t k, double budget) {
    const Apart two =
        apart(world, spheres[near.first], spheres[static_cast<std::size_t>(near.second)], near, 0);
    if (two.distance2 > two.reach * two.reach)
      far_above_[k] = budget_at(std::sqrt(two.distance2) - two.reach, two.reach, budget);
    else
      overlap(world, near, k);
  }
  void overlap(const PileWorld& world, const PileNear& near, std::uint32_t k) {
    meeting_.push_back(k);
    prefetch(world.bodies[near.first]);
    prefetch(world.bodies[static_cast<std::size_t>(near.second)]);
  }
  /// The same of a body and a surface.
  void look_at_surface(const PileWorld& world, double time, std::span<const NearSphere> spheres,
                       const PileNear& near, AtSurface& at, double budget) {
    const NearSphere& first = spheres[near.first];
    const double distance = nearest(world, time, near, first.position).distance;
    if (!(distance > first.radius))
      meeting_.push_back(at.entry);
    else if (near.second == kSubstrate ||
             !PileSlabs::turns(world.scene->hard.surfaces[touched_surface(near.second)]))
      at.far_above = budget_at(distance - first.radius, first.radius, budget);
  }
  /// At which a gap may be used up, whatever is rounded.
  static double budget_at(double gap, double reach, double budget) {
    return budget - ((1 - 1e-9) * gap - 1e-12 * reach);
  }

  /// A contact that begins is kept; one that has ended, where somebody watches, until its impulse
  /// has been asked for.
  [[gnu::noinline]] SLIPCHECK_FLATTEN void act(PileWorld& world, double time,
                                               const PileLawTable& laws, List& list,
                                               std::uint32_t k) {
    PileNear& near = list[k];
    Step step(world, time, sum_);
    if (near.contact == PileNear::kNone) {
      Contact made;
      made.first = near.first;
      made.second = near.second;
      made.law = &laws[near.law];
      act_on(world, time, step, near, made);
      if (!made.touching) return;
      begun_.emplace_back(k, made);
    } else {
      change(near, laws, [&](Contact& c) { act_on(world, time, step, near, c); });
      if (!world.watched && !touches(near)) {
        drop(near, k);
        return;
      }
    }
    after_.push_back(known(list, k));
  }

  static void act_on(PileWorld& world, double time, Step& step, const PileNear& near, Contact& c) {
    const PileBody& a = world.bodies[near.first];
    if (near.second >= 0) {
      const PileBody& b = world.bodies[static_cast<std::size_t>(near.second)];
      const Apart two = apart(world, a, b, near, c.touching ? c.offset : 0);
      if (two.distance2 > two.reach * two.reach && !c.touching) return;
      step.act_on_bodies(c, two.by, two.reach, std::sqrt(two.distance2));
    } else {
      const NearestPoint at = nearest(world, time, near, a.position);
      if (at.distance > a.radius && !c.touching) return;
      step.act_on_surface(c, at);
    }
  }

  /// Whether a contact in lanes lasts, of whose force push() is the rest. Takes it on, and the next
  /// ones with it: their bodies are in the nearest cache when it comes to these.
  bool lasts(const PileWorld& world, std::span<const PileLaneLaw> laws, std::uint32_t contact) {
    if (!lanes_.is_taken_on(contact) && take_on_lanes(world, laws, contact, lanes_))
      sum_.slid = true;
    return lanes_.lasted(contact);
  }

  void push(PileWorld& world, const Known& near, const PileLaneForce& f) {
    PileBody& a = world.bodies[near.first];
    PileBody& b = world.bodies[static_cast<std::size_t>(near.second)];
    a.force += f.all;
    a.torque += a.radius * f.lever;
    b.force -= f.all;
    b.torque += b.radius * f.lever;
    sum_.ledger.dissipated += f.lost;
  }

  /// Of the skin, the way for which `soon_` is found.
  static constexpr double kSoonPart = 0.125;

  struct None {};
  PileContacts<kTurns> contacts_;  ///< that are not in lanes
  [[no_unique_address]] std::conditional_t<kLanes, PileLaneContacts, None> lanes_;
  typename Step::Sum sum_;
  // Of the list:
  std::vector<AtSurface> at_surface_;   ///< its entries of a surface, in order
  std::vector<double> far_above_;       ///< as AtSurface's, by entry of two bodies
  std::vector<std::uint32_t> soon_;     ///< are looked at before the budget is soon_down_to_
  double soon_down_to_ = kNever;        ///< [m]
  double soon_step_ = 0;                ///< what it is lowered by then [m]
  std::vector<Known> known_;            ///< have a contact, in order
  std::vector<std::uint32_t> far_;      ///< of one step: are looked at
  std::vector<std::uint32_t> meeting_;  ///< of one step: overlap anew
  std::vector<Known> after_;            ///< of one step: have a contact then
  std::vector<std::pair<std::uint32_t, Contact>> begun_;  ///< of one step
};

}  // namespace slipcheck
