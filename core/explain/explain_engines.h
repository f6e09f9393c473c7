#pragma once

#include <atomic>
#include <vector>

#include "explain/explain_rows.h"
#include "harness/compare/record.h"
#include "scenario/scenario.h"
#include "scene/scene.h"

namespace slipcheck {

/// What each engine that the scenario asks for would make of the scene; takes no step. `runs` are
/// those of the scenario; what an engine says at the first of its rates stands for all. It is told
/// to `stop` by another thread or a signal; may be null.
ExplainSections explain_engines(const Scenario& scenario, const EngineScene& scene,
                                const std::vector<EngineRecord>& runs,
                                const std::atomic<bool>* stop);

}  // namespace slipcheck
