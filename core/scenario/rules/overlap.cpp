#include "scenario/rules/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

/// A body, or one of its periodic images.
struct Image {
  Vector3 position;
  double radius;
  std::size_t body;
  double first(int axis) const { return position[axis] - radius; }
  double last(int axis) const { return position[axis] + radius; }
};

std::vector<Image> images_of(const std::vector<Body>& bodies,
                             const std::optional<Vector2>& periodic) {
  std::vector<Image> images;
  double largest = 0;
  for (const Body& body : bodies) largest = std::max(largest, body.sphere.radius);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Vector3 position = bodies[i].initial.position;
    const double radius = bodies[i].sphere.radius;
    if (!periodic) {
      images.push_back({position, radius, i});
      continue;
    }
    std::vector<double> shifts[2];
    for (int axis = 0; axis < 2; ++axis) {
      const double length = (*periodic)[axis];
      position[axis] -= length * std::floor(position[axis] / length);
      shifts[axis] = {0};
      // What reaches over one end may meet what is near the other.
      if (position[axis] < radius + largest) shifts[axis].push_back(length);
    }
    for (const double x : shifts[0]) {
      for (const double y : shifts[1]) {
        images.push_back({position + Vector3(x, y, 0), radius, i});
      }
    }
    // The corner across: near the left end in x and the far end in y.
    if (shifts[0].size() > 1) {
      const double length = (*periodic)[1];
      if (position.y() > length - radius - largest) {
        images.push_back({position + Vector3((*periodic)[0], -length, 0), radius, i});
      }
    }
  }
  return images;
}

int longest_axis(const std::vector<Image>& images) {
  Vector3 least = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 most = -least;
  for (const Image& image : images) {
    least = least.cwiseMin(image.position);
    most = most.cwiseMax(image.position);
  }
  int axis = 0;
  (most - least).maxCoeff(&axis);
  return axis;
}

}  // namespace

double overlap_of(const Vector3& a, double radius_a, const Vector3& b, double radius_b) {
  constexpr double kRoundOff = 1e-12;
  const double sum = radius_a + radius_b;
  const Vector3 apart = a - b;
  // Far apart along one axis: told without a distance that neither overflows nor underflows.
  if ((apart.cwiseAbs().array() >= sum).any()) return 0;
  const double overlap = sum - apart.stableNorm();
  // Positions carry their own round-off, which far from the origin is more than the radii's.
  const double scale = std::max({sum, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
  return overlap <= kRoundOff * sum || overlap <= 4e-16 * scale ? 0 : overlap;
}

void check_overlaps(const std::vector<Body>& bodies, const std::vector<std::string>& paths,
                    const std::optional<Vector2>& periodic, Reading& reading,
                    const OverlapRule& rule) {
  if (bodies.empty()) return;
  std::vector<Image> images = images_of(bodies, periodic);
  // Sweep along the longest extent: only bodies whose shadows on it meet are compared.
  const int axis = longest_axis(images);
  std::ranges::sort(images, {}, [axis](const Image& image) { return image.first(axis); });
  std::vector<bool> reported(bodies.size(), false);
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t j = i + 1; j < images.size() && images[j].first(axis) < images[i].last(axis);
         ++j) {
      const auto [first, second] = std::minmax(images[i].body, images[j].body);
      if (first == second || reported[second]) continue;
      const double overlap =
          overlap_of(images[i].position, images[i].radius, images[j].position, images[j].radius);
      if (overlap <= 0) continue;
      const Body &a = bodies[first], &b = bodies[second];
      std::optional<std::string> why = rule ? rule(a, b) : "";
      if (!why) {
        if (overlap < std::min(a.sphere.radius, b.sphere.radius)) continue;
        why = " (bodies with a soft contact may, by less than the smaller radius)";
      }
      reported[second] = true;
      const double shown = overlap / to_si(1, kLength, reading.units());
      reading.fault_at(paths[second] + ".position",
                       fmt::format("must not overlap {}, but does by {:.6g} {}{}", a.name, shown,
                                   unit_name(kLength, reading.units()), *why));
    }
  }
}

}  // namespace slipcheck
