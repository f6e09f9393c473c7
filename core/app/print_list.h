#pragma once

#include <nlohmann/json.hpp>

namespace slipcheck {

/// A list of objects as a table on stdout, a column for each key in the order in which they come.
void print_list(const nlohmann::ordered_json& list);

}  // namespace slipcheck
