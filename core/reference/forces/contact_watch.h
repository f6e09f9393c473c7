#pragma once

#include <cstddef>
#include <vector>

#include "reference/forces/contact_state.h"

namespace slipcheck {

/// What ends the present modes: functions of the state whose roots the integrator stops at.
class ContactWatch {
 public:
  enum class What {
    landing,        ///< a body comes down
    lift_off,       ///< the substrate's normal force is gone
    slip_end,       ///< u, or with coupled drilling u and Ω_z together, comes to zero
    slip_dies_out,  ///< a coupled slip ceases to count; changes no mode
    slip_develops,  ///< a slip that has begun has its own direction
    slip_begin,     ///< static friction gives way
    roll_end,
    roll_begin,
    roll_kink,  ///< a corner of μ_r over the speed
    spin_end,
    spin_begin,
    contact_end,
    force_end,         ///< zero_force: F_N falls to zero
    force_begin,       ///< and rises again
    greatest_overlap,  ///< changes no mode
    edge,              ///< of the tangential law
  };
  struct Item {
    What what;
    std::size_t index;                          ///< of the body or the contact
    double value = 0;                           ///< of what the function measures from
    TangentialEdge edge = TangentialEdge::cap;  ///< where `what` is one
  };

  /// The functions of the present modes.
  explicit ContactWatch(const ContactState& state);

  const std::vector<Item>& items() const { return items_; }
  const std::vector<int>& directions() const { return directions_; }
  void values(const ContactState& state, double t, const double* y,
              ContactDynamics::Evaluation& scratch, double* value) const;

 private:
  void watch_body(const ContactState& state, std::size_t i);
  void watch_contact(const ContactState& state, std::size_t index);
  void add(What what, std::size_t index, int direction, double value = 0) {
    items_.push_back({what, index, value, {}});
    directions_.push_back(direction);
  }

  std::vector<Item> items_;
  std::vector<int> directions_;
};

}  // namespace slipcheck
