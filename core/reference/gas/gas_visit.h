#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/gas/gas_law.h"
#include "reference/gas/gas_random.h"

namespace slipcheck {

/// Particles lie in groups of eight: eight first components of the velocity, eight second ones, …,
/// then those of the surface's velocity w = R ω [m/s], where there are spins. In two dimensions w
/// is one number, counterclockwise.
inline constexpr std::size_t kGasGroup = GasRandom::kWidth;

/// Components of the velocity and of w of a particle.
struct GasLayout {
  std::size_t dimensions = 3;
  bool spins = false;
  std::size_t spin_components() const { return !spins ? 0 : dimensions == 3 ? 3 : 1; }
  std::size_t stride() const {
    return kGasGroup * (dimensions + spin_components());
  }  ///< of a group
};

/// What one cell does in one step.
struct GasVisit {
  double* particles = nullptr;
  std::span<const std::uint32_t> groups;  ///< of the cell, 2 at least
  double majorant = 0;                    ///< G, no two particles pass each other faster [m/s]
  std::size_t candidates = 0;             ///< pairs of groups to choose, of eight pairs each
  std::size_t collisions = 0;             ///< counted on
  std::size_t overtaken = 0;              ///< pairs that did pass each other faster than G
};

/// Chooses the candidates and collides those that NTC accepts. A pair of groups is chosen evenly
/// among all of them and so are the eight ways k → k ^ x in which they face each other: each pair
/// of particles of two groups is as likely a candidate as any other. The eight share no particle,
/// so that each finds the velocities that those before it left. A pair collides with the
/// probability g/G, along a line that is as likely as the flux along it, and with the impulse that
/// the law gives at its contact point.
///
/// The same bits on every instruction set: no operation is fused, nothing is summed over lanes.
void visit_cell(const GasLayout& layout, const GasLaw& law, double shape_factor, GasRandom& random,
                GasVisit& visit);

/// Of the particles of a cell [m²/s²].
struct GasSquares {
  double largest = 0;  ///< v²
  double sum = 0;      ///< of v²
};
GasSquares squares_of(const GasLayout& layout, const GasVisit& visit);

}  // namespace slipcheck
