#include "reference/piles/pile_loop.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <span>
#include <utility>

#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/piles/pile_motion.h"
#include "reference/piles/pile_share.h"
#include "reference/piles/pile_slabs.h"
#include "reference/piles/pile_step.h"

namespace slipcheck {
namespace {

/// kLinear: all normal forces are linear; kTurns: rolling or drilling is resisted; kLanes: contacts
/// of bodies that last are taken on several at once.
template <bool kLinear, bool kTurns, bool kLanes>
class PileLoopOf final : public PileLoop {
 public:
  PileLoopOf(const PileLaws& laws, const ContactScene& scene, std::size_t ordered_from)
      : table_(laws, scene), slabs_(ordered_from) {}

  void find_forces(PileWorld& world) override {
    if (!forces_known_) forces(world, [](std::size_t) {});
    forces_known_ = true;
  }

  void advance(PileWorld& world, std::size_t steps) override {
    const std::size_t between_looks = 1 + kBodySteps / (1 + world.bodies.size());
    for (std::size_t k = 0; k < steps; ++k) {
      if (k % between_looks == 0) heed_stop();
      const auto move = [&](std::size_t s) {
        speeds_[s] = move_bodies(world, slabs_.members(s), slabs_.spheres(), slabs_.drift(s));
      };
      if (forces_known_)
        slabs_.sweep(
            world.team, [](std::size_t) {}, move);
      else
        forces(world, move);
      end_step(world);
    }
  }

  void take_touches(std::vector<Touch>& touches) override {
    touches = std::exchange(gone_, {});
    const bool in_order = touches.empty() && shares_.size() == 1;
    for (std::size_t s = 0; s < shares_.size(); ++s)
      shares_[s].take_impulses(slabs_.lists()[s], table_,
                               [&](const PileNear& near, double impulse) {
                                 touches.push_back(touch_of(near, impulse));
                               });
    if (in_order) return;
    std::ranges::sort(touches, {}, [](const Touch& t) { return std::pair(t.first, t.second); });
    merge_repeated(touches);
  }

  void wait(double time) override {
    for (std::size_t s = 0; s < shares_.size(); ++s)
      shares_[s].change_touching(slabs_.lists()[s], table_, [&](Contact& c) {
        c.impulse += time * std::max(0.0, c.normal_force);
      });
  }

  double elastic_energy() const override {
    double energy = 0;
    for_each_touching([&](const Contact& c) { energy += Step::elastic_energy(c); });
    return energy;
  }

  bool bodies_touch() const override {
    bool touch = false;
    for_each_touching([&](const Contact& c) { touch = touch || c.second != kSubstrate; });
    return touch;
  }

  bool rolls_on_substrate(std::size_t bodies) const override {
    std::size_t rolling = 0;
    for_each_touching(
        [&](const Contact& c) { rolling += c.second == kSubstrate && !c.sliding.slides; });
    return rolling == bodies;
  }

  std::vector<std::string> features() const override {
    std::string steps = "any number of contacts at once, in steps of fixed length";
    if (shares_.size() > 1) steps += ", in slabs";
    if (kLanes) steps += ", eight in lanes";
    return {kLinear ? "linear normal forces" : "any normal force",
            kTurns ? "springs against sliding, rolling and drilling"
                   : "springs against sliding, none against rolling or drilling",
            steps};
  }

  void exchange(StateArchive& archive) override {
    archive(slabs_, shares_, gone_, forces_known_, budgets_, approach_);
    if (archive.reads()) find_laws();
  }

 private:
  using Share = PileShare<kLinear, kTurns, kLanes>;
  using Step = typename Share::Step;
  using Contact = typename Share::Contact;

  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;

  /// A contact of the lists before, by the scene's numbers.
  struct Kept {
    std::uint32_t first;
    int second;
    const Share* share;
    PileNear before;  ///< of the lists before
    bool is_found;
  };

  Touch touch_of(const PileNear& near, double impulse) const {
    return {static_cast<int>(slabs_.bodies()[near.first]), number_of(near), impulse};
  }

  /// The scene's number of the second.
  int number_of(const PileNear& near) const {
    return near.second < 0
               ? near.second
               : static_cast<int>(slabs_.bodies()[static_cast<std::size_t>(near.second)]);
  }

