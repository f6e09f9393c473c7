#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scenario/written_scene.h"

namespace slipcheck {

/// The plane that a fill is spread over, (x, y) or a container's (x, z), with what stands there.
class FillPlane {
 public:
  FillPlane(const Fill& fill, const WrittenScene& scene);

  /// Whether the area has few enough cells of the fill's largest diameter for their numbers.
  bool has_few_cells() const;
  void insert(const Body& body);
  /// Whether a sphere may stand there without overlap of what was inserted or of its images.
  bool is_free(const Vector3& position, double radius) const;

 private:
  struct Ball {
    Vector3 position;
    double radius;
  };

  /// Of a grid as large as the area; beyond it the nearest one, `shift` cells further.
  std::size_t cell_of(const Vector3& position, int axis, std::int64_t shift = 0) const;
  bool is_image_free(const Vector3& position, double radius) const;

  int up_;
  Vector2 origin_, size_;
  double diameter_;  ///< the fill's largest
  double cell_;      ///< width
  std::array<std::size_t, 2> cells_;
  double largest_ = 0;  ///< radius of what was inserted
  std::optional<Vector2> periodic_;
  std::vector<Ball> large_;
  /// Cells to look at on each side: one for balls like those of the fill, two and a half for the
  /// largest in the grid.
  std::int64_t neighbours_ = 1;
  /// In turn: the last ball of each cell, and of each ball the one before it there.
  std::vector<std::uint32_t> last_, before_;
  std::vector<Ball> balls_;
};

}  // namespace slipcheck
