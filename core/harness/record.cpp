#include "harness/record.h"

#include <algorithm>

#include "harness/comparison.h"
#include "harness/observables.h"

namespace slipcheck {

std::vector<ExpectationResult> EngineRecord::expectations() const {
  if (!expect) return {};
  std::vector<ExpectationResult> results = expectation_results(*expect, observables);
  if (status == Status::ok) return results;
  for (ExpectationResult& result : results) {
    result.met = false;
    result.value = kNotObserved;
    result.reason = std::string("the run is ") + name_of(status);
  }
  return results;
}

bool EngineRecord::within() const {
  if (expect && expect->status) return status == *expect->status;
  if (expect) {
    const std::vector<ExpectationResult> results = expectations();
    return std::all_of(results.begin(), results.end(),
                       [](const ExpectationResult& result) { return result.met; });
  }
  return std::all_of(errors.begin(), errors.end(),
                     [](const auto& error) { return error.second.within; });
}

std::optional<Verdict> EngineRecord::verdict() const {
  const bool any_status = expect && expect->status;
  if (!any_status && status == Status::skipped) return std::nullopt;
  if (!any_status && status != Status::ok) return Verdict::failed;
  return within() ? Verdict::within : Verdict::deviates;
}

Verdict SceneRecord::verdict() const {
  Verdict worst = Verdict::within;
  for (const EngineRecord& run : runs)
    worst = std::max(worst, run.verdict().value_or(Verdict::within));
  return worst;
}

const char* name_of(EngineRecord::Status status) {
  switch (status) {
    case EngineRecord::Status::ok:
      return "ok";
    case EngineRecord::Status::unstable:
      return "unstable";
    case EngineRecord::Status::crashed:
      return "crashed";
    case EngineRecord::Status::timed_out:
      return "timed_out";
    case EngineRecord::Status::skipped:
      return "skipped";
  }
  return "";
}

const char* name_of(ExpectationResult::Statistic statistic) {
  switch (statistic) {
    case ExpectationResult::Statistic::min:
      return "min";
    case ExpectationResult::Statistic::median:
      return "median";
    case ExpectationResult::Statistic::max:
      return "max";
    case ExpectationResult::Statistic::none:
      return "none";
  }
  return "";
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::within:
      return "within";
    case Verdict::deviates:
      return "deviates";
    case Verdict::failed:
      return "failed";
  }
  return "";
}

}  // namespace slipcheck
