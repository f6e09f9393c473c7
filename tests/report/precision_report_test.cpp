#include <gtest/gtest.h>

#include <tuple>

#include "report/charts/precision_charts.h"
#include "report/charts/report_charts.h"
#include "report/files/precision_csv.h"
#include "report/html/html_precision.h"
#include "report/json/precision_json.h"
#include "report/rows/csv_rows.h"
#include "report/rows/precision_rows.h"
#include "report/terminal/precision_table.h"
#include "study_records.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

const std::string kRestitution = "i-j.effective_restitution";

TableStyle wide() {
  TableStyle style;
  style.width = 160;
  return style;
}

TEST(CsvRows, QuotesWhatNeedsItAndLeavesOutWhatIsNoNumber) {
  CsvRows rows({"a", "b,c"});
  rows.add({std::string("say \"x\""), 0.1});
  rows.add({std::string("two\nlines"), kNotObserved});
  rows.add({std::string("\r"), -INFINITY});
  EXPECT_EQ(rows.text(), "a,\"b,c\"\n\"say \"\"x\"\"\",0.1\n\"two\nlines\",\n\"\r\",\n");
}

TEST(PrecisionRows, NumbersAreShort) {
  EXPECT_EQ(short_number(0.141), "0.14");
  EXPECT_EQ(short_number(3.14e-7), "3.1e-7");
  EXPECT_EQ(short_number(1e-12), "1e-12");
  EXPECT_EQ(short_number(1e20), "1e20");
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(kNotObserved), "–");
  EXPECT_EQ(short_error(1.2e-5, kLength), "12 µm");
}

TEST(PrecisionRows, RestitutionComesFirstThenTheTrajectory) {
  PrecisionScene scene = precision_scene();
  auto& errors = scene.curves[0].points[0].errors;
  errors["a.sliding_time"] = {0.1, 0.1, 0.1, false, 0.01, ""};  // before it in the alphabet
  errors["z.stopping_time"] = {0.1, 0.1, 0.1, false, {}, ""};   // nobody asked for it
  EXPECT_EQ(judged_quantities(scene), (std::vector<std::string>{kRestitution, "a.sliding_time"}));
  EXPECT_EQ(shown_quantities(scene, false), (std::vector<std::string>{kRestitution, kTrajectory}));
  EXPECT_EQ(
      shown_quantities(scene, true),
      (std::vector<std::string>{kRestitution, "a.sliding_time", kTrajectory, "z.stopping_time"}));
}

TEST(PrecisionRows, CountsScenesByHowTheyConverge) {
  const auto all = convergence_counts({precision_scene("a"), precision_scene("b")});
  ASSERT_EQ(all.size(), 7u);  // 4 of the engine, 1 with iterations, 2 of the reference
  using Counts = std::array<std::size_t, 4>;  // exact, converges, does not, unknown
  EXPECT_EQ(all[0].judged, (Counts{0, 0, 2, 0}));
  EXPECT_EQ(all[3].judged, (Counts{0, 2, 0, 0}));
  EXPECT_EQ(all[3].trajectory, (Counts{0, 2, 0, 0}));
  EXPECT_EQ(all[3].on_front, 2u);
  EXPECT_EQ(all[5].on_front, 0u);
  EXPECT_EQ(all[6].judged, (Counts{2, 0, 0, 0}));
}

TEST(PrecisionRows, TheWorstObservableCountsWhereNoRestitutionIsJudged) {
  PrecisionScene scene = precision_scene();
  scene.curves.resize(1);
  MethodCurve& curve = scene.curves[0];
  const PhaseErrors errors = curve.points[0].errors[kRestitution];
  for (WorkPrecision& point : curve.points)
    point.errors = {{"i.sliding_time", errors}, {"i.sliding_distance", errors}};
  curve.convergence = {{"i.sliding_time", {Convergence::Kind::exact}},
                       {"i.sliding_distance", {Convergence::Kind::does_not_converge}}};
  EXPECT_EQ(convergence_counts({scene})[0].judged, (std::array<std::size_t, 4>{0, 0, 1, 0}));
  curve.convergence.erase("i.sliding_distance");
  EXPECT_EQ(convergence_counts({scene})[0].judged, (std::array<std::size_t, 4>{0, 0, 0, 1}));
}

