#include "report/rows/comparison_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/by_name.h"
#include "engine/engine_registry.h"
#include "harness/compare/observable_scale.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

Cell spread_cell(const EnsembleValue& ensemble, const QuantityFormat& format) {
  const std::string low = format.number(ensemble.min), high = format.number(ensemble.max);
  return {low == high ? low : low + " … " + high, Tone::plain, ensemble.min};
}

/// `counts`: the tolerance judges the run.
void add_error(const Deviation& deviation, const Dimension& dimension, bool counts,
               ComparisonRow& row) {
  row.worst = {error_text(deviation.max, deviation.absolute, dimension), Tone::plain,
               deviation.max};
  row.note = printable(deviation.reason);
  if (!deviation.tolerance || !counts) return;
  const double tolerance = *deviation.tolerance;
  row.tolerance = {tolerance_text(tolerance, deviation.absolute, dimension), Tone::plain,
                   tolerance};
  row.verdict = deviation.verdict;
  if (row.verdict == Verdict::deviates) row.worst.tone = Tone::bad;
  if (row.verdict == Verdict::undecided) return;
  const bool exact = deviation.max == 0 && tolerance == 0;
  row.severity = exact ? 0 : deviation.max / tolerance;
  // What is not shown at all is worse than any number.
  if (row.verdict == Verdict::deviates && (std::isnan(row.severity) || row.severity <= 1))
    row.severity = std::numeric_limits<double>::infinity();
}

/// Relative as errors are, where the reference tells what to.
Cell heading_cell(const SceneRecord& scene, const std::string& name, const EnsembleValue& ensemble,
                  bool absolute) {
  if (!ensemble.headings) return {};
  const double spread = ensemble.headings->spread;
  const double scale = observable_scale(scene.scenario, scene.reference.observables, name);
  const bool is_relative = !absolute && scale > 0;
  return {error_text(is_relative ? spread / scale : spread, !is_relative, dimension_of(name)),
          Tone::plain, spread};
}

/// "0.03", "4", "400": one significant digit, without a power of ten while it stays readable.
std::string one_digit(double value) {
  if (value < 9.5 || value >= 1e6) return fmt::format("{:.1g}", value);
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

}  // namespace

QuantityFormat format_for(const SceneRecord& scene, const std::string& name,
                          const EnsembleValue* ensemble) {
  double magnitude = 0;
  if (ensemble) magnitude = std::max(std::abs(ensemble->min), std::abs(ensemble->max));
  if (const UncertainValue* value = find_in(scene.reference.observables, name)) {
    // A zero with its rounding errors has no magnitude of its own; an uncertain mean has.
    const double factor = scene.reference.box ? 1 : 10;
    const bool is_zero = std::abs(value->value) <= factor * value->uncertainty;
    if (!ensemble || (!is_zero && std::abs(value->value) > 1e-4 * magnitude))
      magnitude = is_zero && std::isfinite(value->uncertainty) ? 0 : std::abs(value->value);
  }
  return QuantityFormat(magnitude, dimension_of(name));
}

std::string error_text(double error, bool absolute, const Dimension& dimension) {
  if (!absolute) return percent(error);
  return dimension.si[0] == '\0' ? plain_number(error) : quantity(error, dimension);
}

std::string tolerance_text(double tolerance, bool absolute, const Dimension& dimension) {
  if (!absolute) return plain_number(100 * tolerance) + " %";
  const QuantityFormat format(tolerance, dimension);
  const std::string number = plain_number(tolerance / format.factor());
  return format.unit().empty() ? number : number + " " + format.unit();
}

std::string closed_form_text(const ReferenceResult& reference, const std::string& name,
                             const QuantityFormat& format) {
  const double* exact = find_in(reference.closed_form, name);
  const UncertainValue* value = find_in(reference.observables, name);
  if (!exact || !value) return {};
  std::string text = fmt::format("{:.10g}", *exact / format.factor());
  if (!format.unit().empty()) text += " " + format.unit();
  const double difference = std::abs(value->value - *exact);
  if (difference == 0) return text + ", the same to the last bit";
  if (*exact == 0) return text + fmt::format(", agrees to {:.0e} absolutely", difference);
  return text + fmt::format(", agrees to {:.0e}", difference / std::abs(*exact));
}

Cell reference_cell(const SceneRecord& scene, const std::string& name,
                    const QuantityFormat& format) {
  const UncertainValue* value = find_in(scene.reference.observables, name);
  if (!value) return {"–"};
  std::string text = format.number(value->value);
  const bool is_zero = std::abs(value->value) <= 1e-9 * format.factor();
  if (!is_zero && value->uncertainty > 1e-9 * std::abs(value->value))
    text +=
        " ± " + (std::isfinite(value->uncertainty) ? one_digit(value->uncertainty / format.factor())
                                                   : std::string("∞"));
  if (!format.unit().empty()) text += " " + format.unit();
  return {text, Tone::plain, value->value};
}

