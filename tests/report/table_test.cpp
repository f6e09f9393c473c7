#include "report/terminal/table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "records.h"
#include "report/rows/told_verdict.h"
#include "report/terminal/brief.h"
#include "report/terminal/text.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::string line_with(const std::string& text, const std::string& part) {
  for (const std::string& line : lines(text))
    if (line.find(part) != std::string::npos) return line;
  return "";
}

const TableStyle kWide{.colour = false, .width = 120};

TEST(Table, ShowsReferenceSpreadErrorAndVerdict) {
  const std::string table = table_of(lottery_scene(), kWide);
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ✗ DEVIATES");
  EXPECT_TRUE(contains(table, "Two rolling steel spheres collide head-on"));
  EXPECT_TRUE(contains(
      table, "reference  event solver, 1 collision, ends at 83.00 ms, 1.2 µs of CPU time"));
  EXPECT_TRUE(
      contains(table, "bullet 3.24 double, profile default, 240 Hz, 64 phases, 3.1 µs/step"));
  const std::size_t run = table.find("240 Hz");
  const std::string e = line_with(table.substr(run), "effective_restitution");
  EXPECT_EQ(e,
            "    i-j.effective_restitution     0.3571  0.4280  0.3580 … 0.4980      0.141      "
            "0.005  ✗  DEVIATES");
  const std::string t = line_with(table.substr(run), "i.sliding_time");
  EXPECT_TRUE(contains(t, "27.78 ms"));
  EXPECT_TRUE(contains(t, "27.60 … 27.70"));
  EXPECT_TRUE(contains(t, "0.300 %"));
  EXPECT_TRUE(contains(t, "1 %"));
  EXPECT_TRUE(contains(t, "✓  within"));
  EXPECT_TRUE(contains(table, "not represented: static friction, coupled drilling"));
}

TEST(Table, SetsTheHeadingsBesideTheSpread) {
  SceneRecord scene = lottery_scene();
  EngineRecord& run = scene.runs[0];
  run.scale = 0.01;
  run.phases = 8;
  run.headings = 8;
  run.observables["i-j.effective_restitution"].headings = {.spread = 0.07, .phase = 2};
  run.observables["i.sliding_time"].headings = {.spread = 0.1 / 3.6 / 50, .phase = 0};
  const std::string table = table_of(scene, {.colour = false, .width = 140});
  EXPECT_TRUE(contains(
      table, "bullet 3.24 double, profile default, 240 Hz, scale 0.01, 8 phases × 8 headings"));
  EXPECT_TRUE(contains(table, "over headings"));
  // Absolute of a restitution, else relative to the reference.
  EXPECT_TRUE(
      contains(line_with(table.substr(table.find("240 Hz")), "effective_restitution"), "0.07"));
  EXPECT_TRUE(contains(line_with(table.substr(table.find("240 Hz")), "i.sliding_time"), "2.00 %"));
  EXPECT_FALSE(contains(table_of(lottery_scene(), kWide), "over headings"));
}

TEST(Table, SetsTheClosedFormBesideTheReference) {
  SceneRecord scene = lottery_scene();
  EXPECT_TRUE(contains(table_of(scene, kWide), "0.3571428571, the same to the last bit"));
  scene.reference.closed_form["i-j.effective_restitution"] += 1e-15;
  EXPECT_TRUE(contains(table_of(scene, kWide), "0.3571428571, agrees to 3e-15"));
}

TEST(Table, ShowsAnUncertaintyThatMatters) {
  SceneRecord scene = lottery_scene();
  scene.reference.observables["i.sliding_time"].uncertainty = 3e-5;
  EXPECT_TRUE(contains(table_of(scene, kWide), "27.78 ± 0.03 ms"));
  scene.reference.observables["i.sliding_time"].uncertainty = 1e-13;
  EXPECT_FALSE(contains(table_of(scene, kWide), "±"));
}

