#include "scenario/fill/fill_plane.h"

#include <algorithm>
#include <cmath>

#include "scenario/rules/overlap.h"

namespace slipcheck {
namespace {

constexpr double kMostDiameters = 1e9;  // along one axis
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Of cells as wide as a diameter, or of so few that there are some two for each ball.
double cell_width(const Vector2& size, double diameter, std::int64_t count) {
  const double cells = 2 * static_cast<double>(count);
  return std::max({diameter, std::sqrt(size.prod() / cells), size.maxCoeff() / cells});
}

}  // namespace

FillPlane::FillPlane(const Fill& fill, const WrittenScene& scene)
    : up_(scene.container ? 2 : 1),
      origin_(fill.area[0], fill.area[1]),
      size_(fill.area[2] - fill.area[0], fill.area[3] - fill.area[1]),
      diameter_(2 * fill.most_radius),
      cell_(cell_width(size_, diameter_, fill.count)),
      cells_{static_cast<std::size_t>(size_.x() / cell_) + 1,
             static_cast<std::size_t>(size_.y() / cell_) + 1},
      last_(cells_[0] * cells_[1], kNone) {
  if (scene.substrate) periodic_ = scene.substrate->periodic;
  before_.reserve(static_cast<std::size_t>(fill.count));
  balls_.reserve(static_cast<std::size_t>(fill.count));
}

bool FillPlane::has_few_cells() const { return size_.maxCoeff() / diameter_ < kMostDiameters; }

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
  std::uint32_t& last = last_[cell_of(position, 0) * cells_[1] + cell_of(position, 1)];
  before_.push_back(last);
  last = static_cast<std::uint32_t>(balls_.size());
  balls_.push_back(ball);
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

std::size_t FillPlane::cell_of(const Vector3& position, int axis, std::int64_t shift) const {
  const double cell = std::floor((position[axis == 0 ? 0 : up_] - origin_[axis]) / cell_);
  const auto last = static_cast<double>(cells_[static_cast<std::size_t>(axis)] - 1);
  return static_cast<std::size_t>(std::clamp(cell + static_cast<double>(shift), 0.0, last));
}

bool FillPlane::is_image_free(const Vector3& position, double radius) const {
  const auto meets = [&](const Ball& ball) {
    return overlap_of(position, radius, ball.position, ball.radius) > 0;
  };
  if (std::ranges::any_of(large_, meets)) return false;
  const std::size_t i1 = cell_of(position, 0, neighbours_), j1 = cell_of(position, 1, neighbours_);
  for (std::size_t i = cell_of(position, 0, -neighbours_); i <= i1; ++i)
    for (std::size_t j = cell_of(position, 1, -neighbours_); j <= j1; ++j)
      for (std::uint32_t k = last_[i * cells_[1] + j]; k != kNone; k = before_[k])
        if (meets(balls_[k])) return false;
  return true;
}

}  // namespace slipcheck
