#include "report/charts/gnuplot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>

#include "../support/in_folder.h"
#include "records.h"
#include "report/charts/gnuplot_script.h"
#include "report/charts/report_charts.h"
#include "report/files/files.h"
#include "report/html/report_page.h"
#include "scene/scene_outline.h"
#include "study_records.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

namespace fs = std::filesystem;

class Gnuplot : public test::InFolder {
 protected:
  void SetUp() override { path_ = std::getenv("PATH"); }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  fs::path charts() const { return folder_ / "charts"; }
  static std::vector<Chart> all_of(const ReportContent& content) {
    return report_charts(content, ChartExtent::all).all();
  }
  /// Draws all; gives what went wrong.
  std::string write(const ReportContent& content) const {
    const ChartDrawings drawings = draw_charts(all_of(content));
    write_charts(charts(), all_of(content), drawings, true);
    return drawings.trouble;
  }
  /// Draws and gives a chart back.
  pugi::xml_document drawn(const ReportContent& content, const std::string& name) const {
    EXPECT_EQ(write(content), "");
    pugi::xml_document document;
    const fs::path svg = charts() / (name + ".svg");
    EXPECT_TRUE(document.load_file(svg.c_str())) << svg;
    return document;
  }
  std::string path_;
};

/// Points that are drawn, those of the key among them.
std::size_t points(const pugi::xml_document& svg) {
  return svg.select_nodes("//use[@color and not(@id)]").size();
}

bool shows(const pugi::xml_document& svg, const std::string& text) {
  for (const pugi::xpath_node& node : svg.select_nodes("//text"))
    if (contains(pugi::xpath_query("string(.)").evaluate_string(node), text)) return true;
  return false;
}

ReportContent content_of(const SceneRecord& scene) {
  ReportContent content;
  content.scenes = {scene};
  return content;
}

TEST_F(Gnuplot, APointForEachPhaseWithinOutsideAndBeyond) {
  SceneRecord scene = lottery_scene(16);
  // Far beyond all others, which lie from 0.358 to 0.498.
  scene.runs[0].observables["i-j.effective_restitution"].values[3] = 1e6;
  const pugi::xml_document svg =
      drawn(content_of(scene), "phases-symmetric-steel-i-j.effective_restitution");
  EXPECT_EQ(points(svg), 2u * 16 + 3);  // and three in the legend
  EXPECT_TRUE(shows(svg, "bullet double default 240 Hz"));
  EXPECT_TRUE(shows(svg, "tolerance 0.005"));
  EXPECT_TRUE(shows(svg, "i-j.effective_restitution"));
  for (const char* end : {".gp", ".dat", ".svg"})
    EXPECT_TRUE(
        fs::exists(charts() / (std::string("phases-symmetric-steel-i.sliding_time") + end)));
}

TEST_F(Gnuplot, APhaseWithoutAValueHasNoPoint) {
  SceneRecord scene = lottery_scene(16);
  scene.runs.resize(1);
  scene.runs[0].observables["i.sliding_time"].values[5] = kNaN;
  // All are of one kind, which the legend names.
  EXPECT_EQ(points(drawn(content_of(scene), "phases-symmetric-steel-i.sliding_time")), 15u + 1);
}

TEST_F(Gnuplot, NamesAreShownAndNothingOfThemIsRun) {
  const std::string trap = (folder_ / "trap").string();
  SceneRecord scene = lottery_scene(4);
  scene.runs.resize(1);
  scene.runs[0].profile = "a_b^c{d}' @unit <&>";
  scene.scenario.name = "x'\n`touch " + trap + "`";
  std::vector<Chart> made = all_of(content_of(scene));
  ASSERT_FALSE(made.empty());
  pugi::xml_document svg = drawn(content_of(scene), made[0].name);
  EXPECT_TRUE(shows(svg, "bullet double a_b^c{d}' @unit <&> 240 Hz"));
  EXPECT_TRUE(shows(svg, "x' `touch " + trap + "`"));

  // Too long a name is cut, or there would be no room for the plot.
  scene.runs[0].profile = "'; system('touch " + trap + "'); `touch " + trap + "` 0123456789";
  made = all_of(content_of(scene));
  svg = drawn(content_of(scene), made[0].name);
  EXPECT_TRUE(shows(svg, "bullet double '; system('touch "));
  EXPECT_FALSE(shows(svg, "0123456789"));
  EXPECT_FALSE(fs::exists(trap));
}

TEST_F(Gnuplot, AScriptDrawsAgainInItsFolder) {
  for (const Chart& chart : all_of(content_of(lottery_scene(4)))) {
    const std::string script = gnuplot_script(chart).script;
    EXPECT_TRUE(contains(script, "set output '" + chart.name + ".svg'"));
    EXPECT_TRUE(contains(script, "data = '" + chart.name + ".dat'"));
    EXPECT_FALSE(contains(script, "/"));
  }
}

