#pragma once

#include <nlohmann/json.hpp>

namespace slipcheck {

/// The workers on this machine, who they are and the names of their profiles; engines that are
/// known but not built are listed too.
nlohmann::ordered_json list_engines();

/// The profiles that lie beside the workers. What is wrong with one goes to stderr.
nlohmann::ordered_json list_profiles();

/// The settings that each engine takes, each once where its precisions agree.
nlohmann::ordered_json list_settings();

/// That list for readers: values as a profile has to write them, limits in words.
nlohmann::ordered_json settings_in_words(const nlohmann::ordered_json& list);

}  // namespace slipcheck
