#include "peer_backends/ode/ode_settings.h"

#include "engine/setting_rows.h"

namespace slipcheck::ode {
namespace {

using S = OdeSettings;
using Make = SettingRows<S>;

std::vector<Make::Row> contact_rows() {
  return {
      Make::word("coefficients", &S::coefficients, {"fields", "pair", "pair_and_slip"})
          .about("the scene's numbers as they stand, mu_r for the length rho; mapped exactly; "
                 "likewise, but with static friction where a contact does not slip and rolling "
                 "friction only there"),
      Make::flag("approx1", &S::approx1)
          .about("dContactApprox1: friction in proportion to the normal force; off, as in a mode "
                 "without the flag: mu is a force in N, rho a torque in N m"),
      Make::word("friction_direction", &S::friction_direction, {"axes", "motion"})
          .about("directions of a contact's two rows of friction: fixed axes (dPlaneSpace), or "
                 "fdir1 along the slip, along the motion where nothing slips"),
      Make::number("bounce_vel", "m/s", &S::bounce_vel)
          .try_each({0.0, 0.1})
          .about("approach below which nothing bounces"),
      Make::number("erp", "", &S::erp)
          .within(0, 1)
          .try_each({0.0, 0.2})
          .search(0, 0.8)
          .about("part of an overlap that is pushed out in a step, as velocity; the rebound is "
                 "the larger of this push and e v"),
      Make::number("cfm", "1/(N s)", &S::cfm).within(0, 1).about("softness of every row"),
      Make::number("contact_max_correcting_vel", "m/s", &S::contact_max_correcting_vel)
          .within(0, 1e18)
          .try_each({1e18, 0.0})
          .about("most that the push may add; ODE's own is infinite"),
      Make::number("contact_surface_layer", "m", &S::contact_surface_layer)
          .about("overlap that is not pushed out"),
  };
}

std::vector<Make::Row> world_rows() {
  return {
      Make::word("stepper", &S::stepper, {"step", "quick_step"})
          .about("dWorldStep, exact up to the friction's limits, or dWorldQuickStep, iterated"),
      Make::count("quick_step_iterations", &S::quick_step_iterations)
          .within(1, 10000)
          .try_each({20.0, 100.0})
          .about("sweeps of dWorldQuickStep"),
      Make::number("quick_step_w", "", &S::quick_step_w)
          .within(0.1, 1.9)
          .search(0.8, 1.6)
          .about("its over-relaxation"),
      Make::flag("auto_disable", &S::auto_disable).about("bodies that stay slow are put to sleep"),
      Make::number("auto_disable_linear_threshold", "m/s", &S::auto_disable_linear_threshold)
          .about("slow is below this"),
      Make::number("auto_disable_angular_threshold", "rad/s", &S::auto_disable_angular_threshold)
          .about("and below this"),
      Make::number("auto_disable_time", "s", &S::auto_disable_time).about("slow for so long"),
      Make::count("auto_disable_steps", &S::auto_disable_steps)
          .within(0, 1e6)
          .about("and for so many steps"),
      Make::number("linear_damping", "", &S::linear_damping)
          .within(0, 1)
          .about("part of the velocity that a body loses in a step"),
      Make::number("angular_damping", "", &S::angular_damping)
          .within(0, 1)
          .about("part of the angular velocity likewise"),
      Make::count("substeps", &S::substeps)
          .within(1, 10000)
          .try_each({1.0, 2.0, 4.0})
          .about("equal steps of ODE's in each step"),
  };
}

const std::vector<Make::Row>& rows() {
  static const std::vector<Make::Row> all = [] {
    std::vector<Make::Row> joined = contact_rows();
    for (Make::Row& row : world_rows()) joined.push_back(std::move(row));
    return joined;
  }();
  return all;
}

}  // namespace

const std::vector<SettingInfo>& setting_table() {
  static const std::vector<SettingInfo> table = infos_of(rows());
  return table;
}

OdeSettings read_settings(const Settings& chosen) { return read_rows(rows(), chosen); }

Settings write_settings(const OdeSettings& settings) { return write_rows(rows(), settings); }

}  // namespace slipcheck::ode
