#include "reference/contact_scene.h"

#include <algorithm>
#include <list>
#include <set>

#include "reference/contact_maker.h"
#include "reference/contact_warnings.h"
#include "scenario/scene_outline.h"

namespace slipcheck {
namespace {

/// A restitution `viscoelastic` takes a dissipation time of both materials.
void look_at(const Scenario& scenario, const ContactMaker& maker, Obstacles& obstacles) {
  if (!maker.is_viscoelastic_restitution()) return;
  const BodyContact& contact = maker.contact();
  for (const std::string& name : std::set{contact.first, contact.second}) {
    const auto material = scenario.materials.find(name);
    if (material == scenario.materials.end() || material->second.dissipation_time) continue;
    obstacles.add(contact.path + ".normal.restitution",
                  "can only be solved with materials." + name + ".dissipation_time",
                  "viscoelastic");
  }
}

}  // namespace

bool ContactScene::is_hard() const {
  return std::ranges::none_of(soft, [](const auto& contact) { return contact.has_value(); });
}

ContactScene make_contact_scene(const Scenario& scenario) {
  std::list<ContactMaker> makers;
  for (const BodyContact& contact : scenario.contacts) makers.emplace_back(scenario, contact);
  Obstacles obstacles(scenario);
  for (const ContactMaker& maker : makers) look_at(scenario, maker, obstacles);
  look_at_surroundings(scenario, obstacles);
  obstacles.throw_any();

  SceneOutline outline = make_outline(scenario);
  const std::size_t size = outline.classes.size();
  ContactScene made;
  made.soft.resize(size * size);
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = a; b < size; ++b) {
      const BodyClass& first = outline.classes[a];
      const BodyClass& second = outline.classes[b];
      const BodyContact* contact = find_contact(scenario, first.material, second.material);
      if (!contact) continue;
      ContactMaker& maker = *std::ranges::find(
          makers, contact, [](const ContactMaker& each) { return &each.contact(); });
      const ClassPair pair = class_pair(scenario, first, second);
      PairContact& hard = outline.scene.pairs[a * size + b];
      if (maker.is_soft()) {
        const SoftContact soft = maker.soft(pair);
        made.soft[a * size + b] = made.soft[b * size + a] = soft;
        hard = maker.hard_equivalent(soft, pair);
      } else {
        hard = maker.hard(pair);
      }
      outline.scene.pairs[b * size + a] = hard;
    }
  }
  for (ContactMaker& maker : makers) {
    for (std::string& warning : contact_warnings(scenario, outline, maker))
      made.warnings.push_back(std::move(warning));
  }
  made.hard = std::move(outline.scene);
  return made;
}

}  // namespace slipcheck
