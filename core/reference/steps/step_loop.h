#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <ranges>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/flatten.h"
#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/steps/step_kernel.h"
#include "reference/steps/step_neighbours.h"
#include "reference/steps/step_pair.h"

namespace slipcheck {

/// The forces between two materials.
template <class Normal, class Tangential>
struct StepLaw {
  Normal normal;
  Tangential tangential;
  bool clamped = false;  ///< ContactEnd::zero_force
};

/// The steps x_{n+1} = x_n + h v_{n+1/2}, v_{n+1/2} = v_{n−1/2} + (h/m) F(x_n, ṽ_n) (velocity
/// Verlet with its two half kicks in one) with ṽ_n = v_{n−1/2} + ½ (v_{n−1/2} − v_{n−3/2}), which
/// makes damped motion second order too.
///
/// A contact that begins or ends within a step gets the impulse of the part of the step that it
/// had, by the trapezoidal rule; a force that starts or ends with a jump would else leave an error
/// of first order.
///
/// A few bodies go over all pairs; more of them, and those on a periodic plane, over StepNeighbours
/// in the same order, that in which bodies are stored: what is far apart adds nothing, so that both
/// give the same bits. So does any number of threads, each of which has a share of the bodies, one
/// behind the other, and the pairs whose further body is in it: to a body of a share before, these
/// come after all pairs of that share, and are kept until it is done.
template <class Normal, class Tangential, class Substrate>
class StepLoop final : public StepKernel {
 public:
  using Law = StepLaw<Normal, Tangential>;

  /// laws: by material × material; material: of each body; neighbours: null: all pairs.
  StepLoop(std::vector<Law> laws, std::vector<std::size_t> material, std::size_t materials,
           std::unique_ptr<StepNeighbours> neighbours, std::vector<std::string> features)
      : features_(std::move(features)),
        laws_(std::move(laws)),
        material_(std::move(material)),
        materials_(materials),
        neighbours_(std::move(neighbours)),
        pairs_(neighbours_ ? 0 : material_.size() * (material_.size() - 1) / 2) {}

  void find_forces(StepWorld& world) override {
    if (!world.forces_known) neighbours_ ? forces_by_neighbours(world) : forces(world);
    world.forces_known = true;
  }

  void advance(StepWorld& world, std::size_t steps, StepStop stop) override {
    const std::size_t batch = 1 + kBodySteps / world.bodies.size();
    for (std::size_t begin = 0; begin < steps; begin += batch) {
      heed_stop();
      const std::size_t end = std::min(steps, begin + batch);
      for (std::size_t k = begin; k < end; ++k) {
        find_forces(world);
        if (stop != StepStop::never && is_met(world, stop)) return;
        move(world);
        ++world.n;
        world.forces_known = false;
      }
    }
  }

  std::vector<std::string> features() const override { return features_; }

  void exchange(StateArchive& archive, StepWorld& world) override {
    archive(world, pairs_);
    if (!neighbours_) return;
    archive(*neighbours_);
    if (archive.reads()) divide(world);
  }

  void show(const StepWorld& world, Frame& frame) override {
    const std::size_t bodies = world.bodies.size();
    frame.bodies.resize(bodies);
    impulses_.resize(bodies);
    StepSurroundings around = world.around;
    around.velocity = velocity_of_substrate(world, world.time());
    if (neighbours_)
      in_shares(world, [&](Share&, std::size_t begin, std::size_t end) {
        show(world, around, begin, end, frame.bodies);
      });
    else
      show(world, around, 0, bodies, frame.bodies);
    frame.touches.clear();
    for (std::size_t i = 0; i < bodies; ++i)
      if (impulses_[i] > 0)
        frame.touches.push_back({static_cast<int>(i), kSubstrate, impulses_[i]});
    const auto pairs = static_cast<std::ptrdiff_t>(frame.touches.size());
    for_each_pair(world, [&](std::size_t i, std::size_t j, const Pair& pair) {
      const double impulse = std::abs(pair.normal_force) * world.step;
      if (pair.touching && impulse > 0)
        frame.touches.push_back(
            {static_cast<int>(world.number_of(i)), static_cast<int>(world.number_of(j)), impulse});
    });
    if (world.number.empty()) return;
    std::sort(frame.touches.begin() + pairs, frame.touches.end(),
              [](const Touch& a, const Touch& b) {
                return std::tie(a.second, a.first) < std::tie(b.second, b.first);
              });
  }

