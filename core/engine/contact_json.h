#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "engine/fields.h"
#include "physics/contact/hard_contact.h"

/// The contacts of a scene as docs/engine-protocol.md words them. What reads throws Rubbish.
namespace slipcheck::protocol {

nlohmann::json contact_to_json(const SubstrateContact& contact);
SubstrateContact substrate_contact_from_json(const Fields& contact);

nlohmann::json pairs_to_json(std::span<const PairContact> pairs);
/// The member `key`, a list of pair contacts of any length.
std::vector<PairContact> pairs_from_json(const Fields& fields, const char* key);

}  // namespace slipcheck::protocol
