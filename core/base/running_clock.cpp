#include "base/running_clock.h"

#include <ctime>
#include <mutex>

namespace slipcheck {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kStopped{1};
constexpr int kLeastShare = 20;  // one in so many, of a processor, where the program runs

std::chrono::nanoseconds processor_time() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

/// What the last one to ask has seen.
struct Looked {
  std::mutex mutex;
  Clock::time_point at = Clock::now();
  std::chrono::nanoseconds used = processor_time();
  Clock::duration lost{};  // while it was stopped
};

}  // namespace

Clock::time_point running_time() {
  static Looked looked;
  const std::lock_guard lock(looked.mutex);
  const auto at = Clock::now();
  const auto used = processor_time();
  const auto gap = at - looked.at;
  if (gap > kStopped && kLeastShare * (used - looked.used) < gap) looked.lost += gap;
  looked.at = at;
  looked.used = used;
  return at - looked.lost;
}

}  // namespace slipcheck
