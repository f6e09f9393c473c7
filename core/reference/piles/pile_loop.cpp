#include "reference/piles/pile_loop.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/piles/pile_slabs.h"
#include "reference/piles/pile_step.h"

namespace slipcheck {
namespace {

template <bool kLinear, bool kTurns>
class PileLoopOf final : public PileLoop {
 public:
  PileLoopOf(const PileLaws& laws, const ContactScene& scene, std::size_t ordered_from)
      : table_(laws, scene), slabs_(ordered_from) {}

  void find_forces(PileWorld& world) override {
    if (!forces_known_) forces(world);
    forces_known_ = true;
  }

  void advance(PileWorld& world, std::size_t steps) override {
    const std::size_t between_looks = 1 + kBodySteps / (1 + world.bodies.size());
    for (std::size_t k = 0; k < steps; ++k) {
      if (k % between_looks == 0) heed_stop();
      find_forces(world);
      move(world);
    }
  }

  void take_touches(std::vector<Touch>& touches) override {
    touches = std::exchange(gone_, {});
    const bool in_order = touches.empty() && shares_.size() == 1;
    const std::vector<std::uint32_t>& bodies = slabs_.bodies();
    for (std::size_t s = 0; s < shares_.size(); ++s)
      for (PileNear& near : slabs_.lists()[s]) {
        if (near.contact == PileNear::kNone) continue;
        Contact& c = shares_[s].contacts[near.contact];
        if (const double impulse = std::exchange(c.impulse, 0); impulse > 0)
          touches.push_back(touch_of(bodies[near.first], number_of(near), impulse));
        if (!c.touching) shares_[s].drop(near);
      }
    if (in_order) return;
    std::ranges::sort(touches, {}, [](const Touch& t) { return std::pair(t.first, t.second); });
    merge_repeated(touches);
  }

  void wait(double time) override {
    for_each_touching([&](Contact& c) { c.impulse += time * std::max(0.0, c.normal_force); });
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
    return {kLinear ? "linear normal forces" : "any normal force",
            kTurns ? "springs against sliding, rolling and drilling"
                   : "springs against sliding, none against rolling or drilling",
            shares_.size() > 1
                ? "any number of contacts at once, in steps of fixed length, in slabs"
                : "any number of contacts at once, in steps of fixed length"};
  }

  void exchange(StateArchive& archive) override {
    archive(slabs_, shares_, gone_, forces_known_, budget_);
    if (archive.reads()) find_laws();
  }

 private:
  using Step = PileStep<kLinear, kTurns>;
  using Contact = PileContact<kTurns>;

  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;
  /// Bodies that one thread moves in a row.
  static constexpr std::size_t kMoved = 1024;

  /// Those in contact within a slab and with the next.
  struct Share {
    std::vector<Contact> contacts;
    std::vector<std::uint32_t> free;  ///< of these
    typename Step::Sum sum;

    void exchange(StateArchive& archive) { archive(contacts, free); }
    void keep(PileNear& near, const Contact& contact) {
      if (free.empty()) {
        near.contact = static_cast<std::uint32_t>(contacts.size());
        contacts.push_back(contact);
        return;
      }
      near.contact = free.back();
      free.pop_back();
      contacts[near.contact] = contact;
    }
    void drop(PileNear& near) {
      free.push_back(near.contact);
      near.contact = PileNear::kNone;
    }
  };

  /// A contact of the lists before, by the scene's numbers.
  struct Kept {
    std::uint32_t first;
    int second;
    const Contact* contact;
    bool is_found;
  };

