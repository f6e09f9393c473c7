#include "free_collision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/tangential_branch.h"
#include "scene/ode.h"
#include "scene/scaled_impact.h"

namespace slipcheck::test {
namespace {

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
        if (found[k] != 0) change(edges_[k - 1], found[k] > 0);
    }
  }

  double overlap_rate() const { return y_[kRate]; }
  double slip() const { return y_[kSlip]; }

 private:
  /// ξ, ξ̇, u, and the state of the asperity.
  enum Part : std::size_t { kOverlap, kRate, kSlip, kBend };
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
    return force_growth(contact_.normal, y[kOverlap], y[kRate], -normal(y) / mass_);
  }
  const AsperityForce* asperity() const { return std::get_if<AsperityForce>(&contact_.tangential); }

  void begin() {
    follow(contact_.tangential, normal(y_.data()), std::abs(y_[kSlip]), branch_);
    branch_.growing = growth(y_.data()) >= 0;
  }

  void right_side(const double* y, double* rate) const {
    const double force = normal(y), u = y[kSlip];
    rate[kOverlap] = y[kRate];
    rate[kRate] = -force / mass_;
    rate[kSlip] =
        tangential_force(contact_.tangential, branch_, force, u, y[kBend]) / tangential_mass_;
    rate[kBend] = asperity() ? bend_rate(*asperity(), branch_, force, u) : 0;
  }

  /// Where the present piece ends; the first is the contact's own end.
  void roots(const double* y, double* value) const {
    const double force = normal(y);
    value[0] = contact_.end == ContactEnd::zero_force ? force : y[kOverlap];
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const double rate = edges_[k] == TangentialEdge::growth ? growth(y) : 0;
      value[k + 1] = edge_value(edges_[k], contact_.tangential, branch_, force, rate,
                                std::abs(y[kSlip]), std::abs(y[kBend]));
    }
  }

  void change(TangentialEdge edge, bool rises) {
    cross(edge, rises, contact_.tangential, normal(y_.data()), branch_, y_[kBend]);
    // The cap falls to 0 and rises again, maybe within one step.
    if (edge == TangentialEdge::force_sign) branch_.capped = true;
  }

  void restart(double t) {
    const bool weighted =
        asperity() && asperity()->form == AsperityForce::Form::passive && branch_.growing;
    const double bend = weighted ? scales_.length * mass_ / (scales_.time * scales_.time) : 1;
    const double size = asperity() ? asperity()->size : 1;
    std::array<double, 4> floor = {scales_.length, scales_.length / scales_.time, slip_scale_,
                                   bend * size};
    for (double& f : floor) f *= 0.01 * tolerance_;
    edges_.clear();
    directions_ = {-1};
    for_each_edge(contact_.tangential, branch_, contact_.end,
                  [&](TangentialEdge edge, int direction) {
                    edges_.push_back(edge);
                    directions_.push_back(direction);
                  });
    ode_.watch(
        directions_.size(), [this](double, const double* y, double* value) { roots(y, value); },
        directions_);
    ode_.start(t, y_, tolerance_, floor);
  }

  const SoftContact& contact_;
  ImpactScales scales_;
  double mass_, tangential_mass_, tolerance_, slip_scale_;
  std::array<double, 4> y_;
  TangentialBranch branch_;
  std::vector<TangentialEdge> edges_;
  std::vector<int> directions_;
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

}  // namespace slipcheck::test
