#include <utility>

#include "scenario/record_keys.h"
#include "scenario/rules/contact_parts.h"

namespace slipcheck {

Rule<FrictionCoefficients> friction_rule() {
  const Rule<double> coefficient = number(kPureNumber, kNotNegative);
  Record<FrictionCoefficients> both;
  both.key("static", &FrictionCoefficients::static_, coefficient, required, "μ_s, at least μ_k")
      .key("kinetic", &FrictionCoefficients::kinetic, coefficient, required, "μ_k");
  return one_form_of<FrictionCoefficients>(
      "must be a number or {static: …, kinetic: …}",
      {{is_mapping, both.rule()},
       {is_scalar, made_from<FrictionCoefficients>(coefficient, [](double value) {
          return FrictionCoefficients{value, value};
        })}});
}

Rule<SpeedTable> speed_table_rule() {
  return made_from<SpeedTable>(
      list(row({{kVelocity, kNotNegative}, {kPureNumber, kNotNegative}}), 1),
      [](const std::vector<std::vector<double>>& points) {
        SpeedTable table;
        for (const auto& point : points) table.emplace_back(point[0], point[1]);
        return table;
      });
}

}  // namespace slipcheck
