#pragma once

#include <vector>

#include "figures/box_runs.h"
#include "harness/observe/box_observer.h"

namespace slipcheck {

// L's box twice: from event to event with hard contacts (PlanarSolver), and with contacts of spring
// and dashpot that last t_col (SoftBoxSolver), L Sec. I and App. B. All contacts are alike.

inline constexpr double kConvergenceRestitution = 0.9;  ///< e
inline constexpr double kConvergenceFriction = 0.2;     ///< μ, with β0 = 0
inline constexpr double kTrajectoryTime = 16e-3;        ///< [s]

/// How far both are apart after kTrajectoryTime, the most of all spheres, for each t_col.
struct TrajectoriesApart {
  std::vector<double> position;  ///< [m]
  std::vector<double> velocity;  ///< [m/s]
  std::vector<double> surface;   ///< R Δω [m/s]
};

/// Six spheres over a floor with V = 0.3 m/s that meet each other 3 times and floor and walls 7
/// times; with the friction μ >= 0, for each of the collision times t_col [s], > 0.
/// Throws std::runtime_error where a run does not come to its end; so do the other two.
TrajectoriesApart trajectories_apart(double friction, const std::vector<double>& collision_times);

/// Twenty spheres in L's box, V = 1 m/s.
VibratedBox dilute_box();

struct EventMeans {
  BoxObservables seen;
  double between = 0;  ///< t_E, mean time between two collisions of a sphere, with whatever [s]
};

/// The dilute box from event to event, 40 000 periods.
EventMeans dilute_box_by_events();
/// With contacts that last t_col [s], > 0; 2000 periods.
BoxObservables dilute_box_by_contacts(double collision_time);

}  // namespace slipcheck
