#include "scenario/hard_scene.h"

#include <string>

#include "scenario/obstacles.h"
#include "scenario/scene_outline.h"

namespace slipcheck {
namespace {

void look_at(const BodyContact& contact, Obstacles& obstacles) {
  constexpr const char* kNormalNames[] = {"hard", "linear", "hertz", "power", "viscoelastic"};
  constexpr const char* kTangentialNames[] = {"none", "viscous", "asperity", "hard"};
  const auto* normal = std::get_if<HardNormal>(&contact.normal);
  if (!normal) {
    obstacles.add(contact.path + ".normal.model", "only the normal model hard can be solved",
                  kNormalNames[contact.normal.index()]);
  } else if (std::holds_alternative<ViscoelasticRestitution>(normal->restitution)) {
    obstacles.add(contact.path + ".normal.restitution",
                  "only a number or {bridges: …} can be solved", "viscoelastic");
  }
  if (!std::holds_alternative<NoTangential>(contact.tangential) &&
      !std::holds_alternative<HardTangential>(contact.tangential)) {
    obstacles.add(contact.path + ".tangential.model",
                  "only the tangential models none and hard can be solved",
                  kTangentialNames[contact.tangential.index()]);
  }
}

}  // namespace

PairContact hard_pair(const BodyContact& contact) {
  PairContact pair;
  const auto& restitution = std::get<HardNormal>(contact.normal).restitution;
  if (const auto* law = std::get_if<BridgesRestitution>(&restitution)) {
    pair.restitution = PowerLawRestitution{law->coefficient, law->exponent, law->speed};
  } else if (const auto* number = std::get_if<double>(&restitution)) {
    pair.restitution = *number;
  }
  if (const auto* tangential = std::get_if<HardTangential>(&contact.tangential)) {
    pair.friction = tangential->friction;
    pair.tangential_restitution = tangential->tangential_restitution;
  }
  return pair;
}

HardScene make_hard_scene(const Scenario& scenario) {
  Obstacles obstacles(scenario);
  for (const BodyContact& contact : scenario.contacts) look_at(contact, obstacles);
  look_at_surroundings(scenario, obstacles);
  obstacles.throw_any();

  SceneOutline outline = make_outline(scenario);
  for (std::size_t i = 0; i < outline.scene.pairs.size(); ++i) {
    const std::size_t size = outline.classes.size();
    const BodyContact* contact = find_contact(scenario, outline.classes[i / size].material,
                                              outline.classes[i % size].material);
    if (contact) outline.scene.pairs[i] = hard_pair(*contact);
  }
  return std::move(outline.scene);
}

}  // namespace slipcheck
