#include "engine/contact_json.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace slipcheck::protocol {

using nlohmann::json;

namespace {

json to_json(const RollingFriction& rolling) {
  json table = json::array();
  for (const RollingFriction::Point& point : rolling.points()) {
    table.push_back({point.speed, point.coefficient});
  }
  return table;
}

RollingFriction rolling_from_json(const json& table, const std::string& place) {
  std::vector<RollingFriction::Point> points;
  for (const json& row : table) {
    if (!row.is_array() || row.size() != 2 || !row[0].is_number() || !row[1].is_number()) {
      throw Rubbish(fmt::format("{}: a point is not [speed, coefficient]", place));
    }
    const RollingFriction::Point point = {row[0].get<double>(), row[1].get<double>()};
    const bool in_range = std::isfinite(point.speed) && point.speed >= 0 &&
                          std::isfinite(point.coefficient) && point.coefficient >= 0;
    if (!in_range) throw Rubbish(fmt::format("{}: a point is out of range", place));
    if (!points.empty() && point.speed <= points.back().speed) {
      throw Rubbish(fmt::format("{}: the speeds do not rise", place));
    }
    points.push_back(point);
  }
  if (points.empty()) throw Rubbish(fmt::format("{} has no point", place));
  return RollingFriction(std::move(points));
}

json to_json(double restitution) { return restitution; }
json to_json(const PowerLawRestitution& law) {
  return {{"coefficient", law.coefficient}, {"exponent", law.exponent}, {"speed", law.speed}};
}
json to_json(const TabulatedRestitution& table) {
  return {{"log_first", table.log_first},
          {"log_step", table.log_step},
          {"log_odds", table.log_odds},
          {"slope", table.slope}};
}

RestitutionLaw restitution_from_json(const Fields& pair) {
  if (!pair.member("restitution").is_object()) return pair.number("restitution", 0, 1);
  const json& object = pair.object("restitution");
  const Fields law(object, pair.place_of("restitution"));
  if (!object.contains("log_odds")) {
    return PowerLawRestitution{law.number("coefficient", kTiny), law.number("exponent", 0),
                               law.number("speed", kTiny)};
  }
  TabulatedRestitution table{law.number("log_first"), law.number("log_step", kTiny),
                             law.numbers("log_odds"), law.numbers("slope")};
  if (table.log_odds.empty()) throw Rubbish(law.place_of("log_odds") + " is empty");
  if (table.slope.size() != table.log_odds.size()) {
    throw Rubbish(fmt::format("{} has {} entries for {} points", law.place_of("slope"),
                              table.slope.size(), table.log_odds.size()));
  }
  return table;
}

}  // namespace

json contact_to_json(const SubstrateContact& contact) {
  return {{"static_friction", contact.static_friction},
          {"kinetic_friction", contact.kinetic_friction},
          {"rolling", to_json(contact.rolling)},
          {"drilling_length", contact.drilling_length},
          {"coupled_radius", contact.coupled_radius},
          {"hertzian_pressure", contact.hertzian_pressure},
          {"rolling_while_sliding", contact.rolling_while_sliding},
          {"restitution", contact.restitution}};
}

SubstrateContact substrate_contact_from_json(const Fields& contact) {
  SubstrateContact out;
  out.kinetic_friction = contact.number("kinetic_friction", 0);
  out.static_friction = contact.number("static_friction", out.kinetic_friction);
  out.rolling = rolling_from_json(contact.list("rolling"), contact.place_of("rolling"));
  out.drilling_length = contact.number("drilling_length", 0);
  out.coupled_radius = contact.number("coupled_radius", 0);
  out.hertzian_pressure = contact.flag("hertzian_pressure");
  out.rolling_while_sliding = contact.flag("rolling_while_sliding");
  out.restitution = contact.number("restitution", 0, 1);
  return out;
}

json pairs_to_json(std::span<const PairContact> pairs) {
  json out = json::array();
  for (const PairContact& pair : pairs) {
    out.push_back({{"restitution",
                    std::visit([](const auto& law) { return to_json(law); }, pair.restitution)},
                   {"friction", pair.friction},
                   {"tangential_restitution", pair.tangential_restitution}});
  }
  return out;
}

std::vector<PairContact> pairs_from_json(const Fields& fields, const char* key) {
  std::vector<PairContact> pairs;
  for (const json& each : fields.list(key)) {
    const Fields pair(each, fmt::format("{}[{}]", fields.place_of(key), pairs.size()));
    pairs.push_back({restitution_from_json(pair), pair.number("friction", 0),
                     pair.number("tangential_restitution", -1, 1)});
  }
  return pairs;
}

}  // namespace slipcheck::protocol
