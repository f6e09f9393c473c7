#pragma once

#include <cstddef>
#include <vector>

namespace slipcheck {

/// Where the runs of an ensemble start, so that the first contact falls everywhere inside a step:
/// times [s] in [0, step), stratified (one in each of `count` equal parts, at a random place with a
/// fixed seed). A first contact before the end of the first step shortens the range to it. One
/// start at 0 where there is no contact (`first_contact` infinite), or one from the start on (0).
std::vector<double> phase_starts(double first_contact, double step, std::size_t count);

}  // namespace slipcheck
