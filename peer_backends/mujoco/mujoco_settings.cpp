#include "peer_backends/mujoco/mujoco_settings.h"

#include "engine/setting_rows.h"

namespace slipcheck::mujoco {
namespace {

using S = MujocoSettings;
using Make = SettingRows<S>;

std::vector<Make::Row> contact_rows() {
  return {
      Make::word("coefficients", &S::coefficients, {"fields", "pair"})
          .about("the scene's numbers as they stand, mu_r for the length, or mapped exactly"),
      Make::word("restitution", &S::restitution, {"none", "spring"})
          .about("MuJoCo has no coefficient of restitution: contacts have the profile's solref, or "
                 "stiffness and damping of their own that give the rebound"),
      Make::number("contact_steps", "", &S::contact_steps)
          .within(2, 1e6)
          .try_each({8.0, 16.0, 64.0})
          .about("MuJoCo's steps that the contact of such a spring lasts"),
      Make::count("condim", &S::condim)
          .within(0, 6)
          .try_each({})
          .about("dimensions of a contact: 1, 3 with sliding, 4 with drilling, 6 with rolling "
                 "friction; 0: as many as the coefficients need"),
      Make::word("cone", &S::cone, {"pyramidal", "elliptic"}).about("of friction"),
      Make::number("impratio", "", &S::impratio)
          .within(1e-6, 1e9)
          .try_each({1.0, 10.0, 100.0})
          .about("how much harder friction is than the normal force; elliptic cones only"),
      Make::number("solref_timeconst", "s", &S::solref_timeconst)
          .within(1e-12, 1e3)
          .try_each({0.02, 0.005, 1e-9})
          .about("time constant of a contact; MuJoCo takes no less than two steps"),
      Make::number("solref_dampratio", "", &S::solref_dampratio)
          .within(1e-6, 1e3)
          .about("damping ratio of a contact; 1: critical"),
      Make::number("solimp_dmin", "", &S::solimp_dmin)
          .within(1e-4, 0.9999)
          .try_each({0.9, 0.9999})
          .about("part of a contact's reference that is enforced where the overlap begins"),
      Make::number("solimp_dmax", "", &S::solimp_dmax)
          .within(1e-4, 0.9999)
          .try_each({0.95, 0.9999})
          .about("and at overlaps from the width on"),
      Make::number("solimp_width", "m", &S::solimp_width)
          .within(1e-12, 1e3)
          .about("overlap over which the one becomes the other"),
      Make::number("margin", "m", &S::margin).about("gap from which a contact acts"),
  };
}

std::vector<Make::Row> world_rows() {
  return {
      Make::word("solver", &S::solver, {"PGS", "CG", "Newton"}).about("of the constraints"),
      Make::count("iterations", &S::iterations)
          .within(1, 100000)
          .try_each({20.0, 100.0})
          .about("most iterations of the solver"),
      Make::number("tolerance", "", &S::tolerance)
          .within(0, 1)
          .try_each({1e-8, 0.0})
          .about("improvement at which it stops before"),
      Make::count("noslip_iterations", &S::noslip_iterations)
          .within(0, 100000)
          .try_each({0.0, 10.0})
          .about("sweeps that take the softness out of friction afterwards"),
      Make::word("integrator", &S::integrator, {"Euler", "RK4", "implicit"}).about("of the motion"),
      Make::count("substeps", &S::substeps)
          .within(1, 10000)
          .try_each({1.0, 4.0, 16.0})
          .about("equal steps of MuJoCo's in each step"),
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

MujocoSettings read_settings(const Settings& chosen) { return read_rows(rows(), chosen); }

Settings write_settings(const MujocoSettings& settings) { return write_rows(rows(), settings); }

}  // namespace slipcheck::mujoco