TEST(PrecisionTable, SaysPlainlyWhatDoesNotConverge) {
  const std::string text = precision_table({precision_scene()}, wide());
  for (const std::string part :
       {"bullet double default", "does not converge", "order 1", "0.14 → 0.14", "tolerance 0.005",
        "◆", "trajectory, of a path of 12.3 mm", "2 µs", "bullet 240 Hz → 4000 Hz",
        "… 1 with other iterations"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  EXPECT_EQ(count(text, "50 iterations"), 0u) << text;
}

TEST(PrecisionTable, SumsUpSeveralScenes) {
  EXPECT_FALSE(contains(precision_table({precision_scene()}, wide()), "Of 1 scene"));
  const std::string text = precision_table({precision_scene("a"), precision_scene("b")}, wide());
  EXPECT_EQ(count(text, "Of 2 scenes"), 2u) << text;  // what is judged, and the trajectory
}

TEST(PrecisionTable, LeavesOutWhatNeverRanAndSaysWhy) {
  PrecisionScene scene = precision_scene();
  MethodCurve& curve = scene.curves.emplace_back();
  curve.kind = MethodCurve::Kind::fixed_step;
  curve.points.resize(1);
  curve.points[0].reason = "needs soft contacts";
  const std::string text = precision_table({scene}, wide());
  EXPECT_EQ(count(text, "fixed step"), 1u) << text;
  EXPECT_TRUE(contains(text, "! fixed step: skipped: needs soft contacts")) << text;
}

TEST(PrecisionTable, AllOfItHasTheIterationsToo) {
  TableStyle style = wide();
  style.all_observables = true;
  const std::string text = precision_table({precision_scene()}, style);
  EXPECT_TRUE(contains(text, "50 iterations")) << text;
  EXPECT_FALSE(contains(text, "other iterations")) << text;
}

TEST(PrecisionTable, FitsTheTerminalAndTellsWhatFailed) {
  PrecisionScene scene = precision_scene();
  WorkPrecision& point = scene.curves[1].points[2];
  point = {};
  point.knob = 4000;
  point.status = RunStatus::crashed;
  point.reason = "signal 11";
  TableStyle style;
  style.width = 100;
  const std::string text = precision_table({scene}, style);
  EXPECT_TRUE(contains(text, "bullet double default: 4000 Hz: crashed: signal 11")) << text;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::size_t columns = 0;
    for (char c : text.substr(begin, end - begin))
      columns += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    EXPECT_LE(columns, 100u) << text.substr(begin, end - begin);
    begin = end + 1;
  }
}

TEST(PrecisionJson, HoldsEverythingAndNullWithAReason) {
  PrecisionScene scene = precision_scene();
  scene.curves[0].points[1].errors[kRestitution] = {.tolerance = 0.005,
                                                    .reason = "no phase has it"};
  scene.curves[0].points[2].errors[kRestitution].worst = INFINITY;
  const nlohmann::ordered_json json = json_of({scene}, PrecisionGrid{});
  EXPECT_EQ(json["schema"], "slipcheck-precision/1");
  EXPECT_TRUE(json["machine"].contains("processor"));
  EXPECT_EQ(json["grid"]["rates"].size(), 5u);
  const auto& curves = json["scenes"][0]["curves"];
  ASSERT_EQ(curves.size(), 7u);
  const auto& points = curves[0]["points"];
  EXPECT_EQ(points[0]["knob"], 240);
  EXPECT_EQ(points[0]["errors"][kRestitution]["worst"], 0.14);
  EXPECT_EQ(points[0]["errors"][kRestitution]["median"], 0.07);
  EXPECT_EQ(points[0]["errors"][kRestitution]["absolute"], true);
  EXPECT_EQ(points[0]["cost"]["cpu_per_step"], 2e-6);
  EXPECT_EQ(points[0]["cost"]["repeats"], 5);
  EXPECT_EQ(points[1]["errors"][kRestitution]["worst"], nullptr);
  EXPECT_EQ(points[1]["errors"][kRestitution]["reason"], "no phase has it");
  EXPECT_EQ(points[2]["errors"][kRestitution]["worst"], nullptr);
  EXPECT_EQ(points[2]["errors"][kRestitution]["reason"], "worst is infinite");
  EXPECT_EQ(curves[0]["convergence"][kRestitution]["kind"],
            name_of(Convergence::Kind::does_not_converge));
  EXPECT_EQ(curves[0]["convergence"][kRestitution]["order"], nullptr);
  EXPECT_TRUE(curves[0]["convergence"][kRestitution].contains("reason"));
  EXPECT_EQ(curves[3]["convergence"][kRestitution]["order"], 1);
  EXPECT_EQ(curves[3]["points"][2]["pareto"].size(), 2u);
  EXPECT_EQ(curves[4]["iterations"], 50);
  EXPECT_FALSE(curves[5].contains("engine"));
}

TEST(PrecisionCsv, OneRowForEachPointAndQuantity) {
  PrecisionScene scene = precision_scene("a,b");
  scene.curves[1].points[0].errors.clear();
  scene.curves[1].points[0].reason = "because";
  const std::string csv = precision_csv({scene});
  // 5 curves of 3 points, 1 of 2 and 1 of 1, two quantities each; a point without errors has one.
  EXPECT_EQ(count(csv, "\n"), 1u + 2u * 18u - 1u);
  EXPECT_EQ(count(csv, "\n\"a,b\","), 35u);
  EXPECT_TRUE(contains(csv, ",240,ok,16,i-j.effective_restitution,0.14,0.07,"));
  EXPECT_EQ(count(csv, ",true,\n"), 4u);  // the front: two points in two quantities
  EXPECT_TRUE(contains(csv, ",false,because\n"));
  EXPECT_FALSE(contains(csv, "nan"));
  EXPECT_EQ(count(convergence_csv({scene}), "\n"), 1u + 2u * 7u);
}

TEST(PrecisionCharts, TellProfileAndPrecisionApart) {
  const auto looks = method_looks({precision_scene()});
  const Look& full = looks.at("bullet double tuned");
  const Look& dashed = looks.at("bullet single tuned");
  const Look& other = looks.at("bullet double default");
  EXPECT_EQ(full.ink, dashed.ink);
  EXPECT_EQ(full.marker, dashed.marker);
  EXPECT_NE(full.line, dashed.line);
  EXPECT_NE(full.ink, other.ink);
  EXPECT_NE(full.marker, other.marker);
}

std::vector<Chart> charts_of(const PrecisionScene& scene) {
  std::set<std::string> taken;
  return precision_charts(scene, method_looks({scene}), taken);
}

TEST(PrecisionCharts, NoErrorAtAllIsOnTheFloor) {
  const PrecisionScene scene = precision_scene();
  const std::vector<Chart> charts = charts_of(scene);
  ASSERT_EQ(charts.size(), 2u);  // effective restitution and the trajectory
  ASSERT_EQ(charts[0].panels.size(), 2u);
  const auto& [work, step] = std::tie(charts[0].panels[0], charts[0].panels[1]);
  const auto curve = [](const Panel& panel, const std::string& label) -> const Curve* {
    for (const Curve& one : panel.curves)
      if (one.label == label) return &one;
    return nullptr;
  };
  const Curve* event = curve(work, label_of(scene.curves[6]));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->y, std::vector<double>{kErrorFloor});
  EXPECT_EQ(event->x, std::vector<double>{1e-5});
  EXPECT_TRUE(contains(event->notes[0], "worst error of i-j.effective_restitution: exact"));
  const Curve* front = curve(work, "nothing is cheaper and no worse");
  ASSERT_TRUE(front);
  EXPECT_EQ(front->x.size(), 2u);
  // What has no step is not drawn over it; 240 Hz is a step of 1/240 s.
  EXPECT_FALSE(curve(step, label_of(scene.curves[6])));
  const Curve* tuned = curve(step, "bullet double tuned");
  ASSERT_TRUE(tuned);
  EXPECT_DOUBLE_EQ(tuned->x[0], 1 / 240.0);
  EXPECT_TRUE(tuned->notes[0].starts_with("240 Hz\nCPU 0.00048 s per simulated s"))
      << tuned->notes[0];
  // Nor are iterations that are best at nothing.
  EXPECT_FALSE(curve(work, label_of(scene.curves[4])));
}

