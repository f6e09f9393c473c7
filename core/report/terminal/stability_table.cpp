#include "report/terminal/stability_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "report/rows/outcome_look.h"
#include "report/rows/quantity.h"
#include "report/rows/stability_rows.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// How much room an outcome and a method's name take.
enum class Room { wide, brief, letters };

std::string outcome_text(Outcome outcome, Room room) {
  const OutcomeLook& look = look_of(outcome);
  return room == Room::wide ? name_of(outcome) : room == Room::brief ? look.brief : look.letter;
}

/// Heads of the methods' columns: whole names, or "d tun" of "bullet double tuned" where that tells
/// them apart, or numbers.
std::vector<std::string> heads_of(const std::vector<StabilityMethod>& methods, Room room) {
  std::vector<std::string> heads;
  for (const StabilityMethod& method : methods)
    heads.push_back(room == Room::wide
                        ? printable(method.label())
                        : printable(fmt::format("{} {}", method.precision.substr(0, 1),
                                                method.profile.substr(0, 3))));
  const std::set<std::string> distinct(heads.begin(), heads.end());
  if (room == Room::letters || distinct.size() < heads.size())
    for (std::size_t k = 0; k < heads.size(); ++k) heads[k] = std::to_string(k + 1);
  return heads;
}

std::string catalogue(const StabilityOverview& overview, Room room, const TableStyle& style) {
  TextTable table{{{"case"}, {"reference"}}};
  for (const std::string& head : heads_of(overview.methods, room)) table.columns.push_back({head});
  for (const StabilityRow& row : overview.rows) {
    const Outcome reference = outcome_of(row.scene->reference);
    std::vector<Cell>& cells = table.rows.emplace_back(
        std::vector<Cell>{{row.label}, {word_of(row.scene->reference), tone_of(reference)}});
    for (const StabilityRun* run : row.runs)
      cells.push_back(run ? Cell{outcome_text(run->outcome, room), tone_of(run->outcome)} : Cell{});
  }
  return terminal_table(std::move(table), style, 2);
}

bool fits(const StabilityOverview& overview, Room room, int width) {
  TableStyle endless;
  endless.width = 1'000'000;
  std::string text = catalogue(overview, room, endless);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (display_width(std::string_view(text).substr(begin, end - begin)) >
        static_cast<std::size_t>(std::max(width, 1)))
      return false;
    begin = end + 1;
  }
  return true;
}

/// What short heads and words stand for.
std::string legend(const StabilityOverview& overview, Room room, const TableStyle& style) {
  if (room == Room::wide) return {};
  const std::vector<std::string> heads = heads_of(overview.methods, room);
  std::vector<std::string> methods, words;
  for (std::size_t k = 0; k < heads.size(); ++k)
    methods.push_back(fmt::format("{} = {}", heads[k], printable(overview.methods[k].label())));
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    const bool occurs = std::any_of(overview.totals.begin(), overview.totals.end(),
                                    [&](const OutcomeCounts& counts) { return counts[k] > 0; });
    if (occurs && outcome_text(outcome, room) != name_of(outcome))
      words.push_back(fmt::format("{} = {}", outcome_text(outcome, room), name_of(outcome)));
  }
  return paragraph("", fmt::format("{}", fmt::join(methods, ", ")), Tone::faint, style) +
         paragraph("", fmt::format("{}", fmt::join(words, ", ")), Tone::faint, style);
}

std::string totals(const StabilityOverview& overview, const TableStyle& style) {
  if (overview.methods.empty()) return {};
  std::vector<std::size_t> shown = {0};  // columns: the method, then what occurs
  for (std::size_t k = 0; k < kOutcomes; ++k)
    if (std::ranges::any_of(overview.totals, [&](const auto& counts) { return counts[k] > 0; }))
      shown.push_back(k + 1);
  TextTable table = totals_table(overview, Tone::faint).with(shown);
  table.columns[0].header = "runs";
  // Whole words where they fit.
  std::size_t width = 4;
  for (const auto& row : table.rows) width = std::max(width, 2 + display_width(row[0].text));
  for (std::size_t c = 1; c < shown.size(); ++c)
    width += 2 + std::max<std::size_t>(3, display_width(table.columns[c].header));
  if (width > static_cast<std::size_t>(std::max(style.width, 1)))
    for (std::size_t c = 1; c < shown.size(); ++c)
      table.columns[c].header = look_of(static_cast<Outcome>(shown[c] - 1)).brief;
  return "\n" + terminal_table(std::move(table), style, 2);
}

std::string reference_line(const StabilityOverview& overview, const TableStyle& style) {
  return fmt::format("  reference: {}, {} refused with the reason, {}\n",
                     inked(fmt::format("{} accurate", overview.accurate), Tone::good, style),
                     overview.refused,
                     inked(fmt::format("{} failed", overview.failed),
                           overview.failed > 0 ? Tone::bad : Tone::plain, style));
}

std::string reasons(const std::vector<StabilityCase>& cases, const TableStyle& style) {
  std::string text;
  for (const StabilityCase& scene : cases) {
    const std::string name = printable(scene.scenario.name);
    if (!scene.reference.accurate)
      text +=
          paragraph(fmt::format("{}, reference {}: ", name, word_of(scene.reference)),
                    scene.reference.why, scene.reference.refused ? Tone::faint : Tone::bad, style);
    if (!style.all_observables) continue;
    for (const StabilityRun& run : scene.runs)
      if (run.outcome != Outcome::accurate)
        text += paragraph(
            fmt::format("{}, {} {} {}, {:g} Hz: ", name, run.record.engine, run.record.precision,
                        printable(run.record.profile), run.record.rate),
            words_of(run), tone_of(run.outcome), style);
  }
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string stability_table(const std::vector<StabilityCase>& cases, const TableStyle& style) {
  const StabilityOverview overview = overview_of(cases);
  Room room = Room::wide;
  for (const Room smaller : {Room::brief, Room::letters})
    if (!fits(overview, room, style.width)) room = smaller;
  std::string text = inked(counted(cases.size(), "case"), Tone::strong, style);
  if (overview.rate) text += fmt::format(", engines at {:g} Hz", *overview.rate);
  text += "\n" + catalogue(overview, room, style) + legend(overview, room, style);
  return text + totals(overview, style) + reference_line(overview, style) + reasons(cases, style);
}

std::string limits_table(const LimitResults& results, const TableStyle& style) {
  std::string text;
  for (const LimitGroup& group : limit_groups(results.limits)) {
    TextTable table = limits_table(group.limits).with({0, 3, 4, 5, 6});
    table.columns[1] = {"good … bad"};
    if (std::ranges::none_of(group.limits,
                             [](const Limit* limit) { return limit->theory.has_value(); }))
      table.columns[2].header = table.columns[3].header = "";
    std::string notes;
    for (const Limit* limit : group.limits) {
      const std::string label = printable(label_of(*limit));
      if (!limit->reason.empty())
        notes += paragraph("! " + label + ": ", limit->reason, Tone::bad, style);
      if (!limit->islands.empty()) {
        std::vector<std::string> values;
        for (double island : limit->islands) values.push_back(value_text(limit->kind, island));
        notes += paragraph("! " + label + ": ",
                           fmt::format("bad all the same at {}", fmt::join(values, ", ")),
                           Tone::bad, style);
      }
    }
    std::string head = words_of(group.kind);
    head.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(head.front())));
    text += fmt::format("{}{}, {}\n", text.empty() ? "" : "\n", inked(head, Tone::strong, style),
                        printable(group.scene));
    text += terminal_table(std::move(table), style, 2) + notes;
  }
  return text;
}

}  // namespace slipcheck