  bool is_met(const StepWorld& world, StepStop stop) const override {
    if (world.touching > 0) return false;
    for (const StepBody& b : world.bodies) {
      if (!b.sticks) return false;
      if (stop == StepStop::rest &&
          (b.velocity.head<2>() != world.around.velocity || b.angular_velocity.z() != 0))
        return false;
    }
    return true;
  }

 private:
  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;

  /// On the first of two bodies, and of that the part across the line of centres, which alone turns
  /// them [N].
  struct Force {
    Vector3 all = Vector3::Zero(), across = Vector3::Zero();

    Force operator+(const Force& other) const { return {all + other.all, across + other.across}; }
    Force operator-(const Force& other) const { return {all - other.all, across - other.across}; }
    friend Force operator*(double factor, const Force& force) {
      return {factor * force.all, factor * force.across};
    }
  };
  /// What a contact does to its bodies: a force on the first [N], and F_T × n [N], which turns
  /// both.
  struct Push {
    Vector3 all, lever;
    bool ends;  ///< the contact does: as of keep_down()

    static Push of(const Force& force, const Vector3& n, bool ends = false) {
      if constexpr (Tangential::kRubs) return {force.all, force.across.cross(n), ends};
      return {force.all, Vector3::Zero(), ends};
    }
    void on(StepBody& body, bool is_second) const {
      const double before = body.force.z();
      if (is_second)
        body.force -= all;
      else
        body.force += all;
      if constexpr (Tangential::kRubs) body.torque += body.radius * lever;
      if (ends) [[unlikely]]
        keep_down(body, before);
    }
    /// What is taken back from a body that the other pressed down was borne by the substrate and
    /// must not lift it.
    static void keep_down(StepBody& body, double before) {
      if (body.supported) body.force.z() = before + std::min(body.force.z() - before, body.weight);
    }
  };
  /// Takes a push at once.
  struct Pushed {
    StepBody &a, &b;
    void operator()(const Push& push) const {
      push.on(a, false);
      push.on(b, true);
    }
  };
  struct Tally {
    std::size_t touching = 0, collisions = 0;
  };
  /// A push on a body of another share.
  struct OutsidePush {
    std::size_t stored;
    bool is_second;
    Push push;
  };
  /// One thread's.
  struct alignas(64) Share {
    std::size_t bodies = 0, pairs = 0;  ///< where they begin
    Tally tally;
    double longest2 = 0;  ///< way in the last step, squared [m²]
    std::vector<OutsidePush> outside;
  };

  struct Pair {
    bool touching = false;
    double normal_force = 0;  ///< F_N [N]
    Force force;
    [[no_unique_address]] typename Tangential::History history;
  };

  template <class Visit>
  void for_each_pair(const StepWorld& world, const Visit& visit) const {
    std::size_t k = 0;
    if (neighbours_) {
      for (const StepNeighbour& near : neighbours_->all())
        visit(near.first, near.second, pairs_[k++]);
      return;
    }
    for (std::size_t j = 1; j < world.bodies.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) visit(i, j, pairs_[k++]);
  }

  static Vector2 velocity_of_substrate(const StepWorld& world, double t) {
    if constexpr (std::is_same_v<Substrate, FullSubstrate>)
      return world.motion->velocity(t).template head<2>();
    else
      return Vector2::Zero();
  }

  static void forget_forces(StepBody& b) {
    b.force.setZero();
    b.torque.setZero();
  }

  static void count(const Tally& tally, StepWorld& world) {
    world.touching += tally.touching;
    world.collisions += tally.collisions;
  }

