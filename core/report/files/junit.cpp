#include "report/files/junit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "engine/lacks.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/findings.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

using OutcomeKind = TestOutcome::Kind;
using Outcomes = std::vector<const TestOutcome*>;

std::size_t count(const Outcomes& outcomes, OutcomeKind kind) {
  return static_cast<std::size_t>(std::count_if(outcomes.begin(), outcomes.end(),
                                                [&](const auto* o) { return o->kind == kind; }));
}

/// XML has no control characters; of text only the line breaks are kept.
std::string xml_lines(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
    result += (result.empty() ? "" : "\n") + printable(line);
  return result;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(value.c_str());
}

/// There is no such attribute for the skipped of all suites in Jenkins' schema.
void add_totals(pugi::xml_node node, const Outcomes& outcomes, bool with_skipped) {
  double seconds = 0;
  for (const TestOutcome* outcome : outcomes) seconds += outcome->seconds;
  set(node, "tests", fmt::format("{}", outcomes.size()));
  set(node, "failures",
      fmt::format("{}",
                  count(outcomes, OutcomeKind::failed) + count(outcomes, OutcomeKind::undecided)));
  set(node, "errors", fmt::format("{}", count(outcomes, OutcomeKind::error)));
  if (with_skipped) set(node, "skipped", fmt::format("{}", count(outcomes, OutcomeKind::skipped)));
  set(node, "time", fmt::format("{:.6f}", seconds));
}

void add_case(pugi::xml_node suite, const TestOutcome& outcome) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "name", printable(outcome.name));
  set(test, "classname", printable(outcome.suite));
  set(test, "time", fmt::format("{:.6f}", outcome.seconds));
  const std::string text = xml_lines(outcome.text);
  if (outcome.kind == OutcomeKind::passed) {
    if (!text.empty()) test.append_child("system-out").text().set(text.c_str());
    return;
  }
  const bool undecided = outcome.kind == OutcomeKind::undecided,
             skipped = outcome.kind == OutcomeKind::skipped;
  const bool failed = undecided || outcome.kind == OutcomeKind::failed;
  pugi::xml_node result = test.append_child(failed ? "failure" : skipped ? "skipped" : "error");
  set(result, "message", printable(outcome.message));
  if (!skipped) set(result, "type", undecided ? "undecided" : failed ? "deviation" : "engine");
  if (!text.empty()) result.text().set(text.c_str());
}

/// Everything that people are shown of a run, in lines.
std::string text_of(const SceneRecord& scene, const EngineRecord& run) {
  std::string text = run_name(run) + "\n";
  if (run.status == RunStatus::ok) {
    for (const ComparisonRow& row : comparison_rows(scene, run, shown_observables(scene, false)))
      text += fmt::format("{} {}\n", symbol_of(row.verdict), deviation_text(row));
    for (const ExpectationRow& row : expectation_rows(run))
      text += fmt::format("{} {}{}{}: {}, expected {}{}{}\n",
                          symbol_of(row.met ? Verdict::within : Verdict::deviates), row.name,
                          row.statistic.empty() ? "" : " ", row.statistic, row.value.text,
                          row.limits.text, row.note.empty() ? "" : "; ", row.note);
  } else {
    text += fmt::format("{}{}{}\n", outcome_text(run), run.reason.empty() ? "" : ": ", run.reason);
  }
  if (!run.applied.not_represented.empty())
    text += fmt::format("not represented: {}\n",
                        fmt::join(texts_of(run.applied.not_represented), ", "));
  for (const std::string& warning : run.warnings) text += fmt::format("warning: {}\n", warning);
  return text;
}

OutcomeKind kind_of(Verdict verdict, bool allow_undecided) {
  switch (verdict) {
    case Verdict::unjudged:
    case Verdict::within:
      return OutcomeKind::passed;
    case Verdict::undecided:
      return allow_undecided ? OutcomeKind::skipped : OutcomeKind::undecided;
    case Verdict::deviates:
      return OutcomeKind::failed;
    case Verdict::failed:
      break;
  }
  return OutcomeKind::error;
}

TestOutcome outcome_of(const SceneRecord& scene, const EngineRecord& run, bool allow_undecided) {
  TestOutcome outcome;
  outcome.suite = scene.scenario.name;
  outcome.name = run_label(run);
  outcome.seconds = run.cpu_seconds;
  outcome.text = text_of(scene, run);
  outcome.kind = kind_of(run.verdict(), allow_undecided);
  outcome.message = finding_text(scene, run);
  return outcome;
}

TestOutcome reference_outcome(const SceneRecord& scene, bool allow_undecided) {
  TestOutcome outcome;
  outcome.kind = kind_of(scene.reference.run.reached ? Verdict::unjudged : Verdict::undecided,
                         allow_undecided);
  outcome.message = printable(scene.reference.run.reason);
  outcome.suite = scene.scenario.name;
  outcome.name = "reference";
  outcome.seconds = scene.reference.cpu_seconds;
  outcome.text = reference_summary(scene.reference) + "\n";
  for (const std::string& warning : scene.reference.warnings)
    outcome.text += fmt::format("warning: {}\n", warning);
  return outcome;
}

}  // namespace

std::string junit_xml(const std::vector<TestOutcome>& outcomes, const std::string& title) {
  std::vector<std::string> names;
  std::map<std::string, Outcomes> suites;
  Outcomes all;
  for (const TestOutcome& outcome : outcomes) {
    Outcomes& suite = suites[outcome.suite];
    if (suite.empty()) names.push_back(outcome.suite);
    suite.push_back(&outcome);
    all.push_back(&outcome);
  }

  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", printable(title));
  add_totals(root, all, false);
  for (const std::string& name : names) {
    pugi::xml_node suite = root.append_child("testsuite");
    set(suite, "name", printable(name));
    add_totals(suite, suites[name], true);
    for (const TestOutcome* outcome : suites[name]) add_case(suite, *outcome);
  }
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
  return text.str();
}

std::vector<TestOutcome> test_outcomes(const std::vector<SceneRecord>& scenes,
                                       bool allow_undecided) {
  std::vector<TestOutcome> outcomes;
  for (const SceneRecord& scene : scenes) {
    if (scene.runs.empty()) outcomes.push_back(reference_outcome(scene, allow_undecided));
    for (const EngineRecord& run : scene.runs)
      outcomes.push_back(outcome_of(scene, run, allow_undecided));
  }
  return outcomes;
}

}  // namespace slipcheck
