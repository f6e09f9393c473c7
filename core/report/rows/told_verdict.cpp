#include "report/rows/told_verdict.h"

#include <algorithm>

namespace slipcheck {

bool is_naive(const EngineRecord& run) { return run.profile == "naive" && !run.expect; }

bool decides(const SceneRecord& scene, const EngineRecord& run) {
  return !is_naive(run) || std::ranges::all_of(scene.runs, is_naive);
}

Verdict told_verdict(const SceneRecord& scene) {
  // Where every run is judged by what is expected of it, the reference judges nothing.
  const bool by_reference =
      scene.runs.empty() || !std::ranges::all_of(scene.runs, [](const EngineRecord& run) {
        return run.expect.has_value();
      });
  const bool has_end = scene.reference.run.reached || scene.reference.left_out || !by_reference;
  Verdict worst = has_end ? Verdict::unjudged : Verdict::undecided;
  for (const EngineRecord& run : scene.runs)
    if (decides(scene, run)) worst = std::max(worst, run.verdict());
  return worst;
}

}  // namespace slipcheck
