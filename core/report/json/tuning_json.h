#pragma once

#include <nlohmann/json.hpp>

#include "report/json/tuning_record.h"

namespace slipcheck {

/// A tuning as "slipcheck-tuning/1" (docs/tuning.md). All values are SI.
nlohmann::ordered_json json_of(const TuningRecord& tuning);

}  // namespace slipcheck
