#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.h"
#include "scene/scene.h"

namespace slipcheck {

/// What a scene needs of an engine, each found on any of its bodies: on the substrate, between two
/// bodies, on the surfaces of a box, or on those beside the substrate.
struct SceneNeeds {
  bool friction = false;
  bool static_friction = false;  ///< other than kinetic
  bool friction_law = false;     ///< between bodies, depends on the speed of slip
  bool drilling = false, coupled_drilling = false;
  bool rolling = false;
  bool rolling_table = false;  ///< depends on the speed
  bool rolling_only = false;   ///< rolling friction that does not act on a sliding body
  bool bounce = false;
  bool bounce_law = false;     ///< restitution depends on the impact speed
  bool reversed_slip = false;  ///< β0 other than −1 (slip is kept) and 0 (just stopped)
  bool moving_substrate = false, moving_floor = false;
  bool swinging_surface = false;   ///< beside the substrate, with a velocity that changes
  bool far_in_a_step = false;      ///< bodies in a box may pass each other within a step
  bool through_in_a_step = false;  ///< a body's centre may pass a plate within a step
};

/// Of a scene in SI with steps of `time_step` [s], > 0.
SceneNeeds needs_of(const Scene& scene, double time_step);

/// The first two bodies for each two materials, or one material, of which there are two: they stand
/// for all contacts between balls.
std::vector<std::pair<std::size_t, std::size_t>> material_pairs(const Scene& scene);

/// How fast the surfaces of two bodies slip on each other where they meet if both go straight on
/// from the start, with the spins that they have there; their relative speed where they do not
/// meet. Where an engine takes one number in place of a law, it is that at this speed [m/s].
double slip_at_meeting(const Scene& scene, std::size_t i, std::size_t j);
/// The scene with numbers in place of laws of friction between bodies, at slip_at_meeting() of the
/// first two bodies of each two materials, and on the surfaces of a box at the speed at the start.
Scene with_friction_numbers(Scene scene);
/// The shapes of its bodies that are no spheres, in words of `scene_part`.
std::vector<std::string> shapes_of(const Scene& scene);

/// Parts of a scene that not every engine takes; none that does not say so is given one.
namespace scene_part {
inline constexpr const char* kFrictionLaw = "friction_law";  ///< of pairs, over the speed of slip
inline constexpr const char* kBlock = "block";
inline constexpr const char* kCylinder = "cylinder";
/// Of spheres alone: the request `skip`, bodies that are packed, longer messages.
inline constexpr const char* kMany = "many";
inline constexpr const char* kSurfaces = "surfaces";  ///< beside the substrate, or without one
inline constexpr const char* kMemory = "memory";      ///< springs of contacts that remember
}  // namespace scene_part

/// What of a scene an engine cannot express, in words that are the same for all engines, so that
/// what they lack can be counted.
namespace lack {
inline constexpr const char* kStaticFriction = "static friction";
inline constexpr const char* kRolling = "rolling friction";
inline constexpr const char* kDrilling = "drilling friction";
inline constexpr const char* kRollingAndDrilling = "rolling and drilling friction";
inline constexpr const char* kCoupledDrilling = "coupled drilling";
inline constexpr const char* kRollingOnly = "rolling friction only while rolling";
inline constexpr const char* kRollingHeadings = "rolling friction alike in all headings";
inline constexpr const char* kFrictionHeadings = "friction alike in all headings";
inline constexpr const char* kRollingTable = "rolling friction that depends on the speed";
inline constexpr const char* kRestitution = "restitution";
inline constexpr const char* kRestitutionLaw = "restitution that depends on the impact speed";
inline constexpr const char* kTangentialRestitution = "tangential restitution";
inline constexpr const char* kFrictionLaw = "friction between bodies that depends on the slip";
inline constexpr const char* kMemory = "contacts that remember";
inline constexpr const char* kConfinement = "confinement to the plane";
inline constexpr const char* kFloorVelocity = "the floor's velocity at the contact";
inline constexpr const char* kSubstrateVelocity = "the substrate's velocity at the end of a step";
inline constexpr const char* kSurfaceVelocity = "a surface's velocity at the end of a step";
inline constexpr const char* kThrough = "plates that a body passes within a step";
inline constexpr const char* kPassing = "collisions of bodies that pass each other within a step";
}  // namespace lack

/// A list of them, in the order in which they are noted.
class LackList {
 public:
  /// Where `condition` holds: `kind` and, where there is one, `why` in brackets.
  void note(bool condition, const char* kind, const char* why = nullptr);
  /// Nothing bounces below `threshold` [m/s]; nothing is lacking where it is 0.
  void note_threshold(bool condition, double threshold);
  void add(Lack lack) { lacks_.push_back(std::move(lack)); }

  std::vector<Lack> take() { return std::move(lacks_); }

 private:
  std::vector<Lack> lacks_;
};

}  // namespace slipcheck
