#pragma once

#include <vector>

#include "figures/statement.h"
#include "report/charts/chart.h"
#include "report/files/csv.h"

namespace slipcheck {

/// A figure of one of the papers, computed, with the paper's number for its name, "K5"; or one of
/// this project's own, "rolling-gas".
struct PaperFigure : Chart {
  std::vector<Statement> statements;  ///< of the paper about it, each beside what the run gives
  std::string notes;  ///< Markdown beneath the caption: what it shows beyond; maybe none
  Table table;        ///< every number that is drawn, and the residuals
};

// One for each figure; K are Kondic's, B those of Brilliantov et al., L Luding's.
PaperFigure figure_k5();   ///< compression in a symmetric collision over its speed
PaperFigure figure_k6();   ///< sliding time and distance over the speed
PaperFigure figure_k7();   ///< losses over e_n
PaperFigure figure_k8();   ///< sliding time after asymmetric collisions
PaperFigure figure_k9();   ///< sliding distance
PaperFigure figure_k10();  ///< energy lost while sliding
PaperFigure figure_k11();  ///< momentum lost while sliding
PaperFigure figure_b1();   ///< normal restitution of ice
PaperFigure figure_b2();   ///< tangential restitution of rough ice
PaperFigure figure_l2();   ///< tangential velocity after a collision over that before
PaperFigure figure_l7();   ///< energies of translation and rotation over the friction
PaperFigure figure_l8();   ///< over β0
PaperFigure figure_l9();   ///< over the shape factor
PaperFigure figure_l10();  ///< height over the floor's speed, elastic smooth walls
PaperFigure figure_l11();  ///< dissipative smooth walls
PaperFigure figure_l12();  ///< rough moving walls
PaperFigure figure_l13();  ///< over the floor's speed and the number of spheres
PaperFigure figure_lb();   ///< event driven against contacts that last, App. B

// The project's own, on K's spheres.
PaperFigure figure_collision_course();     ///< one symmetric collision over time
PaperFigure figure_slide_course();         ///< from it to rolling
PaperFigure figure_spin_exchange();        ///< slip after asymmetric collisions, by their rubbing
PaperFigure figure_rolling_restitution();  ///< rolling velocities and effective restitution
PaperFigure figure_rolling_gas();          ///< effective restitution in a gas, over the free path

// How the same things look in all of them.
inline constexpr Look kReference{Ink::black, Line::none, Marker::circle};
inline constexpr Look kClosedForm{Ink::blue, Line::solid, Marker::none};
inline constexpr const char* kReferenceLabel = "reference (integrated)";
inline constexpr const char* kClosedFormLabel = "closed form";

/// What curves of v, R Ω and u look like, for the legend: without points of their own.
std::vector<Curve> velocity_legend();

}  // namespace slipcheck