TEST(Table, TellsWhatTheMeansOverABoxAreTakenOver) {
  SceneRecord scene = box_scene();
  const TableStyle wide{.colour = false, .width = 200};
  EXPECT_TRUE(contains(table_of(scene, wide),
                       "of CPU time; means over 250 samples after 50 periods, steady; ± holds the "
                       "true mean with 95 %"));
  EXPECT_TRUE(contains(table_of(scene, wide), "5414 ± 400 1/s"));
  EXPECT_TRUE(contains(table_of(scene, wide), "146.1 ± 7 nJ"));
  scene.reference.box->steady = false;
  scene.reference.box->discarded = 0;
  EXPECT_TRUE(contains(table_of(scene, wide), "means over 250 samples, NOT steady"));
}

TEST(Table, FitsItsWidth) {
  SceneRecord scene = lottery_scene();
  scene.runs[0].warnings = {
      "a long warning that certainly needs more than a single line, and "
      "then some more of it to be on the safe side"};
  for (const int width : {60, 80, 100, 140})
    for (const std::string& line : lines(table_of(scene, {.colour = false, .width = width})))
      EXPECT_LE(display_width(line), static_cast<std::size_t>(width)) << line;
}

TEST(Table, KeepsTheVerdictWhereThereIsLittleRoom) {
  const std::string table = table_of(lottery_scene(), {.colour = false, .width = 70});
  EXPECT_TRUE(contains(table, "max error"));
  EXPECT_TRUE(contains(table, "✗"));
  EXPECT_TRUE(contains(table, "… no room for tolerance, median: widen"));
}

TEST(Table, HasAllColumnsInAPipe) {
  const std::string table =
      table_of(lottery_scene(), {.colour = false, .width = 70, .is_bound = false});
  EXPECT_TRUE(contains(line_with(table, "max error"), "median"));
  EXPECT_TRUE(contains(line_with(table, "max error"), "tolerance"));
  EXPECT_FALSE(contains(table, "no room for"));
}

TEST(Table, AlignsColumnsByDisplayWidth) {
  const std::string table = table_of(lottery_scene(), kWide);
  const std::string run = table.substr(table.find("240 Hz"));
  const auto column = [&](const std::string& line, const std::string& symbol) {
    return display_width(line.substr(0, line.find(symbol)));
  };
  EXPECT_EQ(column(line_with(run, "i-j.effective_restitution"), "✗"),
            column(line_with(run, "i.sliding_time"), "✓"));
}

TEST(Table, HasColourOnlyIfAskedFor) {
  EXPECT_FALSE(contains(table_of(lottery_scene(), kWide), "\x1b"));
  EXPECT_TRUE(contains(table_of(lottery_scene(), {.colour = true, .width = 100}), "\x1b[31m✗"));
}

TEST(Table, HidesWhatHasNoToleranceUnlessAskedFor) {
  SceneRecord scene = lottery_scene();
  scene.reference.observables["i.final_velocity.x"] = {1, 0};
  EXPECT_FALSE(contains(table_of(scene, kWide), "final_velocity"));
  EXPECT_TRUE(contains(table_of(scene, kWide), "i-j.restitution"));
  EXPECT_TRUE(contains(table_of(scene, {.colour = false, .width = 120, .all_observables = true}),
                       "i.final_velocity.x"));
}

TEST(Table, ShowsAllLengthsOfASceneWithoutEngines) {
  SceneRecord scene = lottery_scene();
  scene.runs.clear();
  scene.reference.observables["i.final_velocity"] = {1, 0};
  scene.reference.observables["i.final_velocity.x"] = {1, 0};
  const std::string table = table_of(scene, kWide);
  EXPECT_EQ(lines(table)[0], "symmetric-steel  – reference alone");
  EXPECT_TRUE(contains(table, "i.final_velocity "));
  EXPECT_FALSE(contains(table, "i.final_velocity.x"));
}

TEST(Table, SaysWhyARunIsNotThere) {
  SceneRecord scene = lottery_scene();
  scene.runs = {failed_run(EngineRecord::Status::timed_out, "no end after 60 s"),
                failed_run(EngineRecord::Status::skipped, "not installed")};
  const std::string table = table_of(scene, kWide);
  EXPECT_TRUE(contains(table, "⚠ timed out: no end after 60 s"));
  EXPECT_TRUE(contains(table, "? skipped: not installed"));
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ⚠ FAILED");
}

