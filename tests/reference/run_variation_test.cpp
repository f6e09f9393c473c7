#include "reference/run_variation.h"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace slipcheck {
namespace {

struct Kept final : FrameSink {
  Frame frame;
  std::vector<std::size_t> bodies;

  void take(double, const Frame& shown) override { frame = shown; }
  bool take_partial(double, const PartialFrame& shown) override {
    bodies.assign(shown.bodies.begin(), shown.bodies.end());
    frame.touches.assign(shown.touches.begin(), shown.touches.end());
    return true;
  }

  std::vector<std::tuple<int, int, double>> touches() const {
    std::vector<std::tuple<int, int, double>> all;
    for (const Touch& touch : frame.touches)
      all.emplace_back(touch.first, touch.second, touch.normal_impulse);
    return all;
  }
};

const std::vector<Touch> kTouches = {
    {0, 1, 1}, {1, 3, 2}, {0, kSubstrate, 3}, {3, surface_touch(0), 4}, {2, surface_touch(5), 5}};
/// Of four bodies: 3 stands for 0, 2 for 1. Substrate and surfaces stay what they are.
const std::vector<std::tuple<int, int, double>> kReversed = {
    {2, 3, 1}, {0, 2, 2}, {3, kSubstrate, 3}, {0, surface_touch(0), 4}, {1, surface_touch(5), 5}};

TEST(ReverseSink, NamesBodiesFromTheLastAndSurfacesAsTheyAre) {
  Kept kept;
  ReverseSink sink(kept);
  Frame frame;
  for (const double x : {0, 1, 2, 3})
    frame.bodies.push_back({{x, 0, 0}, Vector3::Zero(), Vector3::Zero()});
  frame.touches = kTouches;
  sink.take(0, frame);
  ASSERT_EQ(kept.frame.bodies.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(kept.frame.bodies[i].position.x(), 3 - static_cast<double>(i));
  EXPECT_EQ(kept.touches(), kReversed);
}

TEST(ReverseSink, DoesSoForSomeBodies) {
  Kept kept;
  ReverseSink sink(kept);
  Frame frame;
  frame.bodies.resize(4);
  sink.take(0, frame);
  const std::vector<std::size_t> bodies = {0, 2};
  EXPECT_TRUE(sink.take_partial(1, {bodies, std::vector<BodyState>(2), kTouches}));
  EXPECT_EQ(kept.bodies, (std::vector<std::size_t>{3, 1}));
  EXPECT_EQ(kept.touches(), kReversed);
}

}  // namespace
}  // namespace slipcheck
