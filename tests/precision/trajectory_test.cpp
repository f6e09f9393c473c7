#include "studies/precision/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../scenes.h"
#include "studies/precision/sampled_path.h"

namespace slipcheck {
namespace {

using test::head_on;

BodyState at(double x, double y = 0) {
  BodyState state;
  state.position = {x, y, 0};
  return state;
}

Frame frame_of(std::vector<BodyState> bodies, double part = 1) {
  Frame frame;
  frame.bodies = std::move(bodies);
  frame.part = part;
  return frame;
}

/// Two runs of one body that should be at x = 2 and 4 after the second and the fourth step.
TrajectorySamples two_runs() {
  TrajectorySamples samples;
  samples.steps = {2, 4};
  samples.centres.assign(2, {{Vector3(2, 0, 0)}, {Vector3(4, 0, 0)}});
  return samples;
}

TEST(Trajectory, LooksAtTheSampledStepsAlone) {
  const TrajectorySamples samples = two_runs();
  TrajectoryWatch watch(samples);
  // The first run is off by 0.5 at the second step and by 3-4-5 at the fourth; what it does at
  // others and inside a step does not count.
  watch.begin(0, {});
  watch.take(1, frame_of({at(77)}));
  EXPECT_TRUE(watch.wants_more());
  watch.take(1.5, frame_of({at(99)}, 0.5));
  watch.take(2, frame_of({at(2.5)}));
  watch.take(3, frame_of({at(-50)}));
  EXPECT_TRUE(watch.wants_more());
  watch.take(4, frame_of({at(1, 4)}));
  EXPECT_FALSE(watch.wants_more());
  watch.take(5, frame_of({at(1000)}));
  // The second one is right.
  watch.begin(0.5, {});
  EXPECT_TRUE(watch.wants_more());
  for (const double x : {0.0, 2.0, 0.0, 4.0}) watch.take(x, frame_of({at(x)}));
  ASSERT_EQ(watch.distances().size(), 2u);
  EXPECT_DOUBLE_EQ(watch.distances()[0], 5);
  EXPECT_EQ(watch.distances()[1], 0);
}

TEST(Trajectory, WhatIsNotFiniteStaysSo) {
  const TrajectorySamples samples = two_runs();
  TrajectoryWatch watch(samples);
  watch.begin(0, {});
  watch.take(1, frame_of({at(1)}));
  watch.take(2, frame_of({at(std::numeric_limits<double>::quiet_NaN())}));
  watch.take(3, frame_of({at(3)}));
  watch.take(4, frame_of({at(4)}));
  EXPECT_TRUE(std::isnan(watch.distances()[0]));
}

TEST(Trajectory, ErrorsAreRelativeToThePath) {
  // Over a path of 2 m: 0.5, 1, 2; the mean square is (0.25 + 1 + 4)/3.
  const std::vector<double> distances = {2, 1, 4};
  const PhaseErrors relative = trajectory_errors(distances, 2);
  EXPECT_FALSE(relative.absolute);
  EXPECT_EQ(relative.worst, 2);
  EXPECT_EQ(relative.median, 1);
  EXPECT_NEAR(relative.rms, std::sqrt(5.25 / 3), 1e-15);
  EXPECT_EQ(relative.reason, "");
  const PhaseErrors absolute = trajectory_errors(distances, 0);
  EXPECT_TRUE(absolute.absolute);
  EXPECT_EQ(absolute.worst, 4);
  const std::vector<double> broken = {1, kNotObserved};
  EXPECT_EQ(trajectory_errors(broken, 1).reason, "1 of 2 phases are not finite");
  EXPECT_EQ(trajectory_errors(broken, 1).worst, 1);
  const std::vector<double> nothing = {kNotObserved};
  EXPECT_TRUE(std::isnan(trajectory_errors(nothing, 1).worst));
}

TEST(Trajectory, LongestPathIsThatOfOneBody) {
  // The first goes 3 up and 4 across, the second 1 there and back.
  const std::vector<Centres> centres = {{Vector3(0, 0, 0), Vector3(0, 0, 0)},
                                        {Vector3(0, 3, 0), Vector3(1, 0, 0)},
                                        {Vector3(4, 3, 0), Vector3(0, 0, 0)}};
  EXPECT_DOUBLE_EQ(longest_path(centres), 7);
  EXPECT_EQ(longest_path({}), 0);
}

/// Two rolling balls that meet at 30 cm/s at 20 ms, K (38)-(44): v^f = −e v, u^f = v^f − v,
/// v^s = v^f − u^f/3.5 after t^s = |u^f|/(3.5 μ g).
struct Meeting {
  static constexpr double v = 0.15, e = 0.9, contact = 0.003 / v;
  ContactScene scene = with_hard_contacts(head_on(v, -v, e));
  ReferenceSolver solver{scene, Compare::Reference::automatic};
  double after = -e * v, slip = after - v, rolling = after - slip / 3.5;
  double sliding_time = -slip / (3.5 * 0.1 * 9.81);

