#include "scene/own_contacts.h"

#include <algorithm>

namespace slipcheck {

OwnContacts::OwnContacts(const Scenario& scenario, const SceneOutline& outline) {
  rules_.file = scenario.file;
  rules_.materials = scenario.materials;
  rules_.contacts = scenario.contacts;
  rules_.locations = scenario.locations;
  for (const BodyContact& contact : rules_.contacts) contacts_.emplace_back(rules_, contact);
  for (const std::vector<std::size_t>& row : outline.rows)
    materials_.push_back(outline.classes[row.front()].material);
  for (const std::string& first : materials_)
    for (const std::string& second : materials_) {
      const BodyContact* contact = find_contact(rules_, first, second);
      const auto maker = std::ranges::find(
          contacts_, contact, [](const ContactMaker& each) { return &each.contact(); });
      makers_.push_back(maker != contacts_.end() && maker->is_soft() ? &*maker : nullptr);
    }
  const auto first_of = [&](std::size_t row) -> const Sphere& {
    return outline.classes[outline.rows[row].front()].sphere;
  };
  for (std::size_t a = 0; a < materials_.size(); ++a)
    for (std::size_t b = a; b < materials_.size(); ++b) of(a, first_of(a), b, first_of(b));
}

std::optional<SoftContact> OwnContacts::of(std::size_t row, const Sphere& sphere,
                                           std::size_t other_row, const Sphere& other) const {
  const ContactMaker* maker = makers_[row * materials_.size() + other_row];
  if (!maker) return std::nullopt;
  return maker->unchecked({sphere, other, rules_.materials.at(materials_[row]),
                           rules_.materials.at(materials_[other_row])});
}

}  // namespace slipcheck
