#include "report/html/html_stability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/html/html_text.h"
#include "report/rows/outcome_look.h"
#include "report/rows/quantity.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

/// What a class means, with the limits that were used.
std::string meaning_of(Outcome outcome, const OutcomeCriteria& criteria) {
  switch (outcome) {
    case Outcome::accurate:
      return "every observable is within its tolerance";
    case Outcome::degraded:
      return "not accurate, but nothing of what follows";
    case Outcome::drifting:
      return fmt::format(
          "what rests in the reference creeps by more than {} of its radius, or more than {} of "
          "the scene's energy is lost where none is",
          percent(criteria.creep), percent(criteria.energy));
    case Outcome::energy_growing:
      return fmt::format("more than {} of the scene's energy comes out of nothing",
                         percent(criteria.energy));
    case Outcome::tunnelled:
      return "a body passes through another one or through the substrate";
    case Outcome::exploded:
      return fmt::format("more than {:g} times as fast as anything in the scene can be",
                         criteria.exploded);
    case Outcome::not_finite:
      return "a state is not a number or infinite";
    case Outcome::timed_out:
      return "no end within the time limit";
    case Outcome::crashed:
      return "the engine's process ended before its time";
    case Outcome::refused:
      return "it says beforehand why it cannot; no result, but no wrong one";
  }
  return "";
}

Cell outcome_cell(Outcome outcome) {
  return {.text = look_of(outcome).letter,
          .css_class = fmt::format("o{}", static_cast<int>(outcome))};
}

/// A cell of sentences.
Cell reason_cell(const std::string& text) { return {.text = text, .css_class = "reason"}; }

std::string criteria_part(const OutcomeCriteria& criteria) {
  TextTable table{{{"class"}, {""}, {"what it means"}}, {}, "Classes"};
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    table.rows.push_back({{name_of(outcome), tone_of(outcome)},
                          outcome_cell(outcome),
                          reason_cell(meaning_of(outcome, criteria))});
  }
  return html_details(
      "How a run can come out, from good to bad; an ensemble counts as its worst phase does",
      html_table(table));
}

std::string totals_part(const StabilityOverview& overview) {
  return html_paragraph("", "The reference:",
                        fmt::format("{} accurate, {} refused with the reason, {} failed",
                                    overview.accurate, overview.refused, overview.failed)) +
         (overview.methods.empty() ? "" : html_table(totals_table(overview, Tone::plain)));
}

std::string case_id(std::size_t k) { return fmt::format("case-{}", k + 1); }

