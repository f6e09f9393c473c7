#include "app/sweep_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>

#include "app/progress_bar.h"
#include "app/say.h"

namespace slipcheck {

std::string duration_text(double seconds) {
  const auto whole = [](double value) { return static_cast<std::int64_t>(std::llround(value)); };
  if (seconds < 100) return fmt::format("{} s", whole(std::ceil(seconds)));
  const std::int64_t minutes = whole(seconds / 60);
  if (minutes < 100) return fmt::format("{} min", minutes);
  if (minutes < 48 * 60) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  return fmt::format("{} d {} h", minutes / 1440, minutes % 1440 / 60);
}

SweepProgress::SweepProgress(std::uint64_t total, bool shown) : total_(total) {
  if (!shown || total == 0) return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    using namespace std::chrono_literals;
    const bool in_place = is_plain_terminal(STDERR_FILENO);
    const auto pause = in_place ? 500ms : 30'000ms;
    const auto begin = std::chrono::steady_clock::now();
    std::mutex mutex;
    std::condition_variable_any stopped;
    std::unique_lock lock(mutex);
    bool drawn = false;
    while (!stopped.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); })) {
      const auto now = std::chrono::steady_clock::now();
      const std::string text = line(std::chrono::duration<double>(now - begin).count());
      if (in_place)
        say("\r\x1b[K{}", text);
      else
        say("{}\n", text);
      std::fflush(stderr);
      drawn = true;
    }
    if (drawn && in_place) say("\r\x1b[K");
    std::fflush(stderr);
  });
}

SweepProgress::~SweepProgress() = default;

void SweepProgress::set(std::uint64_t done) { done_ = done; }

std::string SweepProgress::line(double seconds) const {
  const auto done = static_cast<double>(done_.load()), total = static_cast<double>(total_);
  const std::string left =
      done > 0 ? "about " + duration_text(seconds * (total - done) / done) + " left" : "";
  return fmt::format("sweep {}/{} ({:.0f} %) in {}  {}", done_.load(), total_, 100 * done / total,
                     duration_text(seconds), left);
}

}  // namespace slipcheck
