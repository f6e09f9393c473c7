#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/compare/observable_scale.h"
#include "harness/compare/record.h"

namespace slipcheck {

/// What is kept of an observable over an engine's phases.
struct BaselineSpread {
  double median = 0, min = 0, max = 0;  ///< [SI]; NaN where no phase shows it
  std::size_t missing = 0;              ///< phases that do not show it

  bool operator==(const BaselineSpread&) const = default;
};

/// What is kept of an engine at one rate on one scene.
struct BaselineRun {
  std::string engine, version, precision, profile;
  double rate = 0;           ///< [Hz], > 0
  double scale = 1;          ///< of lengths, > 0
  std::size_t headings = 1;  ///< in which each phase was run
  RunStatus status = RunStatus::skipped;
  std::optional<Verdict> verdict;  ///< none in older files, of a run that was skipped
  std::size_t phases = 0;
  double cpu_seconds = 0;  ///< of the stepping alone [s]; informs only
  /// What has a tolerance or is expected, by full name; of vectors also the components.
  std::map<std::string, BaselineSpread> observables;
};

/// What a scene gave at an earlier time.
struct SceneBaseline {
  std::string scene;       ///< its name
  std::string sha256;      ///< content_digest() of the scene; in older files of its bytes
  std::string slipcheck;   ///< version with which the numbers were made
  std::size_t phases = 0;  ///< that were asked of each ensemble, >= 1
  std::string solver;      ///< of the reference
  double cpu_seconds = 0;  ///< of the reference [s]; informs only
  ReferenceValues reference;
  std::vector<BaselineRun> runs;  ///< in the scene's order
};

/// What is kept of a scene that was just run with ensembles of `phases`. Uncertainties that are not
/// finite become NaN.
SceneBaseline baseline_of(const SceneRecord& scene, std::size_t phases,
                          const std::string& slipcheck_version);

/// "bullet double default 240 Hz"
std::string run_label(const BaselineRun& run);

}  // namespace slipcheck
