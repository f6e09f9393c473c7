#include "scenario/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <unordered_map>

#include "scenario/overlap.h"

namespace slipcheck {
namespace {

constexpr int kMostAttempts = 10'000;              // for one body
constexpr std::int64_t kAllAttempts = 40'000'000;  // for all; some seconds
constexpr double kMostCells = 1e9;                 // along one axis

/// Evenly distributed numbers. The standard's distributions differ between libraries; the engine
/// does not.
class Random {
 public:
  explicit Random(std::int64_t seed) : engine_(static_cast<std::uint64_t>(seed)) {}
  double between(double low, double high) {
    constexpr double k2ToMinus53 = 1.0 / 9007199254740992.0;
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * k2ToMinus53);
  }
  /// A unit vector, evenly over the circle; by rejection, as sines are not the same everywhere.
  Vector2 direction() {
    while (true) {
      const double x = between(-1, 1);
      const double y = between(-1, 1);
      const double square = x * x + y * y;
      if (square > 1e-4 && square <= 1) return Vector2(x, y) / std::sqrt(square);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// The plane that bodies are spread over, (x, y) or a container's (x, z), with what stands there.
class Plane {
 public:
  Plane(const Fill& fill, const WrittenScene& scene)
      : up_(scene.container ? 2 : 1),
        origin_(fill.area[0], fill.area[1]),
        size_(fill.area[2] - fill.area[0], fill.area[3] - fill.area[1]),
        cell_(2 * fill.most_radius) {
    if (scene.substrate) periodic_ = scene.substrate->periodic;
  }

  bool has_few_cells() const { return size_.maxCoeff() / cell_ < kMostCells; }

  void insert(const Body& body) {
    Vector3 position = body.initial.position;
    if (periodic_) {
      for (int axis = 0; axis < 2; ++axis) {
        const double length = (*periodic_)[axis];
        const double middle = origin_[axis] + size_[axis] / 2;
        position[axis] -= length * std::round((position[axis] - middle) / length);
      }
    }
    const Ball ball{position, body.sphere.radius};
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

  bool is_free(const Vector3& position, double radius) const {
    const int images = periodic_ ? 1 : 0;
    for (int i = -images; i <= images; ++i) {
      for (int j = -images; j <= images; ++j) {
        Vector3 image = position;
        if (periodic_) image += Vector3(i * periodic_->x(), j * periodic_->y(), 0);
        if (!is_image_free(image, radius)) return false;
      }
    }
    return true;
  }

 private:
  struct Ball {
    Vector3 position;
    double radius;
  };

  std::int64_t cell_of(const Vector3& position, int axis) const {
    return static_cast<std::int64_t>(
        std::floor((position[axis == 0 ? 0 : up_] - origin_[axis]) / cell_));
  }
  static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) * 0x100000000u ^
           (static_cast<std::uint64_t>(j) & 0xFFFFFFFFu);
  }

  bool is_image_free(const Vector3& position, double radius) const {
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

  int up_;
  Vector2 origin_, size_;
  double cell_;
  std::optional<Vector2> periodic_;
  std::vector<Ball> large_;
  /// Cells to look at on each side: one for balls like those of the fill, two and a half for the
  /// largest in the grid.
  std::int64_t neighbours_ = 1;
  std::unordered_map<std::uint64_t, std::vector<Ball>> cells_;
};

/// Where the centre of a body of this radius may be: [x0, y0, x1, y1].
std::vector<double> free_area(const Fill& fill, const WrittenScene& scene, double radius) {
  std::vector<double> area = fill.area;
  if (scene.container) {
    area[0] = std::max(area[0], radius);
    area[1] = std::max(area[1], radius);
    area[2] = std::min(area[2], scene.container->width - radius);
    if (scene.container->height) area[3] = std::min(area[3], *scene.container->height - radius);
  }
  return area;
}

}  // namespace

std::vector<Body> expand(const Fill& fill, const WrittenScene& scene,
                         const std::vector<Body>& others, Reading& reading) {
  const std::string area_path = fill.path + ".area";
  if (!(fill.area[0] <= fill.area[2] && fill.area[1] <= fill.area[3])) {
    reading.fault_at(area_path, "must be [x0, y0, x1, y1] with x0 <= x1 and y0 <= y1");
    return {};
  }
  if (scene.substrate && scene.substrate->periodic) {
    const Vector2& length = *scene.substrate->periodic;
    if (fill.area[2] - fill.area[0] > length.x() || fill.area[3] - fill.area[1] > length.y()) {
      reading.fault_at(area_path, "must be at most the periodic cell");
      return {};
    }
  }
  Plane plane(fill, scene);
  if (!plane.has_few_cells()) {
    reading.fault_at(area_path, "must be at most 1e9 diameters across");
    return {};
  }
  for (const Body& body : others) plane.insert(body);

  Random random(fill.seed);
  std::vector<Body> bodies;
  std::int64_t attempts = 0;
  for (std::int64_t n = 1; n <= fill.count; ++n) {
    Body body{fill.prefix + std::to_string(n), fill.material, {}, {}};
    const double radius = random.between(fill.least_radius, fill.most_radius);
    body.sphere.radius = radius;
    body.sphere.shape_factor = fill.shape_factor;
    const std::vector<double> area = free_area(fill, scene, radius);
    bool placed = false;
    for (int i = 0; i < kMostAttempts && !placed && attempts < kAllAttempts; ++i, ++attempts) {
      if (area[0] > area[2] || area[1] > area[3]) break;
      const double x = random.between(area[0], area[2]);
      const double y = random.between(area[1], area[3]);
      body.initial.position = scene.container ? Vector3(x, 0, y) : Vector3(x, y, radius);
      placed = plane.is_free(body.initial.position, radius);
    }
    if (!placed) {
      reading.fault_at(area_path, fmt::format("must have room for {} bodies, but only {} found a "
                                              "place",
                                              fill.count, n - 1));
      return {};
    }
    if (fill.speed > 0) {
      const Vector2 v = fill.speed * random.direction();
      body.initial.velocity = scene.container ? Vector3(v.x(), 0, v.y()) : Vector3(v.x(), v.y(), 0);
    }
    plane.insert(body);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace slipcheck
