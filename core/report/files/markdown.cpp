#include "report/files/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "report/rows/engine_matrix.h"
#include "report/rows/findings.h"
#include "report/rows/quantity.h"
#include "report/rows/summary.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kWorst = 5;
constexpr std::size_t kMostMoved = 10, kMostScores = 12;  // rows
constexpr std::size_t kLongestReason = 90;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) != 0; }

/// What begins a list, a heading or a rule where it is the first of a line.
bool begins_block(std::string_view text, std::size_t at) {
  const char next = at + 1 < text.size() ? text[at + 1] : ' ';
  if (at == 0)
    return text[at] == '=' ||
           ((text[at] == '-' || text[at] == '+') && (next == ' ' || next == text[at]));
  return (text[at] == '.' || text[at] == ')') && next == ' ' &&
         text.find_first_not_of("0123456789") == at;
}

std::string head_of(const Summary& summary) {
  const AllVerdicts& all = summary.counts;
  std::string text =
      fmt::format("## {} Slipcheck: {}\n\n", symbol_of(summary.verdict), summary.heading);
  if (!summary.finding.empty()) text += markdown_escaped(summary.finding) + "\n\n";
  text += fmt::format("{}: {}  \n{}: {}\n", counted(all.scene_count, "scene"), scenes_text(summary),
                      counted(all.run_count, "engine run"), all.runs.list());
  return summary.naive.empty() ? text : text + "\n" + markdown_escaped(summary.naive) + "\n";
}

std::string moved_part(const std::optional<Moved>& moved) {
  if (!moved) return {};
  std::string text = "\n### What has moved\n\n" + markdown_escaped(moved->finding) + "\n";
  TextTable table = moved->table;
  const std::size_t count = table.rows.size();
  if (count == 0) return text;
  table.rows.resize(std::min(count, kMostMoved));
  text += "\n" + markdown_table(table);
  if (count > kMostMoved) text += fmt::format("\n… and {} more.\n", count - kMostMoved);
  return text;
}

/// What came to no end of itself, in the scenes that it decides.
std::string failed_part(const std::vector<SceneRecord>& scenes) {
  TextTable table{{{"scene"}, {"run"}, {"why"}}};
  std::size_t count = 0;
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs) {
      if (run.verdict() != Verdict::failed || !decides(scene, run)) continue;
      if (++count <= kWorst)
        table.rows.push_back({{"⚠ " + scene.scenario.name},
                              {run_label(run)},
                              {shortened(finding_text(scene, run), kLongestReason)}});
    }
  if (count == 0) return {};
  std::string text = "\n### What failed\n\n" + markdown_table(table);
  if (count > kWorst) text += fmt::format("\n… and {}.\n", counted(count - kWorst, "more run"));
  return text;
}

std::string worst_part(const Summary& summary) {
  if (summary.worst.empty()) return {};
  TextTable table{comparison_columns({{"scene"}, {"run"}})};
  for (const Finding& finding : summary.worst)
    table.rows.push_back(
        comparison_cells(finding.row, {{finding.scene->scenario.name}, {run_label(*finding.run)}}));
  return "\n### Worst deviations\n\n" + markdown_table(table);
}

std::string scores_part(const Summary& summary) {
  if (summary.scores.empty()) return {};
  TextTable table = score_table(summary);
  const std::size_t count = table.rows.size();
  table.rows.resize(std::min(count, kMostScores));
  std::string text = "\n### Within all tolerances, by profile\n\n" + markdown_table(table);
  if (count > kMostScores) text += fmt::format("\n… and {} more.\n", count - kMostScores);
  return text;
}

/// A scene that is not within, in a row.
std::vector<Cell> scene_row(const SceneRecord& scene) {
  std::size_t within = 0;
  const EngineRecord* first = nullptr;
  for (const EngineRecord& run : scene.runs) {
    within += run.verdict() == Verdict::within ? 1 : 0;
    if (!first && decides(scene, run) && run.verdict() == told_verdict(scene)) first = &run;
  }
  std::vector<Cell> cells = {
      {fmt::format("{} {}", symbol_of(told_verdict(scene)), scene.scenario.name)},
      {fmt::format("{}/{}", within, scene.runs.size())}};
  const auto worst = worst_finding(scene);
  if (worst && told_verdict(scene) == Verdict::deviates) {
    cells.insert(cells.end(), {{off_text(worst->row)}, {run_label(*worst->run)}});
  } else if (first) {
    cells.insert(cells.end(), {{finding_text(scene, *first)}, {run_label(*first)}});
  } else {
    cells.push_back({scene_finding(scene)});
  }
  if (cells.size() > 2) cells[2].text = shortened(cells[2].text, kLongestReason);
  return cells;
}