std::vector<ComparisonRow> comparison_rows(const SceneRecord& scene, const EngineRecord& run,
                                           const std::vector<std::string>& names) {
  std::vector<ComparisonRow> rows;
  for (const std::string& name : names) {
    const EnsembleValue* ensemble = find_in(run.observables, name);
    const bool in_reference = scene.reference.observables.contains(name);
    const Deviation* deviation = find_in(run.errors, name);
    if (!ensemble && !in_reference && !deviation) continue;
    const QuantityFormat format = format_for(scene, name, ensemble);
    ComparisonRow row;
    row.name = name;
    row.reference = reference_cell(scene, name, format);
    row.median = row.spread = row.worst = row.tolerance = {"–"};
    if (ensemble) {
      const double median = ensemble->median;
      row.median = {in_reference ? format.number(median) : format.text(median), Tone::plain,
                    median};
      row.spread = spread_cell(*ensemble, format);
      row.headings = heading_cell(scene, name, *ensemble, deviation && deviation->absolute);
    }
    row.severity = std::numeric_limits<double>::quiet_NaN();
    if (deviation) {
      add_error(*deviation, dimension_of(name), !run.expect, row);
    } else if (!in_reference) {
      row.note = "the reference does not show it";
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ComparisonRow> most_severe(std::vector<ComparisonRow> rows, std::size_t count) {
  if (rows.size() <= count) return rows;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto severity = [&](std::size_t k) {
    return std::isnan(rows[k].severity) ? -1 : rows[k].severity;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return severity(a) > severity(b); });
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<ComparisonRow> result;
  for (std::size_t k : order) result.push_back(std::move(rows[k]));
  return result;
}

std::vector<Column> comparison_columns(std::vector<Column> whose) {
  const Column columns[] = {{"observable"},      {"reference", true}, {"median", true, 2},
                            {"min … max", true}, {"max error", true}, {"tolerance", true, 1}};
  whose.insert(whose.end(), std::begin(columns), std::end(columns));
  return whose;
}

std::vector<Cell> comparison_cells(const ComparisonRow& row, std::vector<Cell> whose) {
  const Cell cells[] = {{row.name}, row.reference, row.median,
                        row.spread, row.worst,     row.tolerance};
  whose.insert(whose.end(), std::begin(cells), std::end(cells));
  return whose;
}

TextTable comparison_table(std::vector<ComparisonRow> rows, std::size_t most) {
  const std::size_t count = rows.size();
  TextTable table{comparison_columns()};
  const bool has_headings = std::ranges::any_of(
      rows, [](const ComparisonRow& row) { return !row.headings.text.empty(); });
  if (has_headings) table.columns.push_back({"over headings", true});
  table.columns.push_back({"verdict", false, 3});
  for (const ComparisonRow& row : most_severe(std::move(rows), most)) {
    table.rows.push_back(comparison_cells(row));
    if (has_headings) table.rows.back().push_back(row.headings);
    table.rows.back().push_back(verdict_cell(row.verdict, word_of(row.verdict)));
    if (!row.note.empty()) table.notes.push_back({row.name, row.note});
  }
  if (count > most)
    table.notes.push_back({"", fmt::format("{} rows more, none more severe", count - most)});
  return table;
}

TextTable reference_table(const SceneRecord& scene, const std::vector<std::string>& names,
                          std::size_t most) {
  TextTable table{{{"observable"}, {"value", true}, {"", false, 1}}, {}, "Reference values"};
  const auto absent = absent_observables(scene);
  for (const std::string& name : names) {
    if (table.rows.size() == most) break;
    const QuantityFormat format = format_for(scene, name, nullptr);
    Cell closed_form{closed_form_text(scene.reference, name, format), Tone::faint};
    if (!closed_form.text.empty()) {
      closed_form.value = *find_in(scene.reference.closed_form, name);
      table.columns[2].header = "closed form";
    }
    if (const std::string* reason = find_in(absent, name)) closed_form.text = *reason;
    table.rows.push_back({{name}, reference_cell(scene, name, format), closed_form});
  }
  return table;
}

std::string run_name(const EngineRecord& run) {
  const std::string version = run.version.empty() ? "" : " " + run.version;
  return printable(fmt::format("{}{} {}, profile {}, {}", engine_family(run.engine), version,
                               run.precision, run.profile, run.rate_text()));
}

std::string ensemble_text(const EngineRecord& run) {
  std::string text = counted(run.phases, "phase");
  if (run.headings > 1) text += fmt::format(" × {} headings", run.headings);
  return text;
}

std::string reference_summary(const ReferenceResult& reference) {
  const SolvedRun& run = reference.run;
  if (reference.left_out) return "left out";
  std::string text =
      fmt::format("{} solver, {}, ends at {}, {} of CPU time", reference.solver,
                  counted(run.collisions, "collision"), quantity(run.end_time, kTime),
                  quantity(reference.cpu_seconds, kTime, 2));
  if (reference.box) text += "; " + sampling_summary(*reference.box);
  return text;
}

std::string sampling_summary(const BoxReference& box) {
  std::string text = "means over " + counted(box.samples, "sample");
  if (box.discarded > 0) text += " after " + counted(box.discarded, "period");
  return text + (box.steady ? ", steady" : ", NOT steady") + "; ± holds the true mean with 95 %";
}

std::string step_cost(const EngineRecord& run) {
  if (run.steps == 0) return {};
  return quantity(run.cpu_seconds / static_cast<double>(run.steps), kTime, 2) + "/step";
}

std::string status_text(EngineRecord::Status status) {
  std::string text = name_of(status);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace slipcheck
