#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>
#include <vector>

#include "records.h"
#include "report/files/junit.h"
#include "report/files/markdown.h"
#include "report/files/result_csv.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

using Kind = TestOutcome::Kind;

const std::string kHostile = "<a&\"b'>|`c`\n\x01\x1b[31m]]> _d_ \xff";

/// RFC 4180: rows of fields.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') {
      if (quoted && k + 1 < text.size() && text[k + 1] == '"')
        rows.back().back() += text[k++];
      else
        quoted = !quoted;
    } else if (!quoted && text[k] == ',') {
      rows.back().emplace_back();
    } else if (!quoted && text[k] == '\n') {
      if (k + 1 < text.size()) rows.push_back({""});
    } else {
      rows.back().back() += text[k];
    }
  }
  return rows;
}

/// The field of a row under a name.
std::string at(const std::vector<std::vector<std::string>>& rows, std::size_t row,
               const std::string& column) {
  for (std::size_t k = 0; k < rows[0].size(); ++k)
    if (rows[0][k] == column) return rows.at(row).at(k);
  ADD_FAILURE() << "no column " << column;
  return {};
}

TEST(JUnit, CountsBySuiteInTheOrderInWhichTheyCome) {
  pugi::xml_document document;
  const std::string xml = junit_xml({{"b", "one", Kind::passed, 0.25, "", "fine"},
                                     {"a", "two", Kind::failed, 0.5, "off", "by\nmuch"},
                                     {"b", "three", Kind::error, 1, "crashed", ""},
                                     {"b", "four", Kind::skipped, 0, "no such sphere", ""}});
  ASSERT_TRUE(document.load_string(xml.c_str()));
  const pugi::xml_node root = document.child("testsuites");
  EXPECT_STREQ(root.attribute("tests").value(), "4");
  EXPECT_STREQ(root.attribute("failures").value(), "1");
  EXPECT_STREQ(root.attribute("errors").value(), "1");
  EXPECT_DOUBLE_EQ(root.attribute("time").as_double(), 1.75);
  const pugi::xml_node b = root.first_child(), a = b.next_sibling();
  EXPECT_STREQ(b.attribute("name").value(), "b");
  EXPECT_STREQ(b.attribute("tests").value(), "3");
  EXPECT_STREQ(b.attribute("failures").value(), "0");
  EXPECT_STREQ(b.attribute("errors").value(), "1");
  EXPECT_STREQ(b.attribute("skipped").value(), "1");
  EXPECT_STREQ(a.attribute("name").value(), "a");
  EXPECT_FALSE(a.next_sibling());

  const pugi::xml_node one = b.first_child();
  EXPECT_STREQ(one.name(), "testcase");
  EXPECT_STREQ(one.attribute("classname").value(), "b");
  EXPECT_STREQ(one.child("system-out").text().get(), "fine");
  const pugi::xml_node failure = a.child("testcase").child("failure");
  EXPECT_STREQ(failure.attribute("message").value(), "off");
  EXPECT_STREQ(failure.text().get(), "by\nmuch");
  EXPECT_STREQ(
      b.find_child_by_attribute("name", "three").child("error").attribute("message").value(),
      "crashed");
  EXPECT_STREQ(
      b.find_child_by_attribute("name", "four").child("skipped").attribute("message").value(),
      "no such sphere");
}

TEST(JUnit, HostileTextStaysWellFormed) {
  pugi::xml_document document;
  const std::string xml =
      junit_xml({{kHostile, kHostile, Kind::failed, 0, kHostile, "one\n" + kHostile}});
  ASSERT_TRUE(document.load_string(xml.c_str()));
  const pugi::xml_node test = document.child("testsuites").child("testsuite").child("testcase");
  // Line breaks of a name are blanks; what XML cannot hold is U+FFFD.
  const std::string shown = "<a&\"b'>|`c` \uFFFD\uFFFD[31m]]> _d_ \uFFFD";
  EXPECT_EQ(test.attribute("name").value(), shown);
  EXPECT_EQ(test.child("failure").attribute("message").value(), shown);
  EXPECT_STREQ(test.child("failure").text().get(),
               "one\n<a&\"b'>|`c`\n\uFFFD\uFFFD[31m]]> _d_ \uFFFD");
  for (const char c : xml) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
}

TEST(JUnit, NothingIsAFileToo) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junit_xml({}).c_str()));
  EXPECT_STREQ(document.child("testsuites").attribute("tests").value(), "0");
}

