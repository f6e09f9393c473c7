#include "report/html/html_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html/html_text.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostScores = 8;  // beside the table of all

std::string counts_part(const AllVerdicts& all) {
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
  return fmt::format("<p class=\"counts\" id=\"counts\"><span class=\"what\">{}:</span> {}</p>\n",
                     counted(all.scene_count, "scene"), html);
}

/// Good, middling or bad: half and nine tenths are what Lighthouse draws the lines at.
const char* grade_of(double share) {
  return share >= 0.9 ? "high" : share >= 0.5 ? "middle" : "low";
}

std::string score_part(const ProfileScore& score, bool with_engine) {
  const double share = score.share();
  const std::string name = with_engine ? score.label(true) : score.profile;
  return fmt::format(
      "<li class=\"score {}{}\"><span class=\"share\">{}</span> <span class=\"whose\">{}</span> "
      "<svg class=\"bar\" viewBox=\"0 0 100 6\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><rect class=\"all\" width=\"100\" height=\"6\"/><rect class=\"part\" "
      "width=\"{:.1f}\" height=\"6\"/></svg> <span class=\"of\">within in {} of {}</span></li>\n",
      std::isnan(share) ? "none" : grade_of(share), score.is_naive ? " naive" : "",
      std::isnan(share) ? "–" : fmt::format("{:.0f} %", 100 * share), escaped(name),
      std::isnan(share) ? 0 : 100 * share, score.runs.of(Verdict::within),
      counted(score.judged(), "run"));
}

std::string scores_part(const Summary& summary) {
  if (summary.scores.empty()) return {};
  std::string html =
      "<ol class=\"scores\" id=\"scores\" aria-label=\"Runs within all tolerances\">\n";
  for (std::size_t k = 0; k < std::min(kMostScores, summary.scores.size()); ++k)
    html += score_part(summary.scores[k], summary.has_engines);
  return html + "</ol>\n" +
         html_details(fmt::format("{} in numbers", counted(summary.scores.size(), "score")),
                      html_table(score_table(summary)));
}

}  // namespace

std::string html_summary(const Summary& summary) {
  if (summary.counts.scene_count == 0) return {};
  return fmt::format("<p class=\"finding\" id=\"finding\">{}</p>\n",
                     escaped(summary.finding.empty() ? summary.heading : summary.finding)) +
         counts_part(summary.counts) + scores_part(summary) +
         html_paragraph("faint naive-note", "", summary.naive);
}

std::string html_worst(const Summary& summary, const std::vector<SceneRecord>& scenes,
                       const std::vector<std::string>& ids) {
  std::string html;
  for (const Finding& finding : summary.worst)
    html += fmt::format("<li><a href=\"#{}\">{}</a>: {} <span class=\"faint\">{}</span></li>\n",
                        ids[static_cast<std::size_t>(finding.scene - scenes.data())],
                        escaped(finding.scene->scenario.name), escaped(off_text(finding.row)),
                        escaped(run_label(*finding.run)));
  return html.empty() ? ""
                      : "<section id=\"worst\"><h2>Worst deviations</h2>\n<ol class=\"worst\">\n" +
                            html + "</ol></section>\n";
}

}  // namespace slipcheck
