#include "studies/stability/body_passage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "watched_runs.h"

namespace slipcheck {
namespace {

using namespace test;

TEST(BodyPassage, ACentreBelowThePlaneHasTunnelled) {
  const PreparedScene scene = falling(0.5, 0.6);
  const ReferencePath path(scene);
  OutcomeWatch watch(path, {}, 0.01);
  BodyState s = scene.contact->hard.initial[0];
  watch.begin(0, {&s, 1});
  s.position.z() = 1e-6;
  watch.take(0.01, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::accurate);
  EXPECT_NEAR(watch.phases()[0].depth, 1, 1e-3);
  EXPECT_TRUE(watch.wants_more());
  s.position.z() = -1e-6;
  watch.take(0.02, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::tunnelled);
  EXPECT_EQ(watch.phases()[0].outcome.time, 0.02);
  EXPECT_FALSE(watch.wants_more());
}

TEST(BodyPassage, APairThatPassesThroughItselfBetweenTwoFramesHasTunnelled) {
  // R = 10 mm and 5 mm: through each other where the centres come nearer than 15 − 5 = 10 mm.
  const PreparedScene scene = meeting("{model: hard, restitution: 0.9}", 0.005);
  const ReferencePath path(scene);
  for (const double off : {0.00999, 0.01001}) {
    OutcomeWatch watch(path, {}, 0.1);
    std::vector<BodyState> s = path.states().front();
    s[1].position = Vector3(0.045, off, s[0].position.z());
    watch.begin(0, s);
    std::swap(s[0].position.x(), s[1].position.x());
    watch.take(0.1, frame_of(s));
    EXPECT_EQ(outcome_of(watch), off < 0.01 ? Outcome::tunnelled : Outcome::accurate);
    EXPECT_NEAR(watch.phases()[0].depth, (0.015 - off) / 0.005, 1e-9);
  }
}

TEST(BodyPassage, ACollisionInsideAStepIsNoTunnelling) {
  EXPECT_EQ(outcome_of(parted(ReferencePath(meeting()), -0.19)), Outcome::accurate);
  const PreparedScene scene = meeting();
  const ReferencePath path(scene);
  // From one frame to the next they meet and are as far apart as before.
  const WatchedPhase phase = parted(path, -0.19, 15).phases()[0];
  EXPECT_EQ(phase.outcome.outcome, Outcome::accurate);
  EXPECT_EQ(phase.depth, 0);
}

TEST(BodyPassage, AnOverlapThatTheReferenceHasTooIsNone) {
  // g √(m̄/k) = 2 m/s √(0.5 kg/8e4 N/m) = 5 mm; deeper by the radius is where the centres are 5 mm
  // apart.
  const PreparedScene scene = meeting("{model: linear, restitution: 1, stiffness: 80000}");
  const ReferencePath path(scene);
  EXPECT_NEAR(path.overlap(0, 1), 0.005, 1e-8);
  EXPECT_NEAR(path.longest_contact(), M_PI * std::sqrt(0.5 / 80000), 1e-8);
  for (const double apart : {0.0051, 0.0049}) {
    OutcomeWatch watch(path, {}, 0.01);
    std::vector<BodyState> s = path.states().front();
    watch.begin(0, s);
    s[0].position.x() = -0.5 * apart;
    s[1].position.x() = 0.5 * apart;
    watch.take(0.01, frame_of(s));
    EXPECT_EQ(outcome_of(watch), apart > 0.005 ? Outcome::accurate : Outcome::tunnelled);
  }
}

TEST(BodyPassage, APairThatCreepsTogetherIsFoundInTime) {
  // Both come nearer by a fifth of a radius a frame, and from a distance beyond what is looked at
  // first: who counts only one frame's way, or only one body's, never looks again.
  const PreparedScene scene = prepared(
      plain_scene(ball("a", "[0, 0]", "[0, 0, 0]") + ball("b", "[0.045, 0.001]", "[0, 0, 0]"),
                  "friction: 0", "{until: 1}"));
  const ReferencePath path(scene);
  OutcomeWatch watch(path, {}, 0.01);
  std::vector<BodyState> s = path.states().front();
  watch.begin(0, s);
  int frames = 0;
  // Until their centres are nearer than 2 R − R.
  while (s[1].position.x() - s[0].position.x() > 0.0105) {
    s[0].position.x() += 0.002;
    s[1].position.x() -= 0.002;
    watch.take(0.01 * ++frames, frame_of(s));
    EXPECT_LT(outcome_of(watch), Outcome::tunnelled) << frames;
    if (s[1].position.x() - s[0].position.x() < 0.0145) break;
  }
  ASSERT_GT(frames, 5);
  s[0].position.x() += 0.002;
  s[1].position.x() -= 0.002;
  watch.take(0.01 * ++frames, frame_of(s));
  EXPECT_EQ(outcome_of(watch), Outcome::tunnelled);
}

TEST(BodyPassage, NearPairsAreFoundHoweverFarTheyCome) {
  // A third ball is shot through the pair from far away in one step.
  const PreparedScene scene =
      prepared(plain_scene(ball("a", "[0, 0]", "[0, 0, 0]") + ball("b", "[1, 0]", "[0, 0, 0]") +
                               ball("c", "[5, 0.001]", "[0, 0, 0]"),
                           "friction: 0", "{until: 1}"));
  const ReferencePath path(scene);
  OutcomeWatch watch(path, {}, 0.01);
  std::vector<BodyState> s = path.states().front();
  watch.begin(0, s);
  for (int n = 1; n < 10; ++n) {  // slowly nearer, a frame at a time
    s[2].position.x() -= 0.3;
    watch.take(0.01 * n, frame_of(s));
  }
  EXPECT_LT(outcome_of(watch), Outcome::tunnelled);
  s[2].position.x() -= 1.5;
  watch.take(0.1, frame_of(s));
  EXPECT_EQ(outcome_of(watch), Outcome::tunnelled);
}

}  // namespace
}  // namespace slipcheck
