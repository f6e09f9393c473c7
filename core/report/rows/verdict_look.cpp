#include "report/rows/verdict_look.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/rows/expectation_rows.h"
#include "report/rows/told_verdict.h"

namespace slipcheck {

namespace {

struct VerdictLook {
  const char* symbol;
  const char* word;
  Tone tone;
};
// In the order of Verdict.
constexpr std::array<VerdictLook, 5> kVerdicts = {{
    {"–", "", Tone::faint},
    {"✓", "within", Tone::good},
    {"?", "UNDECIDED", Tone::doubtful},
    {"✗", "DEVIATES", Tone::bad},
    {"⚠", "FAILED", Tone::bad},
}};

const VerdictLook& look_of(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }

}  // namespace

const char* symbol_of(Verdict verdict) { return look_of(verdict).symbol; }
const char* word_of(Verdict verdict) { return look_of(verdict).word; }
Tone tone_of(Verdict verdict) { return look_of(verdict).tone; }

Cell verdict_cell(Verdict verdict, const char* word) {
  return {.text = word, .tone = tone_of(verdict), .symbol = symbol_of(verdict)};
}

std::string class_of(Verdict verdict) {
  std::string name = name_of(verdict);
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string VerdictCounts::text_of(Verdict verdict) const {
  const std::size_t count = of(verdict);
  const bool are_many = verdict == Verdict::deviates && count != 1;
  return fmt::format("{} {}", count, are_many ? "deviate" : name_of(verdict));
}

std::string VerdictCounts::list(const std::function<std::string(Verdict)>& text) const {
  std::string result;
  for (const Verdict verdict :
       {Verdict::within, Verdict::deviates, Verdict::undecided, Verdict::failed, Verdict::unjudged})
    if (verdict != Verdict::unjudged || of(verdict) > 0)
      result += (result.empty() ? "" : ", ") + text(verdict);
  return result;
}

std::string VerdictCounts::list() const {
  return list([this](Verdict verdict) { return text_of(verdict); });
}

AllVerdicts count_verdicts(const std::vector<SceneRecord>& scenes) {
  AllVerdicts counts;
  counts.scene_count = scenes.size();
  for (const SceneRecord& scene : scenes) {
    if (is_reference_alone(scene))
      ++counts.scenes_alone;
    else
      counts.scenes.add(told_verdict(scene));
    counts.run_count += scene.runs.size();
    for (const EngineRecord& run : scene.runs) counts.runs.add(run.verdict());
  }
  return counts;
}

bool is_reference_alone(const SceneRecord& scene) {
  return scene.runs.empty() && scene.verdict() == Verdict::unjudged;
}

std::string verdict_name(const SceneRecord& scene) {
  const Verdict verdict = told_verdict(scene);
  if (is_reference_alone(scene)) return "reference alone";
  if (is_judged_by_expectations(scene) &&
      (verdict == Verdict::within || verdict == Verdict::deviates))
    return expectation_word(verdict == Verdict::within);
  return name_of(verdict);
}

}  // namespace slipcheck