/// Cases by methods, a letter for each ensemble; a case's name leads to its reasons.
std::string catalogue_part(const std::vector<StabilityCase>& cases,
                           const StabilityOverview& overview) {
  std::string html =
      "<div class=\"table\" role=\"region\" aria-label=\"The catalogue\" tabindex=\"0\"><table "
      "class=\"map\"><caption>The catalogue: cases by methods, each as its worst phase comes "
      "out</caption><thead><tr><th scope=\"col\">case</th><th scope=\"col\">reference</th>";
  for (const StabilityMethod& method : overview.methods)
    html += fmt::format("<th scope=\"col\">{}</th>", escaped(method.label()));
  html += "</tr></thead><tbody>\n";
  const auto cell = [&](Outcome outcome) {
    const Cell made = outcome_cell(outcome);
    html += fmt::format("<td class=\"{}\">{}</td>", made.css_class, made.text);
  };
  for (const StabilityRow& row : overview.rows) {
    html += fmt::format("<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th>",
                        case_id(static_cast<std::size_t>(row.scene - cases.data())),
                        escaped(row.label));
    cell(outcome_of(row.scene->reference));
    for (const StabilityRun* run : row.runs)
      if (run)
        cell(run->outcome);
      else
        html += "<td></td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}
std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

Cell share_cell(double value) {
  return {std::isfinite(value) ? percent(value) : "–", Tone::plain, value};
}

/// A case with all its runs.
std::string case_part(const StabilityCase& scene, std::size_t k) {
  const bool all_well =
      scene.reference.accurate &&
      std::all_of(scene.runs.begin(), scene.runs.end(),
                  [](const StabilityRun& run) { return run.outcome == Outcome::accurate; });
  std::string html = fmt::format(
      "<details id=\"{}\"><summary>{} <span class=\"{}\">{}</span> <span "
      "class=\"faint\">{}</span></summary>\n",
      case_id(k), escaped(scene.scenario.name), all_well ? "good" : "bad",
      all_well ? "all accurate" : "", escaped(scene.scenario.title));
  html += html_paragraph(scene.reference.accurate ? "faint" : "reason", "The reference:",
                         fmt::format("{}{}{}", word_of(scene.reference),
                                     scene.reference.why.empty() ? "" : ": ", scene.reference.why));
  TextTable table{{{"method"},
                   {"rate", true},
                   {"class"},
                   {"worst error in tolerances"},
                   {"energy gained", true},
                   {"creep", true},
                   {"overlap", true},
                   {"why"}}};
  std::vector<std::string> accurate;
  for (const StabilityRun& run : scene.runs) {
    if (run.outcome == Outcome::accurate) {
      accurate.push_back(fmt::format("{} {} {} at {:g} Hz", run.record.engine, run.record.precision,
                                     run.record.profile, run.record.rate));
      continue;
    }
    std::string worst = number_text(run.worst_error);
    if (!run.worst_observable.empty()) worst += " " + run.worst_observable;
    table.rows.push_back(
        {{fmt::format("{} {} {}", run.record.engine, run.record.precision, run.record.profile)},
         {fmt::format("{:g} Hz", run.record.rate), Tone::plain, run.record.rate},
         {name_of(run.outcome), tone_of(run.outcome)},
         {worst, Tone::plain, run.worst_error},
         share_cell(run.energy_gain),
         share_cell(run.creep),
         share_cell(run.depth),
         reason_cell(words_of(run))});
  }
  if (!table.rows.empty()) html += html_table(table);
  html += html_paragraph("faint", "Accurate:", fmt::format("{}", fmt::join(accurate, ", ")));
  return html + "</details>\n";
}

std::string limits_part(const std::vector<Limit>& limits) {
  std::vector<const Limit*> grouped;
  for (const LimitGroup& group : limit_groups(limits))
    grouped.insert(grouped.end(), group.limits.begin(), group.limits.end());
  return html_table(limits_table(grouped));
}

/// A map as its chart and as letters, the first row the highest of y.
std::string map_part(const OutcomeMap& map, std::size_t k, const std::string& chart) {
  const std::size_t columns = map.x.values.size();
  TextTable table{{{fmt::format("{} \\ {}", map.y.label, map.x.label)}}, {}, map.title};
  for (const double x : map.x.values) table.columns.push_back({fmt::format("{:.3g}", x)});
  for (std::size_t r = map.y.values.size(); r-- > 0;) {
    std::vector<Cell>& row =
        table.rows.emplace_back(1, Cell{fmt::format("{:.3g}", map.y.values[r])});
    for (std::size_t c = 0; c < columns; ++c)
      row.push_back(outcome_cell(map.outcome[r * columns + c]));
  }
  return fmt::format("<h4>{0}</h4>\n<div class=\"plots\" id=\"map-{1}\" data-map=\"{2}\"></div>\n",
                     escaped(map.title), k + 1, k) +
         chart + html_details("As letters", html_table(table));
}

std::string limits_plots(const std::vector<Chart>& charts, const StandingCharts& standing) {
  std::string html;
  for (std::size_t k = 0; k < charts.size(); ++k)
    html +=
        fmt::format("<div class=\"plots\" id=\"limits-{}\" data-limits=\"{}\"></div>\n", k + 1, k) +
        standing.html({charts[k]});
  return html;
}

}  // namespace

std::string outcome_css() {
  std::string css;
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const OutcomeLook& look = look_of(static_cast<Outcome>(k));
    css += fmt::format(".o{} {{ background: {}; color: {}; }}\n", k, look.fill, look.ink);
  }
  return css;
}

std::string html_stability(const ReportContent& content, const ReportCharts& charts,
                           const StandingCharts& standing) {
  const std::vector<OutcomeMap const*> maps = complete_maps(content.limits);
  const std::vector<Limit>& limits = content.limits.limits;
  if (content.cases.empty() && limits.empty() && maps.empty()) return {};
  std::string html = "<h2 id=\"stability\">Where it gets stiff</h2>\n";
  html += html_paragraph("", "",
                         "Stiff and extreme scenes in the reference and in each engine: how they "
                         "come out, why, and how far each method works.");
  html += criteria_part(content.criteria);
  if (!content.cases.empty()) {
    const StabilityOverview overview = overview_of(content.cases);
    html += totals_part(overview) + "<h3>The catalogue</h3>\n" +
            catalogue_part(content.cases, overview) + "<h3>Case by case</h3>\n";
    for (std::size_t k = 0; k < content.cases.size(); ++k) html += case_part(content.cases[k], k);
  }
  if (!limits.empty())
    html += "<h3>Limits</h3>\n" + limits_plots(charts.limits, standing) + limits_part(limits);
  if (!maps.empty()) html += "<h3>Maps</h3>\n";
  for (std::size_t k = 0; k < maps.size(); ++k)
    html += map_part(*maps[k], k, standing.html({charts.maps[k]}));
  return html;
}

}  // namespace slipcheck
