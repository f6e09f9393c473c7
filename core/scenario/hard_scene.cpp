#include "scenario/hard_scene.h"

namespace slipcheck {
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

}  // namespace slipcheck
