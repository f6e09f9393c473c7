#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "../support/refusal.h"
#include "records.h"
#include "report/files/extended_xyz.h"
#include "report/files/vtk_files.h"
#include "report/json/motion_json.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

/// Three frames of two bodies with numbers that need all their digits.
RecordedMotion some_motion(const std::string& role, std::size_t phase, double error) {
  RecordedMotion motion{role, phase, error, {}};
  for (int k = 0; k < 3; ++k) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.time = (k + static_cast<double>(phase)) / 3.0;
    frame.substrate = {std::sqrt(2.0) * k, -1e-3 * k, 0};
    for (int i = 0; i < 2; ++i) {
      const double x = 1 + 10 * k + i;
      frame.bodies.push_back(
          {{1 / x, -x / 7, 0.002}, {x / 3, 1e-9 / x, -0.0}, {1e5 / x, -x / 11, std::exp(-x)}});
    }
    if (k > 0) frame.touches = {{0, kSubstrate}, {0, 1}};
  }
  return motion;
}

/// The lottery with motions: of the reference, and of both runs three and one.
SceneRecord recorded_scene() {
  SceneRecord scene = testing::lottery_scene();
  scene.reference.motion = some_motion("reference", 0, testing::kNaN);
  scene.runs[0].motions = {some_motion("median", 4, 2.0 / 3), some_motion("worst", 1, 28.2),
                           some_motion("nearest", 0, 0)};
  scene.runs[1].motions = {some_motion("worst", 7, testing::kInfinity)};
  return scene;
}

void expect_same(const Vector3& a, const Vector3& b) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 5e-9 * std::abs(b[k]));
}

void expect_same(const RecordedMotion& read, const RecordedMotion& written) {
  EXPECT_EQ(read.role, written.role);
  EXPECT_EQ(read.phase, written.phase);
  if (std::isfinite(written.error)) {
    EXPECT_NEAR(read.error, written.error, 5e-9 * written.error);
  } else {
    EXPECT_EQ(std::isnan(read.error), std::isnan(written.error));
  }
  ASSERT_EQ(read.frames.size(), written.frames.size());
  for (std::size_t k = 0; k < read.frames.size(); ++k) {
    const MotionFrame &a = read.frames[k], &b = written.frames[k];
    EXPECT_EQ(a.time, b.time);
    expect_same(a.substrate, b.substrate);
    EXPECT_EQ(a.touches, b.touches);
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      expect_same(a.bodies[i].position, b.bodies[i].position);
      expect_same(a.bodies[i].velocity, b.bodies[i].velocity);
      expect_same(a.bodies[i].angular_velocity, b.bodies[i].angular_velocity);
    }
  }
}

// --- JSON ----------------------------------------------------------------------------------------

void read_motions(const Json& json, SceneRecord& scene) {
  const auto parsed = nlohmann::json::parse(json.dump());
  const std::string file = "m.json";
  slipcheck::read_motions(JsonNode(parsed, file), scene);
}

TEST(MotionJson, IsReadBackAsItWasWritten) {
  const SceneRecord written = recorded_scene();
  SceneRecord read = testing::lottery_scene();
  read_motions(Json::parse(motion_json_of(written).dump()), read);
  ASSERT_TRUE(read.reference.motion);
  expect_same(*read.reference.motion, *written.reference.motion);
  for (std::size_t r = 0; r < 2; ++r) {
    ASSERT_EQ(read.runs[r].motions.size(), written.runs[r].motions.size());
    for (std::size_t m = 0; m < read.runs[r].motions.size(); ++m)
      expect_same(read.runs[r].motions[m], written.runs[r].motions[m]);
  }
  EXPECT_TRUE(std::isinf(read.runs[1].motions[0].error));
}

TEST(MotionJson, HasNineDigits) {
  const Json json = motion_json_of(recorded_scene());
  EXPECT_EQ(json["schema"], "slipcheck-motion/1");
  EXPECT_EQ(json["bodies"], Json({"i", "j"}));
  EXPECT_EQ(json["reference"]["error"], nullptr);
  EXPECT_EQ(json["runs"].size(), 4u);
  const Json& motion = json["runs"][0];
  EXPECT_EQ(motion["engine"], "bullet");
  EXPECT_EQ(motion["rate"], 240);
  EXPECT_EQ(motion["error"].dump(), "0.666666667");
  EXPECT_EQ(motion["substrate"][1].dump(), "[1.41421356,-0.001,0.0]");
  EXPECT_EQ(motion["position"][0].dump(), "[1.0,-0.142857143,0.002,0.5,-0.285714286,0.002]");
  EXPECT_EQ(motion["velocity"][0][2].dump(), "0.0");
  EXPECT_EQ(motion["touches"].dump(), "[[1,0,-1],[1,0,1],[2,0,-1],[2,0,1]]");
}

