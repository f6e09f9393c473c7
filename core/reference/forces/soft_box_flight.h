#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reference/forces/soft_box_dynamics.h"

namespace slipcheck {

/// The bodies of a box that touch nothing, on their exact parabolas, and who can touch whom soon.
///
/// Near are those within a skin of each other. Until valid_until() no others can meet: no body
/// moves further than half the skin while covers() holds for all, which the user sees to.
class SoftBoxFlight {
 public:
  struct Near {
    std::size_t first = 0, partner = 0;  ///< as of SoftTouch
    bool touching = false;
    double meeting = 0;  ///< when they do if both fly till then [s]; infinite: not while valid
  };

  /// Both must outlive this.
  explicit SoftBoxFlight(const SoftBoxDynamics& dynamics);

  bool is_flying(std::size_t i) const { return flights_[i].flies; }
  PlanarMotion at(std::size_t i, double t) const;
  void release(std::size_t i, double t, const PlanarMotion& motion);
  void stop(std::size_t i);

  /// Lists who is near at the time t; `bodies`: all of them then.
  void list(double t, std::span<const PlanarMotion> bodies);
  double valid_until() const { return valid_until_; }  ///< [s]
  /// Whether a body this fast [m/s] now keeps the list valid.
  bool covers(double speed) const { return speed < 0.75 * fastest_; }

  /// Sorted by first and partner.
  const std::vector<Near>& near() const { return near_; }
  /// The near pair, which must be listed.
  Near& find(std::size_t first, std::size_t partner);
  /// The earliest meeting of bodies that fly, or null; of those near, from the time t on.
  const Near* next_meeting(double t);

 private:
  struct Flight {
    PlanarMotion start;
    double time = 0;
    bool flies = true;
    bool is_new = true;  ///< no meetings found yet
  };

  double pair_meeting(double t, std::size_t i, std::size_t j) const;
  double surface_meeting(double t, std::size_t i, std::size_t surface) const;

  const SoftBoxDynamics* dynamics_;
  std::vector<Flight> flights_;
  std::vector<std::size_t> order_;  ///< bodies along the axis that was swept last
  std::vector<Near> near_;
  double skin_ = 0, valid_until_ = 0, fastest_ = 0, largest_radius_ = 0;
  bool is_stale_ = true;  ///< next_ is
  const Near* next_ = nullptr;
};

}  // namespace slipcheck
