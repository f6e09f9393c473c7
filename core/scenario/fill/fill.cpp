#include "scenario/fill/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "base/stop_scope.h"
#include "scenario/fill/fill_lattice.h"
#include "scenario/fill/fill_plane.h"
#include "scenario/surfaces.h"

namespace slipcheck {
namespace {

constexpr int kMostAttempts = 100'000;             // for one body
constexpr std::int64_t kAllAttempts = 40'000'000;  // for all; about a minute

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

/// A unit vector, evenly over the sphere.
Vector3 direction_in_space(Random& random) {
  while (true) {
    const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
    const double square = x * x + y * y + z * z;
    if (square > 1e-4 && square <= 1) return Vector3(x, y, z) / std::sqrt(square);
  }
}

Vector3 velocity_of(const Fill& fill, const WrittenScene& scene, Random& random) {
  if (fill.heights) return fill.speed * direction_in_space(random);
  const Vector2 v = fill.speed * random.direction();
  return scene.container ? Vector3(v.x(), 0, v.y()) : Vector3(v.x(), v.y(), 0);
}

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

Vector3 place(const WrittenScene& scene, double x, double y, double radius) {
  return scene.container ? Vector3(x, 0, y) : Vector3(x, y, radius);
}

/// Random places, each free of what the plane holds at the time.
class RandomPlaces {
 public:
  RandomPlaces(const Fill& fill, const WrittenScene& scene, const FillPlane& plane)
      : fill_(fill), scene_(scene), plane_(plane), surfaces_(named_surfaces(scene)) {}

  std::optional<Vector3> next(double radius, Random& random) {
    const std::vector<double> area = free_area(fill_, scene_, radius);
    if (area[0] > area[2] || area[1] > area[3]) return std::nullopt;
    for (int i = 0; i < kMostAttempts && attempts_ < kAllAttempts; ++i, ++attempts_) {
      const double x = random.between(area[0], area[2]);
      const double y = random.between(area[1], area[3]);
      Vector3 position = place(scene_, x, y, radius);
      if (fill_.heights) position.z() = random.between(fill_.heights->x(), fill_.heights->y());
      if (plane_.is_free(position, radius) && is_beside_surfaces(position, radius)) return position;
    }
    return std::nullopt;
  }

 private:
  bool is_beside_surfaces(const Vector3& position, double radius) const {
    const bool stands_free =
        !scene_.substrate || scene_.substrate->periodic || position.z() >= radius;
    return stands_free && std::ranges::all_of(surfaces_, [&](const NamedSurface& surface) {
             return overlap_of(surface, position, radius) <= 0;
           });
  }

  const Fill& fill_;
  const WrittenScene& scene_;
  const FillPlane& plane_;
  const std::vector<NamedSurface> surfaces_;
  std::int64_t attempts_ = 0;
};

/// The first `count` sites of a lattice that are free; fewer where it has not as many.
std::vector<Vector3> free_sites(const Fill& fill, const WrittenScene& scene, const FillPlane& plane,
                                const FillLattice& lattice, std::int64_t& attempts) {
  const std::vector<double> area = free_area(fill, scene, fill.most_radius);
  std::vector<Vector3> sites;
  for (double row = 0; row < lattice.rows(); ++row) {
    for (double column = 0; column < lattice.columns(row); ++column) {
      heed_stop();
      if (static_cast<std::int64_t>(sites.size()) == fill.count || ++attempts > kAllAttempts)
        return sites;
      const Vector2 site = Vector2(area[0], area[1]) + lattice.site(row, column);
      const Vector3 position = place(scene, site.x(), site.y(), fill.most_radius);
      if (plane.is_free(position, fill.most_radius)) sites.push_back(position);
    }
  }
  return sites;
}

/// As many sites as there are bodies, as far apart as may be among `others`; fewer where not even
/// spheres that touch fit.
std::vector<Vector3> lattice_sites(const Fill& fill, const WrittenScene& scene,
                                   const FillPlane& plane) {
  constexpr double kCloser = 0.98;  // where other bodies stand on sites
  const std::vector<double> area = free_area(fill, scene, fill.most_radius);
  const Vector2 size(area[2] - area[0], area[3] - area[1]);
  if (size.minCoeff() < 0) return {};
  std::optional<Vector2> periodic;
  if (scene.substrate) periodic = scene.substrate->periodic;
  const double least = 2 * fill.most_radius;
  const auto widest = FillLattice::widest(size, periodic, least, fill.count);
  std::int64_t attempts = 0;
  double spacing = widest ? widest->spacing() : least;
  while (true) {
    std::vector<Vector3> sites =
        free_sites(fill, scene, plane, FillLattice(size, periodic, spacing), attempts);
    const bool all = static_cast<std::int64_t>(sites.size()) == fill.count;
    if (all || spacing <= least || attempts > kAllAttempts) return sites;
    spacing = std::max(least, kCloser * spacing);
  }
}

}  // namespace

std::vector<Body> expand(const Fill& fill, const WrittenScene& scene,
                         const std::vector<Body>& others, Reading& reading) {
  const std::string area_path = fill.path + (fill.heights ? ".volume" : ".area");
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
  FillPlane plane(fill, scene);
  if (!plane.has_few_cells()) {
    reading.fault_at(area_path, "must be at most 1e9 diameters across");
    return {};
  }
  for (const Body& body : others) plane.insert(body);

  const bool on_lattice = fill.arrange == Fill::Arrange::lattice;
  const std::vector<Vector3> sites =
      on_lattice ? lattice_sites(fill, scene, plane) : std::vector<Vector3>{};
  Random random(fill.seed);
  RandomPlaces places(fill, scene, plane);
  const auto next_place = [&](std::size_t n, double radius) -> std::optional<Vector3> {
    if (!on_lattice) return places.next(radius, random);
    if (n >= sites.size()) return std::nullopt;
    const Vector3& site = sites[n];
    return place(scene, site.x(), scene.container ? site.z() : site.y(), radius);
  };
  std::vector<Body> bodies;
  bodies.reserve(static_cast<std::size_t>(fill.count));
  for (std::int64_t n = 1; n <= fill.count; ++n) {
    heed_stop();
    Body body{fill.prefix + std::to_string(n), fill.material, {}, {}};
    const double radius = random.between(fill.least_radius, fill.most_radius);
    body.sphere.radius = radius;
    body.sphere.shape_factor = fill.shape_factor;
    const auto position = next_place(bodies.size(), radius);
    if (!position) {
      reading.fault_at(area_path,
                       fmt::format("must have room for {} bodies, but only {} found a "
                                   "place",
                                   fill.count, on_lattice ? sites.size() : bodies.size()));
      return {};
    }
    body.initial.position = *position;
    if (fill.speed > 0) body.initial.velocity = velocity_of(fill, scene, random);
    plane.insert(body);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace slipcheck
