#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "../support/bundled.h"
#include "harness/observe/observer.h"
#include "harness/run/reference_run.h"
#include "reference/events/event_solver.h"
#include "reference/reference_solver.h"
#include "scenario/load.h"

namespace slipcheck::test {

/// The files of all bundled scenes, by name.
inline std::vector<std::filesystem::path> bundled_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SLIPCHECK_SOURCE_DIR "/scenarios"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// One run of the reference and what it shows.
struct Played {
  ContactScene scene;
  SolvedRun run;
  std::map<std::string, double> seen;  ///< by full name, what was observed

  double operator[](const std::string& name) const {
    const auto found = seen.find(name);
    if (found == seen.end()) throw std::out_of_range(name + " was not observed");
    return found->second;
  }
  Vector3 vector(const std::string& name) const {
    return {(*this)[name + ".x"], (*this)[name + ".y"], (*this)[name + ".z"]};
  }
};

inline Played play(const Scenario& scenario, Compare::Reference asked) {
  Played played;
  played.scene = make_contact_scene(scenario);
  const ReferenceSolver solver(played.scene, asked);
  const Scene& hard = solver.scene().hard;
  Observer observer(hard, 0, speed_scale(hard, hard.initial), solver.is_resolved());
  played.run = solver.run(run_end(scenario), &observer);
  played.seen = named_values(observer.finish(played.run.end_time), body_names(scenario));
  return played;
}

inline Played play(const Scenario& scenario) { return play(scenario, scenario.compare.reference); }
inline Played play(const std::string& name) { return play(bundled(name)); }

/// The same scene until a time [s].
inline Scenario until(Scenario scenario, double time) {
  scenario.run.until = Run::Until::time;
  scenario.run.time = scenario.run.limit = time;
  return scenario;
}

}  // namespace slipcheck::test
