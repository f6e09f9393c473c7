#include "reference/piles/pile_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/piles/pile_contact.h"
#include "reference/piles/pile_neighbours.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

/// Of the smallest radius, the gap up to which bodies are looked at for a contact.
constexpr double kSkin = 0.1;
/// Of Coulomb's cap, what a contact is prepared with: the rest of it holds what shakes later.
constexpr double kPrepared = 0.998;

template <class V>
double energy_of(double stiffness, const V& stretch) {
  if constexpr (std::is_same_v<V, double>)
    return 0.5 * stiffness * stretch * stretch;
  else
    return 0.5 * stiffness * stretch.squaredNorm();
}

double product(double a, double b) { return a * b; }
double product(const Vector3& a, const Vector3& b) { return a.dot(b); }

/// kLinear: all normal forces are linear; kTurns: rolling or drilling is resisted.
template <bool kLinear, bool kTurns>
class PileLoopOf final : public PileLoop {
 public:
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
    touches.clear();
    for (PileContact& c : contacts_)
      if (const double impulse = std::exchange(c.impulse, 0); impulse > 0)
        touches.push_back({static_cast<int>(c.first), c.second, impulse});
  }

  void wait(double time) override {
    for (PileContact& c : contacts_)
      if (c.touching) c.impulse += time * std::max(0.0, c.normal_force);
  }

  double elastic_energy() const override {
    double energy = 0;
    for (const PileContact& c : contacts_)
      if (c.touching) energy += elastic(c) + memory_energy(c);
    return energy;
  }

  bool bodies_touch() const override {
    return std::ranges::any_of(
        contacts_, [](const PileContact& c) { return c.touching && c.second != kSubstrate; });
  }

  bool rolls_on_substrate(std::size_t bodies) const override {
    const auto rolls = [](const PileContact& c) {
      return c.touching && c.second == kSubstrate && !c.sliding.slides;
    };
    return static_cast<std::size_t>(std::ranges::count_if(contacts_, rolls)) == bodies;
  }

  std::vector<std::string> features() const override {
    return {kLinear ? "linear normal forces" : "any normal force",
            kTurns ? "springs against sliding, rolling and drilling"
                   : "springs against sliding, none against rolling or drilling",
            "any number of contacts at once, in steps of fixed length"};
  }

 private:
  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;

  // --- laws --------------------------------------------------------------------------------------

  static double normal_force_of(const PileContact& c, double overlap, double rate) {
    if constexpr (kLinear)
      return (*std::get_if<LinearForce>(&c.law.normal))(overlap, rate);
    else
      return normal_force(c.law.normal, overlap, rate);
  }
  static double elastic_force(const PileContact& c, double overlap) {
    return std::visit([&](const auto& law) { return law.elastic(overlap); }, c.law.normal);
  }
  static double elastic(const PileContact& c) {
    return std::visit([&](const auto& law) { return law.energy(c.overlap); }, c.law.normal);
  }
  static double memory_energy(const PileContact& c) {
    double energy = energy_of(c.stiffness, c.sliding.stretch);
    if constexpr (kTurns)
      energy += energy_of(c.law.rolling.stiffness, c.rolling.stretch) +
                energy_of(c.law.drilling.stiffness, c.drilling.stretch);
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
    lost -= 0.5 * product(V(dashpot + dashpot_now), way) +
            0.5 * product(V(now.elastic - stiffness_before * stretch), now.cut) +
            0.5 * (law.stiffness - stiffness_before) * product(stretch, memory.stretch);
    dashpot = dashpot_now;
    return now.force;
  }

  /// Where Mindlin's k_t grows with what the contact is pressed by, the force stays and the stretch
  /// falls. Returns what that takes of the energy.
  static double stiffen(PileContact& c, double stiffness) {
    const double before = c.stiffness;
    if (c.law.sliding.form != SpringFriction::Form::mindlin || stiffness <= before) return 0;
    const double energy = energy_of(before, c.sliding.stretch);
    c.sliding.stretch *= before / stiffness;
    c.stiffness = stiffness;
    return energy - energy_of(stiffness, c.sliding.stretch);
  }

  static Vector3 slide(PileContact& c, const PileMotion& m, double overlap, double pressed,
                       double way, bool dilates, double& lost) {
    const SpringFriction& law = c.law.sliding;
    if (law.static_friction == 0) return Vector3::Zero();
    const bool opens = dilates && c.law.hard;
    SpringNow now{law.stiffness_at(overlap), law.damping, law.static_friction * pressed,
                  law.kinetic_friction * pressed};
    if (opens) now.holds = now.slides = kPrepared * now.holds;
    if (law.damping_ratio > 0)
      now.damping +=
          law.damping_ratio * (normal_force_of(c, overlap, 1) - elastic_force(c, overlap));
    lost += stiffen(c, now.stiffness);
    const double before = std::exchange(c.stiffness, now.stiffness);
    Vector3 cut;
    const Vector3 force = take(now, before, Vector3(way * m.slip_before), m.slip, c.sliding,
                               c.sliding_dashpot, lost, &cut);
    if (opens && c.sliding.slides) open(c, cut);
    return force;
  }

  /// Shares a cut of the tangential spring between it and the normal one, so that both come back to
  /// the cone |F_T| = μ F_N along its normal.
  static void open(PileContact& c, const Vector3& cut) {
    const double mu = c.law.sliding.static_friction;
    const double normal = mu * mu * std::get_if<LinearForce>(&c.law.normal)->stiffness;
    const double part = c.stiffness / (c.stiffness + normal);
    c.sliding.stretch += (1 - part) * cut;
    c.sliding.slides = false;
    c.offset += mu * part * cut.norm();
  }

  static Vector3 turn(PileContact& c, const PileMotion& m, double pressed, double way,
                      double& lost) {
    const double about = m.spin.dot(m.normal);
    Vector3 torque = Vector3::Zero();
    if (c.law.rolling.length > 0 || c.law.rolling_table) {
      if (c.sliding.slides && !c.law.rolls_while_sliding) {
        lost += energy_of(c.law.rolling.stiffness, c.rolling.stretch);
        c.rolling = {Vector3::Zero()};
        c.rolling_dashpot.setZero();
      } else {
        SpringNow law = c.law.rolling.at(pressed);
        if (c.law.rolling_table)
          law.holds = law.slides = c.law.rolling_lever * (*c.law.rolling_table)(m.speed) * pressed;
        const Vector3& w = m.spin_before;
        torque += take(law, law.stiffness, Vector3(way * (w - w.dot(m.normal) * m.normal)),
                       Vector3(m.spin - about * m.normal), c.rolling, c.rolling_dashpot, lost);
      }
    }
    if (c.law.drilling.length > 0)
      torque +=
          take(c.law.drilling.at(pressed), c.law.drilling.stiffness,
               way * m.spin_before.dot(m.normal), about, c.drilling, c.drilling_dashpot, lost) *
          m.normal;
    return torque;
  }

  /// Takes a contact that touches on to now, over `part` of the step, and counts its energy. Caps
  /// are those of the normal force `pressed`.
  void follow(PileWorld& world, PileContact& c, const PileMotion& m, double overlap, double normal,
              double pressed, double part) const {
    const double way = part * world.step;
    double lost = 0;
    const double angle = way * m.turning_before;
    c.sliding.stretch = carried(c.sliding.stretch, c.normal, m.normal, angle);
    const Vector3 across = slide(c, m, overlap, std::abs(pressed), way, world.dilates, lost);
    Vector3 torque = Vector3::Zero();
    if constexpr (kTurns) {
      c.rolling.stretch = carried(c.rolling.stretch, c.normal, m.normal, angle);
      torque = turn(c, m, std::abs(pressed), way, lost);
    }
    const double dashpot = normal - elastic_force(c, overlap);
    lost += 0.5 * (c.normal_dashpot + dashpot) * (overlap - c.overlap);
    world.ledger.dissipated += lost;
    world.slid = world.slid || c.sliding.slides;
    const PileForce force{normal * m.normal + across, across, torque};
    if (c.second < 0)
      world.ledger.work += 0.5 * way *
                           ((c.force.all + force.all).dot(m.carried_by) +
                            (c.force.torque + force.torque).dot(m.turned_by));
    c.overlap = overlap;
    c.normal = m.normal;
    c.force = force;
    c.normal_force = normal;
    c.normal_dashpot = dashpot;
  }

  // --- contacts that begin, last and end ---------------------------------------------------------

  void push(PileWorld& world, const PileContact& c, const PileForce& f, const Vector3& n) const {
    PileBody& a = world.bodies[c.first];
    const Vector3 lever = f.across.cross(n);
    a.force += f.all;
    a.torque += a.radius * lever + f.torque;
    if (c.second < 0) return;
    PileBody& b = world.bodies[static_cast<std::size_t>(c.second)];
    b.force -= f.all;
    b.torque += b.radius * lever - f.torque;
  }

  /// The two overlap.
  void meet(PileWorld& world, PileContact& c, const PileMotion& m) {
    if (!(m.overlap <= c.law.most_overlap)) throw_too_deep(world, c, m.overlap);
    double normal = normal_force_of(c, m.overlap, m.closing);
    if ((c.law.clamped && normal <= 0) || (m.overlap <= 0 && m.closing <= 0)) {
      if (c.touching) {
        const double left = normal < 0 ? c.normal_force / (c.normal_force - normal) : 1;
        end(world, c, m, left, c.overlap + left * (m.overlap - c.overlap), 0);
      }
      return;
    }
    if (c.touching) {
      follow(world, c, m, m.overlap, normal, normal, 1);
      push(world, c, c.force, m.normal);
      c.impulse += std::abs(normal) * world.step;
    } else {
      begin(world, c, m, normal);
    }
  }

  /// The contact has lasted for `part` of the step before now, and gets part h ½ (F_begin + F) for
  /// it.
  void begin(PileWorld& world, PileContact& c, const PileMotion& m, double normal) {
    const double closing = m.closing, reached = closing * world.step;
    const bool within = world.started && closing > 0 && reached >= m.overlap;
    const double part = within ? m.overlap / reached : 0;
    c.touching = true;
    c.overlap = within ? 0 : m.overlap;
    c.normal = m.normal;
    c.stiffness = 0;
    c.sliding = c.rolling = {Vector3::Zero()};
    c.drilling = {0};
    c.sliding_dashpot.setZero();
    c.rolling_dashpot.setZero();
    c.drilling_dashpot = c.normal_dashpot = 0;
    c.force = {};
    if (!within) world.ledger.dissipated -= elastic(c);  // came with it
    double first = normal_force_of(c, c.overlap, closing);
    if (c.law.clamped) first = std::max(0.0, first);
    follow(world, c, m, c.overlap, first, first, 0);
    const PileForce begun = c.force;
    follow(world, c, m, m.overlap, normal, normal, part);
    push(world, c, within ? 0.5 * ((1 + part) * c.force + part * begun) : c.force, m.normal);
    c.impulse += std::abs(normal) * world.step;
    world.collisions += c.second >= 0;
  }

  /// The contact lasted for `part` of the step before now and should have had part h ½ (F + F_end)
  /// there; it had h/2 F.
  void end(PileWorld& world, PileContact& c, const PileMotion& m, double part, double overlap,
           double normal) {
    const PileForce before = c.force;
    // The cap goes with F_N to its end, which what sticks follows in no time: the step sees a jump.
    const double before_end = c.normal_force;
    follow(world, c, m, overlap, normal, before_end, part);
    push(world, c, 0.5 * (part * (before + c.force) - before), m.normal);
    world.ledger.dissipated += elastic(c) + memory_energy(c);
    c.touching = false;
    c.sliding.slides = false;
    c.offset = 0;
  }

  /// Two that touched a step ago and overlap no more.
  void leave(PileWorld& world, PileContact& c, const PileMotion& m) {
    const double fell = c.overlap - m.overlap;
    const double part = fell > 0 ? std::clamp(c.overlap / fell, 0.0, 1.0) : 1;
    const double last = c.law.clamped ? 0 : normal_force_of(c, 0, m.closing);
    end(world, c, m, part, 0, last);
  }

  [[noreturn]] static void throw_too_deep(const PileWorld& world, const PileContact& c,
                                          double overlap) {
    const std::string other = c.second >= 0            ? fmt::format("body {}", c.second)
                              : c.second == kSubstrate ? "the substrate"
                                                       : "a surface";
    throw StepTooLong(
        fmt::format("body {} is {:.3g} m deep in {} at {:.9g} s, more than {:.3g} m: what presses "
                    "them together "
                    "is too much for the contact's stiffness",
                    c.first, overlap, other, world.time(), c.law.most_overlap));
  }

  // --- how the two move --------------------------------------------------------------------------

  struct Half {
    Vector3 velocity, spin;
  };

  /// Relative to what the second is: its velocity and turning at the contact, now and half a step
  /// before.
  static void look(const PileContact& c, const Vector3& n, const Half& now, const Half& before,
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

  PileMotion of_bodies(const PileWorld& world, const PileContact& c, const Vector3& apart,
                       double reach, double distance) const {
    const PileBody &a = world.bodies[c.first],
                   &b = world.bodies[static_cast<std::size_t>(c.second)];
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

  PileMotion on_surface(const PileWorld& world, const PileContact& c,
                        const NearestPoint& at) const {
    const PileBody& a = world.bodies[c.first];
    const Scene& scene = world.scene->hard;
    PileMotion m;
    m.overlap = a.radius + c.offset - at.distance;
    const double t = world.time(), half = t - (world.started ? 0.5 * world.step : 0);
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

  // --- the step ----------------------------------------------------------------------------------

  void forces(PileWorld& world) {
    if (!(budget_ > 0)) find_contacts(world);
    for (PileBody& b : world.bodies) {
      b.force.setZero();
      b.torque.setZero();
    }
    for (PileContact& c : contacts_) {
      const PileBody& a = world.bodies[c.first];
      if (c.second >= 0) {
        const PileBody& b = world.bodies[static_cast<std::size_t>(c.second)];
        const Vector3 apart = a.position - b.position;
        const double reach = a.radius + b.radius + c.offset, distance2 = apart.squaredNorm();
        if (distance2 > reach * reach && !c.touching) continue;
        act(world, c, of_bodies(world, c, apart, reach, std::sqrt(distance2)));
      } else {
        NearestPoint at;
        if (c.second == kSubstrate) {
          at.distance = a.position.z();
          at.point = {a.position.x(), a.position.y(), 0};
        } else {
          at = world.scene->hard.surfaces[touched_surface(c.second)].nearest(world.time(),
                                                                             a.position);
        }
        if (at.distance > a.radius && !c.touching) continue;
        act(world, c, on_surface(world, c, at));
      }
    }
  }

  void act(PileWorld& world, PileContact& c, const PileMotion& m) {
    if (m.overlap >= 0)
      meet(world, c, m);
    else
      leave(world, c, m);
  }

  void move(PileWorld& world) {
    const double h = world.step, kick = world.started ? h : 0.5 * h;
    const double drag = 0.5 * h * world.drag, keep = (1 - drag) / (1 + drag);
    double fastest = 0;
    for (PileBody& b : world.bodies) {
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
      fastest = std::max(fastest, b.velocity.squaredNorm());
    }
    const double speed = std::sqrt(fastest);
    if (!(speed * h < largest_radius_)) throw_lost(world, speed);
    budget_ -= h * (2 * speed + surfaces_speed_);
    world.started = true;
    ++world.n;
    forces_known_ = false;
  }

  [[noreturn]] static void throw_lost(const PileWorld& world, double speed) {
    throw StepTooLong(
        fmt::format("a body moves by more than a radius in a step, at {:.3g} m/s, at {:.9g} s",
                    speed, world.time()));
  }

  // --- who is near -------------------------------------------------------------------------------

  void find_contacts(PileWorld& world) {
    double smallest = kNever;
    largest_radius_ = 0;
    for (const PileBody& b : world.bodies) {
      smallest = std::min(smallest, b.radius);
      largest_radius_ = std::max(largest_radius_, b.radius);
    }
    const double skin = kSkin * smallest;
    std::vector<std::pair<std::uint32_t, int>> near;
    for (const PilePair& pair : near_pairs(world.bodies, skin))
      near.emplace_back(pair.first, static_cast<int>(pair.second));
    const Scene& scene = world.scene->hard;
    surfaces_speed_ = 0;
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
      const PileBody& b = world.bodies[i];
      if (scene.has_substrate && b.position.z() - b.radius <= skin)
        near.emplace_back(i, kSubstrate);
      for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
        const SurfaceMotion& motion = scene.surfaces[k].motion;
        const bool turns = !motion.rate().isZero(0) && !motion.is_belt();
        if (!motion.is_belt())
          surfaces_speed_ = std::max(surfaces_speed_, motion.course().largest_speed());
        if (turns ||
            scene.surfaces[k].nearest(world.time(), b.position).distance - b.radius <= skin)
          near.emplace_back(i, surface_touch(k));
      }
    }
    std::ranges::sort(near);
    keep(world, near);
    budget_ = skin;
  }

  /// Contacts that stay near keep what they remember.
  void keep(const PileWorld& world, const std::vector<std::pair<std::uint32_t, int>>& near) {
    std::vector<PileContact> kept;
    kept.reserve(near.size());
    auto old = contacts_.begin();
    for (const auto& [first, second] : near) {
      const auto place = std::pair(first, second);
      while (old != contacts_.end() && std::pair(old->first, old->second) < place) ++old;
      if (old != contacts_.end() && std::pair(old->first, old->second) == place) {
        kept.push_back(std::move(*old));
        continue;
      }
      PileContact& made = kept.emplace_back();
      made.first = first;
      made.second = second;
      made.law = world.laws->of(first, second);
    }
    contacts_ = std::move(kept);
  }

  std::vector<PileContact> contacts_;
  bool forces_known_ = false;
  double budget_ = 0;  ///< of the way [m] that two may come nearer before the near ones change
  double surfaces_speed_ = 0, largest_radius_ = 0;
};

template <bool kLinear>
std::unique_ptr<PileLoop> loop_of(bool turns) {
  if (turns) return std::make_unique<PileLoopOf<kLinear, true>>();
  return std::make_unique<PileLoopOf<kLinear, false>>();
}

}  // namespace

std::unique_ptr<PileLoop> make_pile_loop(const PileLaws& laws, bool general) {
  const bool turns = laws.turns() || general;
  return laws.is_linear() && !general ? loop_of<true>(turns) : loop_of<false>(turns);
}

}  // namespace slipcheck
