#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "report/rows/text_table.h"
#include "scenario/units.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// The quantities of a scene by which methods are judged: what has a tolerance, effective
/// restitution first, the others by name. Where nothing has one, all that has an error.
std::vector<std::string> judged_quantities(const PrecisionScene& scene);

/// What is shown of a scene: the first that is judged and the trajectory; with `all` everything
/// that has an error, what is judged first.
std::vector<std::string> shown_quantities(const PrecisionScene& scene, bool all);

/// The error of a point in a quantity, or null.
const PhaseErrors* errors_of(const WorkPrecision& point, const std::string& quantity);

/// The dimension that a quantity's errors have in this scene: relative ones are pure numbers.
const Dimension& error_dimension(const PrecisionScene& scene, const std::string& quantity);

/// An error for people, "0.14", "3.1e-7", "12 µm"; "–" for NaN.
std::string short_error(double error, const Dimension& dimension);
/// Two significant digits, "0.14", "3.1e-7"; "–" for NaN.
std::string short_number(double value);
/// A knob for people: "240 Hz", "1e-9", "1.2 µs"; empty where the method has none.
std::string knob_text(MethodCurve::Kind kind, double knob);

/// From the coarsest to the finest, "2 µs → 3 µs", or once where both are the same.
std::string from_to(const std::string& first, const std::string& last);
/// A CPU time from the coarsest point to the finest; "–" where none was taken.
Cell cost_cell(const MethodCurve& curve, double WorkCost::*cost, Tone tone = Tone::plain);
Tone tone_of(Convergence::Kind kind);

/// Whether any point of it ran.
bool has_run(const MethodCurve& curve);

/// Whether a curve is shown where there is no room for all: not those with iterations that are not
/// the profile's own, unless they are the best at something in this quantity.
bool is_main_curve(const MethodCurve& curve, const std::string& quantity);
bool is_on_front(const MethodCurve& curve, const std::string& quantity);

/// Why points of a curve came to nothing: "240 Hz: crashed: signal 11", one for each reason.
std::vector<std::string> troubles_of(const MethodCurve& curve);

/// Of one method over several scenes: how many come out how, by Convergence::Kind.
struct ConvergenceCounts {
  std::string method;
  bool other_iterations = false;            ///< than the profile's own
  std::array<std::size_t, 4> judged{};      ///< by the worst of what is judged in a scene
  std::array<std::size_t, 4> trajectory{};  ///< likewise
  std::size_t on_front = 0;                 ///< scenes in which the method is best at something
};
/// In order of appearance. Of effective restitution where it is judged, else of all that is.
std::vector<ConvergenceCounts> convergence_counts(const std::vector<PrecisionScene>& scenes);
/// They beside each other: by kind what is judged, by kind the trajectory, the front.
TextTable convergence_table(const std::vector<ConvergenceCounts>& methods);

}  // namespace slipcheck
