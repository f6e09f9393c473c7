#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/set_option.h"
#include "explain/explain_engines.h"
#include "explain/explain_scene.h"
#include "harness/run/requested_runs.h"
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

void print(const ExplainSections& sections) {
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

void explain(const Scenario& scenario, const std::vector<EngineRecord>& runs, bool general) {
  fmt::print("{}  {}\n", scenario.name, scenario.title);
  if (!scenario.source.empty()) fmt::print("  source: {}\n", scenario.source);
  try {
    const ContactScene scene = make_contact_scene(scenario);
    const Explanation explanation = explain_scene(scenario, scene, general);
    fmt::print("  solver: {}\n", explanation.solver);
    print(explanation.sections);
    print(explain_engines(scenario, EngineScene(scene), runs, &interrupted()));
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
  accept_quiet(*command);
  command->footer("Example:\n  slipcheck explain scenarios/symmetric-30cms.yaml");
  command->callback([files, general, &exit_code] {
    watch_for_interrupts();
    const std::vector<Scenario> scenarios = load_files(*files);
    const auto runs = requested_runs(scenarios, {}, &interrupted(), {}, *general);
    for (std::size_t s = 0; s < scenarios.size(); ++s) explain(scenarios[s], runs[s], *general);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
