#pragma once

#include <cstdint>
#include <string>

namespace slipcheck {

/// "45 s", "12 min", "3 h 20 min", "2 d 5 h".
std::string duration_text(double seconds);

/// ", about 4 min left", as if the rest went on as what is done in so many seconds did; empty
/// before there is anything to go by.
std::string time_left_text(double seconds, std::uint64_t done, std::uint64_t total);

}  // namespace slipcheck
