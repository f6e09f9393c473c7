#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "reference/forces/contact_state.h"
#include "reference/forces/contact_touch.h"
#include "reference/forces/contact_watch.h"
#include "scene/ode.h"

namespace slipcheck {

/// Which method suits the stretch between two events: Adams, until it crawls and BDF does not. A
/// slip that begins slowly while its direction turns is stiff; a contact that swings is not.
class MethodChoice {
 public:
  Ode::Method method() const { return method_; }
  void begin(Ode::Method method) {
    method_ = method;
    trial_ = method == Ode::Method::adams ? Trial::adams : Trial::over;
    steps_ = 0;
  }
  /// After a step to the time `now`; whether the method changed.
  bool step(double now) {
    if (trial_ == Trial::over || ++steps_ < kSteps) {
      if (steps_ == kSteps / 2) middle_ = now;
      return false;
    }
    const double pace = now - middle_;
    steps_ = 0;
    if (trial_ == Trial::adams) {
      adams_pace_ = pace;
      trial_ = Trial::bdf;
      method_ = Ode::Method::bdf;
      return true;
    }
    trial_ = Trial::over;
    if (pace > 3 * adams_pace_) return false;
    method_ = Ode::Method::adams;
    return true;
  }

 private:
  enum class Trial { adams, bdf, over };
  static constexpr int kSteps = 400;
  Ode::Method method_ = Ode::Method::adams;
  Trial trial_ = Trial::adams;
  int steps_ = 0;
  double middle_ = 0, adams_pace_ = 0;
};

/// Carries a state from one event to the next.
class ContactIntegrator {
 public:
  /// `state` must outlive the integrator; tolerance: relative, see ContactSettings.
  ContactIntegrator(ContactState& state, double tolerance);
  ContactIntegrator(const ContactIntegrator&) = delete;
  ContactIntegrator& operator=(const ContactIntegrator&) = delete;

  /// What stopped the integration; nothing, if only the step has ended.
  struct Happening {
    std::optional<NextTouch> touch;                         ///< two bodies meet; nothing else then
    std::vector<std::pair<ContactWatch::Item, int>> roots;  ///< with −1 falling, +1 rising
    bool kink = false;                                      ///< the substrate's velocity jumps
  };

  /// One step, to `limit` [s] at most. Throws IntegrationFailure.
  Happening advance(double limit);
  /// An event has changed modes or velocities.
  void begin_stretch() { must_restart_ = new_stretch_ = true; }

  std::size_t steps() const { return steps_before_ + ode_->steps(); }
  double largest_kinetic_energy() const { return largest_energy_; }  ///< so far [J]

 private:
  void make_ode(Ode::Method method);
  void restart();
  void set_floors();
  void predict_landings();
  void add_landings(double time, Happening& happening) const;

  ContactState& state_;
  double tolerance_;
  std::optional<Ode> ode_;
  Ode::Method method_ = Ode::Method::adams;  ///< of ode_
  MethodChoice choice_;
  std::optional<ContactWatch> watch_;
  ContactDynamics::Evaluation scratch_;
  std::vector<double> floor_;
  std::vector<double> landing_;   ///< when each body comes down from a free flight, or infinity
  std::size_t steps_before_ = 0;  ///< of integrators that were replaced
  bool must_restart_ = true;
  bool new_stretch_ = true;  ///< the modes have changed since the last restart
  double largest_energy_ = 0;
};

}  // namespace slipcheck