TEST_F(Gnuplot, AnImageHasItsTextsAndItsOwnIds) {
  Chart chart = all_of(content_of(lottery_scene(4)))[0];
  chart.name = "K5";
  chart.title = "t^s & s";
  chart.caption = "what it shows";
  const ChartDrawings drawings = draw_charts({chart});
  pugi::xml_document svg;
  ASSERT_TRUE(svg.load_string(drawings.svgs[0].c_str()));
  EXPECT_STREQ(svg.child("svg").child_value("title"), "t^s & s");
  EXPECT_STREQ(svg.child("svg").child_value("desc"), "what it shows");
  std::set<std::string> ids;
  for (const pugi::xpath_node& node : svg.select_nodes("//@id")) {
    EXPECT_TRUE(contains(node.attribute().value(), "K5-"));
    EXPECT_TRUE(ids.insert(node.attribute().value()).second) << node.attribute().value();
  }
  for (const pugi::xpath_node& node : svg.select_nodes("//use"))
    EXPECT_TRUE(ids.contains(node.node().attribute("xlink:href").value() + 1));
  // In a page, which declares no name spaces.
  const std::string inside = inline_svg(drawings.svgs[0]);
  EXPECT_TRUE(inside.starts_with("<svg width=")) << inside.substr(0, 80);
  EXPECT_FALSE(contains(inside, "xlink"));
  EXPECT_FALSE(contains(inside, "http:"));
  EXPECT_TRUE(contains(inside, "href=\"#K5-"));
}

/// A ball that slides at 1 m/s and slows down evenly to 0.5 m/s within 10 frames.
RecordedMotion sliding(const std::string& role, std::size_t bodies) {
  RecordedMotion motion;
  motion.role = role;
  for (int k = 0; k < 10; ++k) {
    MotionFrame frame;
    frame.time = 0.01 * k;
    for (std::size_t b = 0; b < bodies; ++b) {
      BodyState state;
      state.position = Vector3(static_cast<double>(b), 0, 0.002);
      state.velocity = Vector3(1 - 0.05 * k, 0, 0);
      frame.bodies.push_back(state);
    }
    motion.frames.push_back(frame);
  }
  return motion;
}

/// Motion is held against the scene in numbers.
void put_on_plane(SceneRecord& scene) {
  scene.scenario.surroundings = Substrate{};
  scene.scene =
      std::make_shared<const ContactScene>(with_hard_contacts(make_outline(scene.scenario).scene));
}

TEST_F(Gnuplot, MotionHasAPanelEachForSlipSpeedAndEnergy) {
  SceneRecord scene = lottery_scene(4);
  put_on_plane(scene);
  scene.reference.motion = sliding("reference", 2);
  scene.runs[0].motions = {sliding("nearest", 2), sliding("median", 2)};
  const pugi::xml_document svg = drawn(content_of(scene), "motion-symmetric-steel");
  for (const char* text : {"slip velocity [m/s]", "speed [m/s]", "kinetic energy", "time [ms]",
                           "reference", "bullet double default 240 Hz", "i", "j"})
    EXPECT_TRUE(shows(svg, text)) << text;
  EXPECT_FALSE(shows(svg, "bullet double default 4000 Hz"));  // nothing is recorded of it
}

TEST_F(Gnuplot, ABoxHasItsSeries) {
  const pugi::xml_document svg = drawn(content_of(box_scene(40)), "series-symmetric-steel");
  EXPECT_TRUE(shows(svg, "H [mm]"));
  EXPECT_TRUE(shows(svg, "collisions [1/s]"));
  EXPECT_FALSE(shows(svg, "R ["));  // all zero
}

TEST_F(Gnuplot, StudiesHaveTheirCharts) {
  ReportContent content;
  content.precision = {precision_scene()};
  content.limits = limit_results();
  EXPECT_EQ(write(content), "");
  std::set<std::string> svgs;
  for (const auto& entry : fs::directory_iterator(charts()))
    if (entry.path().extension() == ".svg") {
      svgs.insert(entry.path().stem().string());
      pugi::xml_document document;
      EXPECT_TRUE(document.load_file(entry.path().c_str())) << entry.path();
    }
  const std::set<std::string> expected = {"limit-stable_step-held-ball",
                                          "limit-stable_step-steel-pair",
                                          "map-speed-restitution-bullet-double-default",
                                          "precision-symmetric-steel-i-j.effective_restitution",
                                          "precision-symmetric-steel-trajectory"};
  EXPECT_EQ(svgs, expected);

  pugi::xml_document map;
  map.load_file((charts() / "map-speed-restitution-bullet-double-default.svg").c_str());
  EXPECT_TRUE(shows(map, "where h v = R"));
  for (const char* letter : {"A", "d", "T", "N", "E"}) EXPECT_TRUE(shows(map, letter)) << letter;
  // Of two of the methods nothing is said: iterations that are not the profile's own.
  pugi::xml_document work;
  work.load_file((charts() / "precision-symmetric-steel-trajectory.svg").c_str());
  for (const char* label : {"bullet single default", "bullet double tuned", "contact", "event"})
    EXPECT_TRUE(shows(work, label)) << label;
  EXPECT_FALSE(shows(work, "50 iterations"));
}

