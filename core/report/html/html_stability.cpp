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

const char* class_of(Outcome outcome) {
  return outcome == Outcome::accurate  ? "good"
         : outcome == Outcome::refused ? "faint"
         : is_usable(outcome)          ? ""
                                       : "bad";
}

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

HtmlCell outcome_cell(Outcome outcome) {
  return {look_of(outcome).letter, fmt::format("o{}", static_cast<int>(outcome))};
}

std::string criteria_part(const OutcomeCriteria& criteria) {
  std::vector<std::vector<HtmlCell>> rows;
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    rows.push_back({{name_of(outcome), class_of(outcome)},
                    outcome_cell(outcome),
                    {meaning_of(outcome, criteria), "reason"}});
  }
  return html_details(
      "How a run can come out, from good to bad; an ensemble counts as its worst phase does",
      html_table("Classes", {{"class", ""}, {"", ""}, {"what it means", ""}}, rows));
}

std::string totals_part(const StabilityOverview& overview) {
  std::vector<HtmlCell> headers = {{"method", ""}};
  for (std::size_t k = 0; k < kOutcomes; ++k)
    headers.push_back({name_of(static_cast<Outcome>(k)), "n"});
  std::vector<std::vector<HtmlCell>> rows;
  for (std::size_t m = 0; m < overview.methods.size(); ++m) {
    std::vector<HtmlCell> row = {{overview.methods[m].label(), ""}};
    for (std::size_t k = 0; k < kOutcomes; ++k) {
      const std::size_t count = overview.totals[m][k];
      const std::string css_class = class_of(static_cast<Outcome>(k));
      row.push_back({count > 0 ? std::to_string(count) : "·", count > 0 ? css_class : ""});
    }
    rows.push_back(std::move(row));
  }
  return html_paragraph("", "The reference:",
                        fmt::format("{} accurate, {} refused with the reason, {} failed",
                                    overview.accurate, overview.refused, overview.failed)) +
         (rows.empty() ? "" : html_table("Runs by class", headers, rows));
}

std::string case_id(std::size_t k) { return fmt::format("case-{}", k + 1); }