TEST(TestOutcomes, ADeviationNamesTheWorstWithItsNumbers) {
  const std::vector<TestOutcome> outcomes = test_outcomes({lottery_scene()});
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[0].suite, "symmetric-steel");
  EXPECT_EQ(outcomes[0].name, "bullet double default 240 Hz");
  EXPECT_EQ(outcomes[0].kind, Kind::failed);
  EXPECT_DOUBLE_EQ(outcomes[0].seconds, 3.1e-4);
  EXPECT_EQ(outcomes[0].message,
            "i-j.effective_restitution: reference 0.3571, median 0.4280 (0.3580 … 0.4980), error "
            "0.141, tolerance 0.005");
  EXPECT_TRUE(contains(outcomes[0].text, "✓ i.sliding_time: reference 27.78 ms"));
  EXPECT_TRUE(contains(outcomes[0].text, "not represented: static friction, coupled drilling\n"));
}

TEST(TestOutcomes, StatusesExpectationsAndTheReferenceAlone) {
  SceneRecord scene = lottery_scene();
  scene.runs = {failed_run(RunStatus::crashed, "signal 11"),
                failed_run(RunStatus::skipped, "no single precision"), lottery_run(240, 4)};
  scene.runs[2].errors.clear();
  const std::vector<TestOutcome> outcomes = test_outcomes({scene, expected_lottery(), box_scene()});
  ASSERT_EQ(outcomes.size(), 5u);
  EXPECT_EQ(outcomes[0].kind, Kind::error);
  EXPECT_EQ(outcomes[0].message, "crashed: signal 11");
  EXPECT_EQ(outcomes[1].kind, Kind::undecided);
  EXPECT_EQ(outcomes[1].message, "skipped: no single precision");
  EXPECT_EQ(test_outcomes({scene}, true).at(1).kind, Kind::skipped);
  EXPECT_EQ(outcomes[2].kind, Kind::passed);
  EXPECT_EQ(outcomes[2].message, "");
  EXPECT_EQ(outcomes[3].kind, Kind::passed);  // a largest value of 0.498 is expected
  EXPECT_EQ(outcomes[4].name, "reference");
  EXPECT_EQ(outcomes[4].kind, Kind::passed);

  SceneRecord unmet = expected_lottery();
  unmet.runs[0].expect->observables["i-j.effective_restitution"] = expected_max(0.3, 0.4);
  const TestOutcome outcome = test_outcomes({unmet}).at(0);
  EXPECT_EQ(outcome.kind, Kind::failed);
  EXPECT_EQ(outcome.message, "i-j.effective_restitution max 0.4980, expected 0.3000 … 0.4000");
}

TEST(TestOutcomes, AReferenceWithoutAnEndIsAFailureUnlessAllowed) {
  SceneRecord scene = box_scene();
  scene.reference.run.reached = false;
  scene.reference.run.reason = "it goes on";
  EXPECT_EQ(test_outcomes({scene}).at(0).kind, Kind::undecided);
  EXPECT_EQ(test_outcomes({scene}).at(0).message, "it goes on");
  EXPECT_EQ(test_outcomes({scene}, true).at(0).kind, Kind::skipped);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junit_xml(test_outcomes({scene})).c_str()));
  EXPECT_STREQ(document.select_node("//failure").node().attribute("type").value(), "undecided");
  EXPECT_STREQ(document.child("testsuites").attribute("failures").value(), "1");
}

TEST(Markdown, TextIsLiteral) {
  EXPECT_EQ(markdown_escaped("i.sliding_time"), "i.sliding_time");
  EXPECT_EQ(markdown_escaped("_a_ *b* `c` [d](e) <f> a|b ~g~ &amp; \\ $x$ #1"),
            "\\_a\\_ \\*b\\* \\`c\\` \\[d\\](e) \\<f\\> a\\|b \\~g\\~ \\&amp; \\\\ \\$x\\$ \\#1");
  EXPECT_EQ(markdown_escaped("a\nb\tc"), "a b c");
  EXPECT_EQ(markdown_escaped("    - no list"), "\\- no list");
  EXPECT_EQ(markdown_escaped("12. no list"), "12\\. no list");
  EXPECT_EQ(markdown_escaped("1.5 ms"), "1.5 ms");
  EXPECT_EQ(markdown_escaped("-1.5"), "-1.5");
  EXPECT_EQ(markdown_escaped("---"), "\\---");
  EXPECT_EQ(markdown_escaped("@all"), "@<!-- -->all");
  EXPECT_EQ(markdown_escaped("\x1b"), "\uFFFD");
}

