#pragma once

#include <cstddef>
#include <vector>

#include "reference/forces/soft_box_dynamics.h"
#include "reference/forces/soft_box_flight.h"

namespace slipcheck {

/// What may end a step of resolved contacts before its length: functions of the state that are
/// positive while all stays as it is.
class SoftBoxWatch {
 public:
  enum class What {
    begin,  ///< two that are near touch
    end,    ///< ξ falls to zero
    force,  ///< zero_force: F_N falls to zero, or rises again
    edge,   ///< of the tangential law
  };
  struct Item {
    What what;
    std::size_t index;         ///< of the touch; begin: of the near
    double low = 0;            ///< value where nothing has happened yet
    double high = 0;           ///< value at the end of the shortest step in which something has
    double now = 0;            ///< value at the end of the last step tried
    double turn = 1;           ///< sign with which an edge is watched: −1 where it rises
    bool can_be_found = true;  ///< it was positive at first
    TangentialEdge edge = TangentialEdge::cap;  ///< where `what` is one
    /// Of the force of a viscous law, which follows it by itself: it shifts the result by the
    /// square of what it is missed by, anything else by that.
    bool is_corner = false;
  };

  std::vector<Item> items;

  /// What to watch from the state with these rates on.
  void begin(const SoftBoxDynamics& dynamics, const SoftBoxDynamics::State& state,
             const SoftBoxDynamics::Rates& now);
  /// Sets `now` of all items but those of bodies that begin to touch.
  void look(const SoftBoxDynamics& dynamics, const SoftBoxDynamics::State& state,
            const SoftBoxDynamics::Rates& then);

 private:
  static double value(const Item& item, const SoftTouch& touch,
                      const SoftBoxDynamics::Forces& forces, double bend);
};

}  // namespace slipcheck
