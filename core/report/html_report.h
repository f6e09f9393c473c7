#pragma once

#include <string>
#include <vector>

#include "harness/record.h"

namespace slipcheck {

/// One page over all scenes of a run: complete in itself, without scripts, and with a policy that
/// forbids it the network. `command` is what was typed to get it.
std::string html_of(const std::vector<SceneRecord>& scenes, const std::string& command);

}  // namespace slipcheck
