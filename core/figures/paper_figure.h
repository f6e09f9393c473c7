#pragma once

#include <vector>

#include "figures/effort.h"
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

// One for each figure; K are Kondic's, B those of Brilliantov et al.
PaperFigure figure_k5();   ///< compression in a symmetric collision over its speed
PaperFigure figure_k6();   ///< sliding time and distance over the speed
PaperFigure figure_k7();   ///< losses over e_n
PaperFigure figure_k8();   ///< sliding time after asymmetric collisions
PaperFigure figure_k9();   ///< sliding distance
PaperFigure figure_k10();  ///< energy lost while sliding
PaperFigure figure_k11();  ///< momentum lost while sliding
PaperFigure figure_b1();   ///< normal restitution of ice
PaperFigure figure_b2();   ///< tangential restitution of rough ice

// Luding's; those of many spheres cost what one likes.
PaperFigure figure_l2();                ///< tangential restitution of one collision
PaperFigure figure_l3();                ///< a sphere hits a wall, for some μ
PaperFigure figure_l4();                ///< for some β0
PaperFigure figure_l5();                ///< two spheres meet, for some μ
PaperFigure figure_l6();                ///< for some e
PaperFigure figure_l7(Effort effort);   ///< a vibrated box over the friction
PaperFigure figure_l8(Effort effort);   ///< over β0
PaperFigure figure_l9(Effort effort);   ///< over the shape factor
PaperFigure figure_l10(Effort effort);  ///< over the floor's speed, for some numbers of spheres
PaperFigure figure_l11(Effort effort);  ///< for some walls
PaperFigure figure_l12(Effort effort);  ///< for rough walls that move
PaperFigure figure_l13(Effort effort);  ///< beside an experiment

// This project's own, about the same boxes.
PaperFigure figure_box_energy_ratio(Effort effort);  ///< K/R beside molecular chaos
PaperFigure figure_soft_box_convergence();           ///< event driven against contacts that last

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
