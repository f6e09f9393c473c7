#include "report/rows/whole_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "harness/compare/assembly_comparison.h"
#include "harness/observe/energy_budget.h"

namespace slipcheck {
namespace {

/// What is shown for people; the table of the files has all.
constexpr std::string_view kShown[] = {"height",         "kinetic_energy", "rotational_energy",
                                       "elastic_energy", "coordination",   "pressure",
                                       "temperature",    "sonine"};

std::string text_of(const AssemblyMean& mean, const char* unit) {
  std::string text = fmt::format("{:.6g}", mean.value);
  if (std::isfinite(mean.error)) text += fmt::format(" ± {:.2g}", mean.error);
  return *unit == '\0' ? text : text + ' ' + unit;
}

}  // namespace

TextTable whole_table(const SceneRecord& scene, const EngineRecord& run) {
  const bool compared = scene.reference.assembly.has_value();
  TextTable table;
  table.columns = {{"over the second half"}};
  if (compared) table.columns.push_back({"reference", true});
  table.columns.push_back({run.engine, true});
  if (compared) table.columns.push_back({"difference", true});
  for (const AssemblyDifference& each :
       assembly_differences(compared ? *scene.reference.assembly : *run.assembly, *run.assembly)) {
    if (std::ranges::find(kShown, each.quantity->name) == std::end(kShown)) continue;
    const char* const unit = each.quantity->unit;
    std::vector<Cell> row = {{each.quantity->name}};
    if (compared) row.push_back({text_of(each.reference, unit)});
    row.push_back({text_of(each.engine, unit)});
    if (compared) row.push_back({text_of(each.difference, unit)});
    table.rows.push_back(std::move(row));
  }
  const EnergyBudget budget = energy_budget(*run.assembly);
  table.notes.push_back(
      {"",
       fmt::format("{} samples of {} bodies; energy {:.6g} J at the first, {:.6g} J at the last",
                   run.assembly->time.size(), run.assembly->bodies, budget.first, budget.last)});
  return table;
}

}  // namespace slipcheck
