#pragma once

#include <vector>

#include "engine/engine.h"

namespace slipcheck::bullet {

enum class BodyKind {
  rigid,      ///< btRigidBody
  multibody,  ///< btMultiBody without links: no other friction than a cone is isotropic in Bullet
};

enum class SolverKind { sequential_impulse, nncg, dantzig, pgs, lemke };

/// How a scene's coefficients get into Bullet.
enum class CoefficientMap {
  fields,         ///< straight into the bodies' fields, combined by Bullet's own rules
  pair,           ///< exact maps, pair by pair, through the combine callbacks
  pair_and_slip,  ///< likewise, and told apart by whether the contact slips
};

/// What tilts: the gravity over a level plane, or the plane under a vertical gravity.
enum class Tilt { gravity, plane };

/// What Bullet is told of the velocity of what moves by itself.
enum class SurfaceVelocity {
  step_before,  ///< mean over the step before: what a motion state gives
  this_step,    ///< mean over the step that begins
  step_end,     ///< at the end of the step that begins
};

enum class BeyondReach { tell, refuse };

/// Everything that a profile can choose; the values here are Bullet's own, but for the last
/// three, which change none of its results. Meaning, unit and range
/// stand once, in setting_table(). Lengths, times and masses are Bullet's, which differ from SI
/// where the profile scales them (world_units.h).
struct BulletSettings {
  BodyKind body = BodyKind::rigid;
  CoefficientMap coefficients = CoefficientMap::pair;
  double friction_factor = 1, restitution_factor = 1, rolling_friction_factor = 1,
         spinning_friction_factor = 1;

  SolverKind solver = SolverKind::sequential_impulse;
  int solver_iterations = 10;
  double sor = 1, residual_threshold = 0;
  bool warm_starting = true;
  double warm_starting_factor = 0.85;
  bool articulated_warm_starting = false;
  bool two_friction_directions = false, velocity_dependent_friction = true,
       friction_direction_caching = false, friction_cone = true, interleave_friction = false,
       randomize_order = false;
  int minimum_batch_size = 128;

  double erp2 = 0.2, global_cfm = 0, friction_cfm = 0, friction_erp = 0.2;
  bool friction_anchor = false;
  bool split_impulse = true;
  double split_impulse_threshold = -0.04, split_impulse_turn_erp = 0.1;
  double linear_slop = 0, restitution_velocity_threshold = 0.2;
  double contact_processing_threshold = 1e18, breaking_threshold = 0.02;
  bool relative_breaking_threshold = true;
  double contact_stiffness = 0, contact_damping = 0;

  double ccd_motion_threshold = 0, ccd_swept_radius = 0;
  bool ccd = true, speculative_restitution = false;

  bool sleeping = true;
  double sleeping_time = 2, linear_sleeping_threshold = 0.8, angular_sleeping_threshold = 1,
         multibody_sleeping_threshold = 0.05;
  double linear_damping = 0, angular_damping = 0, multibody_linear_damping = 0.04,
         multibody_angular_damping = 0.04;
  double multibody_velocity_limit = 100;

  int substeps = 1, splits_at_contacts = 0;
  double reach = 0;
  BeyondReach beyond_reach = BeyondReach::tell;

  double scale_radius_to = 0, scale_mass_to = 0, scale_gravity_to = 0;
  Tilt tilt = Tilt::gravity;
  SurfaceVelocity surface_velocity = SurfaceVelocity::step_before;
  bool flush_denormals = true, update_all_aabbs = true, leaves_out = true;
};

/// What this engine takes.
const std::vector<SettingInfo>& setting_table();

/// `chosen` names only settings of the table, with values of their types and in their ranges.
BulletSettings read_settings(const Settings& chosen);

/// All of them, by name.
Settings write_settings(const BulletSettings& settings);

}  // namespace slipcheck::bullet
