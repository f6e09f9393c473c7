#include <utility>

#include "scenario/record_keys.h"
#include "scenario/rules/contact_parts.h"

namespace slipcheck {
namespace {

using RollingTable = decltype(RollingLaw::table);

Rule<RollingTable> rolling_table_rule() {
  return one_form_of<RollingTable>(
      "must be a number or a table [[speed, coefficient], …]",
      {{[](const YamlNode& node) { return is_list(node); }, speed_table_rule()},
       {is_scalar, made_from<RollingTable>(number(kPureNumber, kNotNegative), [](double value) {
          return RollingTable{{0, value}};
        })}});
}

}  // namespace

Rule<RollingLaw> rolling_rule() {
  Record<RollingLaw> law;
  law.key("coefficient", &RollingLaw::table, rolling_table_rule(), required,
          "μ_r, or a table of it over the speed")
      .key("while_sliding", &RollingLaw::while_sliding, boolean(), optional,
           "whether it acts on a sliding body too");
  return one_form_of<RollingLaw>(
      "must be a number, a table [[speed, coefficient], …] or {coefficient: …}",
      {{is_mapping, law.rule()},
       {[](const YamlNode& node) { return is_scalar(node) || is_list(node); },
        made_from<RollingLaw>(rolling_table_rule(), [](RollingTable table) {
          return RollingLaw{std::move(table), false};
        })}});
}

Rule<Drilling> drilling_rule() {
  using Radius = std::optional<double>;
  struct None {};
  struct Uncoupled {
    Radius contact_radius;
  };
  struct Coupled {
    Radius contact_radius;
  };
  const auto radius = one_form_of<Radius>(
      "must be a length or hertz",
      {{is_word("hertz"), made_from<Radius>(word({"hertz"}), [](std::size_t) { return Radius(); })},
       {is_scalar,
        made_from<Radius>(number(kLength, kPositive), [](double a) { return Radius(a); })}});
  constexpr const char* kRadiusDoc = "a_c, or hertz: from the material and the weight";
  Record<Uncoupled> uncoupled;
  uncoupled.key("contact_radius", &Uncoupled::contact_radius, radius, required, kRadiusDoc);
  Record<Coupled> coupled;
  coupled.key("contact_radius", &Coupled::contact_radius, radius, required, kRadiusDoc);

  using Model = std::variant<None, Uncoupled, Coupled>;
  const Rule<Model> model = one_of<Model>(
      "model", {alternative<Model>("none", "no torque about the vertical", Record<None>()),
                alternative<Model>("uncoupled", "constant torque, whatever the sliding", uncoupled),
                alternative<Model>("coupled", "force and torque share the friction", coupled)});
  return made_from<Drilling>(model, [](const Model& written) {
    if (const auto* free = std::get_if<Uncoupled>(&written)) {
      return Drilling{Drilling::Model::uncoupled, free->contact_radius};
    }
    if (const auto* joint = std::get_if<Coupled>(&written)) {
      return Drilling{Drilling::Model::coupled, joint->contact_radius};
    }
    return Drilling{};
  });
}

}  // namespace slipcheck
