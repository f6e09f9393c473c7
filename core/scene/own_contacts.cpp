#include "scene/own_contacts.h"

#include <algorithm>

#include "scenario/contact_models.h"

namespace slipcheck {

OwnContacts::OwnContacts(const Scenario& scenario,
                         const std::vector<std::vector<BodyClass>>& rows) {
  rules_.file = scenario.file;
  rules_.materials = scenario.materials;
  rules_.contacts = scenario.contacts;
  rules_.locations = scenario.locations;
  for (const BodyContact& contact : rules_.contacts) contacts_.emplace_back(rules_, contact);
  for (const std::vector<BodyClass>& row : rows) materials_.push_back(row.front().material);
  for (const std::string& first : materials_)
    for (const std::string& second : materials_) {
      const BodyContact* contact = find_contact(rules_, first, second);
      const auto maker = std::ranges::find(
          contacts_, contact, [](const ContactMaker& each) { return &each.contact(); });
      makers_.push_back(maker != contacts_.end() && maker->is_soft() ? &*maker : nullptr);
    }
  // What is found once is found now.
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = a; b < rows.size(); ++b) of(a, rows[a][0].sphere, b, rows[b][0].sphere);
}

std::optional<SoftContact> OwnContacts::of(std::size_t row, const Sphere& sphere,
                                           std::size_t other_row, const Sphere& other) const {
  const ContactMaker* maker = makers_[row * materials_.size() + other_row];
  if (!maker) return std::nullopt;
  return maker->unchecked(
      class_pair(rules_, {materials_[row], sphere}, {materials_[other_row], other}));
}

}  // namespace slipcheck
