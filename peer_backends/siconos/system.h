#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "physics/sphere.h"

namespace slipcheck::siconos {

/// What Siconos's nonsmooth laws take for a contact.
struct ImpactLaw {
  double restitution = 0;             ///< e_n
  double tangential_restitution = 0;  ///< e_t, >= 0
  double friction = 0;                ///< μ
  double rolling_length = 0;          ///< largest rolling torque per normal force [m]
};

enum class Solver { nsgs, admm };

/// The place of a surface that is nearest to a point.
struct NearestPlace {
  Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();  ///< [m], unit, towards what asks
  double distance = 0;                                         ///< [m]
};

/// Something fixed or of constant velocity beside the plane.
struct FixedSurface {
  std::function<NearestPlace(double time, const Vector3& from)> nearest;  ///< since the start [s]
  Vector3 velocity = Vector3::Zero();                                     ///< of its matter [m/s]
};

/// Two bodies, or a body and the plane or surface k as kPlane − 1 − k, and what they exchanged
/// along their normal.
struct Impulse {
  static constexpr int kPlane = -1;
  int first = 0, second = kPlane;
  double normal = 0;  ///< [N s]
};

/// What a system is made of.
struct SystemPlan {
  std::vector<Sphere> bodies;
  std::vector<BodyState> states;
  bool has_substrate = true;
  std::vector<ImpactLaw> on_substrate;  ///< by body
  std::vector<FixedSurface> surfaces;
  std::vector<ImpactLaw> on_surfaces;           ///< by body × surface
  std::vector<std::optional<ImpactLaw>> pairs;  ///< of bodies i < j, in the order of i, then of j
  Vector3 gravity = Vector3::Zero();            ///< [m/s²]
  /// Of the plane that the world is seen from, since the start [m/s²]; empty: none.
  std::function<Vector3(double time)> plane_acceleration;
  double time_step = 0;  ///< [s]
  bool rolls = false;    ///< all contacts have five dimensions: a torque beside the force
  double theta = 0.5;
  Solver solver = Solver::nsgs;
  double tolerance = 0;
  int iterations = 0;
  double newton_tolerance = 0;
  double activation_threshold = 0;  ///< [m]
};

/// One nonsmooth system of Siconos's: spheres, the plane z = 0, and surfaces beside it. All that
/// includes Siconos, whose headers are C++17 at most, is behind this.
class System {
 public:
  explicit System(const SystemPlan& plan);
  ~System();

  /// One step of Moreau and Jean's scheme.
  void step();
  std::vector<BodyState> states() const;
  /// Those of the last step, > 0.
  const std::vector<Impulse>& impulses() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::siconos
