#pragma once

#include <cstdint>
#include <optional>

#include "physics/vector.h"

namespace slipcheck {

/// A triangular lattice over a rectangle, row by row from its lower left: sites are a apart in a
/// row, rows √3/2 a apart, and every other row begins at a/2.
class FillLattice {
 public:
  /// `size` of the rectangle [m], >= 0; `periodic`: the lengths of a cell at least as large, over
  /// whose ends sites keep their distance too [m], > 0; `spacing` a [m], > 0.
  FillLattice(const Vector2& size, const std::optional<Vector2>& periodic, double spacing);

  /// The widest one, at least `least` apart [m], > 0, that has `count` sites; nothing where none
  /// has. The same on every machine.
  static std::optional<FillLattice> widest(const Vector2& size,
                                           const std::optional<Vector2>& periodic, double least,
                                           std::int64_t count);

  double spacing() const { return spacing_; }  ///< a [m]
  double rows() const { return rows_; }        ///< whole, maybe beyond the range of integers
  double columns(double row) const { return columns_[is_shifted(row) ? 1 : 0]; }
  double sites() const;
  /// From the rectangle's lower left [m].
  Vector2 site(double row, double column) const;

 private:
  static bool is_shifted(double row);

  double spacing_, height_;  ///< of a row over the one below
  double rows_ = 0;
  double columns_[2] = {0, 0};
};

}  // namespace slipcheck