TEST(Table, ShowsWhatAnEngineIsExpectedToDo) {
  SceneRecord scene = expected_lottery();
  std::string table = table_of(scene, kWide);
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ✓ as expected");
  std::string run = table.substr(table.find("240 Hz"));
  // The error is there, but no tolerance judges it.
  EXPECT_TRUE(contains(line_with(run, "0.3571"), "0.141          –  –"));
  EXPECT_FALSE(contains(run, "DEVIATES"));
  const std::string expected = run.substr(run.find("of this engine"));
  EXPECT_EQ(line_with(expected, "restitution"),
            "    i-j.effective_restitution  max  0.4980  0.4900 … 0.5000  ✓  as expected");
  EXPECT_EQ(line_with(expected, "jump_height"),
            "    j.jump_height                        –  not seen         ✓  as expected");

  scene.runs[0].expect->observables["i-j.effective_restitution"] = expected_max(0.4, 0.45);
  scene.runs[0].observables["j.jump_height"] = {1e-3, 1e-3, 1e-3, {1e-3, kNaN}, 1};
  table = table_of(scene, kWide);
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ✗ NOT AS EXPECTED");
  run = table.substr(table.find("of this engine"));
  EXPECT_TRUE(contains(line_with(run, "restitution"),
                       "max    0.4980  0.4000 … 0.4500  ✗  NOT AS EXPECTED"));
  EXPECT_TRUE(
      contains(line_with(run, "j.jump_height"), "1.000 mm  not seen         ✗  NOT AS EXPECTED"));
  EXPECT_TRUE(contains(run, "j.jump_height: 1 of 2 phases do not show it"));
}

TEST(Table, ShowsHowARunWasExpectedToEnd) {
  SceneRecord scene = lottery_scene();
  scene.runs = {failed_run(EngineRecord::Status::unstable, "not finite"),
                failed_run(EngineRecord::Status::timed_out, "60 s"), lottery_run(240, 64)};
  for (EngineRecord& run : scene.runs) run.expect = Expectation{RunStatus::unstable, {}};
  const std::string table = table_of(scene, kWide);
  EXPECT_TRUE(contains(table, "✓ unstable, as expected: not finite"));
  EXPECT_TRUE(contains(table, "✗ timed out, NOT AS EXPECTED (unstable): 60 s"));
  EXPECT_TRUE(contains(table, "✗ ran to its end, NOT AS EXPECTED (unstable)"));
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ✗ NOT AS EXPECTED");
  EXPECT_EQ(
      summary_of({scene}, kWide),
      "1 scene: 0 within, 1 deviates, 0 undecided, 0 failed; 3 engine runs: 1 within, 2 deviate, "
      "0 undecided, 0 failed\n1 of 3 runs of which something is expected do as expected.\n");
}

TEST(Table, KeepsItsWordsWhereOnlySomeRunsHaveExpectations) {
  SceneRecord scene = expected_lottery();
  scene.runs.push_back(lottery_run(240, 64));
  EXPECT_EQ(lines(table_of(scene, kWide))[0], "symmetric-steel  ✗ DEVIATES");
}

TEST(Brief, NamesTheFirstThingThatIsNotAsExpected) {
  SceneRecord scene = expected_lottery();
  EXPECT_TRUE(contains(brief_of({scene}, kWide), "symmetric-steel  ✓          1/1\n"));
  scene.runs[0].expect->observables["i-j.effective_restitution"] = expected_max(0.4, 0.45);
  EXPECT_TRUE(contains(brief_of({scene}, kWide),
                       "✗          0/1  i-j.effective_restitution max 0.4980, bullet double "
                       "default 240 Hz"));
}

TEST(Table, ShortensASceneOfManyBodies) {
  SceneRecord scene = lottery_scene();
  scene.runs.resize(1);
  for (int k = 0; k < 100; ++k) {
    const std::string name = fmt::format("g{}.sliding_time", k);
    scene.reference.observables[name] = {0.1, 0};
    scene.runs[0].errors[name] = {0.1, 0.1 + 0.01 * k, 0.01, false, Verdict::deviates, ""};
  }
  const std::string table = table_of(scene, kWide);
  EXPECT_TRUE(contains(table, "rows more, none more severe"));
  EXPECT_TRUE(contains(table.substr(table.find("240 Hz")), "g99.sliding_time"));
  EXPECT_FALSE(contains(table.substr(table.find("240 Hz")), "g0.sliding_time"));
}

