#include "peer_backends/dart/dart_settings.h"

#include "engine/setting_rows.h"

namespace slipcheck::dart_engine {
namespace {

using S = DartSettings;
using Make = SettingRows<S>;

const std::vector<Make::Row>& rows() {
  static const std::vector<Make::Row> all = {
      Make::word("coefficients", &S::coefficients, {"fields", "pair"})
          .about(
              "one shape for each body with the scene's numbers, of which DART takes the lesser "
              "friction and the product of restitutions; or a shape for each kind of partner, so "
              "that each two have their own numbers"),
      Make::word("collision_detector", &S::collision_detector, {"fcl", "dart"})
          .about("FCLCollisionDetector as a World comes with it, to which spheres are meshes, or "
                 "DARTCollisionDetector"),
      Make::word("lcp_solver", &S::lcp_solver, {"dantzig", "pgs"})
          .about("DantzigBoxedLcpSolver with PGS where it fails, or PgsBoxedLcpSolver alone"),
      Make::number("error_reduction_parameter", "", &S::error_reduction_parameter)
          .within(0, 1)
          .try_each({0.0, 0.01})
          .about("part of an overlap that is pushed out in a step, as velocity; the rebound is the "
                 "larger of this push and e v"),
      Make::number("max_error_reduction_velocity", "m/s", &S::max_error_reduction_velocity)
          .within(0, 1e18)
          .try_each({0.0, 1e-3})
          .about("most that the push may add"),
      Make::number("error_allowance", "m", &S::error_allowance)
          .within(0, 1e18)
          .about("overlap that is not pushed out"),
      Make::number("constraint_force_mixing", "", &S::constraint_force_mixing)
          .within(1e-9, 1)
          .try_each({1e-5, 1e-9})
          .about("softness of every row, a part of its own inverse mass"),
      Make::number("length_unit", "m", &S::length_unit)
          .within(1e-9, 1e9)
          .try_each({1.0, 0.1, 0.05})
          .about("length of DART's unit: its threshold of restitution is a rebound of 0.1 units/s, "
                 "its cap one of 100"),
      Make::count("substeps", &S::substeps)
          .within(1, 10000)
          .try_each({1.0, 2.0, 4.0})
          .about("equal steps of DART's in each step"),
  };
  return all;
}

}  // namespace

const std::vector<SettingInfo>& setting_table() {
  static const std::vector<SettingInfo> table = infos_of(rows());
  return table;
}

DartSettings read_settings(const Settings& chosen) { return read_rows(rows(), chosen); }

Settings write_settings(const DartSettings& settings) { return write_rows(rows(), settings); }

}  // namespace slipcheck::dart_engine
