#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "reference/piles/pile_contact.h"
#include "reference/piles/pile_impacts.h"
#include "reference/piles/pile_loop.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {

/// Of Coulomb's cap, what a contact is prepared with: the rest of it holds what shakes later.
inline constexpr double kPreparedPart = 0.998;

/// What one contact of PileLoop does in a step. kLinear: all normal forces are linear; kTurns:
/// rolling or drilling is resisted.
template <bool kLinear, bool kTurns>
class PileStep {
 public:
  using Contact = PileContact<kTurns>;

  /// What the contacts of a share have done in the step.
  struct Sum {
    PileLedger ledger;
    std::size_t collisions = 0;
    bool slid = false;
  };

  PileStep(PileWorld& world, double time, Sum& sum)
      : world_(&world), time_(time), sum_(&sum), impacts_(world, time) {}

  /// Two bodies that are `apart` from each other [m], by no more than `reach` or in contact.
  void act_on_bodies(Contact& c, const Vector3& apart, double reach, double distance) {
    act(c, of_bodies(c, apart, reach, distance));
  }
  /// A body and the substrate or a surface; where it is nearest.
  void act_on_surface(Contact& c, const NearestPoint& at) { act(c, on_surface(c, at)); }

  static double elastic_energy(const Contact& c) { return elastic(c) + memory_energy(c); }

 private:
  void act(Contact& c, const PileMotion& m) {
    if (m.overlap >= 0)
      meet(c, m);
    else
      leave(c, m);
  }

  // --- laws --------------------------------------------------------------------------------------

  static double normal_force_of(const Contact& c, double overlap, double rate) {
    if constexpr (kLinear)
      return (*std::get_if<LinearForce>(&c.law->normal))(overlap, rate);
    else
      return normal_force(c.law->normal, overlap, rate);
  }
  static double elastic_force(const Contact& c, double overlap) {
    return std::visit([&](const auto& law) { return law.elastic(overlap); }, c.law->normal);
  }
  static double elastic(const Contact& c) {
    return std::visit([&](const auto& law) { return law.energy(c.overlap); }, c.law->normal);
  }
  static double memory_energy(const Contact& c) {
    double energy = spring_energy(c.stiffness, c.sliding.stretch);
    if constexpr (kTurns)
      energy += spring_energy(c.law->rolling.stiffness, c.rolling.stretch) +
                spring_energy(c.law->drilling.stiffness, c.drilling.stretch);
    return energy;
  }

  /// Takes one spring on and counts what it loses: with f = f_e + f_d over the way w, of which
  /// `cut` is no stretch, while the stiffness goes from k0 to k,
  ///   −½ (f_d0 + f_d1)·w − ½ (f_e0 + f_e1)·cut − ½ (k − k0) s0·s1.
  template <class V>
  static V take(const SpringNow& law, double stiffness_before, const V& way, const V& rate,
                SpringMemory<V>& memory, V& dashpot, double& lost, V* cut = nullptr) {
    const V stretch = memory.stretch;
    const SpringResponse<V> now = respond(law, way, rate, memory);
    const V dashpot_now = now.force - now.elastic;
    if (cut) *cut = now.cut;
    lost -= 0.5 * work_of(V(dashpot + dashpot_now), way) +
            0.5 * work_of(V(now.elastic - stiffness_before * stretch), now.cut) +
            0.5 * (law.stiffness - stiffness_before) * work_of(stretch, memory.stretch);
    dashpot = dashpot_now;
    return now.force;
  }

  /// Where Mindlin's k_t grows with what the contact is pressed by, the force stays and the stretch
  /// falls. Returns what that takes of the energy.
  static double stiffen(Contact& c, double stiffness) {
    const double before = c.stiffness;
    if (c.law->sliding.form != SpringFriction::Form::mindlin || stiffness <= before) return 0;
    const double energy = spring_energy(before, c.sliding.stretch);
    c.sliding.stretch *= before / stiffness;
    c.stiffness = stiffness;
    return energy - spring_energy(stiffness, c.sliding.stretch);
  }

