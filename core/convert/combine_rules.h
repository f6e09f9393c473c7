#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slipcheck {

/// How an engine makes one coefficient of a pair from those of its two bodies.
enum class CombineRule { product, minimum, maximum, average, geometric_mean, harmonic_mean };

/// f(a, b) for a, b >= 0.
double combined(CombineRule rule, double a, double b);

/// What the other body must have so that the pair has `pair`, where one has `own`; both >= 0.
/// Nothing where no value does: 0.5 as the minimum of 0.3 and anything.
std::optional<double> other_of_pair(CombineRule rule, double own, double pair);

/// What both bodies must have, where they have the same.
double both_of_pair(CombineRule rule, double pair);

/// "a b", "min(a, b)"
const char* formula_of(CombineRule rule);

/// An engine's rules as it ships.
struct EngineRules {
  std::string engine;
  CombineRule friction;
  std::optional<CombineRule> restitution;  ///< nothing where bodies have no coefficient of it
  std::string source;                      ///< where the rule is written, and what may change it
};

/// Of the engines that combine coefficients of bodies, by name.
const std::vector<EngineRules>& engine_rules();

}  // namespace slipcheck