TEST(Markdown, ATableHasOneLineARowAndItsCells) {
  EXPECT_EQ(markdown_table({{{"a"}, {"b", true}}, {{{"x|y"}, {"1"}}, {{"line\nbreak"}, {"2"}}}}),
            "| a | b |\n| --- | ---: |\n| x\\|y | 1 |\n| line break | 2 |\n");
}

TEST(Markdown, SaysWhatDeviatesAndWhatIsWithin) {
  SceneRecord good = lottery_scene();
  good.scenario.name = "good-scene";
  for (EngineRecord& run : good.runs) run.errors.erase("i-j.effective_restitution");
  SceneRecord crashed = lottery_scene();
  crashed.scenario.name = "crashed-scene";
  crashed.runs = {failed_run(RunStatus::crashed, "signal 11")};
  const std::string text = markdown_of({lottery_scene(), good, crashed, box_scene()});
  EXPECT_TRUE(text.starts_with(
      "## ⚠ Slipcheck: 2 of 4 scenes not within tolerance\n\n"
      "bullet 3.24 default is within all tolerances in 2 of 4 runs, bullet tuned in 0 of 1; worst: "
      "symmetric-steel, "
      "i-j.effective_restitution off by up to 0.141, tolerance 0.005 (bullet double default 240 "
      "Hz).\n\n"
      "4 scenes: 1 within, 1 deviates, 0 undecided, 1 failed, 1 of the reference alone  \n"
      "5 engine runs: 2 within, 2 deviate, 0 undecided, 1 failed\n"));
  EXPECT_TRUE(contains(text, "### What failed\n"));
  EXPECT_TRUE(
      contains(text, "| ⚠ crashed-scene | bullet single tuned 240 Hz | crashed: signal 11 |"));
  EXPECT_TRUE(contains(text, "### Worst deviations\n"));
  EXPECT_TRUE(contains(text,
                       "| symmetric-steel | bullet double default 240 Hz | "
                       "i-j.effective_restitution | 0.3571 | 0.4280 | 0.3580 … 0.4980 | 0.141 | "
                       "0.005 |\n"));
  EXPECT_TRUE(contains(text, "| bullet 3.24 | default | 2 | 4 | 2 | · | · | · |"));
  EXPECT_TRUE(contains(text, "<summary>2 scenes not within tolerance, one by one</summary>\n\n|"));
  EXPECT_TRUE(contains(text,
                       "| ✗ symmetric-steel | 0/2 | i-j.effective_restitution off by up to 0.141, "
                       "tolerance 0.005 | bullet double default 240 Hz |"));
  EXPECT_TRUE(contains(text, "<summary>✓ 1 scene within tolerance</summary>\n\ngood-scene\n"));
  EXPECT_FALSE(contains(text, "✗ good-scene"));

  const std::string fine = markdown_of({good});
  EXPECT_TRUE(fine.starts_with("## ✓ Slipcheck: all within tolerance\n"));
  EXPECT_FALSE(contains(fine, "Worst"));
}

TEST(Markdown, FitsAndCountsWhatDoesNot) {
  std::vector<SceneRecord> scenes(94, lottery_scene(4));
  for (std::size_t k = 0; k < scenes.size(); ++k) scenes[k].scenario.name += std::to_string(k);
  for (const std::size_t most : {3000u, 8000u}) {
    const std::string text = markdown_of(scenes, std::nullopt, most);
    EXPECT_LE(text.size(), most);
    const std::size_t shown = count(text, "\n| ✗ ");
    EXPECT_GT(shown, 1u);
    EXPECT_LT(shown, 94u);
    EXPECT_TRUE(
        contains(text, "… and " + std::to_string(94 - shown) + " more scenes; there is no"));
  }
  scenes.resize(20);
  EXPECT_EQ(count(markdown_of(scenes), "\n| ✗ "), 20u);
}

TEST(Markdown, TellsWhatHasMoved) {
  Moved moved;
  moved.finding = "1 of 2 values has moved";
  moved.table.columns = {{"scene"}, {"now"}};
  moved.table.rows.push_back({{"one"}, {"0.5"}});
  const std::string text = markdown_of({lottery_scene()}, moved);
  EXPECT_TRUE(contains(text, "### What has moved\n\n1 of 2 values has moved\n\n| scene | now |\n"));
  EXPECT_LT(text.find("What has moved"), text.find("Worst deviations"));
}

