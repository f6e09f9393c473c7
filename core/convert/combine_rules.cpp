#include "convert/combine_rules.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {

using enum CombineRule;

double combined(CombineRule rule, double a, double b) {
  switch (rule) {
    case product:
      return a * b;
    case minimum:
      return std::min(a, b);
    case maximum:
      return std::max(a, b);
    case average:
      return (a + b) / 2;
    case geometric_mean:
      return std::sqrt(a * b);
    case harmonic_mean:
      return a + b > 0 ? 2 * a * b / (a + b) : 0;
  }
  return 0;
}

std::optional<double> other_of_pair(CombineRule rule, double own, double pair) {
  const auto if_any = [](bool condition, double value) {
    return condition ? std::optional(value) : std::nullopt;
  };
  switch (rule) {
    case product:
      return own == 0 ? if_any(pair == 0, 0) : pair / own;
    case minimum:
      return if_any(pair <= own, pair);
    case maximum:
      return if_any(pair >= own, pair);
    case average:
      return if_any(2 * pair >= own, 2 * pair - own);
    case geometric_mean:
      return own == 0 ? if_any(pair == 0, 0) : pair * pair / own;
    case harmonic_mean:
      return if_any(pair == 0 || pair < 2 * own, pair == 0 ? 0 : pair * own / (2 * own - pair));
  }
  return std::nullopt;
}

double both_of_pair(CombineRule rule, double pair) {
  return rule == product ? std::sqrt(pair) : pair;
}

const char* formula_of(CombineRule rule) {
  switch (rule) {
    case product:
      return "a b";
    case minimum:
      return "min(a, b)";
    case maximum:
      return "max(a, b)";
    case average:
      return "(a + b)/2";
    case geometric_mean:
      return "√(a b)";
    case harmonic_mean:
      return "2 a b/(a + b)";
  }
  return "";
}

const std::vector<EngineRules>& engine_rules() {
  static const std::vector<EngineRules> rules = {
      {"bullet", product, product, "btManifoldResult; clamped to 10"},
      {"dart", minimum, product, "constraint/ContactConstraint.cpp"},
      {"jolt", geometric_mean, maximum, "ContactConstraintManager; or a program's own"},
      {"mujoco", maximum, std::nullopt, "Contact parameters; or by priority"},
      {"physx", average, average, "PxCombineMode; or a material's stronger one"},
      {"rapier", average, average, "CoefficientCombineRule; or a stronger one"},
      {"simbody", harmonic_mean, std::nullopt, "HuntCrossleyForce.h"},
  };
  return rules;
}

}  // namespace slipcheck
