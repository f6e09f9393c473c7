#pragma once

#include <fmt/format.h>

#include <utility>
#include <variant>
#include <vector>

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
void describe(Fields& f, ExponentialFriction& law) {
  f("a", law.a, kNotBelowZero);
  f("b", law.b, kNotBelowZero);
  f("c", law.c, kNotBelowZero);
}

/// Coefficients over rising speeds.
inline std::vector<RollingFriction::Point> friction_points(const JsonNode& node) {
  std::vector<RollingFriction::Point> points;
  for (const JsonNode& row : node.items()) {
    const std::vector<JsonNode> point = row.items(2);
    points.push_back({point[0].number(0), point[1].number(0)});
    if (points.size() > 1 && points.back().speed <= points[points.size() - 2].speed)
      point[0].fault("must be above the one before");
  }
  if (points.empty()) node.fault("must have a point");
  return points;
}

inline std::vector<std::pair<double, double>> rows_of(const RollingFriction& friction) {
  std::vector<std::pair<double, double>> rows;
  for (const auto& [speed, coefficient] : friction.points()) rows.emplace_back(speed, coefficient);
  return rows;
}

/// A number, a table, or the law's three numbers.
template <class Fields>
void describe_friction(Fields& f, FrictionLaw& friction) {
  if constexpr (Fields::kReads) {
    const JsonNode node = f["friction"];
    if (node.json().is_object())
      friction = read_finite<ExponentialFriction>(node);
    else if (node.json().is_array())
      friction = TabulatedFriction(friction_points(node));
    else
      friction = node.number(0);
  } else if (const auto* table = std::get_if<TabulatedFriction>(&friction)) {
    f("friction", rows_of(*table));
  } else if (auto* law = std::get_if<ExponentialFriction>(&friction)) {
    f("friction", *law);
  } else {
    f("friction", std::get<double>(friction), kNotBelowZero);
  }
}

template <class Fields>
void describe(Fields& f, PairContact& pair) {
  describe_restitution(f, pair.restitution);
  describe_friction(f, pair.friction);
  f("tangential_restitution", pair.tangential_restitution, NumberRange{-1, 1});
}

}  // namespace slipcheck
