#include "app/sweep_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/duration_text.h"
#include "app/progress_bar.h"

namespace slipcheck {

SweepProgress::SweepProgress(std::uint64_t total, bool shown) : total_(total) {
  if (!shown || total == 0) return;
  line_.emplace([this](double seconds) { return line(seconds); },
                is_plain_terminal(STDERR_FILENO) ? LinePlace::stays : LinePlace::follows);
}

void SweepProgress::set(std::uint64_t done) { done_ = done; }

std::string SweepProgress::line(double seconds) const {
  const std::uint64_t done = done_;
  return fmt::format("sweep {}/{} ({:.0f} %) in {}{}", done, total_,
                     100 * static_cast<double>(done) / static_cast<double>(total_),
                     duration_text(seconds), time_left_text(seconds, done, total_));
}

}  // namespace slipcheck
