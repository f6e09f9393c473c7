#pragma once

#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck::peer {

/// What stands in the place of a body's index where a ball touches no other ball: the substrate or
/// the floor of a box, either of its walls, its lid. Where there is no box, what is below
/// kSubstrate is a surface_touch().
inline constexpr int kFloor = kSubstrate, kWall = -2, kLid = -3;

/// The numbers of a contact in the terms that most engines share.
struct ContactValues {
  double friction = 0;     ///< μ [-], >= 0
  double restitution = 0;  ///< e [-], in [0, 1]
  double rolling = 0;      ///< torque in the plane of contact per normal force [m], >= 0
  double drilling = 0;     ///< torque about the normal per normal force [m], >= 0
};

/// How the two move when an engine asks for the numbers of their contact.
struct ContactMotion {
  double approach = 0;  ///< normal speed of approach [m/s], >= 0
  double speed = 0;     ///< of the body over the substrate [m/s], >= 0
  /// Friction does not stop the slip in this step. A contact that does not slip has its static
  /// friction, and rolling friction that a sliding body is to be spared.
  bool slips = true;
};

/// Whether an adapter tells contacts that slip from those that do not.
enum class SlipRule { ignored, told_apart };

/// What the scene says of a body and another, kFloor, kWall, kLid, or a surface.
///
/// K (16): a rolling sphere slows down with μ_r g. With a torque ρ m g it slows down with
/// ρ g/((1 + q) R), q = I/(m R²), hence ρ = (1 + q) μ_r R. A contact of β0 = −1 keeps its slip: no
/// friction.
ContactValues exact_values(const Scene& scene, int body, int other, const ContactMotion& motion,
                           SlipRule rule = SlipRule::ignored);

/// What people type: the scene's numbers as they stand, a length's place taken by μ_r; a law of
/// restitution at the speed at which the two start relative to each other, or at its reference
/// speed.
ContactValues typed_values(const Scene& scene, int body, int other);

/// The slip that the friction of the substrate or a surface stops in a step [m/s]:
/// (1 + 1/q) μ_k g dt, with g the gravity onto it [m/s²].
double slip_stopped_in(const Scene& scene, int body, int other, double onto, double time_step);

/// Of a body on the substrate or a surface; null elsewhere.
const SubstrateContact* lasting_contact(const Scene& scene, int body, int other);

/// The contact of a body with another, with a box's surface or with one beside the substrate.
const PairContact& pair_contact(const Scene& scene, int body, int other);

}  // namespace slipcheck::peer
