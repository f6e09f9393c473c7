#pragma once

#include <string>
#include <vector>

#include "studies/conformance/trial.h"

namespace slipcheck {

/// A question and what to change in a worker that fails it. `ask` returns what was seen; it throws
/// Breach where the worker is wrong, NotJudged where it cannot be asked, and passes WorkerFailure
/// and Refused on.
struct Check {
  const char* name;
  const char* mend;
  std::string (*ask)(const Trial& trial);
};

/// What is said, and how it ends.
std::vector<Check> talk_checks();
std::vector<Check> setting_checks();
/// Starts, steps and what they return.
std::vector<Check> frame_checks();
/// What is asked only of a worker that says that it takes it.
std::vector<Check> takes_checks();
/// Scenes that an engine may refuse, but must not fall over.
std::vector<Check> scene_checks();
/// Where there is no doubt how a sphere moves.
std::vector<Check> motion_checks();

}  // namespace slipcheck
