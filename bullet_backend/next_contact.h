#pragma once

#include "bullet_backend/balls.h"
#include "bullet_backend/near_pairs.h"
#include "bullet_backend/periodic_cell.h"
#include "bullet_backend/surfaces.h"

namespace slipcheck::bullet {

/// When two balls, or a ball and a surface, will touch if all go on as they are: in straight lines,
/// those in flight towards a surface with the velocities that gravity gives them in the step, as
/// Bullet's semi-implicit integration does.
class NextContact {
 public:
  /// To within `tolerance` of length, > 0. All but `units` must outlive this.
  NextContact(const Balls& balls, const Surfaces& surfaces, const Scene& scene,
              const WorldUnits& units, const PeriodicCell& cell, double tolerance);

  /// Time after `now` until the first contact that is not there yet, at most `within`, > 0, or
  /// `within` where there is none; 0 where bodies touch and still approach each other. A surface
  /// that swings is met early rather than late: a look from there finds the rest.
  double after(double now, double within);

 private:
  /// Whether bodies that touch meet in earnest, and do not just lean on each other.
  bool touches_now(double approach, double within) const;
  double of_surfaces(double now, double within) const;
  double of_surface(const SurfaceBody& surface, std::size_t body, double now, double within) const;
  double of_pairs(double within);
  double of_balls(const BodyState& a, const BodyState& b, double reach, double within) const;

  const Balls& balls_;
  const Surfaces& surfaces_;
  const Scene& scene_;
  Vector3 gravity_;
  double tolerance_;
  std::vector<BodyState> states_;
  const PeriodicCell& cell_;
  NearPairs near_;
};

}  // namespace slipcheck::bullet