  static Touch touch_of(std::uint32_t first, int second, double impulse) {
    return {static_cast<int>(first), second, impulse};
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
  void for_each_touching(const Visit& visit) {
    for (std::size_t s = 0; s < shares_.size(); ++s)
      for (const PileNear& near : slabs_.lists()[s])
        if (near.contact != PileNear::kNone)
          if (Contact& c = shares_[s].contacts[near.contact]; c.touching) visit(c);
  }
  template <class Visit>
  void for_each_touching(const Visit& visit) const {
    for (std::size_t s = 0; s < shares_.size(); ++s)
      for (const PileNear& near : slabs_.lists()[s])
        if (near.contact != PileNear::kNone)
          if (const Contact& c = shares_[s].contacts[near.contact]; c.touching) visit(c);
  }

  // --- the step ----------------------------------------------------------------------------------

  void forces(PileWorld& world) {
    if (!(budget_ > 0)) find_contacts(world);
    // One share goes on with the sums; several begin at zero.
    const bool alone = shares_.size() == 1;
    for (Share& share : shares_) share.sum = {};
    if (alone) shares_[0].sum.ledger = world.ledger;
    slabs_.for_each(world.team, [&](std::size_t s) { forces_of(world, s); });
    if (alone) world.ledger = {};
    for (const Share& share : shares_) {
      world.ledger.dissipated += share.sum.ledger.dissipated;
      world.ledger.work += share.sum.ledger.work;
      world.collisions += share.sum.collisions;
      world.slid = world.slid || share.sum.slid;
    }
  }

  /// Flat, but for what begins and ends.
  [[gnu::flatten]] void forces_of(PileWorld& world, std::size_t s) {
    Share& share = shares_[s];
    Step step(world, share.sum);
    const Vector2& periodic = world.scene->hard.periodic;
    const bool repeats = !periodic.isZero(0);
    const PileBody* bodies = world.bodies.data();
    for (PileNear& near : slabs_.lists()[s]) {
      Contact* c = near.contact == PileNear::kNone ? nullptr : &share.contacts[near.contact];
      const bool touching = c && c->touching;
      const PileBody& a = bodies[near.first];
      if (near.second >= 0) {
        const PileBody& b = bodies[near.second];
        Vector3 apart = a.position - b.position;
        if (repeats)
          apart.head<2>() -= Vector2(near.across_x * periodic.x(), near.across_y * periodic.y());
        double reach = a.radius + b.radius;
        if (touching) reach += c->offset;
        const double distance2 = apart.squaredNorm();
        if (distance2 > reach * reach && !touching) continue;
        act(share, near, c, [&](Contact& contact) {
          step.act_on_bodies(contact, apart, reach, std::sqrt(distance2));
        });
      } else {
        NearestPoint at;
        if (near.second == kSubstrate) {
          at.distance = a.position.z();
          at.point = {a.position.x(), a.position.y(), 0};
        } else {
          at = world.scene->hard.surfaces[touched_surface(near.second)].nearest(world.time(),
                                                                                a.position);
        }
        if (at.distance > a.radius && !touching) continue;
        act(share, near, c, [&](Contact& contact) { step.act_on_surface(contact, at); });
      }
    }
  }

  /// A contact that begins is kept; one that has ended until somebody has asked for its impulse.
  template <class Act>
  void act(Share& share, PileNear& near, Contact* c, const Act& what) {
    if (c) {
      what(*c);
      return;
    }
    Contact made;
    made.first = near.first;
    made.second = near.second;
    made.law = &table_[near.law];
    what(made);
    if (made.touching) share.keep(near, made);
  }

  void move(PileWorld& world) {
    const std::size_t n = world.bodies.size(), shares = (n + kMoved - 1) / kMoved;
    fastest_.assign(shares, 0);
    const auto move_share = [&](std::size_t k) {
      fastest_[k] = move_bodies(
          world, std::span(world.bodies).subspan(k * kMoved, std::min(kMoved, n - k * kMoved)));
    };
    if (world.team && shares > 1)
      world.team->run(shares, move_share);
    else
      for (std::size_t k = 0; k < shares; ++k) move_share(k);
    const double speed = std::sqrt(*std::ranges::max_element(fastest_));
    if (!(speed * world.step < slabs_.largest_radius())) throw_lost(world, speed);
    budget_ -= world.step * (2 * speed + slabs_.surfaces_speed());
    world.started = true;
    ++world.n;
    forces_known_ = false;
  }

  /// Returns the largest square of a speed [m²/s²].
  [[gnu::flatten]] static double move_bodies(const PileWorld& world, std::span<PileBody> bodies) {
    const double h = world.step, kick = world.started ? h : 0.5 * h;
    const double drag = 0.5 * h * world.drag, keep = (1 - drag) / (1 + drag);
    double fastest = 0;
    for (PileBody& b : bodies) {
      const Vector3 gain = b.force / b.mass + b.load * world.gravity, turn = b.torque / b.inertia;
      b.change = h * gain;
      b.turn_change = h * turn;
      b.velocity += kick * gain;
      b.angular_velocity += kick * turn;
      if (drag > 0) [[unlikely]] {
        b.velocity *= keep;
        b.angular_velocity *= keep;
      }
      // Summed with what rounding took before: else a slow body stands while its springs stretch.
      const Vector3 way = h * b.velocity + b.rounded, next = b.position + way;
      b.rounded = way - (next - b.position);
      b.position = next;
      b.turned += h * b.angular_velocity;
      b.force.setZero();
      b.torque.setZero();
      fastest = std::max(fastest, b.velocity.squaredNorm());
    }
    return fastest;
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
    slabs_.find(world, table_);
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
          found[s].keep(near, *kept[k].contact);
          Contact& c = found[s].contacts.back();
          c.first = near.first;
          c.second = near.second;
          c.law = &table_[near.law];
        }
      }
    };
    if (world.team)
      world.team->run(found.size(), take);
    else
      for (std::size_t s = 0; s < found.size(); ++s) take(s);
    if (world.watched)
      for (const Kept& each : kept)
        if (!each.is_found && each.contact->impulse > 0)
          gone_.push_back(touch_of(each.first, each.second, each.contact->impulse));
    shares_ = std::move(found);
    budget_ = slabs_.skin();
  }

