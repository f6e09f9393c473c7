#include "app/duration_text.h"

#include <fmt/format.h>

#include <cmath>

namespace slipcheck {

std::string duration_text(double seconds) {
  const auto whole = [](double value) { return static_cast<std::int64_t>(std::llround(value)); };
  if (seconds < 100) return fmt::format("{} s", whole(std::ceil(seconds)));
  const std::int64_t minutes = whole(seconds / 60);
  if (minutes < 100) return fmt::format("{} min", minutes);
  if (minutes < 48 * 60) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  return fmt::format("{} d {} h", minutes / 1440, minutes % 1440 / 60);
}

std::string time_left_text(double seconds, std::uint64_t done, std::uint64_t total) {
  if (done == 0 || done >= total || seconds < 3) return {};
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return ", about " + duration_text(left) + " left";
}

}  // namespace slipcheck