TEST(MotionJson, OfRunsThatAreAlikeTheFirstWithoutTheRoleHasIt) {
  SceneRecord scene = recorded_scene();
  scene.runs[1] = scene.runs[0];
  scene.runs[1].motions = {some_motion("median", 5, 1), some_motion("worst", 6, 9)};
  SceneRecord read = scene;
  for (EngineRecord& run : read.runs) run.motions = {some_motion("median", 31, 0)};
  read_motions(motion_json_of(scene), read);
  ASSERT_EQ(read.runs[0].motions.size(), 3u);
  ASSERT_EQ(read.runs[1].motions.size(), 2u);
  EXPECT_EQ(read.runs[0].motions[0].phase, 4u);
  EXPECT_EQ(read.runs[1].motions[0].phase, 5u);
  EXPECT_EQ(read.runs[1].motions[1].phase, 6u);
}

TEST(MotionJson, ASceneWithoutMotionsIsReadToo) {
  SceneRecord scene = recorded_scene();
  read_motions(motion_json_of(testing::lottery_scene()), scene);
  EXPECT_FALSE(scene.reference.motion);
  EXPECT_TRUE(scene.runs[0].motions.empty());
}

TEST(MotionJson, ABadFileIsRefusedAtItsPlace) {
  struct Case {
    const char *pointer, *value, *message;
  };
  const Case cases[] = {
      {"/schema", "\"slipcheck-motion/2\"",
       "schema: must be slipcheck-motion/1, got \"slipcheck-motion/2\""},
      {"/scenario", "[]", "scenario: must be an object, got a list"},
      {"/scenario/name", "\"other\"", "scenario.name: must be symmetric-steel, got \"other\""},
      {"/scenario/name", "7", "scenario.name: must be a text, got 7"},
      {"/bodies", "[\"i\"]", "bodies: must be a list of 2, got a list"},
      {"/bodies/1", "\"k\"", "bodies[1]: must be j, got \"k\""},
      {"/runs", "{}", "runs: must be a list, got an object"},
      {"/runs/1/rate", "60",
       "runs[1]: must be of a run of the result, is of bullet double default at 60 Hz"},
      {"/runs/1/rate", "null", "runs[1].rate: must be a number, got null"},
      {"/runs/1/role", "\"median\"",
       "runs[1]: must be of a run of the result, is of bullet double default at 240 Hz"},
      {"/runs/1/phase", "1.5", "runs[1].phase: must be a whole number >= 0, got 1.5"},
      {"/runs/1/error", "\"large\"", "runs[1].error: must be infinite, got \"large\""},
      {"/runs/1/time", "[]", "runs[1].time: must be a list of one time at least, got a list"},
      {"/runs/1/time/2", "0.5", "runs[1].time[2]: must be later than the one before, got 0.5"},
      {"/runs/1/substrate", "[]", "runs[1].substrate: must be a list of 3, got a list"},
      {"/runs/1/substrate/2", "[1, 2]",
       "runs[1].substrate[2]: must be a list of 3 numbers, got a list"},
      {"/reference/position", "[[1]]", "reference.position: must be a list of 3, got a list"},
      {"/reference/velocity/0/5", "null", "reference.velocity[0][5]: must be a number, got null"},
      {"/reference/angular_velocity", "7",
       "reference.angular_velocity: must be a list of 3, got 7"},
      {"/reference/touches/0/0", "3",
       "reference.touches[0][0]: must be a whole number from 0 to 2, got 3"},
      {"/reference/touches/0/1", "-1",
       "reference.touches[0][1]: must be a whole number from 0 to 1, got -1"},
      {"/reference/touches/0/2", "-2",
       "reference.touches[0][2]: must be a whole number from -1 to 1, got -2"},
  };
  const Json good = motion_json_of(recorded_scene());
  for (const Case& bad : cases) {
    Json json = good;
    json[Json::json_pointer(bad.pointer)] = Json::parse(bad.value);
    SceneRecord scene = testing::lottery_scene();
    EXPECT_EQ(test::refusal_of<std::runtime_error>([&] { read_motions(json, scene); }),
              std::string("m.json: ") + bad.message);
    EXPECT_FALSE(scene.reference.motion);
  }
  SceneRecord scene = testing::lottery_scene();
  EXPECT_THROW(read_motions(Json::parse("[1]"), scene), std::runtime_error);
}

// --- extended XYZ --------------------------------------------------------------------------------

