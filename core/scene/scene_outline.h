#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "scene/scene.h"

namespace slipcheck {

/// Bodies that all contacts treat alike. Where a force depends on radius, mass or shape, bodies of
/// one material fall into several classes.
struct BodyClass {
  std::string material;
  Sphere sphere;  ///< of its first body
};

/// A scene with everything but what happens between bodies and at the surfaces of a box.
struct SceneOutline {
  /// `material` holds classes; `pairs` and a box's contacts are as by default. In a box the
  /// substrate's contacts are too, one for each class.
  Scene scene;
  std::vector<BodyClass> classes;  ///< by class
};

SceneOutline make_outline(const Scenario& scenario);

/// Of a class on a surface, from a contact of the substrate's form and from one of a pair's.
SurfaceContact surface_contact(const MaterialOnSubstrate& from, const Material& material,
                               const Sphere& sphere, double gravity);
SurfaceContact surface_contact(const PairContact& impact);

/// The pair contact of a normal model `hard`; a restitution `viscoelastic` is left at 1.
PairContact hard_pair(const BodyContact& contact);

}  // namespace slipcheck
