#pragma once

#include <vector>

// A program of Siconos's own API, with the relations of its library of spheres; its headers are
// C++17 and stay out of this one.
namespace slipcheck::test {

struct BareSphere {
  double radius, mass, x, z, vx, wy;
};
struct BareLaw {
  double restitution, friction;
};

/// Nine numbers a ball after each step.
std::vector<std::vector<double>> siconos_bare(const std::vector<BareSphere>& balls,
                                              const BareLaw& ground, const BareLaw& pair,
                                              double rate, int steps);

}  // namespace slipcheck::test
