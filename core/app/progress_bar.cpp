#include "app/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "app/duration_text.h"

namespace slipcheck {

bool is_plain_terminal(int file_descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(file_descriptor) == 1 && (!no_colour || *no_colour == '\0');
}

ProgressBar::ProgressBar(std::string label, bool shown)
    : place_(is_plain_terminal(STDERR_FILENO) ? LinePlace::stays : LinePlace::follows),
      label_(std::move(label)) {
  if (shown) line_.emplace([this](double seconds) { return line(seconds); }, place_);
}

void ProgressBar::set(std::size_t done, std::size_t total) {
  done_ = done;
  total_ = total;
}

std::string ProgressBar::line(double seconds) const {
  const std::size_t total = total_, done = done_;
  const std::string took = duration_text(seconds) + time_left_text(seconds, done, total);
  if (place_ == LinePlace::follows) return fmt::format("{} {}/{}  {}", label_, done, total, took);
  constexpr std::size_t width = 30;
  const std::size_t filled = total > 0 ? width * done / total : 0;
  return fmt::format("{} [{:█<{}}{:·<{}}] {}/{}  {}", label_, "", filled, "", width - filled, done,
                     total, took);
}

}  // namespace slipcheck
