#include "scenario/fill/fill_plane.h"

#include <algorithm>
#include <cmath>

#include "scenario/rules/overlap.h"

namespace slipcheck {
namespace {

constexpr double kMostCells = 1e9;  // along one axis

std::uint64_t key(std::int64_t i, std::int64_t j) {
  return static_cast<std::uint64_t>(i) * 0x100000000u ^
         (static_cast<std::uint64_t>(j) & 0xFFFFFFFFu);
}

}  // namespace

FillPlane::FillPlane(const Fill& fill, const WrittenScene& scene)
    : up_(scene.container ? 2 : 1),
      origin_(fill.area[0], fill.area[1]),
      size_(fill.area[2] - fill.area[0], fill.area[3] - fill.area[1]),
      cell_(2 * fill.most_radius) {
  if (scene.substrate) periodic_ = scene.substrate->periodic;
  cells_.reserve(static_cast<std::size_t>(fill.count));
}

bool FillPlane::has_few_cells() const { return size_.maxCoeff() / cell_ < kMostCells; }

void FillPlane::insert(const Body& body) {
  Vector3 position = body.initial.position;
  if (periodic_) {
    for (int axis = 0; axis < 2; ++axis) {
      const double length = (*periodic_)[axis];
      const double middle = origin_[axis] + size_[axis] / 2;
      position[axis] -= length * std::round((position[axis] - middle) / length);
    }
  }
  const Ball ball{position, body.sphere.radius};
  largest_ = std::max(largest_, ball.radius);
  if (ball.radius > cell_ / 2) neighbours_ = 3;
  if (ball.radius > 2 * cell_) {
    large_.push_back(ball);
    return;
  }
  // Beyond this nothing of the area can be met, whichever image is looked at.
  const double reach = ball.radius + cell_;
  for (int axis = 0; axis < 2; ++axis) {
    const double at = position[axis == 0 ? 0 : up_] - origin_[axis];
    const double margin = periodic_ ? reach + (*periodic_)[axis] : reach;
    if (at < -margin || at > size_[axis] + margin) return;
  }
  cells_[key(cell_of(position, 0), cell_of(position, 1))].push_back(ball);
}

bool FillPlane::is_free(const Vector3& position, double radius) const {
  if (!periodic_) return is_image_free(position, radius);
  const Vector2 middle = origin_ + size_ / 2;
  // What was inserted lies in the cell around the middle: few images reach into it.
  const Vector2 reach = 0.5 * *periodic_ + Vector2::Constant(1.001 * (radius + largest_));
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const Vector3 image = position + Vector3(i * periodic_->x(), j * periodic_->y(), 0);
      const Vector2 off = (image.head<2>() - middle).cwiseAbs();
      if (off.x() > reach.x() || off.y() > reach.y()) continue;
      if (!is_image_free(image, radius)) return false;
    }
  }
  return true;
}

std::int64_t FillPlane::cell_of(const Vector3& position, int axis) const {
  return static_cast<std::int64_t>(
      std::floor((position[axis == 0 ? 0 : up_] - origin_[axis]) / cell_));
}

bool FillPlane::is_image_free(const Vector3& position, double radius) const {
  const auto meets = [&](const Ball& ball) {
    return overlap_of(position, radius, ball.position, ball.radius) > 0;
  };
  if (std::ranges::any_of(large_, meets)) return false;
  const std::int64_t i0 = cell_of(position, 0), j0 = cell_of(position, 1);
  for (std::int64_t i = i0 - neighbours_; i <= i0 + neighbours_; ++i) {
    for (std::int64_t j = j0 - neighbours_; j <= j0 + neighbours_; ++j) {
      const auto found = cells_.find(key(i, j));
      if (found != cells_.end() && std::ranges::any_of(found->second, meets)) return false;
    }
  }
  return true;
}

}  // namespace slipcheck
