#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "harness/run/reference_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// What --checkpoint asks for: a file for the reference of each scene, NAME.checkpoint, and for
/// each run of an engine that is looked at as a whole, NAME.RUN.checkpoint. It says whose state it
/// holds and what its bytes must sum up to.
///
///   slipcheck-checkpoint/1 PROGRAM SCENE BYTES SHA256\n
///
/// and then the state. PROGRAM: version, commit and build, as the numbers lie in it as in that
/// program's memory; SCENE: SHA-256 of what the scene says and how it is solved, by which engine
/// with which settings.
struct CheckpointFiles {
  std::string folder;    ///< empty: nothing is kept
  double every = 600;    ///< wall time from one to the next [s], >= 0
  bool resume = false;   ///< go on from what is there
  bool general = false;  ///< as of ReferenceSettings

  /// That of the reference; of the run of an engine.
  std::filesystem::path file_of(const Scenario& scenario) const;
  std::filesystem::path file_of(const Scenario& scenario, const EngineRecord& run) const;
  /// Adds them by the scenes' names, for RunOptions, and makes the folder. Throws BadOption, before
  /// anything is made, where a file is there but not to be gone on from, is of another scene or
  /// program, or is damaged.
  void add_to(std::map<std::string, ReferenceExtras>& extras,
              const std::vector<Scenario>& scenarios) const;
  /// For RunOptions::keep_run, which throws the same; with the extras that they were added to.
  std::function<Checkpoints(const Scenario&, const EngineRecord&)> of_runs(
      const std::map<std::string, ReferenceExtras>& extras) const;
  /// Removes those of scenes of which nothing can go on any more, and says where the others are.
  void settle(const std::vector<SceneRecord>& scenes) const;

 private:
  /// `scene`: as it stands in the file.
  Checkpoints checkpoints(const std::filesystem::path& file, const std::string& name,
                          const std::string& scene) const;
};

}  // namespace slipcheck
