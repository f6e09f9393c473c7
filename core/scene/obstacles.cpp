#include "scene/obstacles.h"

#include <utility>

#include "scene/scene.h"

namespace slipcheck {

Fault fault_of(const Scenario& scenario, const std::string& path, const std::string& rule,
               const std::string& value) {
  Location location;
  for (std::string known = path; !known.empty();) {
    const auto found = scenario.locations.find(known);
    if (found != scenario.locations.end()) {
      location = found->second;
      break;
    }
    const std::size_t end = known.find_last_of(".[");
    known.resize(end == std::string::npos ? 0 : end);
  }
  return {scenario.file, location, path, rule, value};
}

void Obstacles::add(const std::string& path, const std::string& rule, const std::string& value) {
  if (!text_.empty()) text_ += '\n';
  text_ += fault_of(scenario_, path, rule, value).message();
}

void Obstacles::throw_any() const {
  if (!text_.empty()) throw Unsupported(text_);
}

}  // namespace slipcheck
