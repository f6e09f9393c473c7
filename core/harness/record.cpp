#include "harness/record.h"

#include <algorithm>

namespace slipcheck {

bool EngineRecord::within() const {
  return std::all_of(errors.begin(), errors.end(),
                     [](const auto& error) { return error.second.within; });
}

Verdict SceneRecord::verdict() const {
  using Status = EngineRecord::Status;
  Verdict verdict = Verdict::within;
  for (const EngineRecord& run : runs) {
    if (run.status == Status::skipped) continue;
    if (run.status != Status::ok) return Verdict::failed;
    if (!run.within()) verdict = Verdict::deviates;
  }
  return verdict;
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
