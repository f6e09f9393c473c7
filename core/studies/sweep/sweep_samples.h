#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slipcheck {

/// Points in the unit cube, one after the other, each with `dimensions` coordinates in [0, 1).
/// The same on every machine.

/// In each coordinate exactly one point falls into each of `points` equal intervals, anywhere in
/// it (McKay, Beckman, Conover, Technometrics 21, 239 (1979)). points, dimensions >= 1.
std::vector<double> latin_hypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed);

/// The sequence of Sobol with the direction numbers of Joe and Kuo (2008), without its first point,
/// the corner 0. dimensions in [1, 3667].
std::vector<double> sobol_points(std::size_t points, std::size_t dimensions);

}  // namespace slipcheck
