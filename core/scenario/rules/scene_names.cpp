#include "scenario/rules/scene_names.h"

#include <charconv>

#include "base/stop_scope.h"

namespace slipcheck {
namespace {

std::string name_of(const Fill& fill, std::int64_t number) {
  return fill.prefix + std::to_string(number);
}

/// The first number of a fill whose name is one of the other's; 0: none. Of names with a prefix in
/// common the first of the longer prefix is the smallest.
std::int64_t first_shared(const Fill& fill, const Fill& other) {
  if (other.prefix.starts_with(fill.prefix)) return number_in(fill, name_of(other, 1));
  return number_in(other, name_of(fill, 1)) > 0 ? 1 : 0;
}

}  // namespace

std::int64_t number_in(const Fill& fill, std::string_view name) {
  if (!fill.complete || !name.starts_with(fill.prefix)) return 0;
  name.remove_prefix(fill.prefix.size());
  if (name.empty() || name[0] < '1' || name[0] > '9') return 0;
  std::int64_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, fault] = std::from_chars(name.data(), end, number);
  return fault == std::errc() && rest == end && number <= fill.count ? number : 0;
}

std::optional<SceneNames::Shared> SceneNames::add(const Fill& fill) {
  if (!fill.complete) return std::nullopt;
  std::int64_t first = 0;
  const std::string* path = nullptr;
  const auto take = [&](std::int64_t number, const std::string& of) {
    if (number == 0 || (first > 0 && first <= number)) return;
    first = number;
    path = &of;
  };
  for (auto each = single_.lower_bound(fill.prefix);
       each != single_.end() && each->first.starts_with(fill.prefix); ++each)
    take(number_in(fill, each->first), each->second);
  for (const Fill* other : fills_) take(first_shared(fill, *other), other->path);
  fills_.push_back(&fill);
  if (!path) return std::nullopt;
  return Shared{name_of(fill, first), *path};
}

const std::string* SceneNames::path_of(const std::string& name) const {
  if (const auto single = single_.find(name); single != single_.end()) return &single->second;
  for (const Fill* fill : fills_)
    if (number_in(*fill, name) > 0) return &fill->path;
  return nullptr;
}

std::vector<std::string> SceneNames::joined() const {
  std::vector<std::string> names;
  for (const auto& [name, path] : single_)
    if (name.find('-') != std::string::npos) names.push_back(name);
  for (const Fill* fill : fills_) {
    if (fill->prefix.find('-') == std::string::npos) continue;
    for (std::int64_t k = 1; k <= fill->count; ++k) {
      heed_stop();
      names.push_back(name_of(*fill, k));
    }
  }
  return names;
}

}  // namespace slipcheck
