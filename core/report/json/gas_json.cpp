#include "report/json/gas_json.h"

#include "report/files/csv.h"
#include "report/json/common_fields.h"

namespace slipcheck {

template <class Fields>
void describe(Fields& f, Measured& measured) {
  f("value", measured.value, "the gas has none");
  f("error", measured.error, "the gas has none");
}

template <class Fields>
void describe(Fields& f, GasSample& sample) {
  f("time", sample.time);
  f("collisions_per_particle", sample.collisions);
  f("translation", sample.translation);
  f("rotation", sample.rotation);
  f("ratio", sample.ratio);
  f("a2", sample.a2);
  f.object("mean_field", [&](auto& both) {
    both("translation", sample.mean_field.translation);
    both("rotation", sample.mean_field.rotation);
  });
}

template <class Fields>
void describe(Fields& f, GasStatement& statement) {
  f("name", statement.name);
  f("measured", statement.measured);
  f("theory", statement.theory, "no closed form is at hand");
  f.if_any("source", statement.source);
}

nlohmann::ordered_json json_of(const Scenario& scenario, const GasOfScene& gas,
                               const GasOptions& options, const GasRun& run) {
  nlohmann::ordered_json json{{"schema", "slipcheck-gas/1"}};
  put_context(json);
  json["scenario"] = written(scenario);
  FieldWriter fields(json);
  const GasSetup& setup = options.setup;
  fields.object("gas", [&](auto& f) {
    f("contact", gas.contact);
    f("law", std::string(gas.law.map ? "map" : gas.law.rough() ? "rough" : "smooth"));
    f("radius", setup.sphere.radius);
    f("mass", setup.sphere.mass);
    f("dimensions", static_cast<std::size_t>(setup.dimensions));
    f("particles", setup.particles);
    f("fraction", setup.filled);
    f("speed", setup.speed);
    f("rotation", setup.rotation);
    f("seed", setup.seed);
    f("step", setup.step);
    f("cells", run.cells);
  });
  fields("collisions", run.collisions);
  fields("overtaken", run.overtaken);
  fields("statements", run.statements);
  fields("samples", run.samples);
  return json;
}

std::string gas_csv(const GasRun& run) {
  Table table;
  const auto add = [&](const char* name, auto value) {
    std::vector<double>& column = table.add(name);
    for (const GasSample& sample : run.samples) column.push_back(value(sample));
  };
  using Sample = const GasSample&;
  add("time [s]", [](Sample s) { return s.time; });
  add("collisions per particle [-]", [](Sample s) { return s.collisions; });
  add("T [J]", [](Sample s) { return s.translation.value; });
  add("T standard error [J]", [](Sample s) { return s.translation.error; });
  add("T_rot [J]", [](Sample s) { return s.rotation.value; });
  add("T_rot standard error [J]", [](Sample s) { return s.rotation.error; });
  add("T_rot/T [-]", [](Sample s) { return s.ratio.value; });
  add("T_rot/T standard error [-]", [](Sample s) { return s.ratio.error; });
  add("a_2 [-]", [](Sample s) { return s.a2.value; });
  add("a_2 standard error [-]", [](Sample s) { return s.a2.error; });
  add("T of the mean field [J]", [](Sample s) { return s.mean_field.translation; });
  add("T_rot of the mean field [J]", [](Sample s) { return s.mean_field.rotation; });
  return csv_text(table);
}

}  // namespace slipcheck
