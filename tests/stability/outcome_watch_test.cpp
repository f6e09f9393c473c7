#include "studies/stability/outcome_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../support/bundled.h"
#include "watched_runs.h"

namespace slipcheck {
namespace {

using namespace test;

TEST(OutcomeWatch, BlownOffAndNotFinite) {
  const PreparedScene scene = falling(0.5);
  const ReferencePath path(scene);
  // √(2·10·1) m/s to fall, and g t.
  EXPECT_NEAR(path.fastest(0.1), std::sqrt(20) + 1, 1e-12);
  BodyState s = scene.contact->hard.initial[0];
  OutcomeWatch watch(path, {}, 0.1);
  watch.begin(0, {&s, 1});
  s.velocity.x() = 0.999e3 * path.fastest(0.1);
  watch.take(0.1, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::energy_growing);
  s.velocity.x() = 1.001e3 * path.fastest(0.2);
  watch.take(0.2, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::exploded);
  s.velocity.x() = 0;
  watch.take(0.3, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::exploded);  // the worst stays
  s.angular_velocity.y() = NAN;
  watch.take(0.4, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::not_finite);
  EXPECT_NE(watch.phases()[0].outcome.why.find("not finite"), std::string::npos);
}

TEST(OutcomeWatch, EachRunIsForItself) {
  const PreparedScene scene = falling(0.5);
  const ReferencePath path(scene);
  OutcomeWatch watch(path, {}, 0.1);
  EXPECT_TRUE(watch.phases().empty());
  const BodyState good = scene.contact->hard.initial[0];
  BodyState bad = good;
  bad.position.z() = -1;
  watch.begin(0, {&good, 1});
  watch.take(0.1, frame_of({bad}));
  watch.begin(0.05, {&good, 1});
  EXPECT_TRUE(watch.wants_more());
  watch.take(0.5, frame_of({good}));
  EXPECT_FALSE(watch.wants_more());  // the reference ended at 0.4 s
  ASSERT_EQ(watch.phases().size(), 2u);
  EXPECT_EQ(watch.phases()[0].outcome.outcome, Outcome::tunnelled);
  EXPECT_EQ(watch.phases()[1].outcome.outcome, Outcome::accurate);
  EXPECT_EQ(watch.phases()[1].end, 0.5);
}

TEST(OutcomeWatch, TheReferenceItselfHasNoFault) {
  // Still, tilted, moved and shaken substrates; hard, soft and rubbing contacts; flight and rest.
  for (const char* name :
       {"symmetric-30cms", "symmetric-10cms", "bouncing-ball", "roll-to-rest", "slope-holds",
        "slope-up-and-back", "slope-shaken", "belt-carries", "shaker-slips", "shaker-sticks",
        "collision-on-shaker", "hertz-10cms", "overlapping", "rubbing-capped", "spin-to-rest",
        "target-at-rest", "haff-werner"}) {
    const PreparedScene scene = std::string(name) == "overlapping"
                                    ? meeting("{model: linear, restitution: 1, stiffness: 20000}")
                                    : std::move(prepare_scenes({bundled(name)}).front());
    const ReferencePath path(scene);
    for (const double rate : {60.0, 1000.0})
      for (const bool soft : {true, false}) {
        const WatchedPhase seen = reference_watched(path, rate, soft);
        EXPECT_EQ(seen.outcome.outcome, Outcome::accurate)
            << name << " at " << rate << " Hz: " << seen.outcome.why;
        // Bodies of the reference touch to rounding, and overlap as deep as it says itself, which
        // the observer knows to the curvature of the top between two of its frames.
        EXPECT_LT(seen.depth, 1e-5) << name;
        EXPECT_LT(seen.creep, 1e-6) << name;
      }
  }
}

}  // namespace
}  // namespace slipcheck
