#include "base/stop_scope.h"

#include <fmt/format.h>

#include "base/running_clock.h"

namespace slipcheck {

StopScope::StopScope(const std::atomic<bool>* stop) : before_(terms()) {
  if (stop != nullptr) stop_scope::state.terms.stop = stop;
}

// Of wall time, but for that in which the program is stopped.
StopScope::StopScope(double seconds) : before_(terms()) {
  constexpr double kForever = 1e9;  // what is longer has no Clock::duration
  if (!(seconds < kForever)) return;
  const auto deadline = running_time() + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double>(seconds));
  if (deadline >= before_.deadline) return;
  stop_scope::state.terms.deadline = deadline;
  stop_scope::state.terms.seconds = seconds;
}

StopScope::StopScope(const Terms& given) : before_(terms()) { stop_scope::state.terms = given; }

StopScope::~StopScope() { stop_scope::state.terms = before_; }

StopScope::Terms StopScope::terms() { return stop_scope::state.terms; }

void stop_scope::look() {
  const StopScope::Terms& terms = state.terms;
  if (terms.stop != nullptr && *terms.stop) throw Interrupted();
  if (terms.deadline != StopScope::Clock::time_point::max() && running_time() >= terms.deadline)
    throw OutOfTime(
        fmt::format("took longer than the time limit of {:g} s (--time-limit)", terms.seconds));
}

}  // namespace slipcheck