  /// Numbers of laws are no state, and pointers to them none of this process.
  void find_laws() {
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      for (Contact& c : shares_[s].contacts) c.law = nullptr;  // a free one has none
      for (PileNear& near : slabs_.lists()[s]) {
        near.law = table_.number(slabs_.bodies()[near.first], number_of(near));
        if (near.contact != PileNear::kNone)
          shares_[s].contacts[near.contact].law = &table_[near.law];
      }
    }
  }

  /// Those that touch or have an impulse to be shown, by the first.
  std::vector<Kept> contacts_in_order() const {
    std::vector<Kept> kept;
    for (std::size_t s = 0; s < shares_.size(); ++s)
      for (const PileNear& near : slabs_.lists()[s]) {
        if (near.contact == PileNear::kNone) continue;
        const Contact& c = shares_[s].contacts[near.contact];
        if (c.touching || c.impulse > 0)
          kept.push_back({slabs_.bodies()[near.first], number_of(near), &c, false});
      }
    const auto by_first = [](const Kept& each) { return each.first; };
    if (!std::ranges::is_sorted(kept, {}, by_first)) std::ranges::sort(kept, {}, by_first);
    return kept;
  }

  PileLawTable table_;
  PileSlabs slabs_;
  std::vector<Share> shares_;  ///< by slab
  std::vector<Touch> gone_;    ///< of contacts that are near no more
  std::vector<double> fastest_;
  bool forces_known_ = false;
  double budget_ = 0;  ///< of the way [m] that two may come nearer before the near ones change
};

template <bool kLinear>
std::unique_ptr<PileLoop> loop_of(const PileLaws& laws, const ContactScene& scene, bool turns,
                                  std::size_t ordered_from) {
  if (turns) return std::make_unique<PileLoopOf<kLinear, true>>(laws, scene, ordered_from);
  return std::make_unique<PileLoopOf<kLinear, false>>(laws, scene, ordered_from);
}

}  // namespace

std::unique_ptr<PileLoop> make_pile_loop(const PileLaws& laws, const ContactScene& scene,
                                         bool general, std::size_t ordered_from) {
  const bool turns = laws.turns() || general;
  return laws.is_linear() && !general ? loop_of<true>(laws, scene, turns, ordered_from)
                                      : loop_of<false>(laws, scene, turns, ordered_from);
}

}  // namespace slipcheck
