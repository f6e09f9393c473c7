#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/text_table.h"

namespace slipcheck {

// How verdicts look in every output.

/// "✓", "?", "✗", "⚠", "–": never colour alone.
const char* symbol_of(Verdict verdict);
/// "within", "UNDECIDED", "DEVIATES", "FAILED"; nothing where nothing is judged.
const char* word_of(Verdict verdict);
Tone tone_of(Verdict verdict);
/// A verdict in a table, of runs that are expected to do something with `word` instead.
Cell verdict_cell(Verdict verdict, const char* word);
/// Its class on the page and in the page's filters: a word without spaces.
std::string class_of(Verdict verdict);

/// How many scenes, or runs, have each verdict.
class VerdictCounts {
 public:
  void add(Verdict verdict) { ++counts_[static_cast<std::size_t>(verdict)]; }
  std::size_t of(Verdict verdict) const { return counts_[static_cast<std::size_t>(verdict)]; }
  /// "3 within", with the word for one or more of these.
  std::string text_of(Verdict verdict) const;
  /// Those that are always told, then what is not judged where there is any: "3 within, 1 deviates,
  /// 0 undecided, 0 failed, 2 not judged"; each as `text` makes it of a verdict.
  std::string list(const std::function<std::string(Verdict)>& text) const;
  std::string list() const;

 private:
  std::array<std::size_t, 5> counts_{};
};
struct AllVerdicts {
  VerdictCounts scenes;  ///< as people are told, but for those of the reference alone
  VerdictCounts runs;
  std::size_t scenes_alone = 0;  ///< of the reference alone, which came to its end
  std::size_t scene_count = 0, run_count = 0;
};
AllVerdicts count_verdicts(const std::vector<SceneRecord>& scenes);

/// Whether a scene asks for no engine and the reference came to its end.
bool is_reference_alone(const SceneRecord& scene);

/// What a scene's verdict is called: "within", "as expected", "reference alone" where it asks for
/// no engine and the reference came to its end.
std::string verdict_name(const SceneRecord& scene);

}  // namespace slipcheck
