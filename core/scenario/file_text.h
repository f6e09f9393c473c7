#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace slipcheck {

inline constexpr std::size_t kMostBytes = 1 << 20;  ///< of a file

/// The bytes of a scenario or profile file. Throws BadScenario, without blocking, for what is not a
/// readable regular file of at most kMostBytes.
std::string read_file(const std::filesystem::path& file);

/// The text without a byte order mark. Throws BadScenario unless it is UTF-8 without control
/// characters other than tabs and line ends, and not empty. `content` says in messages what the
/// file holds.
std::string_view checked_text(std::string_view bytes, const std::string& file,
                              const char* content = "scene");

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace slipcheck
