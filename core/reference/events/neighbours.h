#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/sphere.h"
#include "reference/events/cell_grid.h"
#include "scene/scene.h"

namespace slipcheck {

/// Few bodies on an unbounded plane: everybody is near everybody.
class AllPairs {
 public:
  static constexpr bool kHasCells = false;

  AllPairs(const Scene&, std::span<const BodyState> initial) : n_(initial.size()) {}

  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    for (std::uint32_t j = 0; j < n_; ++j)
      if (j != i) f(j, CellGrid::Shift{});
  }
  template <class F>
  void for_each_newly_near(std::uint32_t, F) const {}

 private:
  std::size_t n_;
};

/// Many bodies on a plane, which may repeat itself: those in the cells around are near.
///
/// A body's path is kept in coordinates of its own: those of the period in which the path began, so
/// that no digits are lost to a gas that wanders far. From there `origin` periods lead to the
/// unfolded position, and the body's present cell lies `image` periods further.
class PlaneCells {
 public:
  static constexpr bool kHasCells = true;

  PlaneCells(const Scene& scene, std::span<const BodyState> initial);

  /// A new path of body i begins at `position`, given in the coordinates of the one before, or
  /// unfolded for the first: into the coordinates of the new one.
  void start_path(std::uint32_t i, Vector3& position) {
    Place& place = places_[i];
    position.x() -= place.image_x * grid_.period().x;
    position.y() -= place.image_y * grid_.period().y;
    place.ix -= place.image_x * static_cast<std::int32_t>(grid_.cells_x());
    place.iy -= place.image_y * static_cast<std::int32_t>(grid_.cells_y());
    place.origin_x += place.image_x;
    place.origin_y += place.image_y;
    place.image_x = place.image_y = 0;
  }
  /// From a path's coordinates to the unfolded ones.
  void unfold(std::uint32_t i, Vector3& position) const {
    position.x() += places_[i].origin_x * grid_.period().x;
    position.y() += places_[i].origin_y * grid_.period().y;
  }

  /// In what time [s] a body at x [m] with velocity v and acceleration a leaves its cell through
  /// the side that cross() will take, or infinity.
  double time_to_leave(std::uint32_t i, const Vector3& x, const Vector3& v, const Vector3& a);
  /// The same for a path with an acceleration of at most `bound` [m/s²]: a time before which it
  /// does not. Whether it then has is for is_at_side() to say; if not, ask again.
  double least_time_to_leave(std::uint32_t i, const Vector3& x, const Vector3& v, double bound);
  /// That the body has come to the side that was found last.
  bool is_at_side(std::uint32_t i, const Vector3& x) const;
  void cross(std::uint32_t i);

  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    grid_.for_each_near(
        i, [&](std::uint32_t j, CellGrid::Shift shift) { f(j, between_paths(i, j, shift)); });
  }
  /// After cross(i).
  template <class F>
  void for_each_newly_near(std::uint32_t i, F f) const {
    grid_.for_each_newly_near(i, moved_x_, moved_y_, [&](std::uint32_t j, CellGrid::Shift shift) {
      f(j, between_paths(i, j, shift));
    });
  }
  /// What to add to a position on the path of j so that it is next to x_i on the path of i.
  CellGrid::Shift nearest_image(const Vector3& x_i, const Vector3& x_j) const;

 private:
  struct Place {
    std::int32_t ix = 0, iy = 0;  ///< cell, in the coordinates of the path
    std::int32_t image_x = 0, image_y = 0;
    std::int32_t origin_x = 0, origin_y = 0;
    std::int8_t leaves_x = 0, leaves_y = 0;  ///< −1, 0, 1: the side that cross() takes
  };

  CellGrid::Shift between_paths(std::uint32_t i, std::uint32_t j, CellGrid::Shift shift) const {
    shift.x += (places_[i].image_x - places_[j].image_x) * grid_.period().x;
    shift.y += (places_[i].image_y - places_[j].image_y) * grid_.period().y;
    return shift;
  }
  /// Calls visit(dx, dy, distance, v, a) for the four sides: how far it lies, and the components of
  /// velocity and acceleration towards it.
  template <class Visit>
  void for_each_side(const Place& place, const Vector3& x, const Vector3& v, const Vector3& a,
                     Visit visit) const;

  CellGrid grid_;
  std::vector<Place> places_;
  int moved_x_ = 0, moved_y_ = 0;
};

}  // namespace slipcheck