  static Vector3 slide(Contact& c, const PileMotion& m, double overlap, double pressed, double way,
                       bool dilates, double& lost) {
    const SpringFriction& law = c.law->sliding;
    if (law.static_friction == 0) return Vector3::Zero();
    const bool opens = dilates && c.law->hard;
    SpringNow now{law.stiffness_at(overlap), law.damping, law.static_friction * pressed,
                  law.kinetic_friction * pressed};
    if (opens) now.holds = now.slides = kPreparedPart * now.holds;
    if (law.damping_ratio > 0)
      now.damping +=
          law.damping_ratio * (normal_force_of(c, overlap, 1) - elastic_force(c, overlap));
    lost += stiffen(c, now.stiffness);
    const double before = std::exchange(c.stiffness, now.stiffness);
    Vector3 cut;
    Vector3 force = take(now, before, Vector3(way * m.slip_before), m.slip, c.sliding,
                         c.sliding_dashpot, lost, &cut);
    if (opens && c.sliding.slides) open(c, cut);
    return force;
  }

  /// Shares a cut of the tangential spring between it and the normal one, so that both come back to
  /// the cone |F_T| = μ F_N along its normal.
  static void open(Contact& c, const Vector3& cut) {
    const double mu = c.law->sliding.static_friction;
    const double normal = mu * mu * std::get_if<LinearForce>(&c.law->normal)->stiffness;
    const double part = c.stiffness / (c.stiffness + normal);
    c.sliding.stretch += (1 - part) * cut;
    c.sliding.slides = false;
    c.offset += mu * part * cut.norm();
  }

  static PileCouples turn(Contact& c, const PileMotion& m, double pressed, double way,
                          double& lost) {
    const double about = m.spin.dot(m.normal);
    PileCouples couples;
    if (c.law->resists_rolling()) {
      if (c.sliding.slides && !c.law->rolls_while_sliding) {
        lost += spring_energy(c.law->rolling.stiffness, c.rolling.stretch);
        c.rolling = {Vector3::Zero()};
        c.rolling_dashpot.setZero();
      } else {
        const SpringNow law = c.law->rolling_at(pressed, m.speed);
        const Vector3& w = m.spin_before;
        couples.rolling =
            take(law, law.stiffness, Vector3(way * (w - w.dot(m.normal) * m.normal)),
                 Vector3(m.spin - about * m.normal), c.rolling, c.rolling_dashpot, lost);
      }
    }
    if (c.law->drilling.length > 0)
      couples.drilling =
          take(c.law->drilling.at(pressed), c.law->drilling.stiffness,
               way * m.spin_before.dot(m.normal), about, c.drilling, c.drilling_dashpot, lost) *
          m.normal;
    return couples;
  }

  /// A couple M against what rolls without slip and does not slide asks for the friction M×n/((1 +
  /// q) R), which cannot break it loose: it is no part of what sticks, K (16).
  void add_couples(const Contact& c, const Vector3& n, const PileCouples& couples,
                   PileForce& force) const {
    force.torque = couples.rolling + couples.drilling;
    if (c.law->rolls_while_sliding || !c.law->resists_rolling()) return;
    const double R = world_->bodies[c.first].radius, lever = c.law->rolling_lever;
    force.all += couples.rolling.cross(n) / lever;
    force.torque -= R / lever * couples.rolling;
  }

  /// Takes a contact that touches on to now, over `part` of the step, and counts its energy. Caps
  /// are those of the normal force `pressed`.
  void follow(Contact& c, const PileMotion& m, double overlap, double normal, double pressed,
              double part) const {
    const double way = part * world_->step;
    double lost = 0;
    const double angle = way * m.turning_before;
    if (c.impact.until > 0 && time_ >= c.impact.until) impacts_.end(c, lost);
    const bool strikes = c.impact.until > 0;
    Vector3& remembered = strikes ? c.impact.leaves : c.sliding.stretch;
    remembered = carried(remembered, c.normal, m.normal, angle);
    const Vector3 across =
        strikes ? impacts_.slide(c, m, std::abs(normal), way, lost)
                : slide(c, m, overlap, std::abs(pressed), way, world_->dilates, lost);
    PileForce force{normal * m.normal + across, across};
    if constexpr (kTurns) {
      c.rolling.stretch = carried(c.rolling.stretch, c.normal, m.normal, angle);
      const PileCouples couples = strikes ? impacts_.turn(c, m, std::abs(normal), way, lost)
                                          : turn(c, m, std::abs(pressed), way, lost);
      add_couples(c, m.normal, couples, force);
    }
    const double dashpot = normal - elastic_force(c, overlap);
    lost += 0.5 * (c.normal_dashpot + dashpot) * (overlap - c.overlap);
    sum_->ledger.dissipated += lost;
    sum_->slid = sum_->slid || c.sliding.slides;
    if (c.second < 0)
      sum_->ledger.work += 0.5 * way *
                           ((c.force.all + force.all).dot(m.carried_by) +
                            (c.force.torque + force.torque).dot(m.turned_by));
    c.overlap = overlap;
    c.normal = m.normal;
    c.force = force;
    c.normal_force = normal;
    c.normal_dashpot = dashpot;
  }

