#include "reference/events/rate_limit.h"

#include <fmt/format.h>

namespace slipcheck {

std::string RateLimit::reason(double now) const {
  return fmt::format(
      "more than {:g} events for each body and second at {:.9g} s: inelastic collapse; "
      "run.collapse or run.most_events decides what then happens",
      most_, now);
}

}  // namespace slipcheck
