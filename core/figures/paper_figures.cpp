#include "figures/paper_figures.h"

#include <array>

namespace slipcheck {

std::span<const PaperFigureMaker> paper_figures() {
  static constexpr std::array<PaperFigureMaker, 19> kFigures = {{
      {"K5", figure_k5},   {"K6", figure_k6},   {"K7", figure_k7},   {"K8", figure_k8},
      {"K9", figure_k9},   {"K10", figure_k10}, {"K11", figure_k11}, {"K12", figure_k12},
      {"B1", figure_b1},   {"B2", figure_b2},   {"L2", figure_l2},   {"L7", figure_l7},
      {"L8", figure_l8},   {"L9", figure_l9},   {"L10", figure_l10}, {"L11", figure_l11},
      {"L12", figure_l12}, {"L13", figure_l13}, {"LB", figure_lb},
  }};
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
    "(1995). The papers' texts were not at hand: the "
    "numbers follow the order of their topics as far as it is known here, and a figure may show a "
    "quantity over another range or in another unit than the printed one of its number.";

}  // namespace slipcheck
