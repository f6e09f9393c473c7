#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/comparison_rows.h"

namespace slipcheck {

/// "bullet double tuned 240 Hz", for one line; empty parts are left out.
std::string run_label(const EngineRecord& run);

/// The deviation of a run that is the most tolerances; what it does not show at all comes after
/// everything that has a number. Nothing where no tolerance is exceeded.
std::optional<ComparisonRow> worst_deviation(const SceneRecord& scene, const EngineRecord& run);

/// "i-j.restitution: reference 0.9000, median 1.021 (0.910 … 1.098), error 0.198, tolerance 0.01",
/// with the row's note.
std::string deviation_text(const ComparisonRow& row);

/// Why a run is not within, in one line; empty where it is or nothing judges it: the status with
/// its reason, what is not as expected, the worst deviation, or what cannot be decided.
std::string finding_text(const SceneRecord& scene, const EngineRecord& run);

/// A scene's run with its worst deviation.
struct Finding {
  const SceneRecord* scene = nullptr;
  const EngineRecord* run = nullptr;
  ComparisonRow row;
};

/// The worst deviation of the runs that decide a scene's verdict, if any exceeds its tolerance.
std::optional<Finding> worst_finding(const SceneRecord& scene);

/// "i.sliding_time off by up to 10.2 %, tolerance 1 %", with the row's note.
std::string off_text(const ComparisonRow& row);

/// "asymmetric, i.sliding_time off by up to 10.2 %, tolerance 1 % (bullet double default 60 Hz)"
std::string worst_text(const Finding& finding);

/// What a scene comes to, in a sentence without its full stop: what failed, the worst deviation,
/// what is not as expected or not decided, else how near to its tolerance the worst run is; of the
/// reference alone what it did.
std::string scene_finding(const SceneRecord& scene);

/// The `most` worst, one of a scene at most, so that one bad scene does not hide the others.
std::vector<Finding> worst_findings(const std::vector<SceneRecord>& scenes, std::size_t most);

}  // namespace slipcheck
