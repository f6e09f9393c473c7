#include "peer_backends/simbody/simbody_settings.h"

namespace slipcheck::simbody {

const std::vector<SettingRow<SimbodySettings>>& setting_rows() {
  using S = SimbodySettings;
  using Make = SettingRows<S>;
  static const std::vector<SettingRow<S>> rows = {
      Make::word("integrator", &S::integrator,
                 {"runge_kutta_merson", "runge_kutta_3", "verlet", "cpodes"})
          .about("all choose their steps to keep to the accuracy"),
      Make::number("accuracy", "", &S::accuracy)
          .within(1e-13, 0.5)
          .try_each({1e-3, 1e-6, 1e-9})
          .about("Integrator::setAccuracy, relative, of each step"),
      Make::flag("interpolate", &S::interpolate)
          .about("the end of a step may be a state between two of Simbody's; off: steps end there"),
      Make::number("transition_velocity", "m/s", &S::transition_velocity)
          .within(1e-9, 10)
          .search(1e-5, 1e-1, true)
          .about("slip from which friction is Coulomb's, below it goes to zero with the slip"),
      Make::number("modulus", "Pa", &S::modulus)
          .within(1, 1e15)
          .search(1e6, 1e12, true)
          .about("plane-strain modulus of the bodies whose contact is hard, and of the substrate"),
      Make::number("impact_speed", "m/s", &S::impact_speed)
          .within(0, 1e6)
          .about("at which the dissipation gives the restitution of hard contacts; 0: the approach "
                 "of the pair at the start, on the substrate the landing"),
      Make::number("lowest_restitution", "", &S::lowest_restitution)
          .within(1e-3, 1)
          .about("of hard contacts: a dissipation for less would be stiffer still"),
      Make::flag("fields", &S::fields)
          .about("what people type: dissipation 1 − e per metre a second, dynamic friction for "
                 "static too"),
      Make::count("frames", &S::frames)
          .within(1, 10000)
          .about("states that are shown of each step, at equal parts of it, but for those "
                 "in the middle of an impact: a collision is seen as "
                 "from so much closer"),
  };
  return rows;
}

}  // namespace slipcheck::simbody
