#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/engine.h"

namespace slipcheck {

/// A number under a key; of one that is not finite null, for which JSON has no other word, and a
/// reason beside it: the one given, else that it is not a number or infinite.
void put_number(nlohmann::ordered_json& object, const std::string& key, double value,
                const std::string& reason = {});

/// Adds to what stands under "reason"; nothing for an empty text and for what stands there already.
void add_reason(nlohmann::ordered_json& object, const std::string& reason);

/// Settings under their names.
nlohmann::ordered_json settings_json(const Settings& settings);

/// What made a file and on which machine, under "slipcheck" and "machine".
void put_context(nlohmann::ordered_json& object);

}  // namespace slipcheck
