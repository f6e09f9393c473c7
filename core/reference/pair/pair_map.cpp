#include "reference/pair/pair_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "physics/contact/elastic_pair.h"
#include "scene/ode.h"
#include "scene/scaled_impact.h"

namespace slipcheck {
namespace {

/// Has the sign of dF_N/dt at the overlap x, its rate v and that one's rate a. Where F_N has a root
/// singularity at x = 0, the power of |x| that removes it is multiplied in.
struct ForceGrowth {
  double x, v, a;

  double operator()(const LinearForce& f) const { return f.stiffness * v + f.damping * a; }
  double operator()(const HertzForce&) const { return v; }
  double operator()(const PowerForce& f) const {
    if (f.viscosity == 0) return v;
    // Ḟ = E α x^(α−1) v + η (γ x^(γ−1) v² + x^γ a)
    const double lowest = std::min(f.alpha, f.gamma), size = std::abs(x);
    return f.modulus * f.alpha * std::pow(size, f.alpha - lowest) * v +
           f.viscosity * std::pow(size, f.gamma - lowest) * (f.gamma * v * v + x * a);
  }
  double operator()(const ViscoelasticForce& f) const {
    // Ḟ = (3/2) ρ (√x v + A (v²/(2√x) + √x a))
    return x * v + f.dissipation_time * (0.5 * v * v + x * a);
  }
  double operator()(const CompactViscoelasticForce& f) const { return v + f.dissipation_time * a; }
};

class Collision {
 public:
  Collision(const SoftContact& contact, double mass, double tangential_mass, double normal_speed,
            double tangential_speed, double tolerance)
      : contact_(contact),
        scales_(impact_scales(contact.normal, mass, normal_speed)),
        mass_(mass),
        tangential_mass_(tangential_mass),
        tolerance_(tolerance),
        slip_scale_(tangential_speed),
        y_{0, normal_speed, tangential_speed, 0},
        ode_(4, method(), [this](double, const double* y, double* rate) { right_side(y, rate); }) {}

  /// To the contact's end; returns when that is [s], or infinity.
  double run() {
    begin();
    double t = 0;
    while (true) {
      restart(t);
      Ode::Stop stop = Ode::Stop::step;
      while (stop == Ode::Stop::step) stop = ode_.step(kLongest * scales_.time);
      t = ode_.time();
      std::copy(ode_.y().begin(), ode_.y().end(), y_.begin());
      if (stop == Ode::Stop::limit) return std::numeric_limits<double>::infinity();
      const auto found = ode_.roots_found();
      if (found[0] != 0) {
        // An overlap that decays without end comes to 0 by rounding alone.
        const bool parts = -y_[kRate] > tolerance_ * scales_.length / scales_.time;
        return parts ? t : std::numeric_limits<double>::infinity();
      }
      for (std::size_t k = 1; k < found.size(); ++k)
        if (found[k] != 0) change(k);
    }
  }

  double overlap_rate() const { return y_[kRate]; }
  double slip() const { return y_[kSlip]; }

 private:
  /// ξ, ξ̇, u, and the asperity's displacement: ζ (printed), F_N b (passive, F_N grows), b (F_N
  /// falls).
  enum Part : std::size_t { kOverlap, kRate, kSlip, kBend };
  enum class Mode {
    smooth,
    viscous,     ///< below Coulomb's cap
    capped,      ///< at it
    printed,     ///< in the tooth cell_ of the saw-tooth
    growing,     ///< passive, F_N grows
    falling,     ///< passive, F_N falls
    attracting,  ///< passive, F_N < 0
  };
  static constexpr double kLongest = 1e5;

  Ode::Method method() const {
    // A viscous force that stops the slip far faster than the collision lasts.
    const auto* viscous = std::get_if<ViscousForce>(&contact_.tangential);
    const bool stiff = viscous && viscous->damping * scales_.time > 30 * tangential_mass_;
    return stiff ? Ode::Method::bdf : Ode::Method::adams;
  }

  double normal(const double* y) const {
    return normal_force(contact_.normal, y[kOverlap], y[kRate]);
  }
  double growth(const double* y) const {
    return std::visit(ForceGrowth{y[kOverlap], y[kRate], -normal(y) / mass_}, contact_.normal);
  }
  const ViscousForce& viscous() const { return std::get<ViscousForce>(contact_.tangential); }
  const AsperityForce& asperity() const { return std::get<AsperityForce>(contact_.tangential); }

  void begin() {
    const double force = normal(y_.data());
    if (const auto* law = std::get_if<ViscousForce>(&contact_.tangential)) {
      mode_ = law->viscous(std::abs(y_[kSlip])) > law->cap(force) ? Mode::capped : Mode::viscous;
    } else if (const auto* rough = std::get_if<AsperityForce>(&contact_.tangential)) {
      if (rough->form == AsperityForce::Form::printed)
        mode_ = Mode::printed;
      else
        mode_ = growth(y_.data()) >= 0 ? Mode::growing : Mode::falling;
    }
  }

