#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace slipcheck {

/// What is in a folder, as paths that begin with it, by name; empty with `error` set where it
/// cannot be read. Throws std::bad_alloc, where an iterator of std::filesystem ends the program.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder,
                                              std::error_code& error);

}  // namespace slipcheck
