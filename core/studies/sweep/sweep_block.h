#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenario/rules/rules.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {

/// More runs than any machine makes in a year, and few enough to note each of them as a bit.
inline constexpr std::uint64_t kMostSweepRuns = 100'000'000;
/// Points of a Latin hypercube or of a Sobol sequence, times the numbers of each.
inline constexpr std::size_t kMostSampled = 4'000'000;

/// What varies in a sweep: the name as it is written, in dots.
struct SweepName {
  std::string name;  ///< "contacts.0.normal.restitution", "rate", "settings.erp"
  Location location;
};

/// Numbers between two, both in one unit.
struct SweepSpan {
  double from = 0, to = 0;  ///< from < to; > 0 where logarithmic
  std::string unit;         ///< as it is written behind both, "cm/s"; empty where there is none
  bool logarithmic = false;
  bool whole = false;  ///< rounded to whole numbers
  Location location;

  /// The value at a place in [0, 1], as it could stand in the file.
  YamlPointer at(double place) const;
};

/// A part of a sweep that goes through its rows: one row at a time gives each of its names a value.
/// A sweep runs all combinations of rows of its parts.
struct SweepPart {
  std::string kind;  ///< "grid", "list", "latin_hypercube", "sobol"
  std::vector<SweepName> names;
  std::size_t count = 0;                       ///< of rows, >= 1
  std::vector<std::vector<YamlPointer>> rows;  ///< a value for each name; or else
  std::vector<SweepSpan> spans;                ///< one for each name,
  std::vector<double> cube;                    ///< and where in them, row by row, in [0, 1]

  YamlPointer value(std::size_t row, std::size_t name) const;
};

/// What stands under `sweep:`.
struct SweepBlock {
  std::vector<SweepPart> parts;
};

/// Reads the block; a grid is one part for each of its names.
Rule<SweepBlock> sweep_rule();

/// The format of scenarios with the block of a sweep, as a JSON Schema (draft-07).
nlohmann::json sweep_file_schema();

}  // namespace slipcheck
