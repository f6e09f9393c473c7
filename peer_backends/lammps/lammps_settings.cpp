#include "peer_backends/lammps/lammps_settings.h"

namespace slipcheck::lammps {

const std::vector<SettingRow<LammpsSettings>>& setting_rows() {
  using S = LammpsSettings;
  using Make = SettingRows<S>;
  static const std::vector<SettingRow<S>> rows = {
      Make::word("pair_style", &S::pair_style, {"law", "hooke_history", "hertz_history"})
          .about("the scene's law in gran/hooke or granular; or gran/hooke/history or "
                 "gran/hertz/history, with a tangential spring of 2/7 of the stiffness"),
      Make::word("coefficients", &S::coefficients, {"pair", "fields"})
          .about("springs that have exactly the restitution of hard contacts; or what people type: "
                 "e for damping tsuji, rolling friction without its factor"),
      Make::number("collision_time", "s", &S::collision_time)
          .search(1e-6, 1e-3, true)
          .about("of an elastic collision on the springs that stand for hard contacts and for the "
                 "substrate; 0: scenes that need such are refused"),
      Make::count("steps_per_collision", &S::steps_per_collision)
          .within(4, 1e6)
          .try_each({20.0, 50.0, 200.0})
          .about("steps of LAMMPS's in the shortest collision"),
      Make::count("substeps", &S::substeps)
          .within(0, 1e8)
          .about("steps of LAMMPS's in each step; 0: as many as steps_per_collision asks for"),
      Make::count("frames", &S::frames)
          .within(1, 10000)
          .about("states that are shown of each step, at equal parts of it, but for those "
                 "in the middle of an impact: a collision is seen as "
                 "from so much closer; steps of LAMMPS's are rounded up to a multiple"),
      Make::number("sticking", "", &S::sticking)
          .within(0, 1e6)
          .search(1, 20, true)
          .about("rate, times collision_time, at which friction of hard contacts and of the "
                 "substrate takes a slip away below Coulomb's cap where sticking_by is damping"),
      Make::word("sticking_by", &S::sticking_by, {"scene", "damping", "spring"})
          .about("what takes that slip away: damping, or a spring that remembers it and so holds; "
                 "scene: springs where contacts of the scene remember"),
      Make::number("lowest_restitution", "", &S::lowest_restitution)
          .within(1e-6, 1)
          .about(
              "of springs that stand for hard contacts; the less, the more damping. Where bodies "
              "land and sticking_by is spring, 0.1 does better"),
      Make::number("skin", "R", &S::skin)
          .within(1e-3, 1e3)
          .about("neighbor skin over the smallest radius; lists are checked each step"),
      Make::count("ranks", &S::ranks)
          .within(1, 64)
          .about("processes of LAMMPS's, by mpirun where more than one"),
  };
  return rows;
}

}  // namespace slipcheck::lammps