/// Folded; GitHub wants empty lines about what is Markdown in HTML.
std::string folded(const std::string& summary, const std::string& content) {
  return fmt::format("\n<details><summary>{}</summary>\n\n{}\n</details>\n", summary, content);
}

/// The scenes that are not within, as many as `room` characters hold; the others are counted.
std::string bad_part(const std::vector<SceneRecord>& scenes, std::size_t room) {
  TextTable table{{{"scene"}, {"runs within", true}, {"finding"}, {"run"}}};
  for (const SceneRecord& scene : scenes)
    if (told_verdict(scene) > Verdict::within) table.rows.push_back(scene_row(scene));
  const std::size_t count = table.rows.size();
  if (count == 0) return {};
  const auto text_of = [&] {
    std::string text = markdown_table(table);
    if (table.rows.size() < count)
      text += fmt::format("\n… and {}; there is no room for them here.\n",
                          counted(count - table.rows.size(), "more scene"));
    return folded(fmt::format("{} not within tolerance, one by one", counted(count, "scene")),
                  text);
  };
  std::string text = text_of();
  while (text.size() > room && !table.rows.empty()) {
    table.rows.pop_back();
    text = text_of();
  }
  return text.size() <= room ? text : "";
}

/// The names of those scenes of which there is nothing more to say.
std::string good_part(const std::vector<SceneRecord>& scenes, std::size_t room) {
  std::string names;
  std::size_t count = 0;
  for (const SceneRecord& scene : scenes) {
    if (told_verdict(scene) != Verdict::within) continue;
    names += (count++ > 0 ? ", " : "") + markdown_escaped(scene.scenario.name);
  }
  if (count == 0) return {};
  const std::string head = fmt::format("✓ {} within tolerance", counted(count, "scene"));
  const std::string text = folded(head, names + "\n");
  return text.size() <= room ? text : fmt::format("\n{}\n", head);
}

}  // namespace

std::string markdown_escaped(const std::string& text) {
  const std::string line = printable(text);
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  const std::string_view rest = std::string_view(line).substr(first);
  std::string result;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const char c = rest[k];
    // Inside a word an underscore is one: i.sliding_time stays readable as plain text, too.
    const bool inside =
        k > 0 && k + 1 < rest.size() && is_word(rest[k - 1]) && is_word(rest[k + 1]);
    if (std::string_view("\\`*[]<>#|~&$").find(c) != std::string_view::npos ||
        (c == '_' && !inside) || begins_block(rest, k))
      result += '\\';
    result += c;
    // Calls nobody.
    if (c == '@') result += "<!-- -->";
  }
  return result;
}

std::string markdown_table(const TextTable& table) {
  const auto cell = [](const std::string& text) { return " " + markdown_escaped(text) + " |"; };
  std::string heads = "|", rules = "|", rows;
  for (const Column& column : table.columns) {
    heads += cell(column.header);
    rules += column.right ? " ---: |" : " --- |";
  }
  for (const auto& row : table.rows) {
    rows += "|";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      rows += cell(c < row.size() ? row[c].text : "");
    rows += "\n";
  }
  return heads + "\n" + rules + "\n" + rows;
}

std::string markdown_of(const std::vector<SceneRecord>& scenes, const std::optional<Moved>& moved,
                        std::size_t most) {
  const Summary summary = summarize(scenes, kWorst);
  // Bytes are counted, of which there are never fewer than characters.
  std::string text = head_of(summary);
  const auto room = [&] { return most > text.size() ? most - text.size() : 0; };
  for (const std::string& part :
       {failed_part(scenes), moved_part(moved), worst_part(summary), scores_part(summary)})
    if (part.size() <= room()) text += part;
  const std::string good = good_part(scenes, room() / 3);
  const std::string bad = bad_part(scenes, room() > good.size() ? room() - good.size() : 0);
  text += bad;
  return good.size() <= room() ? text + good : text;
}

std::string engines_markdown(const std::vector<SceneRecord>& scenes) {
  const EngineMatrix matrix = engine_matrix(scenes);
  std::string text = "## Engines over all scenes\n\n";
  if (matrix.methods.empty()) return text + "There are not two scenes and two engines.\n";
  for (const std::string& finding : matrix_findings(matrix))
    text += "- " + markdown_escaped(finding) + "\n";
  text += "\n" + markdown_table(score_table(matrix));
  text +=
      "\n### Scene by engine\n\nThe worst phase's largest error in tolerances, 1 is just within; ✗ "
      "failed, – cannot run it, · nothing is judged.\n\n";
  return text + markdown_table(matrix_table(matrix));
}

}  // namespace slipcheck
