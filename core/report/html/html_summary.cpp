#include "report/html/html_summary.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "report/html/html_scene.h"
#include "report/html/html_text.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/findings.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

constexpr std::size_t kWorst = 5;

std::string counts_part(const std::vector<SceneRecord>& scenes) {
  const AllVerdicts all = count_verdicts(scenes);
  std::string html;
  for (const Verdict verdict :
       {Verdict::within, Verdict::deviates, Verdict::undecided, Verdict::failed, Verdict::unjudged})
    if (verdict != Verdict::unjudged || all.scenes.of(verdict) > 0)
      html += fmt::format("<span class=\"verdict {}\">{} {}</span> ", class_of(verdict),
                          symbol_of(verdict), all.scenes.text_of(verdict));
  if (all.scenes_alone > 0)
    html += fmt::format("<span class=\"verdict not-judged\">{} {} of the reference alone</span> ",
                        symbol_of(Verdict::unjudged), all.scenes_alone);
  html.pop_back();
  return "<p class=\"counts\">" + html + "</p>\n";
}

std::string words_of(const ComparisonRow& row) {
  if (row.worst.text == "–") return fmt::format("{} ({})", row.name, row.note);
  std::string text =
      fmt::format("{} off by up to {}, tolerance {}", row.name, row.worst.text, row.tolerance.text);
  return row.note.empty() ? text : fmt::format("{} ({})", text, row.note);
}

std::string worst_part(const std::vector<SceneRecord>& scenes) {
  std::string html;
  for (const Finding& finding : worst_findings(scenes, kWorst))
    html += fmt::format("<li><a href=\"#{}\">{}</a>: {} <span class=\"faint\">{}</span></li>\n",
                        scene_id(static_cast<std::size_t>(finding.scene - scenes.data())),
                        escaped(finding.scene->scenario.name), escaped(words_of(finding.row)),
                        escaped(run_name(*finding.run)));
  return html.empty() ? "" : "<h2>Worst deviations</h2>\n<ol class=\"worst\">\n" + html + "</ol>\n";
}

/// Plain radio buttons that the style sheet listens to.
std::string filter_part() {
  std::string html = "<fieldset class=\"filter\"><legend>Show scenes</legend>\n";
  for (const char* choice : {"all", "deviates", "undecided", "failed", "within"})
    html += fmt::format(
        "<span><input type=\"radio\" name=\"show\" id=\"show-{0}\"{1}/><label "
        "for=\"show-{0}\">{0}</label></span>\n",
        choice, std::string_view(choice) == "all" ? " checked=\"checked\"" : "");
  return html + "</fieldset>\n";
}

/// What a line of the contents says of a scene: the worst deviation, or the first of its runs that
/// does not do what is expected of it or cannot be judged, else the title.
std::string contents_text(const SceneRecord& scene) {
  std::optional<ComparisonRow> worst;
  for (const EngineRecord& run : scene.runs)
    if (auto row = worst_deviation(scene, run); row && (!worst || row->severity > worst->severity))
      worst = std::move(row);
  if (worst) return words_of(*worst);
  for (const EngineRecord& run : scene.runs)
    if (const std::string unmet = unmet_expectation(run, true); !unmet.empty())
      return fmt::format("{}, {}", unmet, run_name(run));
  for (const EngineRecord& run : scene.runs)
    if (run.verdict() == Verdict::undecided)
      return fmt::format("{}, {}", finding_text(scene, run), run_name(run));
  return scene.scenario.title;
}

}  // namespace

std::string scene_id(std::size_t k) { return fmt::format("scene-{}", k + 1); }

std::string html_summary(const std::vector<SceneRecord>& scenes) {
  return scenes.empty() ? "" : counts_part(scenes) + worst_part(scenes);
}

std::string html_contents(const std::vector<SceneRecord>& scenes) {
  std::string html = filter_part() + "<nav aria-label=\"Scenes\"><ul class=\"contents\">\n";
  for (std::size_t k = 0; k < scenes.size(); ++k)
    html += fmt::format(
        "<li class=\"scene {}\" data-scene=\"{}\">{} <a href=\"#{}\">{}</a> <span "
        "class=\"faint\">{}</span></li>\n",
        class_of(scenes[k].verdict()), k, verdict_label(scenes[k]), scene_id(k),
        escaped(scenes[k].scenario.name), escaped(contents_text(scenes[k])));
  return html + "</ul></nav>\n";
}

}  // namespace slipcheck
