#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/engine_scene.h"
#include "peer_backends/lammps/lammps_settings.h"

namespace slipcheck::lammps {

/// A contact as LAMMPS has it, linear or of Hertz's shape, all in SI.
struct Spring {
  bool hertz = false;
  double stiffness = 0;         ///< k [N/m], or ρ [N/m^1.5]
  double damping = 0;           ///< of ξ̇ [N s/m], or of √ξ ξ̇ [N s/m^1.5]
  double tangential = 0;        ///< of the slip, below Coulomb's cap [N s/m]
  double friction = 0;          ///< [-]
  bool never_attracts = false;  ///< LAMMPS's limit_damping
  /// A spring that remembers the slip beside that damping: k_t [N/m], or of Mindlin k_t/√ξ
  /// [N/m^1.5]; 0: none.
  double shear = 0;
  SpringFriction::Form shear_form = SpringFriction::Form::constant;
  /// Of a Hertz contact with damping: that of the slip over it, in place of `tangential` [-].
  double tangential_ratio = 0;
  SpringTorque rolling = {}, drilling = {};  ///< with a length of 0 where there is none
  /// e in place of `damping`, for LAMMPS's damping model `tsuji`.
  std::optional<double> tsuji_restitution = {};
  double mass = 0;              ///< reduced [kg]
  double effective_radius = 0;  ///< R_i R_j/(R_i + R_j), R on the substrate [m]
};

/// Bodies that LAMMPS's coefficients do not tell apart: an atom type of its own each.
struct AtomTypes {
  std::vector<std::size_t> of_body;     ///< from 0 on
  std::vector<std::size_t> first_body;  ///< of each type
};
AtomTypes atom_types(const Scene& scene);

/// The spring of two bodies: the scene's soft contact, or one that has the hard contact's
/// restitution in the settings' collision time. Throws Refused for a law that LAMMPS has not.
Spring pair_spring(const EngineScene& scene, std::size_t i, std::size_t j,
                   const LammpsSettings& settings);
/// That of a body and the substrate. Throws Refused.
Spring substrate_spring(const EngineScene& scene, std::size_t body, const LammpsSettings& settings);

/// That of a body and surface k beside the substrate: its soft contact, or one in place of the hard
/// one. Throws Refused.
Spring surface_spring(const EngineScene& scene, std::size_t body, std::size_t k,
                      const LammpsSettings& settings);

/// Hard contacts and those with the substrate hold by a spring, not by damping alone: a scene whose
/// contacts remember rests on what holds.
bool holds_by_springs(const EngineScene& scene, const LammpsSettings& settings);

/// How long an elastic collision takes [s], of a Hertz contact at the relative speed [m/s].
double collision_time(const Spring& spring, double speed);

/// The fastest approach of two bodies by the velocities at the start, or 1 mm/s [m/s]; of more than
/// 2000 bodies twice the fastest one's velocity beside the mean, which no two exceed.
double approach_speed(const Scene& scene);

}  // namespace slipcheck::lammps
