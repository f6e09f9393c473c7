#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "harness/observe/observables.h"
#include "scenario/units.h"

namespace slipcheck {

/// One observable over the phases of one run.
struct RunSpread {
  const EngineRecord* run = nullptr;
  std::vector<double> values;  ///< by phase [SI]; NaN where a phase does not show it
  std::size_t shown = 0;       ///< phases that do
  std::size_t outside = 0;     ///< of these, the ones beyond the tolerance
  std::size_t far_off = 0;     ///< phases more than 5 % off the reference
  double min = kNotObserved, max = kNotObserved;  ///< [SI]
};

/// One observable with a tolerance over the phases of all runs: what the strip charts draw and what
/// is said about them. A vector is shown as its distance from the reference's vector, since its
/// length alone would not tell a wrong direction.
struct PhaseSpread {
  std::string name;  ///< "i-j.effective_restitution"
  Dimension dimension = kPureNumber;
  bool is_distance = false;     ///< of a vector; then the reference is 0
  double reference = 0;         ///< [SI]
  double scale = 0;             ///< what relative errors are of [SI], >= 0
  double low = 0, high = 0;     ///< what is within the tolerance [SI]
  std::string tolerance;        ///< as text, "0.005", "1 %"
  std::vector<RunSpread> runs;  ///< that have shown it at all
};

/// Nothing where the observable has no tolerance or is not comparable.
std::optional<PhaseSpread> phase_spread(const SceneRecord& scene, const std::string& name);

/// Whether charts of both could not be told apart, as of two bodies that mirror each other.
bool look_alike(const PhaseSpread& a, const PhaseSpread& b);

/// "Over 64 phases i-j.effective_restitution comes out between 0.358 and 0.498; 0.3571 is right: 64
/// of 64 phases are outside the tolerance of 0.005, 56 of them more than 5 % off."
std::string words_of(const PhaseSpread& spread, const RunSpread& run);

/// Says so for each engine whose worst error at its highest rate is no better than half of that at
/// its lowest: "A smaller step does not help …".
std::vector<std::string> words_on_convergence(const PhaseSpread& spread);

}  // namespace slipcheck
