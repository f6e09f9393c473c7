#pragma once

#include <string>

#include "scene/contact_scene.h"

namespace slipcheck {

/// What is usual in a scene: the measure of what is zero by its symmetry.
struct NaturalScales {
  double speed = 0;  ///< [m/s], >= 0
  double large = 0;  ///< the largest radius [m]
  double small = 0;  ///< the smallest radius [m]
  double mass = 0;   ///< the largest [kg]
  double time = 0;   ///< of the run [s]

  /// The scale of an observable (a full name), in its unit.
  double of(const std::string& full_name) const;
  /// Whether a difference in an observable is no more than what rounding leaves, 1e-9 of its scale.
  bool is_rounding(const std::string& full_name, double difference) const;
};

/// Of a scene; the time is for who runs it to say.
NaturalScales natural_scales(const ContactScene& scene);

}  // namespace slipcheck
