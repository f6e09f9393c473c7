#include "report/html/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "engine/engine_registry.h"
#include "report/charts/report_charts.h"
#include "report/html/html_charts.h"
#include "report/html/html_engines.h"
#include "report/html/html_index.h"
#include "report/html/html_matrix.h"
#include "report/html/html_page.h"
#include "report/html/html_precision.h"
#include "report/html/html_scene.h"
#include "report/html/html_stability.h"
#include "report/html/html_summary.h"
#include "report/html/html_text.h"
#include "report/html/packed_text.h"
#include "report/html/page_data.h"
#include "report/html/page_scenes.h"
#include "report/html/page_script.h"
#include "report/rows/summary.h"

namespace slipcheck {
namespace {

/// "bullet 3.24", of all results.
std::vector<std::string> engines_of(const ReportContent& content) {
  std::set<std::string> engines;
  const auto add = [&](const std::string& engine, const std::string& version) {
    if (!version.empty()) engines.insert(fmt::format("{} {}", engine_family(engine), version));
  };
  for (const SceneRecord& scene : content.scenes)
    for (const EngineRecord& run : scene.runs) add(run.engine, run.version);
  for (const PrecisionScene& scene : content.precision)
    for (const MethodCurve& curve : scene.curves) add(curve.engine, curve.version);
  for (const StabilityCase& scene : content.cases)
    for (const StabilityRun& run : scene.runs) add(run.record.engine, run.record.version);
  return {engines.begin(), engines.end()};
}

/// Links to the parts of a page that has several.
std::string parts_nav(bool scenes, bool precision, bool stability) {
  if (int{scenes} + int{precision} + int{stability} < 2) return {};
  std::string html = "<nav class=\"parts\" aria-label=\"Parts\">";
  if (scenes) html += "<a href=\"#scenes\">Scenes</a> ";
  if (precision) html += "<a href=\"#precision\">Error against run time</a> ";
  if (stability) html += "<a href=\"#stability\">Where it gets stiff</a> ";
  return html + "</nav>\n";
}

constexpr std::size_t kMostMoved = 10;  // rows that are not folded

/// The toolbar is the script's.
constexpr const char* kToolbar = "<div id=\"toolbar\"></div>\n";

std::string scenes_part(const std::vector<PageTopic>& topics,
                        const std::vector<SceneRecord>& scenes, const ReportCharts& charts,
                        const StandingCharts& standing, bool has_script) {
  if (scenes.empty()) return {};
  const SharedSettings shared(scenes);
  std::string html = "<div id=\"scenes\" tabindex=\"-1\">\n";
  for (const PageTopic& topic : topics) {
    html += fmt::format(
        "<section class=\"topic\" id=\"{}\">\n<h2>{} <span class=\"faint\">{}</span></h2>\n",
        topic.id, escaped(topic.name), topic.counts());
    for (const PageScene& each : topic.scenes) {
      const SceneRecord& scene = *each.scene;
      // With a script the runs come with its data, when their scene is opened.
      const std::string runs = scene.runs.empty() ? ""
                               : has_script ? "<noscript>" + html_run_list(scene) + "</noscript>\n"
                                            : html_runs(scene, shared);
      html += html_scene(
          each, shared,
          standing.html(charts.motions[each.place]) + standing.html(charts.scenes[each.place]),
          runs);
    }
    html += "</section>\n";
  }
  return html + "</div>\n" + html_lacks(scenes) + shared.html();
}

/// What has moved, before all that is.
std::string moved_part(const std::optional<Moved>& moved) {
  if (!moved) return {};
  std::string html = "<section id=\"moved\">\n<h2>What has moved</h2>\n";
  html += html_paragraph("", "", moved->finding);
  TextTable table = moved->table;
  if (table.rows.empty()) return html + "</section>\n";
  table.title = "What has moved";
  const std::size_t count = table.rows.size();
  TextTable first = table;
  first.rows.resize(std::min(count, kMostMoved));
  html += html_table(first);
  if (count > kMostMoved) {
    table.rows.erase(table.rows.begin(), table.rows.begin() + kMostMoved);
    html += html_details(fmt::format("{} more", count - kMostMoved), html_table(table));
  }
  return html + "</section>\n";
}

std::string escaped_lines(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    html += escaped(text.substr(0, text[end] == '\n' ? end : end + 1)) + "\n";
    text.remove_prefix(end + 1);
  }
  return html;
}

/// Unpacks the page's script, which is three times as long, and runs it.
constexpr std::string_view kLoader = R"((async () => {
  const packed = atob(document.getElementById("slipcheck-script").textContent);
  const bytes = Uint8Array.from(packed, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const script = document.createElement("script");
  script.textContent = await new Response(stream).text();
  document.body.append(script);
})();
)";

std::string packed_part(std::string_view id, std::string_view base64) {
  return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                     base64);
}

/// What the script draws, the script, and the terms of what is in it.
std::string script_part(const ReportContent& content, const ReportCharts& charts) {
  std::string html = "<footer>\n";
  html += html_details("Licences of the libraries in this page",
                       fmt::format("<pre tabindex=\"0\">{}</pre>\n", escaped_lines(kPageLicences)));
  html += "</footer>\n" + packed_part("slipcheck-data", packed_page_data(content, charts)) +
          packed_part("slipcheck-script", base64_of(deflated(kPageScript))) + "<script>";
  html += kLoader;
  return html + "</script>\n";
}

}  // namespace

std::string report_page(const ReportContent& content, PageScript script) {
  const bool has_script = script == PageScript::included && !kPageScript.empty();
  const ReportCharts charts = report_charts(content, ChartExtent::page);
  const StandingCharts standing = has_script ? StandingCharts() : StandingCharts(charts.all());
  const Summary summary = summarize(content.scenes);
  const std::vector<PageTopic> topics = page_topics(content.scenes);
  const std::string precision = html_precision(content.precision, charts, standing);
  const std::string stability = html_stability(content, charts, standing);
  std::string html =
      html_head("Slipcheck report", stability.empty() ? "" : outcome_css(),
                has_script ? std::vector{kLoader, kPageScript} : std::vector<std::string_view>());
  if (!content.scenes.empty())
    html += "<a class=\"skip\" href=\"#scenes\">Skip to the scenes</a>\n";
  html += "<header>\n<h1>Slipcheck</h1>\n";
  html += html_paragraph(
      "title", "",
      "Physics engines beside an exact reference of spheres that collide, slide and roll");
  html += html_summary(summary) +
          parts_nav(!content.scenes.empty(), !precision.empty(), !stability.empty());
  html += "</header>\n<main>\n" + moved_part(content.moved) + kToolbar +
          html_index(topics, engine_matrix(content.scenes, MatrixExtent::all)) +
          html_worst(summary, content.scenes, scene_ids(content.scenes)) +
          scenes_part(topics, content.scenes, charts, standing, has_script) +
          html_matrix(content.scenes, charts, standing) + precision + stability +
          html_context(content.context, content.commands, engines_of(content)) + "</main>\n";
  if (has_script) html += script_part(content, charts);
  return html + kHtmlEnd;
}

}  // namespace slipcheck
