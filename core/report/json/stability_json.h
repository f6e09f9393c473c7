#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

// Why numbers of the file are null.
inline constexpr const char* kNoError = "no error could be taken";
inline constexpr const char* kNoEnergy = "no energy could be taken";
inline constexpr const char* kNothingRests = "nothing rests in the reference";
inline constexpr const char* kNoOverlap = "no overlap could be taken";
inline constexpr const char* kNoGood = "no value was found good";
inline constexpr const char* kNoBad = "no value was found bad";
inline constexpr const char* kNoRatio = "there is no limit to divide";

/// Catalogue, limits and maps as "slipcheck-stability/1" (docs/result-file.md). All values are SI.
nlohmann::ordered_json json_of(const std::vector<StabilityCase>& cases, const StabilityGrid& grid,
                               const LimitResults& limits);

}  // namespace slipcheck