TEST(PrecisionCharts, NamesAreFitForFilesAndDistinct) {
  ReportContent content;
  content.precision = {precision_scene("../a b"), precision_scene("../a b")};
  const std::vector<Chart> charts = report_charts(content, ChartExtent::all).all();
  ASSERT_EQ(charts.size(), 4u);
  EXPECT_EQ(charts[1].name, "precision-..-a-b-trajectory");
  EXPECT_EQ(charts[3].name, "precision-..-a-b-trajectory-2");
}

TEST(PrecisionPage, EscapesAndHoldsTheMainMethods) {
  PrecisionScene scene = precision_scene("<b>&");
  scene.curves[0].points[0].status = RunStatus::crashed;
  scene.curves[0].points[0].reason = "signal 11";
  ReportContent content;
  content.precision = {scene};
  const std::string html =
      html_precision({scene}, report_charts(content, ChartExtent::page), StandingCharts());
  EXPECT_FALSE(contains(html, "<b>"));
  EXPECT_TRUE(contains(html, "&lt;b&gt;&amp;"));
  EXPECT_TRUE(contains(html, "does not converge"));
  EXPECT_TRUE(contains(html, "<li>bullet single default: 240 Hz: crashed: signal 11</li>"));
  EXPECT_TRUE(contains(html, "<div class=\"plots\" data-precision=\"0\"></div>"));
  EXPECT_TRUE(contains(
      html,
      "<tr><th scope=\"row\">bullet double default</th><td class=\"bad\" data-value=\"0.14\">"));
  // In the table over all scenes alone.
  EXPECT_EQ(count(html, "<tr><th scope=\"row\">bullet double default, 50 iterations</th>"), 1u);
  EXPECT_EQ(html_precision({}, {}, {}), "");
}

}  // namespace
}  // namespace slipcheck::testing
