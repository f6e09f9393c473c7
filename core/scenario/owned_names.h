#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scenario/observable_key.h"

namespace slipcheck {

/// Whether owners may be written as a pattern, in which '*' stands for any text.
enum class Wildcards { no, yes };

/// Why a name as in "i-j.restitution" names no observable of a body, a pair or all by its form
/// alone, "" if it does.
std::string fault_of_owned_name(std::string_view name, Wildcards wildcards);

/// The same as JSON Schema: what may stand at such keys, by regular expressions of them.
nlohmann::json owned_names_schema(
    Wildcards wildcards, const std::function<nlohmann::json(const ObservableName&)>& schema_of);

/// Whether a text is what a pattern stands for.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace slipcheck