  /// Such that each has as many bodies and pairs.
  void divide(const StepWorld& world) {
    const std::vector<StepNeighbour>& all = neighbours_->all();
    const auto pairs_before = [&](std::size_t stored) {
      return static_cast<std::size_t>(
          std::ranges::lower_bound(all, stored, {}, &StepNeighbour::further) - all.begin());
    };
    const std::size_t bodies = world.bodies.size(), shares = neighbours_->team().size();
    shares_.resize(shares);
    for (std::size_t s = 0; s < shares; ++s) {
      const std::size_t work = (bodies + all.size()) * s / shares;
      const auto stored = std::views::iota(std::size_t{0}, bodies);
      shares_[s].bodies = static_cast<std::size_t>(
          std::ranges::partition_point(stored,
                                       [&](std::size_t k) { return k + pairs_before(k) < work; }) -
          stored.begin());
      shares_[s].pairs = pairs_before(shares_[s].bodies);
    }
  }
  /// Those stored from `begin` to before `end`, and what the substrate does to them.
  SLIPCHECK_FLATTEN void show(const StepWorld& world, const StepSurroundings& around,
                              std::size_t begin, std::size_t end, std::vector<BodyState>& shown) {
    for (std::size_t k = begin; k < end; ++k) {
      StepBody body = world.bodies[k];
      if (world.n > 0) kick<Substrate>(body, around, 0.5 * world.step);
      const std::size_t i = world.number_of(k);
      shown[i] = {body.position, body.velocity, body.angular_velocity};
      impulses_[i] = world.n > 0 ? 2 * body.normal_impulse : 0;
    }
  }
  /// Calls work(share, begin, end) with the bodies of each: always the same thread with the same
  /// share, in whose caches it is.
  template <class Work>
  void in_shares(const StepWorld& world, const Work& work) {
    neighbours_->team().run(shares_.size(), [&](std::size_t s) {
      const bool is_last = s + 1 == shares_.size();
      work(shares_[s], shares_[s].bodies, is_last ? world.bodies.size() : shares_[s + 1].bodies);
    });
  }

  void forces_by_neighbours(StepWorld& world) {
    if (!neighbours_->cover()) {
      neighbours_->find(world, pairs_, [](const Pair& pair) { return pair.touching; });
      divide(world);
    }
    in_shares(world, [&](Share& share, std::size_t begin, std::size_t end) {
      meet_neighbours(world, share, begin, end);
    });
    world.touching = 0;
    for (Share& share : shares_) {
      for (const OutsidePush& each : share.outside)
        each.push.on(world.bodies[each.stored], each.is_second);
      count(share.tally, world);
    }
  }

  /// The bodies from `begin` to before `end`.
  [[gnu::noinline]] void meet_neighbours(StepWorld& world, Share& share, std::size_t begin,
                                         std::size_t end) {
    share.outside.clear();
    std::size_t i = begin;
    const auto forget_before = [&](std::size_t body) {
      for (; i < body; ++i) forget_forces(world.bodies[i]);
    };
    Tally tally;
    const std::vector<StepNeighbour>& all = neighbours_->all();
    for (std::size_t k = share.pairs; k < all.size() && all[k].further() < end; ++k) {
      const StepNeighbour& near = all[k];
      forget_before(near.further() + 1);
      const StepBody &a = world.bodies[near.first], &b = world.bodies[near.second];
      Pair& pair = pairs_[k];
      const auto push_one = [&](const Push& push, std::size_t stored, bool is_second) {
        if (stored < begin) [[unlikely]]
          share.outside.push_back({stored, is_second, push});
        else
          push.on(world.bodies[stored], is_second);
      };
      const auto push_both = [&](const Push& push) {
        push_one(push, near.first, false);
        push_one(push, near.second, true);
      };
      const double reach = a.radius + b.radius;
      Vector3 between = a.position - b.position;
      between.head<2>() -= near.shift;
      const double distance2 = between.squaredNorm();
      const auto law = [&]() -> const Law& {
        return law_of(world.number_of(near.first), world.number_of(near.second));
      };
      if (distance2 <= reach * reach)
        meet(world, a, b, pair, law(), between, reach, std::sqrt(distance2), tally, push_both);
      else if (pair.touching)
        push_both(part(world, a, b, pair, law(), between, reach, std::sqrt(distance2)));
    }
    forget_before(end);
    share.tally = tally;
  }

  const Law& law_of(std::size_t i, std::size_t j) const {
    return laws_[material_[i] * materials_ + material_[j]];
  }