  /// One touch for each two, of sorted ones.
  static void merge_repeated(std::vector<Touch>& touches) {
    std::size_t last = 0;
    for (std::size_t k = 1; k < touches.size(); ++k) {
      if (touches[k].first == touches[last].first && touches[k].second == touches[last].second)
        touches[last].normal_impulse += touches[k].normal_impulse;
      else
        touches[++last] = touches[k];
    }
    if (!touches.empty()) touches.resize(last + 1);
  }

  template <class Visit>
  void for_each_touching(const Visit& visit) const {
    for (std::size_t s = 0; s < shares_.size(); ++s)
      shares_[s].for_each(slabs_.lists()[s], [&](const PileNear& near) {
        if (shares_[s].touches(near)) visit(shares_[s].get(near, table_[near.law]));
      });
  }

  // --- the step ----------------------------------------------------------------------------------

  /// Adds the forces of now; done(s) is called when those on a slab's bodies are known.
  template <class Done>
  void forces(PileWorld& world, const Done& done) {
    if (!std::ranges::all_of(budgets_, &PileBudget::is_left) || budgets_.empty())
      find_contacts(world);
    // One share goes on with the sums; several begin at zero.
    const bool alone = shares_.size() == 1;
    for (Share& share : shares_) share.begin_sum(alone ? world.ledger : PileLedger());
    failures_.assign(shares_.size(), nullptr);
    const auto act = [&](std::size_t s) {
      try {
        shares_[s].find_forces(world, slabs_.spheres(), slabs_.lists()[s], table_, lane_laws_,
                               budgets_[s]);
      } catch (const StepTooLong&) {
        failures_[s] = std::current_exception();
      }
    };
    slabs_.sweep(world.team, act, done);
    // The same one, whichever list was taken first.
    for (const std::exception_ptr& failure : failures_)
      if (failure) std::rethrow_exception(failure);
    if (alone) world.ledger = {};
    for (const Share& share : shares_) {
      const typename Step::Sum& sum = share.sum();
      world.ledger.dissipated += sum.ledger.dissipated;
      world.ledger.work += sum.ledger.work;
      world.collisions += sum.collisions;
      world.slid = world.slid || sum.slid;
    }
  }

  /// All bodies have moved.
  void end_step(PileWorld& world) {
    double fastest2 = 0;
    for (const PileSpeed& each : speeds_) fastest2 = std::max(fastest2, each.still);
    const double fastest = std::sqrt(fastest2);
    if (!(fastest * world.step < slabs_.largest_radius())) throw_lost(world, fastest);
    approach_ = fastest + slabs_.surfaces_speed();
    for (std::size_t s = 0; s < budgets_.size(); ++s) {
      budgets_[s].surfaces -= world.step * (fastest + slabs_.surfaces_speed());
      const double nearer = approach_in(s);
      budgets_[s].bodies -= world.step * nearer;
      approach_ = std::max(approach_, nearer);
    }
    world.started = true;
    ++world.n;
    forces_known_ = false;
  }

  /// How fast two bodies of a slab's list come nearer at most [m/s].
  double approach_in(std::size_t s) const {
    const std::size_t t = slabs_.next(s);
    const double first = std::sqrt(speeds_[s].adrift), second = std::sqrt(speeds_[t].adrift);
    return std::max(2 * first, first + second + (slabs_.drift(s) - slabs_.drift(t)).norm());
  }

  [[noreturn]] static void throw_lost(const PileWorld& world, double speed) {
    throw StepTooLong(
        fmt::format("a body moves by more than a radius in a step, at {:.3g} m/s, at {:.9g} s",
                    speed, world.time()));
  }

  // --- who is near -------------------------------------------------------------------------------

