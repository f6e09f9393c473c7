#pragma once

#include <fmt/format.h>

#include <variant>

#include "base/json_fields.h"
#include "engine/message_fields.h"
#include "physics/contact/hard_contact.h"

/// The fields of contacts in messages.
namespace slipcheck {

/// A list of something for each of so many `things`.
inline void check_size(const JsonNode& list, std::size_t size, std::size_t count,
                       const char* things) {
  if (size != count)
    list.fault_alone(
        fmt::format("must have an entry for each of {} {}, has {}", count, things, size));
}

template <class Fields>
void describe(Fields& f, PowerLawRestitution& law) {
  f("coefficient", law.coefficient, kAboveZero);
  f("exponent", law.exponent, kNotBelowZero);
  f("speed", law.speed, kAboveZero);
}

template <class Fields>
void describe(Fields& f, TabulatedRestitution& table) {
  f("log_first", table.log_first);
  f("log_step", table.log_step, kAboveZero);
  f("log_odds", table.log_odds);
  f("slope", table.slope);
  if constexpr (Fields::kReads) {
    if (table.log_odds.empty()) f["log_odds"].fault("must have a point");
    check_size(f["slope"], table.slope.size(), table.log_odds.size(), "points");
  }
}

inline RestitutionLaw restitution_of(const JsonNode& node) {
  if (!node.json().is_object()) return node.number(0, 1);
  if (!node.has("log_odds")) return read_finite<PowerLawRestitution>(node);
  return read_finite<TabulatedRestitution>(node);
}

template <class Fields>
void describe_restitution(Fields& f, RestitutionLaw& restitution) {
  if constexpr (Fields::kReads)
    restitution = restitution_of(f["restitution"]);
  else
    std::visit([&](const auto& law) { f("restitution", law); }, restitution);
}

template <class Fields>
void describe(Fields& f, PairContact& pair) {
  describe_restitution(f, pair.restitution);
  f("friction", pair.friction, kNotBelowZero);
  f("tangential_restitution", pair.tangential_restitution, NumberRange{-1, 1});
}

}  // namespace slipcheck
