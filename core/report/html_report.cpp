#include "report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "report/comparison_rows.h"
#include "report/context.h"
#include "report/expectation_rows.h"
#include "report/html_scene.h"
#include "report/html_text.h"
#include "report/page_css.h"
#include "report/selection.h"
#include "report/strip_chart.h"

namespace slipcheck {
namespace {

constexpr std::size_t kWorst = 5;

/// What deviates by the most tolerances.
struct Finding {
  std::size_t scene;
  std::string run;
  ComparisonRow row;
};

std::string scene_id(std::size_t k) { return fmt::format("scene-{}", k + 1); }

/// By tolerances; what an engine does not show at all has no number and comes last.
bool is_worse(const Finding& a, const Finding& b) {
  const auto rank = [](const Finding& f) {
    return std::isfinite(f.row.severity) ? f.row.severity : 0;
  };
  return rank(a) > rank(b);
}

/// All deviations, worst first; of a scene the same observable of twin bodies, or at another rate,
/// counts once.
std::vector<Finding> findings(const std::vector<SceneRecord>& scenes) {
  std::vector<Finding> all;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const auto names = shown_observables(scenes[k], false);
    for (const EngineRecord& run : scenes[k].runs)
      for (ComparisonRow& row : comparison_rows(scenes[k], run, names))
        if (row.mark == Mark::deviates) all.push_back({k, run_name(run), std::move(row)});
  }
  std::stable_sort(all.begin(), all.end(), is_worse);
  std::set<std::pair<std::size_t, const ObservableName*>> seen;
  std::erase_if(all, [&](const Finding& finding) {
    return !seen.emplace(finding.scene, observable_of(finding.row.name)).second;
  });
  return all;
}

/// The worst of them, no more than one of a scene, so that one bad scene does not hide the others;
/// filled up with what else there is.
std::vector<Finding> worst_of(const std::vector<Finding>& all) {
  std::vector<Finding> result;
  std::vector<bool> taken(all.size());
  for (const bool new_scenes_only : {true, false})
    for (std::size_t k = 0; k < all.size() && result.size() < kWorst; ++k) {
      const bool is_known = std::any_of(result.begin(), result.end(), [&](const Finding& other) {
        return other.scene == all[k].scene;
      });
      if (taken[k] || (new_scenes_only && is_known)) continue;
      taken[k] = true;
      result.push_back(all[k]);
    }
  std::stable_sort(result.begin(), result.end(), is_worse);
  return result;
}

std::string counts_part(const std::vector<SceneRecord>& scenes) {
  std::array<std::size_t, 3> counts{};
  for (const SceneRecord& scene : scenes) ++counts[static_cast<std::size_t>(scene.verdict())];
  return fmt::format(
      "<p class=\"counts\"><span class=\"verdict within\">✓ {} within</span> "
      "<span class=\"verdict deviates\">✗ {} deviate</span> "
      "<span class=\"verdict failed\">⚠ {} failed</span></p>\n",
      counts[0], counts[1], counts[2]);
}

std::string finding_text(const Finding& finding) {
  if (finding.row.worst == "–") return fmt::format("{} ({})", finding.row.name, finding.row.note);
  std::string text = fmt::format("{} off by up to {}, tolerance {}", finding.row.name,
                                 finding.row.worst, finding.row.tolerance);
  if (!finding.row.note.empty()) text += " (" + finding.row.note + ")";
  return text;
}

std::string worst_part(const std::vector<SceneRecord>& scenes, const std::vector<Finding>& worst) {
  if (worst.empty()) return {};
  std::string html = "<h2>Worst deviations</h2>\n<ol class=\"worst\">\n";
  for (const Finding& finding : worst)
    html += fmt::format("<li><a href=\"#{}\">{}</a>: {} <span class=\"faint\">{}</span></li>\n",
                        scene_id(finding.scene), escaped(scenes[finding.scene].scenario.name),
                        escaped(finding_text(finding)), escaped(finding.run));
  return html + "</ol>\n";
}

std::string context_part(const std::string& command) {
  const Context& c = context();
  const std::array<std::pair<const char*, std::string>, 7> facts = {{
      {"command", command},
      {"date", c.date},
      {"slipcheck", fmt::format("{}, commit {}", c.version, c.commit)},
      {"build", fmt::format("{}, {}", c.build, c.compiler)},
      {"processor", fmt::format("{}, {} hardware threads", c.cpu, c.cores)},
      {"system", c.system},
      {"warning", debug_build_warning()},
  }};
  std::string html = "<dl class=\"context\">\n";
  for (const auto& [name, value] : facts)
    if (!value.empty())
      html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(value));
  return html + "</dl>\n";
}

/// Plain radio buttons that the style sheet listens to.
std::string filter_part() {
  std::string html = "<fieldset class=\"filter\"><legend>Show scenes</legend>\n";
  for (const char* choice : {"all", "deviates", "failed", "within"})
    html += fmt::format(
        "<span><input type=\"radio\" name=\"show\" id=\"show-{0}\"{1}/><label "
        "for=\"show-{0}\">{0}</label></span>\n",
        choice, std::string_view(choice) == "all" ? " checked=\"checked\"" : "");
  return html + "</fieldset>\n";
}

/// What a line of the contents says of a scene without findings: the first of its runs that does
/// not do what is expected of it, else the title.
std::string contents_text(const SceneRecord& scene) {
  for (const EngineRecord& run : scene.runs)
    if (const std::string unmet = unmet_expectation(run, true); !unmet.empty())
      return unmet + ", " + run_name(run);
  return scene.scenario.title;
}

std::string contents_part(const std::vector<SceneRecord>& scenes,
                          const std::vector<Finding>& all_findings) {
  std::string html = "<nav aria-label=\"Scenes\"><ul class=\"contents\">\n";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const auto worst = std::find_if(all_findings.begin(), all_findings.end(),
                                    [&](const Finding& finding) { return finding.scene == k; });
    html += fmt::format(
        "<li class=\"scene {}\">{} <a href=\"#{}\">{}</a> <span class=\"faint\">{}</span></li>\n",
        verdict_class(scenes[k]), verdict_label(scenes[k]), scene_id(k),
        escaped(scenes[k].scenario.name),
        escaped(worst == all_findings.end() ? contents_text(scenes[k]) : finding_text(*worst)));
  }
  return html + "</ul></nav>\n";
}

}  // namespace

std::string html_of(const std::vector<SceneRecord>& scenes, const std::string& command) {
  const std::vector<Finding> all = findings(scenes);
  std::string html = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<title>Slipcheck report</title>
<style>
)";
  html += kPageCss;
  html += "</style>\n</head>\n<body>\n" + strip_chart_shapes() + "<header>\n<h1>Slipcheck</h1>\n";
  html += html_paragraph(
      "title", "",
      "Physics engines beside an exact reference of spheres that collide, slide and roll");
  html += counts_part(scenes) + worst_part(scenes, worst_of(all)) + context_part(command);
  html += "</header>\n<main>\n<h2>Scenes</h2>\n" + filter_part() + contents_part(scenes, all);
  for (std::size_t k = 0; k < scenes.size(); ++k) html += html_scene(scenes[k], scene_id(k));
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace slipcheck
