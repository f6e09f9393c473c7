#include "report/files/assembly_csv.h"

#include <cmath>
#include <functional>

#include "report/rows/csv_rows.h"

namespace slipcheck {
namespace {

struct AssemblyColumn {
  const char* name;
  const char* unit;
  double (*of)(const AssemblyState& state);
};

constexpr AssemblyColumn kAssemblyColumns[] = {
    {"height", "m", [](const auto& s) { return s.height; }},
    {"kinetic_energy", "J", [](const auto& s) { return s.kinetic_energy; }},
    {"rotational_energy", "J", [](const auto& s) { return s.rotational_energy; }},
    {"weight_energy", "J", [](const auto& s) { return s.weight_energy; }},
    {"elastic_energy", "J", [](const auto& s) { return s.elastic_energy; }},
    {"contacts", "", [](const auto& s) { return static_cast<double>(s.contacts); }},
    {"coordination", "", [](const auto& s) { return s.coordination; }},
    {"coordination_of_carried", "", [](const auto& s) { return s.coordination_of_carried; }},
    {"pressure", "Pa", [](const auto& s) { return s.pressure(); }},
    {"stress.xx", "Pa", [](const auto& s) { return s.stress(0, 0); }},
    {"stress.yy", "Pa", [](const auto& s) { return s.stress(1, 1); }},
    {"stress.zz", "Pa", [](const auto& s) { return s.stress(2, 2); }},
    {"stress.xy", "Pa", [](const auto& s) { return s.stress(0, 1); }},
    {"stress.xz", "Pa", [](const auto& s) { return s.stress(0, 2); }},
    {"stress.yz", "Pa", [](const auto& s) { return s.stress(1, 2); }},
    {"temperature", "J", [](const auto& s) { return s.temperature; }},
    {"sonine", "", [](const auto& s) { return s.sonine; }},
};

}  // namespace

std::string assembly_series_csv(const std::string& scene, const Assembly& assembly) {
  CsvRows rows({"scene", "quantity", "unit", "time", "value"});
  for (const AssemblyColumn& column : kAssemblyColumns)
    for (std::size_t k = 0; k < assembly.time.size(); ++k)
      rows.add({scene, std::string(column.name), std::string(column.unit), assembly.time[k],
                column.of(assembly.states[k])});
  return rows.text();
}

std::string assembly_distributions_csv(const std::string& scene, const Assembly& assembly) {
  CsvRows rows({"scene", "distribution", "curve", "x", "density"});
  const auto add = [&](const char* distribution, const char* curve, const Histogram& histogram,
                       const std::function<double(std::size_t)>& density) {
    for (std::size_t k = 0; k < histogram.counts.size(); ++k)
      if (const double value = density(k); std::isfinite(value))
        rows.add(
            {scene, std::string(distribution), std::string(curve), histogram.middle(k), value});
  };
  const Histogram& velocity = assembly.velocity;
  const double a2 = assembly.sonine().first;
  if (std::isfinite(assembly.velocity_density(0))) {
    add("velocity", "measured", velocity,
        [&](std::size_t k) { return assembly.velocity_density(k); });
    add("velocity", "maxwell", velocity,
        [&](std::size_t k) { return Assembly::maxwell(velocity.middle(k)); });
    add("velocity", "sonine", velocity,
        [&](std::size_t k) { return Assembly::with_sonine(velocity.middle(k), a2); });
  }
  add("pairs", "measured", assembly.pairs,
      [&](std::size_t k) { return assembly.pair_correlation(k); });
  add("pairs", "ideal gas", assembly.pairs, [&](std::size_t k) {
    return std::isfinite(assembly.pair_correlation(k)) ? 1.0 : assembly.pair_correlation(k);
  });
  return rows.text();
}

}  // namespace slipcheck
