#pragma once

#include <nlohmann/json_fwd.hpp>

namespace slipcheck {

/// The scenario format as a JSON Schema (draft-07), made from the same table as the loader.
nlohmann::json scenario_schema();

}  // namespace slipcheck
