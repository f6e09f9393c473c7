#include "harness/compare/contact_kinds.h"

namespace slipcheck {

std::string ContactKinds::rubbing() const {
  std::string text;
  const auto add = [&](bool has, const char* what) {
    if (has) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(impulse, "Coulomb friction with restitution beta0");
  add(viscous, "viscous up to Coulomb's cap");
  add(asperity, "asperities that bend and break");
  return text.empty() ? "the impulse is normal" : text;
}

ContactKinds contact_kinds(const std::vector<PairContact>& hard,
                           const std::vector<std::optional<SoftContact>>& soft) {
  ContactKinds kinds;
  for (std::size_t k = 0; k < hard.size(); ++k) {
    if (k < soft.size() && soft[k]) {
      kinds.any_soft = true;
      kinds.viscous |= std::holds_alternative<ViscousForce>(soft[k]->tangential);
      kinds.asperity |= std::holds_alternative<AsperityForce>(soft[k]->tangential);
      kinds.impulse |= std::holds_alternative<ImpactAngleForce>(soft[k]->tangential);
      continue;
    }
    const double* number = std::get_if<double>(&hard[k].restitution);
    kinds.impulse |= has_friction(hard[k].friction);
    kinds.speed_law |= !number;
    kinds.dissipates |= !number || *number < 1;
  }
  return kinds;
}

ContactKinds operator|(const ContactKinds& a, const ContactKinds& b) {
  return {a.any_soft || b.any_soft, a.viscous || b.viscous,     a.asperity || b.asperity,
          a.impulse || b.impulse,   a.speed_law || b.speed_law, a.dissipates || b.dissipates};
}

}  // namespace slipcheck
