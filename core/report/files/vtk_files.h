#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/observe/motion.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A motion as files of VTK, names and texts, which ParaView reads: the collection `stem`.pvd,
/// which knows the times, and for each frame `stem`_0000.vtp … with the bodies as points that have
/// velocity, angular_velocity, radius and body, its index from 0. All values SI.
std::vector<std::pair<std::string, std::string>> vtk_files_of(const Scenario& scenario,
                                                              const RecordedMotion& motion,
                                                              const std::string& stem);

}  // namespace slipcheck
