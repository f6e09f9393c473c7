#pragma once

#include <string>
#include <vector>

#include "studies/precision/precision.h"

namespace slipcheck {

/// A row for each scene, method, knob and quantity; a point without errors has one row with its
/// status and reason (docs/result-file.md).
std::string precision_csv(const std::vector<PrecisionScene>& scenes);

/// A row for each scene, method and quantity: how the worst error falls.
std::string convergence_csv(const std::vector<PrecisionScene>& scenes);

}  // namespace slipcheck
