#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "studies/conformance/conformance.h"

namespace slipcheck {

/// What the checks of one or more workers found, schema slipcheck-conformance/1.
nlohmann::ordered_json json_of(const std::vector<ConformanceReport>& reports);

}  // namespace slipcheck
