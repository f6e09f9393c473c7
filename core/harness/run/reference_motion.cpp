#include "harness/run/reference_motion.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "harness/observe/motion_quantities.h"
#include "harness/observe/motion_recorder.h"
#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

struct TimedTouch {
  double time;
  std::pair<int, int> pair;
};

/// When things happen in a run.
class EventTimes final : public FrameSink {
 public:
  void take(double time, const Frame& frame) override {
    if (time != time_) {
      times_.push_back(time);
    } else if (jumps(frame) && !times_.empty() && times_.back() == time) {
      times_.pop_back();
      jumps_.push_back(time);
    }
    time_ = time;
    // Bodies that lie on the substrate show it by their height.
    for (const Touch& touch : frame.touches)
      if (touch.second != kSubstrate || rises(frame, touch.first))
        touches_.push_back({time, {touch.first, touch.second}});
    last_ = frame;
  }

  const std::vector<double>& jumps() const { return jumps_; }  ///< of velocities
  const std::vector<double>& times() const { return times_; }  ///< of all else
  const std::vector<TimedTouch>& touches() const { return touches_; }

 private:
  bool jumps(const Frame& frame) const {
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const Vector3 &before = last_.bodies[i].velocity, &after = frame.bodies[i].velocity;
      if ((after - before).norm() > 1e-6 * before.norm()) return true;
    }
    return false;
  }

  static bool rises(const Frame& frame, int body) {
    return frame.bodies[static_cast<std::size_t>(body)].velocity.z() > 0;
  }

  double time_ = kNotObserved;
  std::vector<double> times_, jumps_;
  std::vector<TimedTouch> touches_;
  Frame last_;
};

/// At most so many of these rising times, those with the longest time since the one before.
std::vector<double> sparsest(const std::vector<double>& times, std::size_t most) {
  std::vector<std::size_t> order(times.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) {
    return k == 0 ? times[0] : times[k] - times[k - 1];
  });
  std::vector<double> chosen;
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) chosen.push_back(times[order[k]]);
  return chosen;
}

/// Rising instants in (0, end], the last one `end`.
std::vector<double> instants(const EventTimes& events, double end, std::size_t most) {
  const double aside = 1e-6 * end;
  std::vector<double> times = sparsest(events.times(), most / 8);
  for (const double jump : sparsest(events.jumps(), most / 4)) {
    times.push_back(jump - aside);
    times.push_back(jump + aside);
  }
  const std::size_t even = most - 2 - times.size();
  for (std::size_t k = 1; k <= even; ++k)
    times.push_back(end * static_cast<double>(k) / static_cast<double>(even + 1));
  std::ranges::sort(times);

  std::vector<double> apart;
  for (const double time : times)
    if (time - (apart.empty() ? 0 : apart.back()) > aside / 2 && time < end - aside / 2)
      apart.push_back(time);
  apart.push_back(end);
  return apart;
}

}  // namespace

RecordedMotion reference_motion(const ReferenceSolver& solver, double end) {
  const Scene& scene = solver.scene().hard;
  EventTimes events;
  solver.run(until_time(end), &events);

  RecordedMotion motion;
  motion.role = "reference";
  std::vector<double> times;
  if (end > 0) times = instants(events, end, 2 * most_frames(scene.bodies.size()));
  std::vector<std::vector<BodyState>> states = solver.states_along(times);
  states.insert(states.begin(), scene.initial);
  times.insert(times.begin(), 0);

  auto touch = events.touches().begin();
  for (std::size_t k = 0; k < states.size(); ++k) {
    MotionFrame frame;
    frame.time = times[k];
    frame.substrate = scene.motion.position(frame.time) - scene.motion.position(0);
    for (; touch != events.touches().end() && touch->time <= frame.time; ++touch)
      frame.touches.push_back(touch->pair);
    for (std::size_t i = 0; i < states[k].size(); ++i)
      if (is_on_substrate(scene, i, states[k][i]))
        frame.touches.emplace_back(static_cast<int>(i), kSubstrate);
    std::ranges::sort(frame.touches);
    const auto twice = std::ranges::unique(frame.touches);
    frame.touches.erase(twice.begin(), twice.end());
    frame.bodies = std::move(states[k]);
    motion.frames.push_back(std::move(frame));
  }
  return motion;
}

}  // namespace slipcheck