  // --- contacts that begin, last and end ---------------------------------------------------------

  void push(const Contact& c, const PileForce& f, const Vector3& n) const {
    PileBody& a = world_->bodies[c.first];
    const Vector3 lever = f.across.cross(n);
    a.force += f.all;
    a.torque += a.radius * lever + f.torque;
    if (c.second < 0) return;
    PileBody& b = world_->bodies[static_cast<std::size_t>(c.second)];
    b.force -= f.all;
    b.torque += b.radius * lever - f.torque;
  }

  /// The two overlap.
  void meet(Contact& c, const PileMotion& m) {
    if (!(m.overlap <= most_overlap(c))) throw_too_deep(c, m.overlap);
    double normal = normal_force_of(c, m.overlap, m.closing);
    if ((c.law->clamped && normal <= 0) || (m.overlap <= 0 && m.closing <= 0)) {
      if (c.touching) {
        const double left = normal < 0 ? c.normal_force / (c.normal_force - normal) : 1;
        end(c, m, left, c.overlap + left * (m.overlap - c.overlap), 0);
      }
      return;
    }
    if (c.touching) {
      follow(c, m, m.overlap, normal, normal, 1);
      push(c, c.force, m.normal);
      c.impulse += std::abs(normal) * world_->step;
    } else {
      begin(c, m, normal);
    }
  }

  /// The contact has lasted for `part` of the step before now, and gets part h ½ (F_begin + F) for
  /// it.
  [[gnu::noinline]] void begin(Contact& c, const PileMotion& m, double normal) {
    const double closing = m.closing, reached = closing * world_->step;
    const bool within = world_->started && closing > 0 && reached >= m.overlap;
    const double part = within ? m.overlap / reached : 0;
    c.touching = true;
    c.overlap = within ? 0 : m.overlap;
    c.normal = m.normal;
    c.stiffness = 0;
    c.sliding = {Vector3::Zero()};
    c.sliding_dashpot.setZero();
    c.normal_dashpot = 0;
    c.impact = impacts_.begin(*c.law, m);
    if constexpr (kTurns) static_cast<PileTurning&>(c) = {};
    c.force = {};
    if (!within) sum_->ledger.dissipated -= elastic(c);  // came with it
    double first = normal_force_of(c, c.overlap, closing);
    if (c.law->clamped) first = std::max(0.0, first);
    follow(c, m, c.overlap, first, first, 0);
    const PileForce begun = c.force;
    follow(c, m, m.overlap, normal, normal, part);
    push(c, within ? 0.5 * ((1 + part) * c.force + part * begun) : c.force, m.normal);
    c.impulse += std::abs(normal) * world_->step;
    sum_->collisions += c.second >= 0;
  }

  /// The contact lasted for `part` of the step before now and should have had part h ½ (F + F_end)
  /// there; it had h/2 F.
  [[gnu::noinline]] void end(Contact& c, const PileMotion& m, double part, double overlap,
                             double normal) {
    const PileForce before = c.force;
    // The cap goes with F_N to its end, which what sticks follows in no time: the step sees a jump.
    const double before_end = c.normal_force;
    follow(c, m, overlap, normal, before_end, part);
    push(c, 0.5 * (part * (before + c.force) - before), m.normal);
    sum_->ledger.dissipated += elastic(c) + memory_energy(c);
    c.touching = false;
    c.sliding.slides = false;
    c.offset = 0;
  }

  /// Two that touched a step ago and overlap no more.
  [[gnu::noinline]] void leave(Contact& c, const PileMotion& m) {
    const double fell = c.overlap - m.overlap;
    const double part = fell > 0 ? std::clamp(c.overlap / fell, 0.0, 1.0) : 1;
    const double last = c.law->clamped ? 0 : normal_force_of(c, 0, m.closing);
    end(c, m, part, 0, last);
  }

