#pragma once

#include <string>

#include "app/command_words.h"

namespace slipcheck {

// What a shell completes after `slipcheck`: commands, options, and values where they are a list;
// files for all other words.

std::string bash_completion(const CommandWords& top);
std::string zsh_completion(const CommandWords& top);
std::string fish_completion(const CommandWords& top);

}  // namespace slipcheck