/// Cases by methods, a letter for each ensemble; a case's name leads to its reasons.
std::string catalogue_part(const std::vector<StabilityCase>& cases,
                           const StabilityOverview& overview) {
  std::string html =
      "<div class=\"table\" role=\"region\" aria-label=\"The catalogue\" tabindex=\"0\"><table "
      "class=\"map\"><thead><tr><th>case</th><th>reference</th>";
  for (const StabilityMethod& method : overview.methods)
    html += fmt::format("<th>{}</th>", escaped(method.label()));
  html += "</tr></thead><tbody>\n";
  const auto cell = [&](Outcome outcome) {
    const HtmlCell made = outcome_cell(outcome);
    html += fmt::format("<td class=\"{}\">{}</td>", made.css_class, made.text);
  };
  for (const StabilityRow& row : overview.rows) {
    html += fmt::format("<tr><th><a href=\"#{}\">{}</a></th>",
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

std::string share_text(double value) { return std::isfinite(value) ? percent(value) : "–"; }

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
  std::vector<std::vector<HtmlCell>> rows;
  std::vector<std::string> accurate;
  for (const StabilityRun& run : scene.runs) {
    if (run.outcome == Outcome::accurate) {
      accurate.push_back(fmt::format("{} {} {} at {:g} Hz", run.record.engine, run.record.precision,
                                     run.record.profile, run.record.rate));
      continue;
    }
    std::string worst = number_text(run.worst_error);
    if (!run.worst_observable.empty()) worst += " " + run.worst_observable;
    rows.push_back(
        {{fmt::format("{} {} {}", run.record.engine, run.record.precision, run.record.profile), ""},
         {fmt::format("{:g} Hz", run.record.rate), ""},
         {name_of(run.outcome), class_of(run.outcome)},
         {worst, ""},
         {share_text(run.energy_gain), ""},
         {share_text(run.creep), ""},
         {share_text(run.depth), ""},
         {words_of(run), "reason"}});
  }
  if (!rows.empty())
    html += html_table("",
                       {{"method", ""},
                        {"rate", "n"},
                        {"class", ""},
                        {"worst error in tolerances", ""},
                        {"energy gained", "n"},
                        {"creep", "n"},
                        {"overlap", "n"},
                        {"why", ""}},
                       rows);
  html += html_paragraph("faint", "Accurate:", fmt::format("{}", fmt::join(accurate, ", ")));
  return html + "</details>\n";
}

std::string limits_part(const std::vector<Limit>& limits) {
  std::vector<std::vector<HtmlCell>> rows;
  for (const LimitGroup& group : limit_groups(limits))
    for (const Limit* limit : group.limits) {
      std::string theory = limit->theory ? value_text(limit->kind, *limit->theory) : "";
      if (!limit->theory_name.empty()) theory += " = " + limit->theory_name;
      const double ratio = ratio_to_theory(*limit);
      std::string notes = limit->reason.empty() ? limit->why : limit->reason;
      for (const double island : limit->islands)
        notes += fmt::format("{}bad all the same at {}", notes.empty() ? "" : "; ",
                             value_text(limit->kind, island));
      rows.push_back(
          {{label_of(*limit), ""},
           {words_of(limit->kind), ""},
           {limit->scene, ""},
           {range_text(*limit), ""},
           {theory, ""},
           {std::isfinite(ratio) ? fmt::format("{:.4f}", ratio) : "", ""},
           {limit->bad ? name_of(limit->beyond) : "", limit->bad ? class_of(limit->beyond) : ""},
           {notes, "reason"}});
    }
  return html_table("Limits",
                    {{"method", ""},
                     {"limit", ""},
                     {"scene", ""},
                     {"last good … first bad", "n"},
                     {"theory", ""},
                     {"ratio", "n"},
                     {"beyond", ""},
                     {"why", ""}},
                    rows);
}

/// A map as letters, its first row the highest of y; charts of it are the script's.
std::string map_part(const OutcomeMap& map, std::size_t k) {
  const std::size_t columns = map.x.values.size();
  std::vector<HtmlCell> headers = {{fmt::format("{} \\ {}", map.y.label, map.x.label), ""}};
  for (const double x : map.x.values) headers.push_back({fmt::format("{:.3g}", x), ""});
  std::vector<std::vector<HtmlCell>> rows;
  for (std::size_t r = map.y.values.size(); r-- > 0;) {
    std::vector<HtmlCell> row = {{fmt::format("{:.3g}", map.y.values[r]), ""}};
    for (std::size_t c = 0; c < columns; ++c)
      row.push_back(outcome_cell(map.outcome[r * columns + c]));
    rows.push_back(std::move(row));
  }
  return fmt::format("<h4>{0}</h4>\n<div class=\"plots\" id=\"map-{1}\" data-map=\"{2}\"></div>\n",
                     escaped(map.title), k + 1, k) +
         html_details("As letters", html_table(map.title, headers, rows));
}

std::string limits_plots(const std::vector<Limit>& limits) {
  std::string html;
  for (std::size_t k = 0; k < limit_groups(limits).size(); ++k)
    html +=
        fmt::format("<div class=\"plots\" id=\"limits-{}\" data-limits=\"{}\"></div>\n", k + 1, k);
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

std::string html_stability(const ReportContent& content) {
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
  if (!limits.empty()) html += "<h3>Limits</h3>\n" + limits_plots(limits) + limits_part(limits);
  if (!maps.empty()) html += "<h3>Maps</h3>\n";
  for (std::size_t k = 0; k < maps.size(); ++k) html += map_part(*maps[k], k);
  return html;
}

}  // namespace slipcheck
