#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// The run of an engine in the name of a file: "lammps-double-default-1000Hz".
std::string words_of(const EngineRecord& run);

/// What --assembly asks for.
struct AssemblyFiles {
  std::string folder;         ///< empty: nothing
  std::size_t samples = 200;  ///< of a run, >= 2
  std::string trajectory;     ///< "xyz", "vtk" or empty
  bool whole = false;         ///< nothing else is looked at, and engines are too
  bool engines_only = false;  ///< not the reference

  /// Adds them by the scenes' names, for RunOptions, and makes the folder. The scenarios are
  /// copied. Throws BadOption.
  void add_to(std::map<std::string, ReferenceExtras>& extras,
              const std::vector<Scenario>& scenarios) const;
  /// The tables of what was seen: NAME.series.csv and NAME.distributions.csv, the same of each run
  /// of an engine with its name behind the scene's, and how both compare.
  void write(const std::vector<SceneRecord>& scenes) const;
};

}  // namespace slipcheck
