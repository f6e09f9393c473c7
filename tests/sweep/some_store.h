#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenario/load.h"
#include "studies/sweep/sweep_store.h"
#include "sweep_text.h"

namespace slipcheck::test {

inline StoreHead some_head() {
  return {"two",
          "abc",
          10,
          "slipcheck 1 (c)",
          "text",
          {{"gravity", "m/s2", "scene"}, {"rate", "Hz", "rate"}, {"settings.erp", "", "setting"}}};
}

/// What a run needs of its scene.
struct SomeRun {
  Scenario scenario;
  ReferenceResult reference;
  EngineRecord record;
  FinishedRun finished;

  explicit SomeRun(std::uint64_t run, RunStatus status = RunStatus::ok) {
    const std::string text = with_sweep("");
    scenario = parse_scenario(text.substr(0, text.find("sweep:")), "s.yaml");
    reference.observables["i.sliding_time"] = {0.5, 1e-12};
    reference.run.reached = true;
    record.engine = "bullet";
    record.version = "3.24";
    record.precision = "double";
    record.profile = "default";
    record.rate = 60 * static_cast<double>(1 + run % 2);
    record.status = status;
    record.phases = 3;
    if (status == RunStatus::ok) {
      const double value = 0.5 + 0.01 * static_cast<double>(run);
      record.observables["i.sliding_time"] = {
          value, value - 0.1, value + 0.1, {value, value - 0.1, value + 0.1}};
      record.observables["i.hops"] = {1, 1, 1, {1, 1, 1}};
      record.errors["i.sliding_time"].max = 0.2;
      record.errors["i.sliding_time"].tolerance = 0.01;
      record.errors["i.sliding_time"].verdict = Verdict::deviates;
    } else {
      record.reason = "it fell over";
    }
    finished.run = run;
    finished.scene = run / 2;
    finished.phases = 3;
    finished.parameters = {9.81, 0.2};
    finished.status = status;
    finished.reason = record.reason;
    finished.seconds = 0.25;
  }
  SomeRun(const SomeRun&) = delete;

  const FinishedRun& get() {
    finished.record = &record;
    finished.scenario = &scenario;
    finished.reference = &reference;
    return finished;
  }
};

inline void fill(const std::filesystem::path& path, const std::vector<std::uint64_t>& runs,
                 RunStatus status = RunStatus::ok) {
  SweepStore store(path, some_head());
  for (const std::uint64_t run : runs) store.add(SomeRun(run, status).get());
}

}  // namespace slipcheck::test
