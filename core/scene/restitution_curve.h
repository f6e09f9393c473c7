#pragma once

#include <vector>

#include "physics/contact/hard_contact.h"
#include "scene/scaled_impact.h"

namespace slipcheck {

/// e over D for one scaled law, from integrated collisions. As e depends on D alone, one curve
/// serves all pairs and speeds of a law.
class RestitutionCurve {
 public:
  RestitutionCurve(const ScaledLaw& law, ContactEnd end) : law_(law), end_(end) {}

  /// e over the impact speed for a pair that collides at 1 m/s with this D [-], >= 0; to 1e-6 at
  /// all speeds where e is smooth in D. A number where D is 0 or does not depend on the speed.
  RestitutionLaw over_speed(double D);

 private:
  void tabulate();

  ScaledLaw law_;
  ContactEnd end_;
  std::vector<double> log_odds_, slope_;  // over ln D, made when first needed
};

}  // namespace slipcheck
