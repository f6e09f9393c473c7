#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "scene/contact_scene.h"

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
  /// By row of `scene.pairs`, bodies that stand for all of it: its class or, where each two bodies
  /// have a contact of their own, the first and those of the least and the largest radius and mass.
  std::vector<std::vector<BodyClass>> rows;
};

/// most_in_table: as of make_contact_scene(). Throws Unsupported where hard contacts depend on the
/// bodies and those fall into too many classes.
SceneOutline make_outline(const Scenario& scenario, std::size_t most_in_table = kMostInTable);

/// Whether each two bodies have a soft contact of their own, in more classes than a table holds.
bool has_own_contacts(const Scenario& scenario, std::size_t most_in_table = kMostInTable);

/// Of a class on a surface, from a contact of the substrate's form and from one of a pair's.
SurfaceContact surface_contact(const MaterialOnSubstrate& from, const Material& material,
                               const Sphere& sphere, double gravity);
SurfaceContact surface_contact(const PairContact& impact);

/// The pair contact of a normal model `hard`; a restitution `viscoelastic` is left at 1.
PairContact hard_pair(const BodyContact& contact);

}  // namespace slipcheck
