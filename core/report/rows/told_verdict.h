#pragma once

#include "harness/compare/record.h"

namespace slipcheck {

/// Whether a run shows what comes of typing a scene's coefficients straight into an engine's
/// fields: the profile `naive`, where nothing is expected of it.
bool is_naive(const EngineRecord& run);

/// Whether a run counts for told_verdict(): a naive one only where there are no others.
bool decides(const SceneRecord& scene, const EngineRecord& run);

/// What people are told of a scene: its verdict over the runs that decide. SceneRecord::verdict(),
/// that of the result file and the exit code, is over all.
Verdict told_verdict(const SceneRecord& scene);

}  // namespace slipcheck
