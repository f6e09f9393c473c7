#include "report/charts/heat_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace slipcheck {
namespace {

constexpr int kLevels = 64;
constexpr std::array kStops = {"#a03c00", "#eb9650", "#fafaf7", "#6eb4dc", "#005492"};

}  // namespace

int heat_level(double share) {
  return std::clamp(static_cast<int>(share * kLevels), 0, kLevels - 1);
}

double heat_share(int level) { return (level + 0.5) / kLevels; }

std::string heat_palette(bool low_is_blue) {
  std::string palette;
  for (std::size_t k = 0; k < kStops.size(); ++k)
    palette += fmt::format("{}{} '{}'", k > 0 ? ", " : "", k,
                           kStops[low_is_blue ? kStops.size() - 1 - k : k]);
  return palette;
}

}  // namespace slipcheck
