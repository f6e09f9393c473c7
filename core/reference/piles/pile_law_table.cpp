#include "reference/piles/pile_law_table.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace slipcheck {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

}  // namespace

PileLawTable::PileLawTable(const PileLaws& laws, const ContactScene& scene)
    : laws_(&laws), scene_(&scene), soft_(scene.soft.size(), kNone) {
  std::map<std::tuple<std::size_t, double, double, double>, std::uint32_t> kinds;
  const Scene& hard = scene.hard;
  for (std::size_t i = 0; i < hard.bodies.size(); ++i) {
    const Sphere& s = hard.bodies[i];
    const auto next = static_cast<std::uint32_t>(kinds.size());
    kind_.push_back(kinds.try_emplace({hard.material[i], s.radius, s.mass, s.shape_factor}, next)
                        .first->second);
  }
}

bool PileLawTable::renew(std::size_t needed) {
  constexpr std::size_t kSpare = 1024;
  if (table_.size() <= 4 * needed + kSpare) return false;
  table_.clear();
  numbers_.clear();
  std::ranges::fill(soft_, kNone);
  return true;
}

std::uint32_t PileLawTable::number(std::size_t body, int second) {
  if (second >= 0) {
    const auto other = static_cast<std::size_t>(second);
    if (!scene_->own && scene_->between(body, other)) {
      const Scene& hard = scene_->hard;
      std::uint32_t& soft = soft_[hard.row_of(body) * hard.row_count() + hard.row_of(other)];
      if (soft == kNone) soft = add(body, second);
      return soft;
    }
    return known((std::uint64_t{kind_[body]} << 32) | kind_[other], body, second);
  }
  // Surfaces have the last numbers, which no kind of body has.
  return known((std::uint64_t{kind_[body]} << 32) | static_cast<std::uint32_t>(second), body,
               second);
}

std::uint32_t PileLawTable::known(std::uint64_t key, std::size_t body, int second) {
  const auto [at, is_new] = numbers_.try_emplace(key, kNone);
  if (is_new) at->second = add(body, second);
  return at->second;
}

std::uint32_t PileLawTable::add(std::size_t body, int second) {
  table_.push_back(laws_->of(body, second));
  return static_cast<std::uint32_t>(table_.size() - 1);
}

}  // namespace slipcheck
