#pragma once

#include <string>
#include <vector>

#include "scenario/hard_scene.h"
#include "scenario/obstacles.h"

namespace slipcheck {

/// Bodies that all contacts treat alike. Where a force depends on radius, mass or shape, bodies of
/// one material fall into several classes.
struct BodyClass {
  std::string material;
  Sphere sphere;  ///< of its first body
};

/// A scene on a substrate with everything but what happens between bodies.
struct SceneOutline {
  HardScene scene;                 ///< `material` holds classes; `pairs` are as by default
  std::vector<BodyClass> classes;  ///< by class
};

/// Notes what surroundings no solver knows: containers and periodic cells.
void look_at_surroundings(const Scenario& scenario, Obstacles& obstacles);

/// For a scenario without such obstacles.
SceneOutline make_outline(const Scenario& scenario);

/// The contact between two materials, in whichever order the file names them, or null.
const BodyContact* find_contact(const Scenario& scenario, const std::string& first,
                                const std::string& second);

/// Whether the contact's forces or restitution depend on the bodies' radius, mass or shape.
bool depends_on_bodies(const BodyContact& contact);

}  // namespace slipcheck
