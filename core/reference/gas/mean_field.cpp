#include "reference/gas/mean_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slipcheck {
namespace {

constexpr std::size_t kIntervals = 64;  // of each integral, even
constexpr double kFarthest = 8;         // where exp(−x²/2) is 1e-14

struct Node {
  double x, weight;
};

/// Simpson's nodes with the density of a speed of `components` normal components, n·x^(n−1)
/// exp(−x²/2), made to add up to 1.
std::array<Node, kIntervals + 1> nodes(int components) {
  std::array<Node, kIntervals + 1> made{};
  double sum = 0;
  for (std::size_t i = 0; i <= kIntervals; ++i) {
    const double x = kFarthest * static_cast<double>(i) / kIntervals;
    const double simpson = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    made[i] = {x, simpson * (components == 1 ? 1 : x) * std::exp(-0.5 * x * x)};
    sum += made[i].weight;
  }
  for (Node& node : made) node.weight /= sum;
  return made;
}

}  // namespace

GasCooling mean_field_cooling(const GasLaw& law, const Sphere& sphere, int dimensions,
                              const GasTemperatures& now) {
  const double m = sphere.mass, q = sphere.shape_factor;
  const double whole = now.translation + now.rotation / q;
  if (!(now.translation > 0)) return {};
  const double normal = std::sqrt(2 * now.translation / m), tangential = std::sqrt(2 * whole / m);
  const double c = now.translation / whole;
  // The flux makes of the one normal component a speed like that of two.
  static const auto kNormal = nodes(2), kLine = nodes(1);
  const auto& across = dimensions == 2 ? kLine : kNormal;
  double translation = 0, rotation = 0;
  for (const auto& [x, weight] : kNormal) {
    const double u_n = normal * x;
    for (const auto& [y, share] : across) {
      const double u_t = tangential * y;
      const GasBounce bounce = law.at(u_n, u_t);
      const double e = bounce.restitution, eta = bounce.stick;
      const double part = law.rough() ? share : 1;
      const double slip = m * u_t * u_t;
      translation += weight * part * (-0.25 * m * (1 - e * e) * u_n * u_n + slip * eta * (eta - c));
      rotation += weight * part * slip * eta * (eta / q - (1 - c));
      if (!law.rough()) break;
    }
  }
  // Two particles share a collision, and each has D T/2.
  const double D = dimensions, D_rot = 0.5 * D * (D - 1);
  return {translation / D, rotation / D_rot};
}

std::vector<GasTemperatures> mean_field_course(const GasLaw& law, const GasSetup& setup,
                                               std::span<const double> times) {
  // Of a change in one step: the error of Runge and Kutta's rule is then below 1e-6.
  constexpr double kChange = 0.1;
  const double m = setup.sphere.mass;
  const double T0 = m * setup.speed * setup.speed / setup.dimensions;
  const double rate =
      collisions_on_the_way(setup.dimensions, setup.filled, 2 * setup.sphere.radius);
  const auto slope = [&](const GasTemperatures& at) -> GasTemperatures {
    const GasCooling cooling = mean_field_cooling(law, setup.sphere, setup.dimensions, at);
    const double omega = rate * mean_relative_speed(setup.dimensions, at.translation / m);
    return {omega * cooling.translation, omega * cooling.rotation};
  };
  const auto moved = [](const GasTemperatures& from, double by, const GasTemperatures& along) {
    return GasTemperatures{from.translation + by * along.translation,
                           std::max(0.0, from.rotation + by * along.rotation)};
  };
  std::vector<GasTemperatures> course;
  GasTemperatures now{T0, setup.rotation * T0};
  double t = 0;
  for (const double end : times) {
    while (t < end) {
      const GasTemperatures k1 = slope(now);
      const double fastest = std::max(std::abs(k1.translation), std::abs(k1.rotation));
      const double least = std::min(now.translation, std::max(now.rotation, 0.1 * now.translation));
      const double most = fastest > 0 ? kChange * least / fastest : end - t;
      const double h = most < end - t ? most : end - t;
      const GasTemperatures k2 = slope(moved(now, 0.5 * h, k1));
      const GasTemperatures k3 = slope(moved(now, 0.5 * h, k2));
      const GasTemperatures k4 = slope(moved(now, h, k3));
      now = moved(now, h / 6,
                  {k1.translation + 2 * (k2.translation + k3.translation) + k4.translation,
                   k1.rotation + 2 * (k2.rotation + k3.rotation) + k4.rotation});
      t = h == end - t ? end : t + h;
    }
    course.push_back(now);
  }
  return course;
}

}  // namespace slipcheck