  double x(double t) const {
    if (t <= contact) return -0.005 + v * t;
    const double s = std::min(t - contact, sliding_time);
    return -0.002 + after * s + 0.5 * 0.1 * 9.81 * s * s + rolling * (t - contact - s);
  }
};

TEST(Trajectory, SamplesAreWhereClosedFormsHaveThem) {
  const Meeting meeting;
  const double step = 1e-3, end = 0.13;
  const std::vector<double> starts = {0.1e-3, 0.9e-3};
  const TrajectorySamples samples = trajectory_samples(meeting.solver, end, step, starts);
  ASSERT_EQ(samples.reason, "");
  ASSERT_EQ(samples.steps.size(), 32u);
  EXPECT_EQ(samples.steps.back(), 129u);
  ASSERT_EQ(samples.centres.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t k = 0; k < 32; ++k) {
      const double t = starts[p] + static_cast<double>(samples.steps[k]) * step;
      EXPECT_LE(t, end);
      // Rounding of a few events.
      EXPECT_NEAR(samples.centres[p][k][0].x(), meeting.x(t), 1e-15);
      EXPECT_NEAR(samples.centres[p][k][1].x(), -meeting.x(t), 1e-15);
    }
}

TEST(Trajectory, ShortRunsHaveAllTheirSteps) {
  const Meeting meeting;
  const std::vector<double> starts = {0, 5e-3};
  EXPECT_EQ(trajectory_samples(meeting.solver, 0.045, 0.01, starts).steps,
            (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(trajectory_samples(meeting.solver, 0.003, 0.01, starts).steps,
            (std::vector<std::size_t>{1}));
}

TEST(Trajectory, PathOfTheReference) {
  const Meeting meeting;
  ReferenceResult reference;
  reference.run.end_time = 0.13;
  const TravelledPath path = travelled_path(meeting.solver, reference);
  ASSERT_EQ(path.centres.size(), path.times.size());
  // There, and after the collision back in one direction (v^f and v^s have one sign): the way of
  // one interval of the 512 is lost where it turns, at most.
  const double length = 0.003 + std::abs(meeting.x(0.13) + 0.002);
  EXPECT_NEAR(path.length, length, 2 * Meeting::v * 0.13 / 512);
  EXPECT_LE(path.length, length + 1e-15);
}

TEST(Trajectory, BetweenStepsTheCubicIsExactForCubics) {
  // x = t³, y = 1 − t², shown at 0, 1, 3 and asked for in between, at a step's end and after both.
  const auto state = [](double t) {
    BodyState s;
    s.position = {t * t * t, 1 - t * t, 2};
    s.velocity = {3 * t * t, -2 * t, 0};
    return s;
  };
  struct Counter final : FrameSink {
    void take(double, const Frame&) override { ++frames; }
    int frames = 0;
  } counter;
  const std::vector<double> times = {0.25, 1, 1.7, 2.9, 4};
  SampledPath path(times, &counter);
  for (const double t : {0.0, 1.0, 3.0}) path.take(t, frame_of({state(t)}));
  EXPECT_EQ(path.centres.size(), 4u);
  path.stop_telling();
  path.take(4, frame_of({state(4)}));
  EXPECT_EQ(counter.frames, 3);
  ASSERT_EQ(path.centres.size(), times.size());
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_LT((path.centres[k][0] - state(times[k]).position).norm(), 1e-13) << times[k];
}

}  // namespace
}  // namespace slipcheck
