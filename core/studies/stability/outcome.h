#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "base/enum_names.h"
#include "harness/run/engine_state.h"

namespace slipcheck {

/// How a run came out, from good to bad; docs/stability.md gives the criteria.
enum class Outcome {
  accurate,        ///< every observable within its tolerance
  degraded,        ///< not that, but nothing below
  drifting,        ///< what rests or keeps its energy in the reference creeps or loses it
  energy_growing,  ///< gains energy that nothing gives
  tunnelled,       ///< passes through a body or the substrate
  exploded,        ///< far faster than anything in the scene can be
  not_finite,      ///< NaN or infinite
  timed_out,
  crashed,
  refused,  ///< the engine or the reference says beforehand why it cannot; not bad, but no result
};
template <>
inline constexpr std::array kNamesOf<Outcome> = {
    "accurate", "degraded", "drifting",  "energy growing", "tunnelled",
    "exploded", "NaN",      "timed out", "crashed",        "refused"};
inline constexpr std::size_t kOutcomes = kNamesOf<Outcome>.size();

/// How many phases came out how.
using OutcomeCounts = std::array<std::size_t, kOutcomes>;

/// Limits of the classes; fractions of the scene's own scales.
struct OutcomeCriteria {
  double creep = 0.01;          ///< of the radius: way of a body that rests in the reference
  double energy = 0.05;         ///< of the scene's energy: gain or, where it is conserved, loss
  double exploded = kExploded;  ///< times the fastest that the scene can make a body
  double least_rest = 0.1;      ///< of the run: a rest that is shorter tells no creep
  double conserved = 1e-6;  ///< of the scene's energy: the reference's change that counts as none
};

/// How one phase came out, and by what.
struct PhaseOutcome {
  Outcome outcome = Outcome::accurate;
  std::string why;  ///< with figures; empty where accurate
  double time = 0;  ///< since the scene's start [s] where the class has an instant, else 0
};

}  // namespace slipcheck
