#include "report/charts/stability_charts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/charts/plot_text.h"
#include "report/files/file_stem.h"
#include "report/rows/outcome_look.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

constexpr double kRow = 17;            // [px]
constexpr double kLeastError = 1e-17;  // smaller ones, and zero, have its colour

/// How cells of each outcome look, in the order of Outcome.
std::vector<CellLook> outcome_looks() {
  std::vector<CellLook> looks;
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    const OutcomeLook& look = look_of(outcome);
    looks.push_back({name_of(outcome), look.letter, look.fill, look.ink});
  }
  return looks;
}

/// Notes of a case's cells: of the reference, then of each method.
std::string note_of(const StabilityRow& row, const StabilityRun& run) {
  std::string note =
      fmt::format("{}: {} {} {}, {:g} Hz: {}", row.scene->scenario.name, run.record.engine,
                  run.record.precision, run.record.profile, run.record.rate, words_of(run));
  if (std::isfinite(run.worst_error))
    note +=
        fmt::format("; worst error {:.3g} tolerances, {}", run.worst_error, run.worst_observable);
  return note;
}

std::string reference_note(const StabilityCase& scene) {
  return fmt::format("{}: reference {}{}{}", scene.scenario.name, word_of(scene.reference),
                     scene.reference.why.empty() ? "" : ": ", scene.reference.why);
}

std::string axis_label(Limit::Kind kind) {
  switch (kind) {
    case Limit::Kind::stable_step:
    case Limit::Kind::accurate_step:
      return "step [s]";
    case Limit::Kind::length_scale:
      return "factor on all lengths [-]";
    case Limit::Kind::mass_ratio:
      return "ratio of masses [-]";
  }
  return "";
}

/// Where the limit's bar changes its colour; at the bad end of the range where all is good.
double border_of(const Limit& limit, bool works_above) {
  if (limit.good && limit.bad) return std::sqrt(*limit.good * *limit.bad);
  return works_above == limit.good.has_value() ? limit.low : limit.high;
}

std::string short_text(const Limit& limit) {
  return limit.good && limit.bad ? value_text(limit.kind, limit.value())
         : limit.good            ? "all"
         : limit.bad             ? "none"
                                 : "no answer";
}

