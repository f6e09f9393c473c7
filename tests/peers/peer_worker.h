#pragma once

#include <string>

#include "engine/remote_engine.h"

namespace slipcheck::test {

inline std::string peer_executable(const std::string& engine) {
  return std::string(SLIPCHECK_BINARY_DIR) + "/slipcheck-engine-" + engine + "-double";
}

/// For tests of what an engine does, not of how fast it is where other work is done beside it.
inline const WorkerLimits kPatient{.reply = 300};

}  // namespace slipcheck::test