/// Charts whose values are missing, alone or far off: gnuplot gives up on some of these by itself.
TEST_F(Gnuplot, PoorDataAreDrawnToo) {
  ReportContent content;
  SceneRecord scene = lottery_scene(1);
  put_on_plane(scene);
  for (EngineRecord& run : scene.runs)
    for (auto& [name, ensemble] : run.observables) ensemble.values = {kInfinity};
  RecordedMotion instant = sliding("median", 2);
  instant.frames.resize(1);
  for (BodyState& state : instant.frames[0].bodies) state.position.z() = 1;  // no slip there
  scene.runs[0].motions = {instant};
  content.scenes.push_back(scene);
  SceneRecord level = box_scene(2);
  level.scenario.name = "level";
  level.reference.box->series.height = {0.01, 0.01};
  content.scenes.push_back(level);

  PrecisionScene one = precision_scene("one");
  one.curves = {one.curves[0]};
  one.curves[0].points.resize(1);
  one.curves[0].points[0].errors["i-j.effective_restitution"].worst = 1e9;
  content.precision = {one};
  content.limits = limit_results();
  content.limits.limits[0].good.reset();
  OutcomeMap& map = content.limits.maps[0];
  map.x.values = {1};
  map.y.values = {0.5};
  map.outcome = {Outcome::crashed};
  map.worst_error.clear();
  EXPECT_EQ(write(content), "");
  for (const Chart& chart : all_of(content)) {
    pugi::xml_document svg;
    EXPECT_TRUE(svg.load_file((charts() / (chart.name + ".svg")).c_str())) << chart.name;
    EXPECT_FALSE(svg.select_nodes("//text").empty()) << chart.name;
    for (const pugi::xpath_node& node : svg.select_nodes("//@*"))
      for (const char* bad : {"nan", "NaN", "inf"})
        EXPECT_FALSE(contains(node.attribute().value(), bad)) << node.attribute().value();
  }
}

TEST_F(Gnuplot, NothingToDrawMakesAnEmptyFolder) {
  EXPECT_EQ(write({}), "");
  EXPECT_TRUE(fs::is_empty(charts()));
}

TEST_F(Gnuplot, WithoutGnuplotItSaysWhatToInstall) {
  ::setenv("PATH", folder_.c_str(), 1);
  const std::string missing =
      "charts as SVG are drawn by gnuplot, which is not there: install gnuplot-nox (Debian) or "
      "gnuplot";
  EXPECT_EQ(write(content_of(lottery_scene(4))), missing);
  EXPECT_TRUE(fs::is_empty(charts()));
  // A page says so at the place of each chart, and all else is there.
  const std::string page = report_page(content_of(lottery_scene(4)), PageScript::left_out);
  EXPECT_EQ(count(page, "<strong>Not drawn:</strong> " + missing), 2u);
  EXPECT_TRUE(contains(page, "A smaller step does not help"));
}

TEST_F(Gnuplot, APageWithoutScriptHasTheImages) {
  const std::string page = report_page(content_of(lottery_scene(4)), PageScript::left_out);
  EXPECT_EQ(count(page, "<figure class=\"plot\">\n<svg"), 2u);
  EXPECT_FALSE(contains(page, "Not drawn"));
}

TEST_F(Gnuplot, WhenGnuplotFailsItsMessageIsToldAndWhatIsDrawnStays) {
  const fs::path fake = folder_ / "gnuplot";
  const auto make = [&](const std::string& script) {
    std::ofstream(fake) << "#!/bin/sh\n" << script;
    fs::permissions(fake, fs::perms::owner_all);
  };
  make("echo 'out of ink' >&2\nexit 3\n");
  ::setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  EXPECT_EQ(write(content_of(lottery_scene(4))), "gnuplot failed: out of ink");
  EXPECT_TRUE(fs::is_empty(charts()));

  make("");
  EXPECT_TRUE(write(content_of(lottery_scene(4))).starts_with("gnuplot has not drawn phases-"));

  make(
      "name=${2%.gp}\necho '<svg><title>x</title><desc>y</desc></svg>' > $name.svg\n"
      "echo '<svg><g>' > ${3%.gp}.svg\nkill -9 $$\n");
  EXPECT_EQ(write(content_of(lottery_scene(4))), "gnuplot failed: no reason given");
  std::size_t drawn = 0;
  for (const auto& entry : fs::directory_iterator(charts()))
    drawn += entry.path().extension() == ".svg";
  EXPECT_EQ(drawn, 1u);
}

TEST_F(Gnuplot, AFolderThatCannotBeMadeIsAWriteFailure) {
  std::ofstream(folder_ / "charts") << "a file\n";
  EXPECT_THROW(write_charts(charts() / "inside", {}, {}, true), WriteFailure);
}

}  // namespace
}  // namespace slipcheck::testing
