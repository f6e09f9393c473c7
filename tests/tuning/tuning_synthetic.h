#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/tuning/tuning.h"

namespace slipcheck::test {

inline SettingInfo setting(const std::string& name, const Setting& shipped) {
  SettingInfo info;
  info.name = name;
  info.shipped = shipped;
  return info;
}

/// An engine that does not exist: its errors are a formula, so that the best settings are known.
///
/// error of a task = 0.5 + kind + 2 |log10(threshold) + 3| + 8 |erp − 0.3| + joint,
/// kind = 4 unless body is multi; joint = 3, 5 with one of warm and split, 0 with both.
/// `idle` does nothing. solver b takes twice the time of a, and c half of it at an error of 1 more.
inline EngineInfo synthetic_engine() {
  EngineInfo info{"synthetic", "1", "double", {}};
  SettingInfo body = setting("body", std::string("single"));
  body.choices = {"single", "multi"};
  body.candidates = {std::string("single"), std::string("multi")};
  SettingInfo erp = setting("erp", 0.2);
  erp.candidates = {0.0, 0.2};
  erp.range = {0, 1, false};
  SettingInfo threshold = setting("threshold", 0.1);
  threshold.range = {1e-6, 1, true};
  SettingInfo solver = setting("solver", std::string("a"));
  solver.choices = {"a", "b", "c"};
  solver.candidates = {std::string("a"), std::string("b"), std::string("c")};
  info.settings = {body, erp, threshold, solver};
  for (const char* name : {"warm", "split", "idle"}) {
    SettingInfo flag = setting(name, false);
    flag.candidates = {false, true};
    info.settings.push_back(flag);
  }
  info.settings.push_back(setting("fixed", 7.0));
  return info;
}

template <class T>
T chosen(const EngineInfo& info, const Settings& settings, const std::string& name) {
  for (const SettingInfo& setting : info.settings)
    if (setting.name == name) return std::get<T>(value_of(setting, settings));
  throw std::invalid_argument(name);
}

inline RunScore synthetic_score(const Settings& settings, const TuningTask& task) {
  const EngineInfo info = synthetic_engine();
  const std::string solver = chosen<std::string>(info, settings, "solver");
  const bool warm = chosen<bool>(info, settings, "warm"),
             split = chosen<bool>(info, settings, "split");
  RunScore score;
  score.observable = "i.sliding_time";
  score.worst = 0.5 + (chosen<std::string>(info, settings, "body") == "multi" ? 0 : 4) +
                2 * std::abs(std::log10(chosen<double>(info, settings, "threshold")) + 3) +
                8 * std::abs(chosen<double>(info, settings, "erp") - 0.3) +
                (warm && split   ? 0
                 : warm || split ? 5
                                 : 3) +
                (solver == "c" ? 1 : 0) + (task.held_out ? 10 : 0);
  score.deviation = score.worst / 100;
  score.simulated_seconds = 2;
  score.cpu_seconds = task.rate * 2e-6 * (solver == "b" ? 2 : solver == "c" ? 0.5 : 1);
  return score;
}

inline TuningRuns synthetic_runs() {
  return [](const Settings& settings, std::size_t, std::span<const TuningTask* const> tasks) {
    std::vector<std::optional<RunScore>> scores;
    for (const TuningTask* task : tasks) scores.push_back(synthetic_score(settings, *task));
    return scores;
  };
}

/// Two scenes to train on and, if wanted, one held out, at 240 Hz and 1 kHz.
inline std::vector<TuningTask> synthetic_tasks(bool held_out = false) {
  std::vector<TuningTask> tasks;
  for (const char* scene : {"one", "two"})
    for (double rate : {240.0, 1000.0}) tasks.push_back({scene, scene, rate, false, 0});
  if (held_out) tasks.push_back({"three", "three", 240, true, 0});
  return tasks;
}

}  // namespace slipcheck::test
