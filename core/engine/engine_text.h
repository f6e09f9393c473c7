#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace slipcheck {

/// What an engine says, fit for terminals and for the logs of CI, where it ends: printable(), and
/// no word of it is a command to what reads the log ("::error::", "##[error]").
std::string harmless(std::string_view text);

/// The same for all texts of a message and for the names of its members; what is no UTF-8 stays,
/// to be refused.
void make_harmless(nlohmann::json& message);

}  // namespace slipcheck