  void right_side(const double* y, double* rate) const {
    const double force = normal(y), u = y[kSlip];
    double tangential = 0, bend = 0;
    switch (mode_) {
      case Mode::smooth:
      case Mode::attracting:
        break;
      case Mode::viscous:
        tangential = -viscous().damping * u;
        break;
      case Mode::capped:
        tangential = -std::copysign(viscous().friction * force_sign_ * force, u);
        break;
      case Mode::printed:
        tangential = -asperity().friction * force * (y[kBend] / asperity().size - cell_);
        bend = u;
        break;
      case Mode::growing:
        tangential = -asperity().friction / asperity().size * y[kBend];
        bend = force * u;
        break;
      case Mode::falling:
        tangential = -asperity().friction / asperity().size * force * y[kBend];
        bend = u;
        break;
    }
    rate[kOverlap] = y[kRate];
    rate[kRate] = -force / mass_;
    rate[kSlip] = tangential / tangential_mass_;
    rate[kBend] = bend;
  }

  /// Where the present mode ends; the first is the contact's own end.
  void roots(const double* y, double* value) const {
    const double force = normal(y);
    value[0] = contact_.end == ContactEnd::zero_force ? force : y[kOverlap];
    value[1] = value[2] = value[3] = -1;
    switch (mode_) {
      case Mode::smooth:
        break;
      case Mode::viscous:
        value[1] = viscous().viscous(std::abs(y[kSlip])) - viscous().cap(force);
        // The cap falls to 0 and rises again, maybe within one step.
        value[2] = -force_sign_ * force;
        break;
      case Mode::capped:
        value[1] = viscous().friction * force_sign_ * force - viscous().viscous(std::abs(y[kSlip]));
        value[2] = -force_sign_ * force;
        break;
      case Mode::printed:
        // The tooth reaches from cell to cell + 1 outwards, the one at 0 to both sides.
        value[1] = y[kBend] - asperity().size * (cell_ + (cell_ >= 0 ? 1 : 0));
        value[2] = asperity().size * (cell_ - (cell_ <= 0 ? 1 : 0)) - y[kBend];
        break;
      case Mode::growing:
        value[1] = y[kBend] - asperity().size * force;
        value[2] = -y[kBend] - asperity().size * force;
        value[3] = -growth(y);
        break;
      case Mode::falling:
        value[1] = std::abs(y[kBend]) - asperity().size;
        value[2] = -force;
        value[3] = growth(y);
        break;
      case Mode::attracting:
        value[1] = force;
        break;
    }
  }

  /// At the root k > 0 of the present mode.
  void change(std::size_t k) {
    const double force = normal(y_.data());
    switch (mode_) {
      case Mode::smooth:
        break;
      case Mode::viscous:
        force_sign_ = k == 2 ? -force_sign_ : force < 0 ? -1 : 1;
        mode_ = Mode::capped;
        break;
      case Mode::capped:
        if (k == 1)
          mode_ = Mode::viscous;
        else
          force_sign_ = -force_sign_;
        break;
      case Mode::printed:
        cell_ += k == 1 ? 1 : -1;
        break;
      case Mode::growing:
        if (k == 3) {
          mode_ = Mode::falling;
          y_[kBend] /= force;
        } else {
          y_[kBend] = 0;
        }
        break;
      case Mode::falling:
        if (k == 1) {
          y_[kBend] = 0;
        } else if (k == 2) {
          mode_ = Mode::attracting;
          y_[kBend] = 0;
        } else {
          mode_ = Mode::growing;
          y_[kBend] *= force;
        }
        break;
      case Mode::attracting:
        mode_ = Mode::growing;
        break;
    }
  }

  void restart(double t) {
    const double bend =
        mode_ == Mode::growing ? scales_.length * mass_ / (scales_.time * scales_.time) : 1;
    const double size =
        std::holds_alternative<AsperityForce>(contact_.tangential) ? asperity().size : 1;
    std::array<double, 4> floor = {scales_.length, scales_.length / scales_.time, slip_scale_,
                                   bend * size};
    for (double& f : floor) f *= 0.01 * tolerance_;
    static constexpr std::array<int, 4> kDirection = {-1, 1, 1, 1};
    ode_.watch(
        4, [this](double, const double* y, double* value) { roots(y, value); }, kDirection);
    ode_.start(t, y_, tolerance_, floor);
  }

  const SoftContact& contact_;
  ImpactScales scales_;
  double mass_, tangential_mass_, tolerance_, slip_scale_;
  std::array<double, 4> y_;
  Mode mode_ = Mode::smooth;
  double force_sign_ = 1;
  double cell_ = 0;
  Ode ode_;
};

}  // namespace

PairCollision collide_freely(const SoftContact& contact, const Sphere& first, const Sphere& second,
                             double normal_speed, double tangential_speed, double tolerance) {
  const double mass = effective_mass(first, second);
  const double tangential_mass = tangential_mass_ratio(first, second) * mass;
  Collision collision(contact, mass, tangential_mass, normal_speed, tangential_speed, tolerance);
  const double duration = collision.run();
  const double restitution = std::isfinite(duration) ? -collision.overlap_rate() / normal_speed : 0;
  return pair_collision(mass, tangential_mass, normal_speed, tangential_speed, restitution,
                        collision.slip() / tangential_speed, duration);
}

}  // namespace slipcheck
