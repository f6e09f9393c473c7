#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/findings.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {

/// An engine in one version under one profile, over all precisions, rates and scenes. Runs of which
/// something is expected are not in it: they show a trait of one engine.
struct ProfileScore {
  std::string engine, version, profile;
  bool is_naive = false;  ///< as is_naive()
  VerdictCounts runs;
  std::size_t skipped = 0;  ///< runs that it cannot do, which are undecided
  double median_error =
      std::numeric_limits<double>::quiet_NaN();  ///< of the worst phases [tolerances]

  /// Runs that it does and a tolerance asks for.
  std::size_t judged() const;
  /// Of these the share within all tolerances, in [0, 1]; NaN without any.
  double share() const;
  /// "rapier 0.21.0 default", or the profile alone.
  std::string label(bool with_engine) const;
};

/// What results come to: counts, words and findings that the terminal, the page, Markdown and JUnit
/// all tell. Verdicts of scenes are told_verdict().
struct Summary {
  AllVerdicts counts;
  std::vector<ProfileScore> scores;  ///< the largest share first, naive last
  bool has_engines = false;          ///< more than one engine or version has a score
  std::vector<Finding> worst;        ///< one of a scene at most; naive runs are not looked at
  std::size_t expected_runs = 0;     ///< of which something is expected
  std::size_t as_expected = 0;       ///< of these
  std::size_t naive_alone = 0;  ///< scenes whose told verdict is better than that of all their runs

  std::string heading;                  ///< "55 of 78 scenes not within tolerance"
  Verdict verdict = Verdict::unjudged;  ///< the worst of the scenes'
  /// "default is within all tolerances in 21 of 173 runs, tuned in 75 of 116; worst: …."; empty
  /// where nothing was judged.
  std::string finding;
  std::string naive;  ///< what is to be said of naive runs; empty without
};

/// The scenes must outlive it. `most_worst`: so many of the worst deviations.
Summary summarize(const std::vector<SceneRecord>& scenes, std::size_t most_worst = 5);

/// "4 within, 55 deviate, 0 undecided, 0 failed, 19 of the reference alone", of scenes.
std::string scenes_text(const Summary& summary);

/// A row for each score.
TextTable score_table(const Summary& summary);

}  // namespace slipcheck