  /// Flat, but for what begins and ends, as move() is: in a large unit the compiler leaves calls
  /// for sums of vectors, which pass them through memory.
  SLIPCHECK_FLATTEN void forces(StepWorld& world) {
    for (StepBody& b : world.bodies) forget_forces(b);
    world.touching = 0;
    Tally tally;
    std::size_t k = 0;
    for (std::size_t j = 1; j < world.bodies.size(); ++j) {
      StepBody& b = world.bodies[j];
      for (std::size_t i = 0; i < j; ++i, ++k) {
        StepBody& a = world.bodies[i];
        const double reach = a.radius + b.radius;
        const Vector3 between = a.position - b.position;
        const double distance2 = between.squaredNorm();
        if (distance2 <= reach * reach)
          meet(world, a, b, pairs_[k], law_of(i, j), between, reach, std::sqrt(distance2), tally,
               Pushed{a, b});
        else if (pairs_[k].touching)
          Pushed{a, b}(
              part(world, a, b, pairs_[k], law_of(i, j), between, reach, std::sqrt(distance2)));
      }
    }
    count(tally, world);
  }

  /// u_t [m/s] with the velocities relative to each other `dv` and the surfaces' `turning`
  /// R_iΩ_i + R_jΩ_j.
  static Vector3 slip(const Vector3& dv, double closing, const Vector3& turning, const Vector3& n) {
    return dv + closing * n - turning.cross(n);
  }

  Force force_of(const Law& law, const Pair& pair, double normal, const Vector3& slip,
                 const Vector3& n) const {
    if constexpr (Tangential::kRubs) {
      const Vector3 across = law.tangential.force(pair.history, normal, slip);
      return {normal * n + across, across};
    } else {
      return {normal * n, Vector3::Zero()};
    }
  }

  /// Two bodies that overlap. push: takes a Push.
  template <class ToPush>
  [[gnu::always_inline]] void meet(const StepWorld& world, const StepBody& a, const StepBody& b,
                                   Pair& pair, const Law& law, const Vector3& between, double reach,
                                   double distance, Tally& tally, const ToPush& push) {
    // Products first that need not wait for the root and the division.
    const Vector3 dv = (a.velocity - b.velocity) + 0.5 * (a.velocity_change - b.velocity_change);
    const double parting = between.dot(dv), inverse = 1 / distance;
    const double overlap = reach - distance, closing = -parting * inverse;
    const Vector3 n = between * inverse;
    const double normal = law.normal(overlap, closing);
    if ((law.clamped && normal <= 0) || (overlap <= 0 && closing <= 0)) [[unlikely]] {
      if (pair.touching) {
        const double left = normal < 0 ? pair.normal_force / (pair.normal_force - normal) : 1;
        push(end(pair, left, {}, n));
      }
      return;
    }
    Vector3 slip_now = Vector3::Zero();
    if constexpr (Tangential::kRubs) {
      const Vector3 turning = a.radius * (a.angular_velocity + 0.5 * a.angular_velocity_change) +
                              b.radius * (b.angular_velocity + 0.5 * b.angular_velocity_change);
      slip_now = slip(dv, closing, turning, n);
    }
    ++tally.touching;
    if (!pair.touching) [[unlikely]] {
      ++tally.collisions;
      push(begin(world, a, b, pair, law, overlap, normal, slip_now, n));
    } else {
      if constexpr (Tangential::kRubs)
        law.tangential.advance(pair.history, 0.5 * world.step, normal, slip_now, n);
      pair.force = force_of(law, pair, normal, slip_now, n);
      push(Push::of(pair.force, n));
    }
    pair.normal_force = normal;
  }

  /// The contact has lasted for `part` of the step before now, and gets part h ½ (F_begin + F) for
  /// it.
  [[gnu::noinline]] Push begin(const StepWorld& world, const StepBody& a, const StepBody& b,
                               Pair& pair, const Law& law, double overlap, double normal,
                               const Vector3& slip_now, const Vector3& n) const {
    const double h = world.step;
    const double closing = -n.dot(a.velocity - b.velocity);
    const bool began_within = world.n > 0 && closing * h >= overlap && closing > 0;
    const double part = began_within ? overlap / (closing * h) : 0;
    const double first =
        law.clamped ? std::max(0.0, law.normal(0, closing)) : law.normal(0, closing);
    if constexpr (Tangential::kRubs)
      law.tangential.begin(pair.history, 0.5 * h, part * h, slip_now, n);
    const Force first_force = force_of(law, pair, first, slip_now, n);
    if constexpr (Tangential::kRubs)
      law.tangential.advance(pair.history, 0.5 * h, normal, slip_now, n);
    pair.force = force_of(law, pair, normal, slip_now, n);
    pair.touching = true;
    return Push::of(
        began_within ? 0.5 * ((1 + part) * pair.force + part * first_force) : pair.force, n);
  }