TEST(Table, LetsATitleNotControlTheTerminal) {
  SceneRecord scene = lottery_scene();
  scene.scenario.name = scene.scenario.title = "evil \x1b]0;title\x07";
  EXPECT_FALSE(contains(table_of(scene, kWide), "\x1b"));
  EXPECT_FALSE(contains(brief_of({scene}, kWide), "\x1b"));
}

TEST(Summary, CountsScenesAndRuns) {
  SceneRecord good = lottery_scene();
  good.runs = {failed_run(EngineRecord::Status::skipped, "")};
  SceneRecord alone = lottery_scene();
  alone.runs.clear();
  EXPECT_EQ(
      summary_of({lottery_scene(), good, alone}, kWide),
      "3 scenes: 0 within, 1 deviates, 1 undecided, 0 failed, 1 of the reference alone; 3 engine "
      "runs: 0 within, 2 deviate, 1\n"
      "undecided, 0 failed\n"
      "bullet 3.24 default is within all tolerances in 0 of 2 runs; worst: symmetric-steel, "
      "i-j.effective_restitution off by up\n"
      "to 0.141, tolerance 0.005 (bullet double default 240 Hz).\n");
}

TEST(Summary, TellsOfNaiveRunsApart) {
  SceneRecord scene = lottery_scene();
  scene.runs[1].profile = "naive";
  scene.runs[0].errors.erase("i-j.effective_restitution");
  const std::string text = summary_of({scene}, kWide);
  EXPECT_TRUE(contains(text, "1 scene: 1 within, 0 deviate"));
  EXPECT_TRUE(contains(text, "2 engine runs: 1 within, 1 deviates"));
  EXPECT_TRUE(contains(text, "default is within all tolerances in 1 of 1 run.\n"));
  EXPECT_TRUE(contains(text, "in 1 scene only it is"));
  EXPECT_EQ(told_verdict(scene), Verdict::within);
  EXPECT_EQ(scene.verdict(), Verdict::deviates);
}

/// The lottery without collision: a tolerance names what never occurs.
SceneRecord vacuous_scene() {
  SceneRecord scene = lottery_scene();
  scene.reference.observables.erase("i-j.effective_restitution");
  scene.runs.resize(1);
  scene.runs[0].observables.erase("i-j.effective_restitution");
  scene.runs[0].errors.erase("i-j.effective_restitution");
  scene.runs[0].errors["effective_restitution"] = {
      kNaN, kNaN, 0.005, true, Verdict::undecided, "nothing of it occurs in the reference"};
  return scene;
}

TEST(Table, NamesWhatIsUndecidedAndWhy) {
  const std::string table = table_of(vacuous_scene(), kWide);
  EXPECT_EQ(lines(table)[0], "symmetric-steel  ? UNDECIDED");
  const std::string run = table.substr(table.find("240 Hz"));
  EXPECT_TRUE(contains(line_with(run, "effective_restitution"), "?  UNDECIDED"));
  EXPECT_TRUE(contains(run, "effective_restitution: nothing of it occurs in the reference"));
  EXPECT_TRUE(contains(brief_of({vacuous_scene()}, kWide), "symmetric-steel  ?          0/1"));
  EXPECT_TRUE(contains(brief_of({vacuous_scene()}, kWide),
                       "undecided: effective_restitution, bullet double default 240 Hz"));
}

TEST(Table, AReferenceWithoutAnEndIsUndecidedAlsoAlone) {
  SceneRecord scene = lottery_scene();
  scene.runs.clear();
  scene.reference.run.reached = false;
  scene.reference.run.reason = "it goes on";
  EXPECT_EQ(lines(table_of(scene, kWide))[0], "symmetric-steel  ? UNDECIDED");
  EXPECT_TRUE(contains(summary_of({scene}, kWide), "1 scene: 0 within, 0 deviate, 1 undecided"));
}

}  // namespace
}  // namespace slipcheck::testing
