#pragma once

#include <span>
#include <vector>

namespace slipcheck {

/// Which of these points are on the Pareto front of cost and error, both the smaller the better: no
/// other point is cheaper and no worse, or better and no dearer. Equal points are on it together;
/// one whose cost or error is not finite never is.
std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors);

}  // namespace slipcheck
