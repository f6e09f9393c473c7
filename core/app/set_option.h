#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// Adds `--set name=value`, which may be given several times.
void add_set_option(CLI::App& command, std::vector<std::string>& written);

/// Adds `--ranks N`, which is `--set ranks=N`.
void add_ranks_option(CLI::App& command, std::vector<std::string>& written);

/// {"erp=0.3", "split_impulse=false", "solver=nncg"} as settings: true, false, numbers, else words.
/// Throws BadOption for what is not of this form and for names that are given twice.
Settings parse_settings(const std::vector<std::string>& written);

/// --general: loops that leave out nothing of what a scene may have.
void add_general_option(CLI::App& command, bool& general);

}  // namespace slipcheck