  /// Beyond which nothing is meant to overlap [m].
  double most_overlap(const Contact& c) const {
    const double first = world_->bodies[c.first].radius;
    if (c.second < 0) return c.law->deepest * first;
    return c.law->deepest *
           std::min(first, world_->bodies[static_cast<std::size_t>(c.second)].radius);
  }

  [[noreturn, gnu::noinline]] void throw_too_deep(const Contact& c, double overlap) const {
    const auto number = [&](std::size_t place) {
      return std::ranges::find(world_->place, place) - world_->place.begin();
    };
    const std::string other =
        c.second >= 0 ? fmt::format("body {}", number(static_cast<std::size_t>(c.second)))
        : c.second == kSubstrate ? "the substrate"
                                 : "a surface";
    throw StepTooLong(
        fmt::format("body {} is {:.3g} m deep in {} at {:.9g} s, more than {:.3g} m: what presses "
                    "them together "
                    "is too much for the contact's stiffness",
                    number(c.first), overlap, other, time_, most_overlap(c)));
  }

  // --- how the two move --------------------------------------------------------------------------

  struct Half {
    Vector3 velocity, spin;
  };

  /// Relative to what the second is: its velocity and turning at the contact, now and half a step
  /// before.
  static void look(const Contact& c, const Vector3& n, const Half& now, const Half& before,
                   const Vector3& turn_now, const Vector3& turn_before, PileMotion& m) {
    m.normal = n;
    m.closing = -n.dot(now.velocity);
    m.slip = now.velocity + m.closing * n - turn_now.cross(n);
    const Vector3 mean = c.touching ? Vector3(0.5 * (n + c.normal)) : n;
    Vector3 way = before.velocity - turn_before.cross(mean);
    m.slip_before = way - way.dot(n) * n;
    m.spin = now.spin;
    m.spin_before = before.spin;
  }

  PileMotion of_bodies(const Contact& c, const Vector3& apart, double reach,
                       double distance) const {
    const PileBody &a = world_->bodies[c.first],
                   &b = world_->bodies[static_cast<std::size_t>(c.second)];
    PileMotion m;
    m.overlap = reach - distance;
    const Half before{a.velocity - b.velocity, a.angular_velocity - b.angular_velocity};
    const Half now{before.velocity + 0.5 * (a.change - b.change),
                   before.spin + 0.5 * (a.turn_change - b.turn_change)};
    const Vector3 turning = a.radius * a.angular_velocity + b.radius * b.angular_velocity;
    const Vector3 n = apart / distance;
    look(c, n, now, before, turning + 0.5 * (a.radius * a.turn_change + b.radius * b.turn_change),
         turning, m);
    m.turning_before = 0.5 * (a.angular_velocity + b.angular_velocity).dot(n);
    if constexpr (kTurns) m.speed = now.velocity.norm();
    return m;
  }

  PileMotion on_surface(const Contact& c, const NearestPoint& at) const {
    const PileBody& a = world_->bodies[c.first];
    const Scene& scene = world_->scene->hard;
    PileMotion m;
    m.overlap = a.radius + c.offset - at.distance;
    const double t = time_, half = t - (world_->started ? 0.5 * world_->step : 0);
    Vector3 matter = Vector3::Zero(), turned = Vector3::Zero();
    if (c.second == kSubstrate) {
      if (!scene.motion.is_still()) {
        m.carried_by = scene.motion.velocity(half);
        matter = scene.motion.velocity(t);
      }
    } else if (const SurfaceMotion& motion = scene.surfaces[touched_surface(c.second)].motion;
               !motion.is_still()) {
      m.carried_by = motion.velocity(half, at.point);
      matter = motion.velocity(t, at.point);
      turned = m.turned_by = motion.rate();
    }
    const Half before{a.velocity - m.carried_by, a.angular_velocity - turned};
    const Half now{a.velocity + 0.5 * a.change - matter,
                   a.angular_velocity + 0.5 * a.turn_change - turned};
    look(c, at.normal, now, before, a.radius * (a.angular_velocity + 0.5 * a.turn_change),
         a.radius * a.angular_velocity, m);
    m.turning_before = 0.5 * (a.angular_velocity + turned).dot(at.normal);
    if constexpr (kTurns) m.speed = now.velocity.norm();
    return m;
  }

  PileWorld* world_;
  double time_;  ///< now [s]
  Sum* sum_;
  PileImpacts<kTurns> impacts_;
};

}  // namespace slipcheck