TEST(ExtendedXyz, HasEveryState) {
  const SceneRecord scene = recorded_scene();
  const RecordedMotion& motion = *scene.reference.motion;
  std::istringstream file(xyz_of(scene.scenario, motion));
  for (const MotionFrame& frame : motion.frames) {
    std::string line;
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_EQ(line, "2");
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_TRUE(
        line.starts_with("pbc=\"F F F\" Properties=species:S:1:pos:R:3:velo:R:3:"
                         "angular_velocity:R:3:radius:R:1 Time="))
        << line;
    EXPECT_EQ(std::stod(line.substr(line.find("Time=") + 5)), frame.time);
    EXPECT_TRUE(line.ends_with(" Scene=symmetric-steel Role=reference Units=SI")) << line;
    for (const BodyState& body : frame.bodies) {
      ASSERT_TRUE(std::getline(file, line));
      std::istringstream columns(line);
      std::string species;
      columns >> species;
      EXPECT_EQ(species, "X");
      for (const Vector3& vector : {body.position, body.velocity, body.angular_velocity})
        for (int k = 0; k < 3; ++k) {
          std::string number;
          columns >> number;
          EXPECT_EQ(std::stod(number), vector[k]);
        }
      double radius = 0;
      columns >> radius;
      EXPECT_EQ(radius, 0.002);
      std::string more;
      EXPECT_FALSE(columns >> more);
    }
  }
  std::string more;
  EXPECT_FALSE(std::getline(file, more));
}

TEST(ExtendedXyz, APeriodicPlaneIsALattice) {
  SceneRecord scene = recorded_scene();
  Substrate substrate;
  substrate.periodic = Vector2(0.25, 0.5);
  scene.scenario.surroundings = substrate;
  // The highest centre is at 2 mm, the radius as much.
  const std::string text = xyz_of(scene.scenario, *scene.reference.motion);
  EXPECT_TRUE(text.starts_with("2\nLattice=\"0.25 0 0 0 0.5 0 0 0 0.004\" pbc=\"T T F\" "))
      << text.substr(0, 100);
}

// --- VTK -----------------------------------------------------------------------------------------

std::vector<double> numbers_of(const pugi::xml_node& array) {
  std::istringstream text(array.text().get());
  std::vector<double> numbers;
  for (std::string number; text >> number;) numbers.push_back(std::stod(number));
  return numbers;
}

std::vector<double> numbers_of(const pugi::xml_node& parent, const char* name) {
  return numbers_of(parent.find_child_by_attribute("DataArray", "Name", name));
}

std::vector<double> flat(const MotionFrame& frame, Vector3 BodyState::*member) {
  std::vector<double> numbers;
  for (const BodyState& body : frame.bodies)
    for (const double component : body.*member) numbers.push_back(component);
  return numbers;
}

TEST(VtkFiles, TheCollectionKnowsFilesAndTimes) {
  const SceneRecord scene = recorded_scene();
  const RecordedMotion& motion = scene.runs[0].motions[0];
  const auto files = vtk_files_of(scene.scenario, motion, "pair-240");
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].first, "pair-240.pvd");
  EXPECT_EQ(files[3].first, "pair-240_0002.vtp");
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(files[0].second.c_str()));
  const pugi::xml_node root = document.child("VTKFile");
  EXPECT_STREQ(root.attribute("type").value(), "Collection");
  std::size_t k = 0;
  for (const pugi::xml_node& entry : root.child("Collection")) {
    EXPECT_EQ(std::stod(entry.attribute("timestep").value()), motion.frames.at(k).time);
    EXPECT_EQ(entry.attribute("file").value(), files.at(++k).first);
  }
  EXPECT_EQ(k, 3u);
}

TEST(VtkFiles, HaveEveryState) {
  const SceneRecord scene = recorded_scene();
  const RecordedMotion& motion = *scene.reference.motion;
  const auto files = vtk_files_of(scene.scenario, motion, "pair");
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const MotionFrame& frame = motion.frames[k];
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(files[k + 1].second.c_str()));
    const pugi::xml_node root = document.child("VTKFile");
    EXPECT_STREQ(root.attribute("type").value(), "PolyData");
    const pugi::xml_node data = root.child("PolyData");
    EXPECT_EQ(numbers_of(data.child("FieldData"), "TimeValue"), std::vector<double>{frame.time});
    const pugi::xml_node piece = data.child("Piece");
    EXPECT_STREQ(piece.attribute("NumberOfPoints").value(), "2");
    EXPECT_STREQ(piece.attribute("NumberOfVerts").value(), "2");
    const pugi::xml_node points = piece.child("Points").child("DataArray");
    EXPECT_STREQ(points.attribute("NumberOfComponents").value(), "3");
    EXPECT_EQ(numbers_of(points), flat(frame, &BodyState::position));
    const pugi::xml_node values = piece.child("PointData");
    EXPECT_EQ(numbers_of(values, "velocity"), flat(frame, &BodyState::velocity));
    EXPECT_EQ(numbers_of(values, "angular_velocity"), flat(frame, &BodyState::angular_velocity));
    EXPECT_EQ(numbers_of(values, "radius"), (std::vector<double>{0.002, 0.002}));
    EXPECT_EQ(numbers_of(values, "body"), (std::vector<double>{0, 1}));
    EXPECT_EQ(numbers_of(piece.child("Verts"), "connectivity"), (std::vector<double>{0, 1}));
    EXPECT_EQ(numbers_of(piece.child("Verts"), "offsets"), (std::vector<double>{1, 2}));
  }
}

}  // namespace
}  // namespace slipcheck
