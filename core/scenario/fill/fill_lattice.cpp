#include "scenario/fill/fill_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipcheck {
namespace {

/// Steps that fit into a length, to within round-off.
double steps(double length, double step) { return std::floor(length / step * (1 + 1e-14)); }

}  // namespace

FillLattice::FillLattice(const Vector2& size, const std::optional<Vector2>& periodic,
                         double spacing)
    : spacing_(spacing), height_(std::numbers::sqrt3 / 2 * spacing) {
  for (const int shifted : {0, 1}) {
    const double width = size.x() - shifted * spacing / 2;
    columns_[shifted] = width >= 0 ? steps(width, spacing) + 1 : 0;
    // The first site's image is a after the last one's place.
    if (periodic) columns_[shifted] = std::min(columns_[shifted], steps(periodic->x(), spacing));
  }
  rows_ = steps(size.y(), height_) + 1;
  if (!periodic) return;
  rows_ = std::min(rows_, steps(periodic->y(), height_));
  // Over the last row of an odd number comes one that is not shifted against it.
  const bool is_odd = is_shifted(rows_);
  if (is_odd && (rows_ - 1) * height_ + spacing > periodic->y() * (1 + 1e-14)) --rows_;
}

bool FillLattice::is_shifted(double row) { return std::fmod(row, 2) == 1; }

double FillLattice::sites() const {
  return std::ceil(rows_ / 2) * columns_[0] + std::floor(rows_ / 2) * columns_[1];
}

Vector2 FillLattice::site(double row, double column) const {
  return {(column + (is_shifted(row) ? 0.5 : 0)) * spacing_, row * height_};
}

std::optional<FillLattice> FillLattice::widest(const Vector2& size,
                                               const std::optional<Vector2>& periodic, double least,
                                               std::int64_t count) {
  const auto has_room = [&](double spacing) {
    return FillLattice(size, periodic, spacing).sites() >= static_cast<double>(count);
  };
  if (!has_room(least)) return std::nullopt;
  // Beyond the rectangle there is one site; halving until neighbouring numbers are left.
  double room = least, most = least + 2 * (size.x() + size.y());
  if (has_room(most)) room = most;
  while (room < most) {
    const double middle = room + (most - room) / 2;
    if (middle <= room || middle >= most) break;
    (has_room(middle) ? room : most) = middle;
  }
  return FillLattice(size, periodic, room);
}

}  // namespace slipcheck
