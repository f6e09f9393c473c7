#include "app/first_meeting.h"

#include <cmath>

#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

/// Keeps the last states before two bodies touch.
class UntilTouch final : public FrameSink {
 public:
  void take(double time, const Frame& frame) override {
    if (found) return;
    for (const Touch& touch : frame.touches) {
      if (touch.second == kSubstrate || before_.empty()) continue;
      Meeting meeting;
      meeting.first = static_cast<std::size_t>(touch.first);
      meeting.second = static_cast<std::size_t>(touch.second);
      meeting.time = time;
      meeting.a = before_[meeting.first];
      meeting.b = before_[meeting.second];
      meeting.n = (meeting.b.position - meeting.a.position).normalized();
      found = meeting;
      return;
    }
    before_ = frame.bodies;
  }

  std::optional<Meeting> found;

 private:
  std::vector<BodyState> before_;
};

}  // namespace

std::optional<Meeting> first_meeting(const ContactScene& scene, double limit) {
  if (scene.hard.bodies.size() < 2) return std::nullopt;
  const ContactScene hard = with_hard_contacts(scene.hard);
  const ReferenceSolver solver(hard, Compare::Reference::event);
  const double time = solver.next_collision(hard.hard.initial, 0, limit, 0);
  if (!(time <= limit)) return std::nullopt;
  UntilTouch sink;
  const double end = time * (1 + 1e-6) + 1e-12;
  solver.run({Run::Until::time, end, end}, &sink);
  return sink.found;
}

}  // namespace slipcheck
