#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/set_option.h"
#include "explain/explain_engines.h"
#include "explain/explain_scene.h"
#include "harness/run/requested_runs.h"
#include "report/rows/quantity.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// Cells of a row, each beneath its column's head where there is one.
std::string in_columns(const ExplainSection& section, const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const ExplainColumn column = k < section.columns.size() ? section.columns[k] : ExplainColumn{};
    text += std::string(section.gap, ' ') + padded(cells[k], column.width, true);
  }
  return text;
}

constexpr std::size_t kMostRows = 6, kMostEngines = 2;  // without --all

bool is_engine(const ExplainSection& section) { return section.title.starts_with("Engine "); }

/// What fits a screen: of each section the first rows, of an engine what it cannot represent; of
/// many engines the first. What the scene needs and warnings stay.
ExplainSections shortened(ExplainSections sections) {
  std::size_t engines = 0, left_out = 0;
  std::erase_if(sections, [&](const ExplainSection& section) {
    const bool goes = is_engine(section) && ++engines > kMostEngines;
    left_out += goes ? 1 : 0;
    return goes;
  });
  for (ExplainSection& section : sections) {
    if (section.title == "Needs" || section.title == "Warnings") continue;
    const std::size_t count = section.rows.size();
    if (is_engine(section))
      std::erase_if(section.rows, [](const ExplainRow& row) {
        return !row.label.empty() || row.remark.starts_with("left out: ");
      });
    if (section.rows.size() > kMostRows) section.rows.resize(kMostRows);
    if (section.rows.size() < count)
      section.add(fmt::format("… {} more: --all", count - section.rows.size()));
  }
  if (left_out > 0 && !sections.empty())
    sections.back().add(fmt::format("… and {} more: --all", counted(left_out, "engine section")));
  return sections;
}

void print(ExplainSections all_sections, bool all) {
  const ExplainSections sections =
      all ? std::move(all_sections) : shortened(std::move(all_sections));
  for (const ExplainSection& section : sections) {
    std::vector<std::string> heads;
    for (const ExplainColumn& column : section.columns) heads.push_back(column.head);
    const std::string head = in_columns(section, heads);
    const std::size_t width = section.label_width;
    if (!section.is_part) {
      fmt::print("\n  {}\n", section.title);
      if (!head.empty()) fmt::print("    {}{}\n", padded("", width), head);
    } else if (!section.title.empty()) {
      fmt::print("      {}{}\n", head.empty() ? section.title : padded(section.title, width - 2),
                 head);
    }
    for (const auto& [label, values, remark] : section.rows) {
      if (label.empty() && values.empty())
        fmt::print("    {}\n", remark);
      else if (values.empty())
        fmt::print("    {} {}\n", padded(label, width), remark);
      else
        fmt::print("    {}{}{}{}\n", padded(label, width), in_columns(section, values),
                   remark.empty() ? "" : "  ", remark);
    }
  }
}

void explain(const Scenario& scenario, const std::vector<EngineRecord>& runs, bool general,
             bool all) {
  fmt::print("{}  {}\n", scenario.name, scenario.title);
  if (!scenario.source.empty()) fmt::print("  source: {}\n", scenario.source);
  try {
    const ContactScene scene = make_contact_scene(scenario);
    const Explanation explanation = explain_scene(scenario, scene, general);
    fmt::print("  solver: {}\n", explanation.solver);
    print(explanation.sections, all);
    if (!runs.empty())
      print(explain_engines(scenario, EngineScene(scene), runs, &interrupted()), all);
  } catch (const Unsupported& unsupported) {
    fmt::print("\n  No solver for this scene:\n{}\n", unsupported.what());
  }
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "explain", "Tell what a scene needs, what is left out and what is expected; runs nothing");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", *files, "Scenario files")->required();
  auto general = std::make_shared<bool>(false);
  add_general_option(*command, *general);
  auto all = std::make_shared<bool>(false);
  command->add_flag("--all", *all, "Every row, where else it is what fits a screen");
  accept_quiet(*command);
  command->footer("Example:\n  slipcheck explain scenarios/symmetric-30cms.yaml");
  command->callback([files, general, all, &exit_code] {
    watch_for_interrupts();
    const std::vector<Scenario> scenarios = load_files(*files);
    const auto runs = requested_runs(scenarios, {}, &interrupted(), {}, *general);
    for (std::size_t s = 0; s < scenarios.size(); ++s)
      explain(scenarios[s], runs[s], *general, *all);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
