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
    if (forces_known_) return;
    keep_near(world);
    sweep<true, false>(world, 1);
    forces_known_ = true;
  }

  void advance(PileWorld& world, std::size_t steps) override {
    const std::size_t between_looks = 1 + kBodySteps / (1 + world.bodies.size());
    std::size_t taken = 0;
    for (std::size_t k = 0, look = 0; k < steps; k += taken) {
      if (k >= look) {
        heed_stop();
        look = k + between_looks;
      }
      if (forces_known_) {
        taken = 1;
        sweep<false, true>(world, 1);
      } else {
        keep_near(world);
        taken = std::min(steps - k, steps_until_near(world));
        sweep<true, true>(world, taken);
      }
      end_steps(world, taken);
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

  /// What has come of a slab and its list in one step.
  struct SlabStep {
    PileSpeed speed;             ///< of its bodies in the end
    typename Step::Sum sum;      ///< of its contacts
    std::exception_ptr failure;  ///< of its contacts
  };
  SlabStep& at(std::size_t slab, std::size_t j) { return of_steps_[j * shares_.size() + slab]; }

  void keep_near(PileWorld& world) {
    if (budgets_.empty() || !std::ranges::all_of(budgets_, &PileBudget::is_left))
      find_contacts(world);
  }

  /// Steps, >= 1, within which no list is used up, though all be twice as fast and gain in each
  /// twice of what they gained in the last one.
  std::size_t steps_until_near(const PileWorld& world) const {
    std::size_t steps = slabs_.waves(world.team).most_steps();
    if (!world.started || steps == 1) return 1;
    double left = kNever;
    for (const PileBudget& each : budgets_) left = std::min({left, each.bodies, each.surfaces});
    const double speed = approach_ + slabs_.turning_speed();
    const auto way = [&](double ahead) { return 2 * ahead * world.step * (speed + ahead * gain_); };
    while (steps > 1 && !(left > way(static_cast<double>(steps - 1)))) --steps;
    return steps;
  }

  /// Adds the forces of now, and moves, so many times; without either where they are not to.
  template <bool kForces, bool kMoves>
  void sweep(PileWorld& world, std::size_t steps) {
    of_steps_.resize(steps * shares_.size());
    const auto act = [&](std::size_t s, std::size_t j) {
      if constexpr (kForces) find_forces_in(world, s, j);
    };
    const auto done = [&](std::size_t s, std::size_t j) {
      if constexpr (kMoves)
        at(s, j).speed = move_bodies(world, slabs_.members(s), slabs_.spheres(), slabs_.drift(s));
    };
    const auto each = [&](std::size_t count, const auto& work) {
      run_each(world.team, count, work);
    };
    slabs_.waves(world.team).run(each, steps, act, done);
    for (std::size_t j = 0; j < steps; ++j) {
      // The same one, whichever list was taken first.
      for (std::size_t s = 0; s < shares_.size(); ++s)
        if (const std::exception_ptr failure = at(s, j).failure) {
          of_steps_.clear();
          std::rethrow_exception(failure);
        }
      if constexpr (kForces) add_sums(world, j);
      if constexpr (kMoves) check_speed(world, j);
    }
  }

  void find_forces_in(PileWorld& world, std::size_t s, std::size_t j) {
    SlabStep& own = at(s, j);
    if (j > 0 && at(s, j - 1).failure) {
      own.failure = at(s, j - 1).failure;
      return;
    }
    try {
      if (j > 0) spend(world, s, j - 1);
      if (!budgets_[s].is_left()) throw_too_fast(world, j);
      // One share goes on with the sums; several begin at zero.
      shares_[s].begin_sum(shares_.size() == 1 ? world.ledger : PileLedger());
      shares_[s].find_forces(world, world.time(j), slabs_.spheres(), slabs_.lists()[s], table_,
                             lane_laws_, budgets_[s]);
      own.sum = shares_[s].sum();
    } catch (const StepTooLong&) {
      own.failure = std::current_exception();
    }
  }

  void add_sums(PileWorld& world, std::size_t j) {
    if (shares_.size() == 1) world.ledger = {};
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      const typename Step::Sum& sum = at(s, j).sum;
      world.ledger.dissipated += sum.ledger.dissipated;
      world.ledger.work += sum.ledger.work;
      world.collisions += sum.collisions;
      world.slid = world.slid || sum.slid;
    }
  }

  void check_speed(const PileWorld& world, std::size_t j) {
    double fastest2 = 0;
    for (std::size_t s = 0; s < shares_.size(); ++s)
      fastest2 = std::max(fastest2, at(s, j).speed.still);
    const double fastest = std::sqrt(fastest2);
    if (!(fastest * world.step < slabs_.largest_radius())) throw_lost(world, j, fastest);
  }

  /// All bodies have moved so often.
  void end_steps(PileWorld& world, std::size_t steps) {
    approach_ = 0;
    double gain2 = 0;
    for (std::size_t s = 0; s < budgets_.size(); ++s) {
      approach_ = std::max(approach_, spend(world, s, steps - 1));
      gain2 = std::max(gain2, at(s, steps - 1).speed.gain);
    }
    gain_ = std::sqrt(gain2);
    world.started = true;
    world.n += steps;
    forces_known_ = false;
  }

  /// The ways that a list's bodies had in step j. Returns how fast they came nearer at most.
  double spend(const PileWorld& world, std::size_t s, std::size_t j) {
    const double to_surfaces = nearing(s, j), to_bodies = approach_in(s, j);
    budgets_[s].surfaces -= world.step * to_surfaces;
    budgets_[s].bodies -= world.step * to_bodies;
    return std::max(to_surfaces, to_bodies);
  }

  /// How fast a body of a slab and a surface come nearer at most [m/s].
  double nearing(std::size_t s, std::size_t j) {
    return std::sqrt(at(s, j).speed.still) + slabs_.surfaces_speed();
  }
  /// How fast two bodies of a slab's list come nearer at most [m/s].
  double approach_in(std::size_t s, std::size_t j) {
    const std::size_t t = slabs_.next(s);
    const double first = std::sqrt(at(s, j).speed.adrift);
    if (t == s) return 2 * first;
    const double second = std::sqrt(at(t, j).speed.adrift);
    return std::max(2 * first, first + second + (slabs_.drift(s) - slabs_.drift(t)).norm());
  }

  [[noreturn]] static void throw_too_fast(const PileWorld& world, std::size_t j) {
    throw StepTooLong(fmt::format("bodies get more than twice as fast within {} steps, at {:.9g} s",
                                  j, world.time(j)));
  }
  [[noreturn]] static void throw_lost(const PileWorld& world, std::size_t j, double speed) {
    throw StepTooLong(
        fmt::format("a body moves by more than a radius in a step, at {:.3g} m/s, at {:.9g} s",
                    speed, world.time(j)));
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
      found[s].index(slabs_.lists()[s], slabs_.skin());
    };
    run_each(world.team, found.size(), take);
    if (world.watched)
      for (const Kept& each : kept)
        if (const double impulse = each.share->impulse(each.before); !each.is_found && impulse > 0)
          gone_.push_back({static_cast<int>(each.first), each.second, impulse});
    shares_ = std::move(found);
    budgets_.assign(shares_.size(), {slabs_.skin(), slabs_.skin()});
  }

  /// Numbers of laws are no state, and pointers to them none of this process.
  void find_laws() {
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      for (PileNear& near : slabs_.lists()[s]) {
        near.law = table_.number(slabs_.bodies()[near.first], number_of(near));
        if (near.contact != PileNear::kNone) shares_[s].set_law(near, table_);
      }
      shares_[s].index(slabs_.lists()[s], slabs_.skin());
    }
    find_lane_laws();
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
  std::vector<Share> shares_;       ///< by slab
  std::vector<Touch> gone_;         ///< of contacts that are near no more
  std::vector<SlabStep> of_steps_;  ///< of one sweep, by step and slab
  bool forces_known_ = false;
  std::vector<PileBudget> budgets_;  ///< by slab; the near ones change when one is used up
  double approach_ = 0;              ///< how fast two came nearer at most in the last step [m/s]
  double gain_ = kNever;  ///< of a body's speed at most in the last step [m/s]; not known: any
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
