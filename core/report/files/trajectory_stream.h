#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/state_archive.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A trajectory that is written as it comes, never whole in memory: `stem`.xyz (extended_xyz.h), or
/// a file of VTK for each frame and their collection `stem`.pvd (vtk_files.h).
class TrajectoryStream {
 public:
  enum class Form { xyz, vtk };

  /// The scenario must outlive it; the folder is there. Nothing is written yet.
  TrajectoryStream(const Scenario& scenario, std::filesystem::path folder, std::string stem,
                   Form form);

  /// Adds a frame, which is in its file on return. Throws WriteFailure.
  void add(double time, const std::vector<BodyState>& bodies);
  /// What it goes on with: what was written after that is written again. Throws WriteFailure where
  /// what was written before is not there any more.
  void exchange(StateArchive& archive);

 private:
  void append(const std::string& text);

  const Scenario* scenario_;
  std::filesystem::path folder_;
  std::string stem_;
  Form form_;
  std::uint64_t bytes_ = 0;    ///< of extended XYZ
  std::vector<double> times_;  ///< of frames of VTK [s]
};

}  // namespace slipcheck
