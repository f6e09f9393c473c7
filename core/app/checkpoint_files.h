#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/run/reference_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// What --checkpoint asks for: a file for each scene, which says whose state it holds and what its
/// bytes must sum up to.
///
///   slipcheck-checkpoint/1 PROGRAM SCENE BYTES SHA256\n
///
/// and then the state. PROGRAM: version, commit and build, as the numbers lie in it as in that
/// program's memory; SCENE: SHA-256 of what the scene says and how it is solved.
struct CheckpointFiles {
  std::string folder;    ///< empty: nothing is kept
  double every = 600;    ///< wall time from one to the next [s], >= 0
  bool resume = false;   ///< go on from what is there
  bool general = false;  ///< as of ReferenceSettings

  std::filesystem::path file_of(const Scenario& scenario) const;
  /// Adds them by the scenes' names, for RunOptions, and makes the folder. Throws BadOption, before
  /// anything is made, where a file is there but not to be gone on from, is of another scene or
  /// program, or is damaged.
  void add_to(std::map<std::string, ReferenceExtras>& extras,
              const std::vector<Scenario>& scenarios) const;
  /// Whether there is one to go on from.
  bool exists(const Scenario& scenario) const;
  /// Nothing of the scene is left to be gone on with.
  void remove(const Scenario& scenario) const;
};

}  // namespace slipcheck
