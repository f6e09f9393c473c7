#include "report/charts/stability_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/charts/category_map.h"
#include "report/charts/figure.h"
#include "report/charts/limits_chart.h"
#include "report/charts/plot_text.h"
#include "report/charts/svg_image.h"
#include "report/files/file_stem.h"
#include "report/rows/outcome_look.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

// All in px at an image width of 760.
constexpr double kWidth = 760, kEdge = 10, kFont = 11, kRow = 15, kTopGap = 8;
constexpr double kWidestCell = 56, kSlant = 0.87;  // sine of the heads' angle, 60°
constexpr double kLegendLine = 20;
constexpr double kLeastError = 1e-17;  // smaller ones, and zero, have its colour

double widest_text(const std::vector<std::string>& texts) {
  double widest = 0;
  for (const std::string& text : texts)
    widest = std::max(widest, kFont * plot_text_width(plot_literal(text)));
  return widest;
}

/// The letters of those outcomes that occur, with their names; `y` moves on.
std::string legend_svg(const std::set<Outcome>& outcomes, double& y) {
  std::string svg;
  double x = kEdge;
  for (const Outcome outcome : outcomes) {
    const std::string name = name_of(outcome);
    const double width = 46 + 12 * plot_text_width(name);
    if (x + width > kWidth) {
      x = kEdge;
      y += kLegendLine;
    }
    svg += outcome_cell_svg(outcome, {x, y, 18, 16}, "");
    svg +=
        fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", x + 24, y + 12, plot_text(name));
    x += width;
  }
  y += kLegendLine;
  return svg;
}

std::string heads_svg(const std::vector<std::string>& heads, double left, double width,
                      double bottom) {
  std::string svg;
  for (std::size_t k = 0; k < heads.size(); ++k) {
    const double x = left + width * (static_cast<double>(k) + 0.6);
    svg += fmt::format(
        "<text x=\"{0:.2f}\" y=\"{1:.2f}\" font-size=\"{2:g}\" transform=\"rotate(-60 {0:.2f} "
        "{1:.2f})\">{3}</text>\n",
        x, bottom, kFont, plot_text(plot_literal(heads[k])));
  }
  return svg;
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

}  // namespace

std::string catalogue_svg(const std::vector<StabilityCase>& cases, const std::string& name) {
  const StabilityOverview overview = overview_of(cases);
  std::vector<std::string> heads = {"reference"}, labels;
  for (const StabilityMethod& method : overview.methods) heads.push_back(method.label());
  for (const StabilityRow& row : overview.rows) labels.push_back(row.label);
  const double left = kEdge + std::min(widest_text(labels), kWidth / 2) + 8;
  const double top = kTopGap + kSlant * widest_text(heads) + 8;
  // The last head leans to the right beyond its column.
  const double room = kWidth - left - kEdge - 0.5 * widest_text(heads);
  const double width = std::min(kWidestCell, room / static_cast<double>(heads.size()));
  std::string body = heads_svg(heads, left, width, top - 6);
  std::set<Outcome> outcomes;
  const auto cell = [&](std::size_t column, double y, Outcome outcome, const std::string& note) {
    outcomes.insert(outcome);
    body += outcome_cell_svg(outcome, {left + width * static_cast<double>(column), y, width, kRow},
                             note);
  };
  double y = top;
  for (const StabilityRow& row : overview.rows) {
    body += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\" "
        "font-size=\"{:g}\">{}</text>\n",
        left - 6, y + 11, kFont, plot_text(plot_literal(row.label)));
    cell(0, y, outcome_of(row.scene->reference), reference_note(*row.scene));
    for (std::size_t m = 0; m < row.runs.size(); ++m)
      if (const StabilityRun* run = row.runs[m]) cell(m + 1, y, run->outcome, note_of(row, *run));
    y += kRow;
  }
  y += 12;
  body += legend_svg(outcomes, y);
  return svg_image(kWidth, y + 6, name, "Stiff and extreme cases",
                   "how each case comes out in the reference and in each engine", body);
}

FigureOnPage map_figure(const OutcomeMap& map, const std::string& name) {
  FigureOnPage figure;
  figure.name = name;
  figure.title = plot_literal(map.title);
  const AxisSpec x{plot_literal(map.x.label), map.x.logarithmic};
  const AxisSpec y{plot_literal(map.y.label), map.y.logarithmic};
  CategoryMap outcomes{
      plot_literal(map.title),      x, y, map.x.values, map.y.values, map.outcome, {}, map.theory,
      plot_literal(map.theory_name)};
  HeatMap errors;
  errors.title = "log_{10} " + plot_literal(map.error_label);
  errors.x = x;
  errors.y = y;
  errors.x_values = map.x.values;
  errors.y_values = map.y.values;
  errors.low_is_blue = true;
  errors.missing = "–";
  double low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < map.outcome.size(); ++k) {
    const double error = k < map.worst_error.size() ? map.worst_error[k] : kNotObserved;
    const double z = std::isfinite(error) ? std::log10(std::max(error, kLeastError)) : kNotObserved;
    errors.z.push_back(z);
    outcomes.notes.push_back(fmt::format(
        "{} {:.3g}, {} {:.3g}: {}{}", map.x.label, map.x.values[k % map.x.values.size()],
        map.y.label, map.y.values[k / map.x.values.size()], name_of(map.outcome[k]),
        std::isnan(z) ? "" : fmt::format(", {} = {:.3g}", map.error_label, error)));
    low = std::fmin(low, z);
    high = std::fmax(high, z);
  }
  FigureDrawing drawing;
  drawing.panels.push_back(std::move(outcomes));
  if (low <= high) {
    errors.z_low = std::floor(low);
    errors.z_high = std::max(std::ceil(high), errors.z_low + 1);
    drawing.panels.push_back(std::move(errors));
  }
  figure.caption = "How it comes out over two parameters; letters and colours say the same.";
  if (drawing.panels.size() > 1)
    figure.caption += " Right: the largest error of all phases, blue where it is small.";
  figure.svg = figure_svg(drawing, name, figure.title, figure.caption);
  return figure;
}

std::vector<FigureOnPage> stability_charts(const std::vector<StabilityCase>& cases,
                                           const LimitResults& limits) {
  std::set<std::string> taken;
  std::vector<FigureOnPage> figures;
  const auto add = [&](const std::string& name, std::string title, std::string caption) {
    figures.push_back({file_stem(name, taken), std::move(title), std::move(caption), ""});
    return figures.size() - 1;
  };
  if (!cases.empty()) {
    const std::size_t k = add("stability-catalogue", "Stiff and extreme cases",
                              "Each cell is an ensemble; point at it to read why.");
    figures[k].svg = catalogue_svg(cases, figures[k].name);
  }
  for (const LimitGroup& group : limit_groups(limits.limits)) {
    const std::size_t k =
        add(fmt::format("limit-{}-{}", name_of(group.kind), group.scene),
            fmt::format("{}, {}", words_of(group.kind), plot_literal(group.scene)), "");
    figures[k].svg = limits_svg(group, figures[k].name);
  }
  for (const OutcomeMap* map : complete_maps(limits))
    figures.push_back(map_figure(*map, file_stem("map-" + map->name, taken)));
  return figures;
}

}  // namespace slipcheck
