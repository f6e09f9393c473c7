#include "reference/steps/steps_as_events.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace slipcheck {
namespace {

using Shown = std::vector<std::tuple<int, int, double>>;

class Recorder final : public FrameSink {
 public:
  void take(double time, const Frame& frame) override {
    EXPECT_EQ(time, static_cast<double>(frames.size()));
    Shown& shown = frames.emplace_back();
    for (const Touch& t : frame.touches) shown.emplace_back(t.first, t.second, t.normal_impulse);
  }
  std::vector<Shown> frames;
};

std::vector<Shown> shown_of(const std::vector<std::vector<Touch>>& steps) {
  Recorder recorder;
  StepsAsEvents events(recorder);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    Frame frame;
    frame.touches = steps[n];
    events.take(static_cast<double>(n), frame);
  }
  return recorder.frames;
}

TEST(StepsAsEvents, ShowAContactForTwoStepsMoreWithItsLastImpulse) {
  EXPECT_EQ(shown_of({{{0, 1, 2}}, {{0, 1, 3}}, {}, {}, {}}),
            (std::vector<Shown>{{{0, 1, 2}}, {{0, 1, 3}}, {{0, 1, 3}}, {{0, 1, 3}}, {}}));
}

TEST(StepsAsEvents, ShowAContactOnceThatBeginsAnewMeanwhile) {
  EXPECT_EQ(shown_of({{{0, 1, 2}}, {}, {{0, 1, 5}}, {}}),
            (std::vector<Shown>{{{0, 1, 2}}, {{0, 1, 2}}, {{0, 1, 5}}, {{0, 1, 5}}}));
}

TEST(StepsAsEvents, ShowWhatEndedBehindWhatLastsTheLatestFirst) {
  const std::vector<Shown> shown =
      shown_of({{{0, 5, 1}, {2, 3, 1}}, {{1, 2, 1}, {2, 3, 2}}, {{3, 4, 1}, {0, 1, 1}}});
  EXPECT_EQ(shown[1], (Shown{{1, 2, 1}, {2, 3, 2}, {0, 5, 1}}));
  EXPECT_EQ(shown[2], (Shown{{3, 4, 1}, {0, 1, 1}, {1, 2, 1}, {2, 3, 2}, {0, 5, 1}}));
}

TEST(StepsAsEvents, LeaveTheSubstrateAsItIs) {
  EXPECT_EQ(shown_of({{{0, kSubstrate, 1}}, {{1, kSubstrate, 2}}}),
            (std::vector<Shown>{{{0, kSubstrate, 1}}, {{1, kSubstrate, 2}}}));
}

TEST(StepsAsEvents, GoOnFromAnArchive) {
  const std::vector<std::vector<Touch>> steps{{{0, 1, 2}, {0, kSubstrate, 1}}, {{1, 2, 3}}, {}, {}};
  const std::vector<Shown> all = shown_of(steps);
  Recorder recorder;
  std::string kept;
  {
    StepsAsEvents events(recorder);
    for (std::size_t n = 0; n < 2; ++n)
      events.take(static_cast<double>(n), {.bodies = {}, .touches = steps[n]});
    StateArchive archive;
    events.exchange(archive);
    kept = archive.take();
  }
  StepsAsEvents events(recorder);
  StateArchive archive(kept);
  events.exchange(archive);
  for (std::size_t n = 2; n < 4; ++n)
    events.take(static_cast<double>(n), {.bodies = {}, .touches = steps[n]});
  EXPECT_EQ(recorder.frames, all);
}

}  // namespace
}  // namespace slipcheck
