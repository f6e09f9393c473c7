#include "reference/events/neighbours.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// Part of a diameter by which cells are larger than it.
constexpr double kSpare = 1e-6;

/// Cells with about one body each, so that collisions and cell borders cost alike.
CellGrid plane_grid(const Scene& scene, std::span<const BodyState> initial) {
  const auto n = static_cast<double>(initial.size());
  double radius = 0;
  for (const Sphere& sphere : scene.bodies) radius = std::max(radius, sphere.radius);
  const double least = 2 * radius * (1 + kSpare);
  Vector2 low = initial.front().position.head<2>(), high = low;
  for (const BodyState& state : initial) {
    low = low.cwiseMin(state.position.head<2>());
    high = high.cwiseMax(state.position.head<2>());
  }
  Vector2 extent = (high - low).cwiseMax(Vector2::Constant(least));
  for (int axis : {0, 1})
    if (scene.periodic[axis] > 0) extent[axis] = scene.periodic[axis];
  const double edge = std::max(least, std::sqrt(extent.x() * extent.y() / n));
  double width[2];
  std::uint32_t cells[2];
  for (int axis : {0, 1}) {
    const double length = scene.periodic[axis];
    // The format asks for four diameters; the cells' spare may then cost the fourth cell.
    const double count = length > 0 ? std::min(length / edge, 4096.0) : std::sqrt(2 * n);
    cells[axis] = static_cast<std::uint32_t>(std::clamp(count, length > 0 ? 3.0 : 4.0, 4096.0));
    width[axis] = length > 0 ? length / cells[axis] : edge;
  }
  return {initial.size(),        width[0], width[1], cells[0], cells[1], scene.periodic.x() > 0,
          scene.periodic.y() > 0};
}

/// When d = v t + ½ a t² first comes true while it grows, d >= 0, t >= 0; or infinity.
double time_to_reach(double d, double v, double a) {
  if (v > 0) {
    const double square = v * v + 2 * a * d;
    return square >= 0 ? 2 * d / (v + std::sqrt(square)) : kNever;
  }
  return a > 0 ? (std::sqrt(v * v + 2 * a * d) - v) / a : kNever;
}

}  // namespace

PlaneCells::PlaneCells(const Scene& scene, std::span<const BodyState> initial)
    : grid_(plane_grid(scene, initial)), places_(initial.size()) {
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    Place& place = places_[i];
    place.ix = CellGrid::cell_of(initial[i].position.x(), grid_.width_x());
    place.iy = CellGrid::cell_of(initial[i].position.y(), grid_.width_y());
    if (grid_.period().x > 0) place.image_x = CellGrid::folds_below(place.ix, grid_.cells_x());
    if (grid_.period().y > 0) place.image_y = CellGrid::folds_below(place.iy, grid_.cells_y());
    grid_.insert(i, place.ix, place.iy);
  }
}

template <class Visit>
void PlaneCells::for_each_side(const Place& place, const Vector3& x, const Vector3& v,
                               const Vector3& a, Visit visit) const {
  const double width_x = grid_.width_x(), width_y = grid_.width_y();
  visit(-1, 0, std::max(x.x() - place.ix * width_x, 0.0), -v.x(), -a.x());
  visit(1, 0, std::max((place.ix + 1) * width_x - x.x(), 0.0), v.x(), a.x());
  visit(0, -1, std::max(x.y() - place.iy * width_y, 0.0), -v.y(), -a.y());
  visit(0, 1, std::max((place.iy + 1) * width_y - x.y(), 0.0), v.y(), a.y());
}

double PlaneCells::time_to_leave(std::uint32_t i, const Vector3& x, const Vector3& v,
                                 const Vector3& a) {
  Place& place = places_[i];
  double earliest = kNever;
  for_each_side(place, x, v, a, [&](int dx, int dy, double d, double towards, double pull) {
    const double t = time_to_reach(d, towards, pull);
    if (t >= earliest) return;
    earliest = t;
    place.leaves_x = static_cast<std::int8_t>(dx);
    place.leaves_y = static_cast<std::int8_t>(dy);
  });
  return earliest;
}

double PlaneCells::least_time_to_leave(std::uint32_t i, const Vector3& x, const Vector3& v,
                                       double bound) {
  Place& place = places_[i];
  double earliest = kNever;
  for_each_side(place, x, v, Vector3::Zero(),
                [&](int dx, int dy, double d, double towards, double) {
                  // From a side it has just come through, the way back is the spare.
                  const double width = dx != 0 ? grid_.width_x() : grid_.width_y();
                  const double t = time_to_reach(d + 0.25 * kSpare * width, towards, bound);
                  if (t >= earliest) return;
                  earliest = t;
                  place.leaves_x = static_cast<std::int8_t>(dx);
                  place.leaves_y = static_cast<std::int8_t>(dy);
                });
  return earliest;
}

bool PlaneCells::is_at_side(std::uint32_t i, const Vector3& x) const {
  const Place& place = places_[i];
  bool is_there = false;
  for_each_side(place, x, Vector3::Zero(), Vector3::Zero(),
                [&](int dx, int dy, double d, double, double) {
                  if (dx == place.leaves_x && dy == place.leaves_y) is_there = d == 0;
                });
  return is_there;
}

void PlaneCells::cross(std::uint32_t i) {
  Place& place = places_[i];
  // Small numbers, no characters: NOLINTBEGIN(bugprone-signed-char-misuse)
  moved_x_ = place.leaves_x;
  moved_y_ = place.leaves_y;
  // NOLINTEND(bugprone-signed-char-misuse)
  place.ix += moved_x_;
  place.iy += moved_y_;
  if (grid_.period().x > 0) place.image_x = CellGrid::folds_below(place.ix, grid_.cells_x());
  if (grid_.period().y > 0) place.image_y = CellGrid::folds_below(place.iy, grid_.cells_y());
  grid_.move(i, moved_x_, moved_y_);
}

CellGrid::Shift PlaneCells::nearest_image(const Vector3& x_i, const Vector3& x_j) const {
  const CellGrid::Shift& period = grid_.period();
  CellGrid::Shift shift;
  // The nearest one in any rounding mode.
  if (period.x > 0) shift.x = period.x * std::round((x_i.x() - x_j.x()) / period.x);
  if (period.y > 0) shift.y = period.y * std::round((x_i.y() - x_j.y()) / period.y);
  return shift;
}

}  // namespace slipcheck
