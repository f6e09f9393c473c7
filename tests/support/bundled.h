#pragma once

#include <cstdlib>
#include <string>

#include "scenario/load.h"

namespace slipcheck::test {

inline Scenario bundled(const std::string& name) {
  return load_scenario(SLIPCHECK_SOURCE_DIR "/scenarios/" + name + ".yaml");
}

/// Both workers: the program's directory holds Bullet's, its folder `faulty` the one that fails.
inline void use_test_engines() {
  setenv("SLIPCHECK_ENGINE_PATH", SLIPCHECK_BINARY_DIR ":" SLIPCHECK_BINARY_DIR "/faulty", 1);
}

}  // namespace slipcheck::test
