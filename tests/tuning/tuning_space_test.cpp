#include "studies/tuning/tuning_space.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "../support/refusal.h"
#include "tuning_synthetic.h"

namespace slipcheck {
namespace {

using test::synthetic_engine;

TEST(TuningSpace, VariesWhatTheEngineHasSomethingToTryFor) {
  const TuningSpace space = tuning_space(synthetic_engine(), {});
  std::vector<std::string> names;
  for (const SettingInfo& info : space.vary) names.push_back(info.name);
  EXPECT_EQ(names, (std::vector<std::string>{"body", "erp", "threshold", "solver", "warm", "split",
                                             "idle"}));
}

TEST(TuningSpace, RefusesSettingsWithNothingToTry) {
  for (const std::string name : {"fixed", "nonsense"}) {
    const std::string what = test::refusal_of<std::invalid_argument>([&] {
      tuning_space(synthetic_engine(), {}, {"erp", name});
    });
    EXPECT_NE(what.find("(body, erp, threshold, solver, warm, split, idle), got " + name),
              std::string::npos)
        << what;
  }
}

TEST(TuningSpace, TheEnginesOwnValuesGoWithoutSaying) {
  const TuningSpace space = tuning_space(synthetic_engine(), {{"erp", 0.2}, {"warm", true}});
  EXPECT_EQ(space.start, (Settings{{"warm", true}}));
}

TEST(TuningSpace, CoordinatesRunOverTheRange) {
  const TuningSpace space = tuning_space(synthetic_engine(), {});
  const SettingInfo &erp = space.vary[1], &threshold = space.vary[2];
  EXPECT_DOUBLE_EQ(coordinate(erp, 0.25), 0.25);
  EXPECT_EQ(coordinate(erp, 7), 1);
  // Half way between 1e-6 and 1 lies 1e-3, of logarithms.
  EXPECT_NEAR(coordinate(threshold, 1e-3), 0.5, 1e-15);
  EXPECT_EQ(value_at(threshold, 0.5), 1e-3);
  EXPECT_EQ(value_at(threshold, 0), 1e-6);
  EXPECT_EQ(value_at(threshold, 1), 1);
  EXPECT_EQ(value_at(erp, 0.123456), 0.1235);
  SettingInfo whole = erp;
  whole.whole = true;
  whole.range = {1, 100, false};
  EXPECT_EQ(value_at(whole, 0.5), 51);
}

TEST(TuningSpace, MovesAreTheCandidatesThatAreNotChosen) {
  const TuningSpace space = tuning_space(synthetic_engine(), {}, {"erp", "solver"});
  const auto moves = moves_from(space, {{"erp", 0.5}});
  // erp 0 and 0.2, solver b and c
  ASSERT_EQ(moves.size(), 4u);
  EXPECT_EQ(moves[1].value, Setting(0.2));
  EXPECT_EQ(moves[3].value, Setting(std::string("c")));
}

TEST(TuningSpace, SaysWhatChanged) {
  const TuningSpace space = tuning_space(synthetic_engine(), {});
  EXPECT_EQ(changes_text(space, {}, {{"warm", true}, {"body", std::string("multi")}}),
            "body multi, warm true");
  EXPECT_EQ(changes_text(space, {{"warm", true}}, {{"erp", 0.2}}), "warm false");
  EXPECT_EQ(changes_text(space, {}, {}), "nothing");
}

}  // namespace
}  // namespace slipcheck
