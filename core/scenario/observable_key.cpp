#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

ObservableKey without_owner(std::string_view name) {
  if (name.size() > 2 && name[name.size() - 2] == '.' &&
      kComponents.find(name.back()) != std::string_view::npos) {
    const std::string_view whole = name.substr(0, name.size() - 2);
    const ObservableName* vector = find_observable(whole);
    if (vector && vector->is_vector) return {"", whole, name.back()};
  }
  return {"", name};
}

}  // namespace

ObservableKey ObservableKey::of(std::string_view other_owner) const {
  return {other_owner, observable, component};
}

std::string ObservableKey::text() const {
  std::string all;
  all.reserve(owner.size() + 1 + observable.size() + 2);
  write(all);
  return all;
}

void ObservableKey::write(std::string& all) const {
  all = owner;
  if (!owner.empty()) all += '.';
  all += observable;
  if (component != '\0') (all += '.') += component;
}

std::array<std::string, 3> ObservableKey::components() const {
  std::array<std::string, 3> texts;
  for (std::size_t k = 0; k < texts.size(); ++k)
    texts[k] = ObservableKey{owner, observable, kComponents[k]}.text();
  return texts;
}

ObservableKey observable_key(std::string_view name) {
  const ObservableKey bare = without_owner(name);
  const std::size_t dot = name.find('.');
  if (dot == 0 || dot == std::string_view::npos || bare.component != '\0') return bare;
  return without_owner(name.substr(dot + 1)).of(name.substr(0, dot));
}

std::string pair_owner(std::string_view first, std::string_view second) {
  return std::string(first).append("-").append(second);
}

}  // namespace slipcheck
