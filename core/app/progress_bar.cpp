#include "app/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include "app/say.h"

namespace slipcheck {

bool is_plain_terminal(int file_descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(file_descriptor) == 1 && (!no_colour || *no_colour == '\0');
}

namespace {

/// ", about 4 min left", as if the rest went on as what is done did; empty before there is anything
/// to go by.
std::string left_text(double seconds, std::size_t done, std::size_t total) {
  if (done == 0 || done >= total || seconds < 3) return {};
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return left < 90 ? fmt::format(", about {:.0f} s left", left)
                   : fmt::format(", about {:.0f} min left", left / 60);
}

}  // namespace

ProgressBar::ProgressBar(std::string label, bool shown) : label_(std::move(label)) {
  if (!shown) return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    using namespace std::chrono_literals;
    const auto begin = std::chrono::steady_clock::now();
    std::mutex mutex;
    std::condition_variable_any stopped;
    std::unique_lock lock(mutex);
    bool drawn = false;
    auto pause = 1000ms;
    while (!stopped.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); })) {
      draw(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      drawn = true;
      pause = 200ms;
    }
    if (drawn) say("\r\x1b[K");
    std::fflush(stderr);
  });
}

ProgressBar::~ProgressBar() = default;

void ProgressBar::set(std::size_t done, std::size_t total) {
  done_ = done;
  total_ = total;
}

void ProgressBar::draw(double seconds) const {
  constexpr std::size_t width = 30;
  const std::size_t total = total_, done = done_;
  const std::size_t filled = total > 0 ? width * done / total : 0;
  say("\r\x1b[K{} [{:█<{}}{:·<{}}] {}/{}  {:.0f} s{}", label_, "", filled, "", width - filled, done,
      total, seconds, left_text(seconds, done, total));
  std::fflush(stderr);
}

}  // namespace slipcheck
