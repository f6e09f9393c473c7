#pragma once

#include <cstddef>
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

/// One frame of it, named by vtk_frame_name(), and the collection of frames at these times [s].
std::string vtk_frame_of(const Scenario& scenario, double time,
                         const std::vector<BodyState>& bodies);
std::string vtk_frame_name(const std::string& stem, std::size_t frame);
std::string vtk_collection_of(const std::vector<double>& times, const std::string& stem);

}  // namespace slipcheck
