#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck {

using Matrix3 = Eigen::Matrix3d;

/// What many spheres are as a whole at one instant, from their states and the laws of their soft
/// contacts alone, whoever computed them.
struct AssemblyState {
  double height = 0;             ///< of the centre of mass over z = 0 [m]
  double kinetic_energy = 0;     ///< of translation, all bodies together [J]
  double rotational_energy = 0;  ///< [J]
  double weight_energy = 0;      ///< of gravity and tilt, zero at the origin [J]
  double elastic_energy = 0;     ///< of the normal springs between bodies [J]
  std::size_t contacts = 0;      ///< of two bodies: they overlap
  /// Contacts of a body on the average, 2 N_c/N [-].
  double coordination = 0;
  /// The same without rattlers, bodies with less than two contacts [-]; 0 where all are.
  double coordination_of_carried = 0;
  /// Of the normal forces and of the motion, compression positive [Pa], over the box of region():
  ///   σ_ab = (1/V) [Σ_c F_a l_b + Σ_i m_i δv_a δv_b]
  /// with the normal force F on the first of two and l from the second's centre to its own (J. H.
  /// Irving, J. G. Kirkwood, J. Chem. Phys. 18, 817 (1950)). Tangential forces, which contacts with
  /// memory keep to themselves, and those of walls are not in it.
  Matrix3 stress = Matrix3::Zero();
  double temperature = 0;  ///< m δv²/d, mean over the bodies, d directions [J]
  /// a_2 = d/(d+2) ⟨δv⁴⟩/⟨δv²⟩² − 1 [-]: how far speeds are from Maxwell's; 0 where nothing moves.
  double sonine = 0;

  double pressure() const { return stress.trace() / 3; }  ///< [Pa]
  /// All of these energies [J].
  double energy() const {
    return kinetic_energy + rotational_energy + weight_energy + elastic_energy;
  }
};

/// Where the bodies are.
struct AssemblyRegion {
  Vector3 low = Vector3::Zero();      ///< corner of the box around all centres, or 0 [m]
  Vector3 lengths = Vector3::Zero();  ///< of the box, or the periods [m]
  bool repeats[3] = {};               ///< a period
  /// All lie on the substrate, like in a plane: what goes with the third direction is left out.
  bool flat = false;
  double volume = 0;  ///< of the spheres' box: in directions that do not repeat a radius more [m³]

  int dimensions() const { return flat ? 2 : 3; }
  /// The pairs that N bodies, at random and independent in it, have on the average at distances
  /// from r to r + dr [m], over dr: closed forms of the set covariance of a box, for r up to
  /// longest().
  double ideal_pairs(std::size_t bodies, double r) const;
  /// Up to which distance that holds: the shortest length, and half of the shortest period [m].
  double longest() const;
};

AssemblyRegion assembly_region(const Scene& scene, std::span<const BodyState> states);

/// `scene` has no hard contact of two bodies that could meet: those have no force.
AssemblyState assembly_state(const ContactScene& scene, std::span<const BodyState> states);

/// Of the normal spring between two bodies [N] that overlap by `overlap` [m], >= 0, and come
/// together at `closing` [m/s]; never pulling where the law ends with its force.
double contact_force(const SoftContact& contact, double overlap, double closing);

}  // namespace slipcheck
