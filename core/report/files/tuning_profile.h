#pragma once

#include <string>

#include "engine/profile.h"
#include "report/json/tuning_record.h"

namespace slipcheck {

/// The profile that a tuning chose.
Profile tuned_profile(const TuningRecord& tuning);

/// Its file, with where it comes from: program, engine, scenes, what was wanted, how far it came.
/// The same tuning gives the same text.
std::string tuned_profile_yaml(const TuningRecord& tuning);

}  // namespace slipcheck
