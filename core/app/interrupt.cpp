#include "app/interrupt.h"

#include <csignal>
#include <ctime>

namespace slipcheck {
namespace {

std::atomic<bool> flag{false};
std::atomic<std::time_t> first_at{0};
static_assert(std::atomic<bool>::is_always_lock_free);  // else not for a signal handler
static_assert(std::atomic<std::time_t>::is_always_lock_free);

std::time_t seconds_now() {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

extern "C" void on_interrupt(int number) {
  if (!flag.exchange(true)) {
    first_at = seconds_now();
  } else if (seconds_now() - first_at >= kPatienceAfterInterrupt) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

}  // namespace

const std::atomic<bool>& interrupted() { return flag; }

void watch_for_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

}  // namespace slipcheck
