#include "report/rows/topic.h"

#include <algorithm>
#include <filesystem>

namespace slipcheck {
namespace {

constexpr std::size_t kMany = 20;  // bodies

bool is_soft(const Scenario& scenario) {
  return std::ranges::any_of(scenario.contacts, [](const BodyContact& contact) {
    return !std::holds_alternative<HardNormal>(contact.normal);
  });
}

bool expects_something(const Scenario& scenario) {
  return std::ranges::any_of(scenario.compare.engines,
                             [](const EngineRequest& engine) { return engine.expect.has_value(); });
}

std::size_t place_of(const std::string& topic) {
  const std::vector<std::string>& known = known_topics();
  return static_cast<std::size_t>(std::ranges::find(known, topic) - known.begin());
}

}  // namespace

const std::vector<std::string>& known_topics() {
  static const std::vector<std::string> topics = {"One body on still ground",
                                                  "Collisions",
                                                  "Slopes",
                                                  "Moving ground",
                                                  "Walls, belts and other surfaces",
                                                  "Blocks and cylinders",
                                                  "Contacts resolved in time",
                                                  "Many grains",
                                                  "Extreme cases",
                                                  "What engines are known to do"};
  return topics;
}

std::string topic_of(const Scenario& scenario) {
  const std::vector<std::string>& known = known_topics();
  if (expects_something(scenario)) return known[9];
  if (std::filesystem::path(scenario.file).parent_path().filename() == "extreme") return known[8];
  const auto* substrate = std::get_if<Substrate>(&scenario.surroundings);
  if (substrate == nullptr || scenario.bodies.size() >= kMany) return known[7];
  if (!scenario.surfaces.empty()) return known[4];
  if (std::ranges::any_of(scenario.bodies, [](const Body& body) { return body.extent != nullptr; }))
    return known[5];
  if (!std::holds_alternative<StillMotion>(substrate->motion)) return known[3];
  if (substrate->tilt > 0) return known[2];
  if (is_soft(scenario)) return known[6];
  return scenario.bodies.size() > 1 ? known[1] : known[0];
}

bool is_topic_before(const std::string& one, const std::string& other) {
  return place_of(one) < place_of(other);
}

}  // namespace slipcheck
