#include "physics/contact/rubbing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/safe_root.h"

namespace slipcheck {
namespace {

constexpr int kPanels = 512;

/// |F_N| over one collision: ξ = v e^(−γt/2) s(t) with s = sin(ωt)/ω, ω² = ω0² − γ²/4, and
/// F_N = −m̄ ξ̈. From critical damping on ω is imaginary and s = sinh(|ω|t)/|ω|.
class NormalPulse {
 public:
  NormalPulse(const LinearContact& contact, double v)
      : mass_(contact.reduced_mass()),
        half_(0.5 * contact.damping_rate()),
        v_(v),
        stiffness_(contact.stiffness()),
        over_critical_(contact.is_over_critical()) {
    const double omega0 = contact.contact_frequency();
    omega_ = std::sqrt(std::abs((omega0 - half_) * (omega0 + half_)));
    // F_N = 0 ends the contact under zero_force.
    zero_ = LinearContact(mass_, stiffness_, 2 * half_, ContactEnd::zero_force).collision_time();
  }
  double size(double t) const {
    return std::abs(stiffness_ * v_ * std::exp(-half_ * t) * sine(t) + 2 * half_ * mass_ * rate(t));
  }
  /// J = ∫ |F_N| dt since the first touch.
  double impulse(double t) const {
    const double up = mass_ * (v_ - rate(std::min(t, zero_)));
    return t <= zero_ ? up : up + mass_ * (rate(t) - rate(zero_));
  }

 private:
  double sine(double t) const {
    if (omega_ == 0) return t;
    return (over_critical_ ? std::sinh(omega_ * t) : std::sin(omega_ * t)) / omega_;
  }
  double cosine(double t) const {
    return over_critical_ ? std::cosh(omega_ * t) : std::cos(omega_ * t);
  }
  /// ξ̇
  double rate(double t) const { return v_ * std::exp(-half_ * t) * (cosine(t) - half_ * sine(t)); }

  double mass_, half_, v_, stiffness_;
  bool over_critical_;
  double omega_, zero_;
};

/// The stretch that is being followed and what happened before it.
class Stretch {
 public:
  Stretch(const LinearContact& contact, const RubbingStart& start)
      : pulse_(contact, start.closing_speed),
        start_(start),
        damping_(start.damping_rate * contact.reduced_mass()),
        w_(start.surface_speed) {
    capped_ = over_cap(0) > 0;
    if (!start.confined && over_weight(0) > 0) lift();
  }

  /// > 0 where viscous rubbing would exceed Coulomb's cap.
  double over_cap(double t) const {
    return damping_ * surface_speed(t) - start_.friction * pulse_.size(t);
  }
  /// > 0 where F_R exceeds the weight.
  double over_weight(double t) const {
    const double force = capped_ ? start_.friction * pulse_.size(t) : damping_ * surface_speed(t);
    return force - start_.lifted_mass * start_.gravity;
  }
  bool has_left_mode(double t) const { return capped_ ? over_cap(t) < 0 : over_cap(t) > 0; }
  bool lifts(double t) const { return !lifted_ && !start_.confined && over_weight(t) > 0; }

  void switch_mode(double t) {
    advance(t);
    capped_ = !capped_;
  }
  void lift_at(double t) {
    advance(t);
    lift();
  }
  Rubbing finish(double t) {
    advance(t);
    Rubbing result;
    result.impulse = impulse_;
    result.share = 0.5 * start_.mobility * impulse_ / start_.surface_speed;
    result.lift_off_time = lift_off_time_;
    if (lifted_)
      result.lift_off_speed = std::max(0.0, (impulse_ - impulse_at_lift_) / start_.lifted_mass -
                                                start_.gravity * (t - lift_off_time_));
    return result;
  }

 private:
  double mobility() const {
    return lifted_ ? start_.mobility + 1 / start_.lifted_mass : start_.mobility;
  }
  double pull() const { return lifted_ ? start_.gravity : 0; }

  /// w.
  double surface_speed(double t) const {
    const double dt = t - begin_;
    if (capped_)
      return w_ - mobility() * start_.friction * (pulse_.impulse(t) - normal_) + pull() * dt;
    const double decay = damping_ * mobility(), rest = pull() / decay;
    return rest + (w_ - rest) * std::exp(-decay * dt);
  }
  void advance(double t) {
    const double w = surface_speed(t);
    impulse_ += (w_ - w + pull() * (t - begin_)) / mobility();
    w_ = w;
    begin_ = t;
    normal_ = pulse_.impulse(t);
  }
  void lift() {
    lifted_ = true;
    lift_off_time_ = begin_;
    impulse_at_lift_ = impulse_;
  }

  NormalPulse pulse_;
  RubbingStart start_;
  double damping_;
  bool capped_ = false, lifted_ = false;
  double begin_ = 0, w_, normal_ = 0;  // t_1, w_1, J_1
  double impulse_ = 0, impulse_at_lift_ = 0;
  double lift_off_time_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Rubbing rub(const LinearContact& contact, const RubbingStart& start) {
  if (!(start.damping_rate > 0 && start.friction > 0 && start.surface_speed > 0)) {
    Rubbing none;
    none.lift_off_time = std::numeric_limits<double>::infinity();
    return none;
  }
  Stretch stretch(contact, start);
  const double end = contact.collision_time();
  double t = 0;
  for (int n = 1; n <= kPanels;) {
    const double next = end * n / kPanels;
    const auto changes = [&](double s) { return stretch.has_left_mode(s) || stretch.lifts(s); };
    if (!changes(next)) {
      t = next;
      ++n;
      continue;
    }
    t = first_true(t, next, changes);
    stretch.lifts(t) ? stretch.lift_at(t) : stretch.switch_mode(t);
    if (t == next) ++n;
  }
  return stretch.finish(end);
}

}  // namespace slipcheck
