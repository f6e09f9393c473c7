#pragma once

#include <CLI/CLI.hpp>

namespace slipcheck {

/// Takes the name of an engine that is installed in some precision and, where it stands for all of
/// these, "all". Of others it tells what would bring them.
CLI::Validator installed_engine(bool or_all);

}  // namespace slipcheck
