#pragma once

#include <string>

namespace slipcheck {

/// Under what circumstances results came about.
struct Context {
  std::string version;   ///< of slipcheck
  std::string commit;    ///< abbreviated, with "-modified" for changes not committed; or "unknown"
  std::string build;     ///< CMake's build type in lower case, "release"; or "unknown"
  std::string compiler;  ///< "GCC 12.2.0"
  std::string date;      ///< when first asked for, UTC, "2024-05-17T09:30:00Z"
  std::string system;    ///< "Linux 6.1.0 x86_64"
  std::string cpu;       ///< the model; or "unknown"
  unsigned cores = 0;    ///< hardware threads, 0 where unknown
};

/// The circumstances of this process, found out once.
const Context& context();

/// Whether assertions or sanitizers slow this build down, so that its times mean nothing.
bool is_debug_build();

/// What a debug build must say before it shows any time; empty for others.
std::string debug_build_warning();

}  // namespace slipcheck
