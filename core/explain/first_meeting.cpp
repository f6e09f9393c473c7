#include "explain/first_meeting.h"

#include <cmath>

#include "reference/events/event_solver.h"
#include "reference/initial_contacts.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

/// Keeps the last states before two bodies touch.
class UntilTouch final : public FrameSink {
 public:
  explicit UntilTouch(const Scene& scene) : scene_(&scene) {}

  void take(double time, const Frame& frame) override {
    if (found) return;
    for (const Touch& touch : frame.touches) {
      if (!is_body(touch.second) || before_.empty()) continue;
      Meeting meeting;
      meeting.first = static_cast<std::size_t>(touch.first);
      meeting.second = static_cast<std::size_t>(touch.second);
      meeting.time = time;
      meeting.a = before_[meeting.first];
      meeting.b = before_[meeting.second];
      meeting.n = scene_->to_nearest_image(meeting.b.position - meeting.a.position).normalized();
      found = meeting;
      return;
    }
    before_ = frame.bodies;
  }

  std::optional<Meeting> found;

 private:
  const Scene* scene_;
  std::vector<BodyState> before_;
};

}  // namespace

std::optional<Meeting> first_meeting(const ContactScene& scene, double limit) {
  if (scene.hard.bodies.size() < 2 || scene.hard.box) return std::nullopt;
  if (!initial_contacts(scene, scene.hard.initial).empty()) return std::nullopt;
  const ContactScene hard = with_hard_contacts(scene.hard);
  UntilTouch sink(scene.hard);
  const auto just_after = [](double time) {
    const double end = time * (1 + 1e-6) + 1e-12;
    return until_time(end);
  };
  if (runs_in_phases(hard.hard)) {
    // Frames of many bodies cost more than the events between them.
    EventSolver solver(hard.hard, hard.hard.initial);
    const double time = solver.next_collision(limit, 0);
    if (!(time <= limit)) return std::nullopt;
    const double before = time * (1 - 1e-6);
    solver.run(until_time(before), nullptr);
    solver.run(just_after(time), &sink);
    return sink.found;
  }
  const ReferenceSolver solver(hard, Compare::Reference::event);
  const double time = solver.next_collision(hard.hard.initial, 0, limit, 0);
  if (!(time <= limit)) return std::nullopt;
  solver.run(just_after(time), &sink);
  return sink.found;
}

}  // namespace slipcheck
