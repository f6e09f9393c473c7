#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "physics/sphere.h"

namespace slipcheck::simbody {

/// A contact as HuntCrossleyForce has it, both surfaces alike.
struct HuntCrossley {
  double modulus = 0;      ///< plane-strain E* of each surface [Pa]
  double dissipation = 0;  ///< c [s/m]
  double static_friction = 0, dynamic_friction = 0;
};

enum class IntegratorKind { runge_kutta_merson, runge_kutta_3, verlet, cpodes };

/// A half-space or a ball beside the ground, at rest or of constant velocity.
struct SurfacePlan {
  bool is_ball = false;
  double radius = 0;                                           ///< of a ball [m]
  Vector3 place = Vector3::Zero(), normal = Vector3::UnitZ();  ///< at the start [m]; out of it
  Vector3 velocity = Vector3::Zero();                          ///< [m/s]
};

/// What a system is made of.
struct SystemPlan {
  std::vector<Sphere> bodies;
  std::vector<BodyState> states;
  bool has_substrate = true;
  std::vector<HuntCrossley> on_substrate;  ///< by body
  std::vector<SurfacePlan> surfaces;
  std::vector<HuntCrossley> on_surfaces;  ///< by body × surface
  std::vector<HuntCrossley> pairs;        ///< of bodies i < j, in the order of i, then of j
  Vector3 gravity = Vector3::Zero();      ///< [m/s²]
  /// Of the plane that the world is seen from, since the start [m/s²]; empty: none.
  std::function<Vector3(double time)> plane_acceleration;
  double transition_velocity = 0;  ///< [m/s]
  IntegratorKind integrator = IntegratorKind::runge_kutta_merson;
  double accuracy = 0;
  bool interpolate = true;
};

/// One system of Simbody's: free spheres, the ground below them, surfaces beside it, and a set of
/// contacts of its own for each two, so that every pair has the coefficients that the scene states.
/// All that includes Simbody, whose headers are C++17, is behind this.
class System {
 public:
  explicit System(const SystemPlan& plan);
  ~System();

  /// To this time since the start [s]. Throws std::exception where no step is small enough.
  void advance_to(double time);
  std::vector<BodyState> states() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::simbody
