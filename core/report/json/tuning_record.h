#pragma once

#include <string>
#include <vector>

#include "studies/tuning/tuning.h"

namespace slipcheck {

/// A tuning with all that is told of it.
struct TuningRecord {
  std::string engine, version, precision;
  std::string start;    ///< the profile's name, or its path as the user gave it
  std::string profile;  ///< the name of the one that was made
  TuningSpace space;
  std::vector<TuningTask> tasks;
  TuningObservables observables;
  TuningGoal goal;
  std::vector<double> rates;     ///< [Hz]
  std::size_t phases = 0;        ///< of the search
  std::size_t final_phases = 0;  ///< of what is told
  std::uint64_t seed = 1;
  TuningResult result;
};

}  // namespace slipcheck
