#include "report/terminal/check_table.h"

#include <fmt/format.h>

#include <sstream>
#include <vector>

#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostOfScene = 12;

/// A scene's lines: a heading of any width above cells of a table that all scenes share.
struct SceneLines {
  std::string heading;
  std::size_t rows = 0;
  std::size_t left_out = 0;
};

SceneLines add_scene(const SceneCheck& scene, const TableStyle& style, TextTable& table) {
  SceneLines lines;
  const bool green = scene.is_green();
  const Tone tone = green ? Tone::good : Tone::bad;
  lines.heading = inked((green ? "✓ " : "✗ ") + scene.scene, tone, style);
  for (const ChangeRow& row : change_rows(scene, style.all_observables)) {
    if (row.part == "scene") {
      lines.heading += ": " + row.note;
      continue;
    }
    if (lines.rows == kMostOfScene && !style.all_observables) {
      ++lines.left_out;
      continue;
    }
    ++lines.rows;
    table.rows.push_back(
        {{row.part},
         {row.what},
         {row.statistic, Tone::faint},
         {row.before + " → " + row.now},
         {row.allowed, Tone::faint},
         row.direction,
         {row.others > 0 ? fmt::format("+ {} more", row.others) : "", Tone::faint}});
  }
  return lines;
}

std::string changes_table(const CheckReport& report, const TableStyle& style) {
  TextTable table{{{"run"},
                   {"observable"},
                   {"of", false, 3},
                   {"baseline → now"},
                   {"may move by", true, 2},
                   {"", false, 1},
                   {"", false, 4}}};
  std::vector<SceneLines> scenes;
  for (const SceneCheck& scene : report.scenes)
    if (!change_rows(scene, style.all_observables).empty())
      scenes.push_back(add_scene(scene, style, table));
  if (scenes.empty()) return {};
  const bool has_rows = !table.rows.empty();
  std::istringstream lines(terminal_table(std::move(table), style, 2));
  std::string text, line;
  std::getline(lines, line);  // the column's headers
  if (has_rows) text = line + '\n';
  for (const SceneLines& scene : scenes) {
    text += scene.heading + '\n';
    for (std::size_t k = 0; k < scene.rows && std::getline(lines, line); ++k) text += line + '\n';
    if (scene.left_out > 0) text += fmt::format("  … and {} more (--all)\n", scene.left_out);
  }
  return text + '\n';
}

}  // namespace

std::string check_table(const CheckReport& report, const TableStyle& style) {
  std::string text = changes_table(report, style);
  const CheckTotals totals = totals_of(report);
  const bool green = totals.moved_scenes == 0;
  text +=
      inked((green ? "✓ " : "✗ ") + check_verdict(report), green ? Tone::good : Tone::bad, style) +
      '\n';
  text += fmt::format("  {} in {} and {} held against {}, ensembles of {}\n",
                      counted(totals.compared, "value"), counted(report.scenes.size(), "scene"),
                      counted(totals.runs, "run"), report.baselines, report.phases);
  for (const std::string& remark : check_remarks(report)) text += "  " + remark + '\n';
  return text;
}

}  // namespace slipcheck