TEST(ResultCsv, ARowForEachObservableOfEachRun) {
  SceneRecord scene = lottery_scene(4);
  scene.scenario.name = "a,\"b\"\nc";
  scene.runs.push_back(failed_run(RunStatus::crashed, "signal 11"));
  const auto rows = parsed_csv(results_csv({scene, box_scene()}));
  // Four of the reference in each of two runs, one for the crash, four of the box.
  ASSERT_EQ(rows.size(), 1u + 4 + 4 + 1 + 4);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(at(rows, 1, "scene"), "a,\"b\"\nc");
  EXPECT_EQ(at(rows, 1, "observable"), "i-j.effective_restitution");
  EXPECT_EQ(at(rows, 1, "status"), "ok");
  EXPECT_EQ(at(rows, 1, "version"), "3.24");
  EXPECT_EQ(at(rows, 1, "rate"), "240");
  EXPECT_EQ(std::stod(at(rows, 1, "reference")), 5.0 / 14);
  EXPECT_EQ(at(rows, 1, "uncertainty"), "1e-16");
  EXPECT_EQ(std::stod(at(rows, 1, "closed_form")), 5.0 / 14);
  EXPECT_EQ(at(rows, 1, "median"), "0.428");
  EXPECT_EQ(at(rows, 1, "min"), "0.358");
  EXPECT_EQ(at(rows, 1, "median_error"), "0.071");
  EXPECT_EQ(at(rows, 1, "max_error"), "0.141");
  EXPECT_EQ(at(rows, 1, "absolute"), "true");
  EXPECT_EQ(at(rows, 1, "tolerance"), "0.005");
  EXPECT_EQ(at(rows, 1, "within"), "false");
  EXPECT_EQ(at(rows, 1, "phases"), "4");
  EXPECT_EQ(at(rows, 1, "missing"), "0");
  EXPECT_EQ(at(rows, 1, "steps"), "100");
  EXPECT_EQ(at(rows, 1, "scale"), "1");
  EXPECT_EQ(at(rows, 1, "headings"), "1");
  EXPECT_EQ(at(rows, 1, "heading_spread"), "");
  // What the engine does not show.
  EXPECT_EQ(at(rows, 2, "observable"), "i-j.restitution");
  EXPECT_EQ(at(rows, 2, "median"), "");
  EXPECT_EQ(at(rows, 2, "missing"), "4");
  EXPECT_EQ(at(rows, 9, "status"), "crashed");
  EXPECT_EQ(at(rows, 9, "reason"), "signal 11");
  EXPECT_EQ(at(rows, 9, "observable"), "");
  EXPECT_EQ(at(rows, 10, "engine"), "");
  EXPECT_EQ(at(rows, 10, "observable"), "all.collision_rate");
  EXPECT_EQ(at(rows, 10, "reference"), "5414");
}

TEST(ResultCsv, SaysWhatTheReferenceDoesNotShow) {
  SceneRecord scene = lottery_scene(4);
  scene.scenario.compare.tolerance["jump_height"] = {0.1, false};
  scene.runs.resize(1);
  const auto rows = parsed_csv(results_csv({scene}));
  std::size_t absent = 0;
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (at(rows, k, "observable") == "i.jump_height") {
      ++absent;
      EXPECT_EQ(at(rows, k, "reference"), "");
      EXPECT_EQ(at(rows, k, "reason"), "it does not occur in the reference");
    }
  EXPECT_EQ(absent, 1u);
}

TEST(PhasesCsv, ARowForEachPhaseOfWhatHasATolerance) {
  SceneRecord scene = lottery_scene(3);
  scene.runs.resize(1);
  scene.runs[0].observables["i.final_speed"].values = {1, 2, 3};
  scene.runs[0].observables["i.sliding_time"].values[1] = kNaN;
  const auto rows = parsed_csv(phases_csv({scene}));
  ASSERT_EQ(rows.size(), 1u + 3 + 3);
  for (std::size_t phase = 0; phase < 3; ++phase) {
    EXPECT_EQ(at(rows, 1 + phase, "phase"), std::to_string(phase));
    EXPECT_NEAR(std::stod(at(rows, 1 + phase, "value")), 0.358 + 0.07 * phase, 1e-15);
    EXPECT_EQ(std::stod(at(rows, 1 + phase, "reference")), 5.0 / 14);
  }
  EXPECT_EQ(at(rows, 4, "observable"), "i.sliding_time");
  EXPECT_EQ(at(rows, 5, "value"), "");
}

}  // namespace
}  // namespace slipcheck::testing
