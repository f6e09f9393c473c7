#include "studies/conformance/conformance.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "studies/conformance/checks.h"

namespace slipcheck {
namespace {

std::vector<Check> all_checks() {
  std::vector<Check> all;
  for (const auto& group : {talk_checks(), setting_checks(), frame_checks(), takes_checks(),
                            scene_checks(), motion_checks()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<Check> chosen_checks(const std::vector<std::string>& only) {
  std::vector<Check> checks = all_checks();
  std::erase_if(checks, [&](const Check& check) {
    return !only.empty() && std::ranges::find(only, check.name) == only.end();
  });
  return checks;
}

/// Whether the question is about the greeting itself, so that it can be asked without one.
bool is_about_greeting(const Check& check) {
  const std::string_view name = check.name;
  return name == "greeting" || name == "settings table";
}

ConformanceCheck answer_of(const Check& check, const Trial& trial) {
  const auto failed = [&](const char* why) {
    return ConformanceCheck{check.name, CheckVerdict::failed, why, check.mend};
  };
  const auto not_judged = [&](const std::string& why) {
    return ConformanceCheck{check.name, CheckVerdict::not_judged, why, ""};
  };
  try {
    return {check.name, CheckVerdict::passed, check.ask(trial), ""};
  } catch (const Breach& breach) {
    return failed(breach.what());
  } catch (const NotJudged& reason) {
    return not_judged(reason.what());
  } catch (const Refused& refused) {
    return not_judged(fmt::format("the engine refuses the scene: {}", refused.what()));
  } catch (const WorkerFailure& failure) {
    return failed(failure.what());
  }
}

/// Why a worker that was just started gives no answer at all; empty where it does, be it a wrong
/// one or a late one.
std::string why_no_start(const Trial& trial) {
  try {
    WorkerProcess worker = trial.process();
    worker.exchange(message_of(hello_request()));
  } catch (const WorkerFailure& failure) {
    const bool speaks = std::string_view(failure.what()).starts_with("spoke rubbish");
    if (!speaks && failure.status() == WorkerFailure::Status::crashed) return failure.what();
  }
  return {};
}

void take_names(ConformanceReport& report, const Trial& trial) {
  try {
    const EngineInfo info = trial.engine().info();
    report.engine = info.engine;
    report.version = info.version;
    report.precision = info.precision;
  } catch (const WorkerFailure&) {  // a row says why
  }
}

}  // namespace

std::size_t ConformanceReport::count(CheckVerdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(checks, verdict, &ConformanceCheck::verdict));
}

ConformanceReport check_conformance(const WorkerCommand& executable,
                                    const ConformanceOptions& options) {
  const Trial trial(executable, options.limits, options.stop);
  ConformanceReport report;
  report.executable = executable;
  report.no_start = why_no_start(trial);
  if (report.no_start.empty()) take_names(report, trial);
  const std::vector<Check> checks = chosen_checks(options.only);
  const auto not_asked = [&](const Check& check, const char* why) {
    report.checks.push_back({check.name, CheckVerdict::not_judged, why, ""});
  };
  for (const Check& check : checks) {
    if (!report.no_start.empty())
      not_asked(check, "no worker could be started");
    else if (report.engine.empty() && !is_about_greeting(check))
      not_asked(check, "the worker does not greet");
    else
      report.checks.push_back(answer_of(check, trial));
    if (options.progress) options.progress(report.checks.size(), checks.size());
  }
  return report;
}

std::vector<std::string> conformance_check_names() {
  std::vector<std::string> names;
  for (const Check& check : all_checks()) names.emplace_back(check.name);
  return names;
}

}  // namespace slipcheck
