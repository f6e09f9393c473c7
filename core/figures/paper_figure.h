#pragma once

#include <string>
#include <vector>

#include "report/csv.h"
#include "report/figure.h"

namespace slipcheck {

/// A figure of one of the papers, computed.
struct PaperFigure {
  std::string name;     ///< "K5"
  std::string title;    ///< as plot_text.h
  std::string caption;  ///< what is shown, with which parameters
  FigureDrawing drawing;
  Table table;  ///< every number that is drawn, and the residuals
};

// One for each figure; K are Kondic's, B those of Brilliantov et al.
PaperFigure figure_k5();   ///< one symmetric collision
PaperFigure figure_k6();   ///< from it to rolling
PaperFigure figure_k7();   ///< sliding time and distance over the relative speed
PaperFigure figure_k8();   ///< slip after asymmetric collisions
PaperFigure figure_k9();   ///< their sliding times and distances
PaperFigure figure_k10();  ///< their rolling velocities and effective restitution
PaperFigure figure_k11();  ///< energy and momentum lost while sliding
PaperFigure figure_b1();   ///< normal restitution of ice
PaperFigure figure_b2();   ///< tangential restitution of rough ice

// How the same things look in all of them.
inline constexpr Look kReference{Ink::black, Line::none, Marker::circle};
inline constexpr Look kClosedForm{Ink::blue, Line::solid, Marker::none};
inline constexpr const char* kReferenceLabel = "reference (integrated)";
inline constexpr const char* kClosedFormLabel = "closed form";

/// What curves of v, R Ω and u look like, for the legend: without points of their own.
std::vector<Curve> velocity_legend();

}  // namespace slipcheck
