#include "peer_backends/siconos/siconos_settings.h"

namespace slipcheck::siconos {

const std::vector<SettingRow<SiconosSettings>>& setting_rows() {
  using S = SiconosSettings;
  using Make = SettingRows<S>;
  static const std::vector<SettingRow<S>> rows = {
      Make::word("coefficients", &S::coefficients, {"pair", "fields"})
          .about("rolling friction by the exact map; or straight as the length that the law takes"),
      Make::number("theta", "", &S::theta)
          .within(0, 1)
          .try_each({0.5, 1.0})
          .about("of MoreauJeanOSI, how implicit smooth forces are"),
      Make::word("solver", &S::solver, {"nsgs", "admm"})
          .about(
              "of FrictionContact, or RollingFrictionContact where the scene rolls with friction"),
      Make::number("tolerance", "", &S::tolerance)
          .within(1e-16, 1)
          .try_each({1e-4, 1e-8, 1e-12})
          .about("SICONOS_DPARAM_TOL, relative, of that solver"),
      Make::count("iterations", &S::iterations)
          .within(1, 1e7)
          .try_each({1000.0, 10000.0})
          .about("SICONOS_IPARAM_MAX_ITER"),
      Make::number("newton_tolerance", "", &S::newton_tolerance)
          .within(1e-16, 1)
          .about("TimeStepping::setNewtonTolerance, of the step's own nonlinear loop"),
      Make::number("activation_threshold", "m", &S::activation_threshold)
          .within(-1, 1)
          .about("MoreauJeanOSI::setConstraintActivationThreshold: predicted gap below which a "
                 "contact acts"),
      Make::count("substeps", &S::substeps)
          .within(1, 10000)
          .try_each({1.0, 4.0})
          .about("equal steps of Siconos's in each step"),
  };
  return rows;
}

}  // namespace slipcheck::siconos