  /// Two bodies that touched a step ago and overlap no more.
  [[gnu::noinline]] Push part(const StepWorld& world, const StepBody& a, const StepBody& b,
                              Pair& pair, const Law& law, const Vector3& between, double reach,
                              double distance) const {
    const Vector3 n = between / distance;
    const Vector3 dv = a.velocity - b.velocity;
    const double closing = -n.dot(dv);
    const double gone = closing < 0 ? (reach - distance) / (closing * world.step) : 0;
    const double last = law.clamped ? 0 : law.normal(0, closing);
    Vector3 slip_now = Vector3::Zero();
    if constexpr (Tangential::kRubs)
      slip_now =
          slip(dv, closing, a.radius * a.angular_velocity + b.radius * b.angular_velocity, n);
    return end(pair, std::max(0.0, 1 - gone), force_of(law, pair, last, slip_now, n), n);
  }

  /// The contact lasted for `part` of the step before now and should have had part h ½ (F + F_end)
  /// there; it had h/2 F.
  [[gnu::noinline]] static Push end(Pair& pair, double part, const Force& last_force,
                                    const Vector3& n) {
    pair.touching = false;
    return Push::of(0.5 * (part * (pair.force + last_force) - pair.force), n, true);
  }

  SLIPCHECK_FLATTEN void move(StepWorld& world) {
    StepSurroundings& s = world.around;
    if constexpr (std::is_same_v<Substrate, FullSubstrate>) {
      s.velocity_before = s.velocity;
      s.velocity = velocity_of_substrate(world, world.time() + 0.5 * world.step);
    }
    const Advance advance{s, world.step, world.kick_length(), world.slowest_rebound};
    if (!neighbours_) {
      for (StepBody& b : world.bodies) advance(b);
      return;
    }
    in_shares(world, [&](Share& share, std::size_t begin, std::size_t end) {
      share.longest2 = advance_all(advance, std::span(world.bodies).subspan(begin, end - begin));
    });
    double longest2 = 0;
    for (const Share& share : shares_) longest2 = std::max(longest2, share.longest2);
    neighbours_->move(std::sqrt(longest2), world);
  }

  /// What a step does to a body.
  struct Advance {
    const StepSurroundings& around;
    double step, dt, slowest_rebound;

    void operator()(StepBody& b) const {
      kick<Substrate>(b, around, dt);
      b.position += step * b.velocity;
      if constexpr (std::is_same_v<Substrate, BareSubstrate>) return;
      if (!b.supported && b.position.z() < b.radius && b.velocity.z() < 0) [[unlikely]]
        land_after_drift(b, around, slowest_rebound);
    }
  };

  /// Advances these; the longest way of one, squared [m²], or kNever.
  SLIPCHECK_FLATTEN static double advance_all(const Advance& given, std::span<StepBody> bodies) {
    // Copies, of which the compiler knows that no body changes them.
    const StepSurroundings around = given.around;
    const Advance advance{around, given.step, given.dt, given.slowest_rebound};
    double longest2 = 0;
    for (StepBody& b : bodies) {
      const Vector3 before = b.position;
      advance(b);
      const double way2 = (b.position - before).squaredNorm();
      longest2 = way2 <= longest2 ? longest2 : std::isnan(way2) ? kNever : way2;
    }
    return longest2;
  }

  std::vector<std::string> features_;
  std::vector<Law> laws_;
  std::vector<std::size_t> material_;  ///< in the scene's order
  std::size_t materials_;
  std::unique_ptr<StepNeighbours> neighbours_;  ///< null: a few bodies, all pairs
  std::vector<Pair> pairs_;                     ///< by neighbours, or by (j, i) with i < j
  std::vector<Share> shares_;                   ///< of neighbours
  std::vector<double> impulses_;                ///< of the substrate, for show() [N s]
};

}  // namespace slipcheck