  /// Contacts that stay near keep what they remember.
  void find_contacts(PileWorld& world) {
    std::vector<Kept> kept = contacts_in_order();
    slabs_.find(world, table_, approach_);
    find_lane_laws();
    std::vector<std::uint32_t> from(world.bodies.size() + 1, 0);
    for (const Kept& each : kept) ++from[each.first + 1];
    std::partial_sum(from.begin(), from.end(), from.begin());
    std::vector<Share> found(slabs_.lists().size());
    const auto take = [&](std::size_t s) {
      for (PileNear& near : slabs_.lists()[s]) {
        const std::uint32_t first = slabs_.bodies()[near.first];
        const int second = number_of(near);
        for (std::uint32_t k = from[first]; k < from[first + 1]; ++k) {
          if (kept[k].second != second) continue;
          kept[k].is_found = true;
          found[s].keep(near, kept[k].share->get(kept[k].before, table_[near.law]), table_);
        }
      }
      found[s].index(slabs_.lists()[s]);
    };
    if (world.team)
      world.team->run(found.size(), take);
    else
      for (std::size_t s = 0; s < found.size(); ++s) take(s);
    if (world.watched)
      for (const Kept& each : kept)
        if (const double impulse = each.share->impulse(each.before); !each.is_found && impulse > 0)
          gone_.push_back({static_cast<int>(each.first), each.second, impulse});
    shares_ = std::move(found);
    budgets_.assign(shares_.size(), {slabs_.skin(), slabs_.skin()});
    speeds_.resize(shares_.size());
  }

  /// Numbers of laws are no state, and pointers to them none of this process.
  void find_laws() {
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      for (PileNear& near : slabs_.lists()[s]) {
        near.law = table_.number(slabs_.bodies()[near.first], number_of(near));
        if (near.contact != PileNear::kNone) shares_[s].set_law(near, table_);
      }
      shares_[s].index(slabs_.lists()[s]);
    }
    find_lane_laws();
    speeds_.resize(shares_.size());
  }

  void find_lane_laws() {
    if constexpr (!kLanes) return;
    lane_laws_.clear();
    for (std::uint32_t k = 0; k < table_.size(); ++k) lane_laws_.emplace_back(table_[k]);
  }

  /// Those that touch or have an impulse to be shown, by the first.
  std::vector<Kept> contacts_in_order() const {
    std::vector<Kept> kept;
    for (std::size_t s = 0; s < shares_.size(); ++s)
      shares_[s].for_each(slabs_.lists()[s], [&](const PileNear& near) {
        if (shares_[s].touches(near) || shares_[s].impulse(near) > 0)
          kept.push_back({slabs_.bodies()[near.first], number_of(near), &shares_[s], near, false});
      });
    const auto by_first = [](const Kept& each) { return each.first; };
    if (!std::ranges::is_sorted(kept, {}, by_first)) std::ranges::sort(kept, {}, by_first);
    return kept;
  }

  PileLawTable table_;
  std::vector<PileLaneLaw> lane_laws_;  ///< by number of the table
  PileSlabs slabs_;
  std::vector<Share> shares_;                 ///< by slab
  std::vector<Touch> gone_;                   ///< of contacts that are near no more
  std::vector<PileSpeed> speeds_;             ///< by slab, of one step
  std::vector<std::exception_ptr> failures_;  ///< by slab, of one step
  bool forces_known_ = false;
  std::vector<PileBudget> budgets_;  ///< by slab; the near ones change when one is used up
  double approach_ = 0;              ///< how fast two came nearer at most in the last step [m/s]
};

}  // namespace

/// So many bodies fill lanes.
constexpr std::size_t kManyInLanes = 64;

std::unique_ptr<PileLoop> make_pile_loop(const PileLaws& laws, const ContactScene& scene,
                                         bool general, std::size_t ordered_from) {
  const bool turns = laws.turns() || general, linear = laws.is_linear() && !general;
  const bool many = scene.hard.bodies.size() >= kManyInLanes;
  const auto make = [&]<bool kLinear, bool kTurns, bool kLanes>() -> std::unique_ptr<PileLoop> {
    return std::make_unique<PileLoopOf<kLinear, kTurns, kLanes>>(laws, scene, ordered_from);
  };
  if (linear && !turns && many && laws.is_plain())
    return make.template operator()<true, false, true>();
  if (linear)
    return turns ? make.template operator()<true, true, false>()
                 : make.template operator()<true, false, false>();
  return turns ? make.template operator()<false, true, false>()
               : make.template operator()<false, false, false>();
}

}  // namespace slipcheck
