#include "figures/paper_figures.h"

namespace slipcheck {

std::span<const PaperFigureMaker> paper_figures() {
  static constexpr PaperFigureMaker kFigures[] = {
      {"K5", figure_k5},
      {"K6", figure_k6},
      {"K7", figure_k7},
      {"K8", figure_k8},
      {"K9", figure_k9},
      {"K10", figure_k10},
      {"K11", figure_k11},
      {"collision-course", figure_collision_course},
      {"slide-course", figure_slide_course},
      {"spin-exchange", figure_spin_exchange},
      {"rolling-restitution", figure_rolling_restitution},
      {"rolling-gas", figure_rolling_gas},
      {"B1", figure_b1},
      {"B2", figure_b2},
      {"L2", figure_l2},
      {"L3", figure_l3},
      {"L4", figure_l4},
      {"L5", figure_l5},
      {"L6", figure_l6},
      {"L7", figure_l7},
      {"L8", figure_l8},
      {"L9", figure_l9},
      {"L10", figure_l10},
      {"L11", figure_l11},
      {"L12", figure_l12},
      {"L13", figure_l13},
      {"box-energy-ratio", figure_box_energy_ratio},
      {"soft-box-convergence", figure_soft_box_convergence},
  };
  return kFigures;
}

std::vector<Curve> velocity_legend() {
  return {{"v", {Ink::blue, Line::solid, Marker::circle}, {}, {}},
          {"R Ω", {Ink::green, Line::dashed, Marker::square}, {}, {}},
          {"u = v − R Ω", {Ink::vermilion, Line::dash_dot, Marker::triangle}, {}, {}}};
}

const char* const kPaperFiguresIntroduction =
    "Every point is computed in the run by the reference, with nothing given but the parameters, "
    "and stands beside the closed form; where a paper's first-order formula and the integrated "
    "law differ, both are drawn. K is L. Kondic, Phys. Rev. E 60, 751 (1999), B is N. V. "
    "Brilliantov et al., Phys. Rev. E 53, 5382 (1996), L is S. Luding, Phys. Rev. E 52, 4442 "
    "(1995). A figure named after a paper's has its quantities and its parameters; ranges are the "
    "project's where the text does not give them. What has a name in words is the project's own. "
    "stated.csv and figures.md hold what the papers say of each against what the run gives: a "
    "claim agrees where the measured value, with its error, lies within what the paper's digits or "
    "words allow. Nothing is tuned; where a claim fails, the remark says why.";

}  // namespace slipcheck
