#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "physics/vector.h"

namespace slipcheck {

/// A sphere that goes straight on.
struct StraightSphere {
  Vector3 position = Vector3::Zero();  ///< [m]
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
  double radius = 0;                   ///< [m], > 0
};

/// Which of many spheres on an unbounded plane meet first, and whether any do. Boxes around places
/// and velocities of groups tell which groups never come near each other: of spheres that fly apart
/// hardly any two are looked at, where cells would be crossed without end.
class MeetingTree {
 public:
  /// may_stop: on their ways they may become slower, down to rest.
  MeetingTree(std::span<const StraightSphere> spheres, bool may_stop);

  /// When two of these touch [s], looked for within a horizon [s], or infinity.
  using PairTime = std::function<double(std::size_t i, std::size_t j, double horizon)>;

  /// The first of these times before `limit` [s], which may be infinite, or infinity. Asks for
  /// pairs i < j that may touch.
  double first(double limit, const PairTime& time_of) const;

 private:
  struct Box {
    Vector3 low, high;         // of places [m]
    Vector3 slowest, fastest;  // of velocities [m/s]
    double radius = 0;         // the largest [m]
    std::uint32_t begin, end;  // in order_
    std::uint32_t left = 0;    // the other half comes at `right`; 0: none
    std::uint32_t right = 0;
  };

  std::uint32_t add(std::span<const StraightSphere> spheres, bool may_stop, std::uint32_t begin,
                    std::uint32_t end);
  static bool may_meet(const Box& a, const Box& b, double horizon);
  void look(std::uint32_t a, std::uint32_t b, const PairTime& time_of, double& horizon) const;

  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;
  double first_look_ = 0;  ///< [s]: in which the fastest comes to its neighbours
};

}  // namespace slipcheck
