#include "report/files/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "report/rows/engine_matrix.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/findings.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kWorst = 5;
constexpr std::size_t kMostOfRun = 8;

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

std::string head_of(const std::vector<SceneRecord>& scenes) {
  const AllVerdicts all = count_verdicts(scenes);
  const std::size_t bad = all.scenes.of(Verdict::undecided) + all.scenes.of(Verdict::deviates) +
                          all.scenes.of(Verdict::failed);
  const std::size_t good = all.scenes.of(Verdict::within);
  const std::string verdict =
      bad > 0 ? fmt::format("{} of {} not within tolerance", bad, counted(scenes.size(), "scene"))
      : good > 0 ? "all within tolerance"
                 : "nothing was judged";
  std::string text = fmt::format("## {} Slipcheck: {}\n\n{}: {}",
                                 bad > 0    ? "✗"
                                 : good > 0 ? "✓"
                                            : "–",
                                 verdict, counted(scenes.size(), "scene"), all.scenes.list());
  if (all.scenes_alone > 0) text += fmt::format(", {} of the reference alone", all.scenes_alone);
  return text + fmt::format("  \n{}: {}\n", counted(all.run_count, "engine run"), all.runs.list());
}

std::string worst_part(const std::vector<SceneRecord>& scenes) {
  const std::vector<Finding> findings = worst_findings(scenes, kWorst);
  if (findings.empty()) return {};
  TextTable table{comparison_columns({{"scene"}, {"run"}})};
  for (const Finding& finding : findings)
    table.rows.push_back(
        comparison_cells(finding.row, {{finding.scene->scenario.name}, {run_label(*finding.run)}}));
  return "\n### Worst deviations\n\n" + markdown_table(table);
}

/// A run that is not within, as rows of its scene's table; the worst of its observables.
void add_rows(const SceneRecord& scene, const EngineRecord& run, TextTable& table) {
  const auto whose = [label = run_label(run)](Verdict verdict) {
    return Cell{std::string(symbol_of(verdict)) + " " + label};
  };
  const Cell bad = whose(Verdict::deviates);
  if (run.status != RunStatus::ok || (run.expect && run.expect->status)) {
    table.rows.push_back({whose(run.verdict()), {finding_text(scene, run)}});
    return;
  }
  for (const ExpectationRow& row : expectation_rows(run))
    if (!row.met)
      table.rows.push_back(
          {bad, {row.name + " " + row.statistic}, {"expected " + row.limits.text}, row.value});
  std::vector<ComparisonRow> rows = comparison_rows(scene, run, shown_observables(scene, false));
  std::erase_if(rows, [](const ComparisonRow& row) {
    return row.verdict != Verdict::deviates && row.verdict != Verdict::undecided;
  });
  const std::size_t count = rows.size();
  for (ComparisonRow& row : most_severe(std::move(rows), kMostOfRun)) {
    if (!row.note.empty()) row.name += " (" + row.note + ")";
    table.rows.push_back(comparison_cells(row, {whose(row.verdict)}));
  }
  if (count > kMostOfRun) table.rows.push_back({bad, {fmt::format("{} more", count - kMostOfRun)}});
}

std::string scene_part(const SceneRecord& scene) {
  TextTable table{comparison_columns({{"run"}})};
  VerdictCounts counts;
  for (const EngineRecord& run : scene.runs) {
    counts.add(run.verdict());
    if (run.verdict() > Verdict::within) add_rows(scene, run, table);
  }
  std::string text = fmt::format("\n### {} {}\n\n", symbol_of(scene.verdict()),
                                 markdown_escaped(scene.scenario.name));
  if (!scene.scenario.title.empty())
    text += fmt::format("{}. ", markdown_escaped(scene.scenario.title));
  if (!scene.reference.run.reached)
    text += fmt::format("The reference did not end: {}. ",
                        markdown_escaped(scene.reference.run.reason));
  if (table.rows.empty()) return text + "\n";
  return text + fmt::format("{}: {}.\n\n", counted(scene.runs.size(), "run"), counts.list()) +
         markdown_table(table);
}

/// The names of those scenes of which there is nothing more to say.
std::string good_part(const std::vector<SceneRecord>& scenes) {
  std::string names;
  std::size_t count = 0;
  for (const SceneRecord& scene : scenes) {
    if (scene.verdict() != Verdict::within) continue;
    names += (count++ > 0 ? ", " : "") + markdown_escaped(scene.scenario.name);
  }
  return count == 0 ? "" : fmt::format("\n**✓ {} within tolerance**: {}\n", count, names);
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

std::string markdown_of(const std::vector<SceneRecord>& scenes, std::size_t most) {
  constexpr std::size_t kRoom = 120;  // for what is said about what is left out
  std::string text = head_of(scenes) + worst_part(scenes);
  std::vector<std::string> parts;
  for (const SceneRecord& scene : scenes)
    if (scene.verdict() > Verdict::within) parts.push_back(scene_part(scene));
  // Bytes are counted, of which there are never fewer than characters.
  std::size_t shown = 0;
  while (shown < parts.size() && text.size() + parts[shown].size() + kRoom <= most)
    text += parts[shown++];
  if (shown < parts.size())
    text += fmt::format(
        "\n… and {} that deviate, are undecided or failed; there is no room for them here.\n",
        counted(parts.size() - shown, "more scene"));
  const std::string good = good_part(scenes);
  return text.size() + good.size() <= most ? text + good : text;
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
