#pragma once

#include <string>
#include <vector>

#include "scenario/hard_scene.h"

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
  HardScene scene;
  std::vector<BodyClass> classes;  ///< by class
};

SceneOutline make_outline(const Scenario& scenario);

/// The contact between two materials, in whichever order the file names them, or null.
const BodyContact* find_contact(const Scenario& scenario, const std::string& first,
                                const std::string& second);

/// Whether the contact's forces or restitution depend on the bodies' radius, mass or shape.
bool depends_on_bodies(const BodyContact& contact);

}  // namespace slipcheck