std::string note_of(const Limit& limit) {
  std::vector<std::string> lines = {fmt::format("limit: {}", short_text(limit))};
  const auto tell = [&](const char* what, const std::optional<double>& value) {
    if (value) lines.push_back(fmt::format("{}: {}", what, value_text(limit.kind, *value)));
  };
  tell("last good", limit.good);
  tell("first bad", limit.bad);
  if (limit.bad) lines.back() += fmt::format(", {}", name_of(limit.beyond));
  tell("theory", limit.theory);
  lines.push_back(fmt::format("searched {} to {}", value_text(limit.kind, limit.low),
                              value_text(limit.kind, limit.high)));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

Chart catalogue_chart(const std::vector<StabilityCase>& cases, std::set<std::string>& taken) {
  const StabilityOverview overview = overview_of(cases);
  Panel panel;
  panel.looks = outcome_looks();
  panel.x.names = {"reference"};
  for (const StabilityMethod& method : overview.methods)
    panel.x.names.push_back(plot_literal(method.label()));
  const auto add = [&](std::size_t row, std::size_t column, Outcome outcome, std::string note) {
    const auto x = static_cast<double>(column), y = static_cast<double>(row);
    panel.cells.push_back(
        {x - 0.5, x + 0.5, y - 0.5, y + 0.5, static_cast<std::size_t>(outcome), std::move(note)});
  };
  for (std::size_t r = 0; r < overview.rows.size(); ++r) {
    const StabilityRow& row = overview.rows[r];
    panel.y.names.push_back(plot_literal(row.label));
    add(r, 0, outcome_of(row.scene->reference), reference_note(*row.scene));
    for (std::size_t m = 0; m < row.runs.size(); ++m)
      if (const StabilityRun* run = row.runs[m]) add(r, m + 1, run->outcome, note_of(row, *run));
  }
  const double height = kRow * static_cast<double>(overview.rows.size());
  return {file_stem("stability-catalogue", taken),
          "Stiff and extreme cases",
          "How each case comes out in the reference and in each engine; a cell is an ensemble.",
          {std::move(panel)},
          1,
          height};
}

Chart limits_chart(const LimitGroup& group, std::set<std::string>& taken) {
  const bool works_above = group.kind == Limit::Kind::length_scale;
  const std::string title = fmt::format("{}, {}", words_of(group.kind), plot_literal(group.scene));
  Panel panel{title, {axis_label(group.kind), true}, {}};
  panel.looks = outcome_looks();
  // What is stable need not be accurate.
  const std::size_t works = panel.looks.size();
  panel.looks.push_back({"works", "✓", "#0072b2", "#ffffff"});
  Curve theory{"theory", {Ink::black, Line::solid, Marker::none, true}, {}, {}};
  Curve islands{"bad all the same", {Ink::vermilion, Line::none, Marker::diamond}, {}, {}};
  double low = INFINITY, high = 0;
  for (std::size_t k = 0; k < group.limits.size(); ++k) {
    const Limit& limit = *group.limits[k];
    const auto row = static_cast<double>(k);
    panel.y.names.push_back(
        plot_literal(fmt::format("{}: {}", label_of(limit), short_text(limit))));
    if (limit.low > 0) low = std::min(low, limit.low);
    high = std::max(high, limit.high);
    const auto add = [&](double from, double to, bool is_good) {
      if (to > from)
        panel.cells.push_back({from, to, row - 0.35, row + 0.35,
                               is_good ? works : static_cast<std::size_t>(limit.beyond),
                               note_of(limit)});
    };
    if (limit.good || limit.bad) {
      const double border = border_of(limit, works_above);
      add(limit.low, border, !works_above);
      add(border, limit.high, works_above);
    }
    if (limit.theory)
      for (const double y : {row - 0.45, row + 0.45, kNotObserved}) {
        theory.x.push_back(*limit.theory);
        theory.y.push_back(y);
      }
    for (const double island : limit.islands) {
      islands.x.push_back(island);
      islands.y.push_back(row);
      islands.notes.push_back(value_text(limit.kind, island));
    }
  }
  if (high > low) {
    panel.x.low = low;
    panel.x.high = high;
  }
  if (has_point(theory)) panel.curves.push_back(std::move(theory));
  if (has_point(islands)) panel.curves.push_back(std::move(islands));
  const double height = 22 * static_cast<double>(group.limits.size());
  return {file_stem(fmt::format("limit-{}-{}", name_of(group.kind), group.scene), taken),
          title,
          "Bars: where each method works, and how it fails beyond.",
          {std::move(panel)},
          1,
          height};
}

Chart map_chart(const OutcomeMap& map, std::set<std::string>& taken) {
  const AxisSpec x{plot_literal(map.x.label), map.x.logarithmic};
  const AxisSpec y{plot_literal(map.y.label), map.y.logarithmic};
  Panel outcomes{plot_literal(map.title), x, y};
  outcomes.looks = outcome_looks();
  Panel errors{"log_{10} " + plot_literal(map.error_label), x, y};
  ColourMap colours{map.x.values, map.y.values, {}, "", 0, 1, true};
  const std::vector<double> across = cell_borders(map.x.values, map.x.logarithmic);
  const std::vector<double> up = cell_borders(map.y.values, map.y.logarithmic);
  double low = INFINITY, high = -INFINITY;
  const std::size_t columns = map.x.values.size();
  for (std::size_t k = 0; k < map.outcome.size(); ++k) {
    const std::size_t c = k % columns, r = k / columns;
    const double error = k < map.worst_error.size() ? map.worst_error[k] : kNotObserved;
    const double z = std::isfinite(error) ? std::log10(std::max(error, kLeastError)) : kNotObserved;
    colours.z.push_back(z);
    low = std::fmin(low, z);
    high = std::fmax(high, z);
    outcomes.cells.push_back(
        {across[c], across[c + 1], up[r], up[r + 1], static_cast<std::size_t>(map.outcome[k]),
         fmt::format("{}: {:.4g}\n{}: {:.4g}{}", map.x.label, map.x.values[c], map.y.label,
                     map.y.values[r],
                     std::isnan(z) ? "" : fmt::format("\n{}: {:.3g}", map.error_label, error))});
  }
  Curve theory{plot_literal(map.theory_name.empty() ? "theory" : map.theory_name),
               {Ink::black, Line::dashed, Marker::none, true},
               {},
               {}};
  for (const auto& [at_x, at_y] : map.theory) {
    theory.x.push_back(at_x);
    theory.y.push_back(at_y);
  }
  if (has_point(theory)) outcomes.curves.push_back(std::move(theory));
  Chart chart{file_stem("map-" + map.name, taken),
              plot_literal(map.title),
              "How it comes out over two parameters; letters and colours say the same.",
              {std::move(outcomes)},
              2,
              250};
  if (low <= high) {
    colours.low = std::floor(low);
    colours.high = std::max(std::ceil(high), colours.low + 1);
    errors.colours = std::move(colours);
    chart.panels.push_back(std::move(errors));
    chart.caption += " Right: the largest error of all phases, blue where it is small.";
  }
  return chart;
}

}  // namespace slipcheck
