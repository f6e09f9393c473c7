#include "report/files/assembly_csv.h"

#include <cmath>
#include <functional>

#include "harness/compare/assembly_comparison.h"
#include "report/rows/csv_rows.h"

namespace slipcheck {
std::string assembly_series_csv(const std::string& scene, const Assembly& assembly) {
  CsvRows rows({"scene", "quantity", "unit", "time", "value"});
  for (const AssemblyQuantity& column : assembly_quantities())
    for (std::size_t k = 0; k < assembly.time.size(); ++k)
      rows.add({scene, std::string(column.name), std::string(column.unit), assembly.time[k],
                column.of(assembly.states[k])});
  return rows.text();
}

std::string assembly_comparison_csv(const SceneRecord& scene) {
  CsvRows rows({"scene", "engine", "version", "precision", "profile", "rate", "quantity", "unit",
                "reference", "reference_error", "value", "error", "difference",
                "difference_error"});
  for (const EngineRecord& run : scene.runs) {
    if (!run.assembly || !scene.reference.assembly) continue;
    for (const AssemblyDifference& each :
         assembly_differences(*scene.reference.assembly, *run.assembly))
      rows.add({scene.scenario.name, run.engine, run.version, run.precision, run.profile, run.rate,
                std::string(each.quantity->name), std::string(each.quantity->unit),
                each.reference.value, each.reference.error, each.engine.value, each.engine.error,
                each.difference.value, each.difference.error});
  }
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
