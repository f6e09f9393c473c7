#pragma once

#include <vector>

// A program of Simbody's own API; Simbody's headers are C++17 and stay out of this one.
namespace slipcheck::test {

struct BareBall {
  double radius, mass, x, z, vx, wy;
};
struct BareContact {
  double modulus, dissipation, static_friction, dynamic_friction;
};

/// Nine numbers a ball after each step.
std::vector<std::vector<double>> simbody_bare(const std::vector<BareBall>& balls,
                                              const BareContact& ground, const BareContact& pair,
                                              double rate, int steps);

}  // namespace slipcheck::test
