#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "report/json/tuning_record.h"
#include "studies/tuning/tuning_runs.h"

namespace slipcheck {

/// The options of `slipcheck tune`.
struct TuneArguments {
  std::vector<std::string> files, held_out;
  std::string engine;
  std::string precision;                          ///< empty: usual_precision()
  std::vector<double> rates = {240, 1000, 4000};  // [Hz]
  std::vector<std::string> observables, settings;
  std::string within;  // "5%"; empty: the least error
  std::string start = "default";
  std::size_t phases = 16, final_phases = 64, workers = 0;
  std::uint64_t seed = 1;
  TuningBudget budget;
  double time_limit = 10;  // [s]
  std::string output = "tuned.yaml", journal, json;
  bool quiet = false;
};

/// Everything that a tuning needs.
struct TuneSetup {
  TuningRecord record;  ///< without its result
  std::vector<PreparedScene> scenes;
  std::string identity;  ///< of programs and versions
  std::string journal_file;
  std::unique_ptr<TuningJournal> journal;
};

/// Checks all arguments, loads and solves the scenes, asks the engine what it takes, opens the
/// journal. Throws BadOption and BadScenario before anything is written.
TuneSetup prepare_tuning(const TuneArguments& arguments);

}  // namespace slipcheck
