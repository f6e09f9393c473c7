#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "../bullet_backend/bullet_run.h"
#include "../reference/scene_images.h"
#include "../support/bundled.h"
#include "engine/engine_registry.h"
#include "peer_worker.h"

// Which symmetries engines have: random scenes of two and three bodies and their images, half a
// second each. Where an engine has one, its two ends differ by rounding; where it has not, by what
// a user would see. Both are said here, engine by engine, so that neither changes unnoticed.

namespace slipcheck {
namespace {

constexpr unsigned kSeeds = 12;
constexpr unsigned kFewSeeds = 4;  ///< of an engine that takes seconds for one
constexpr std::size_t kRate = 240;

enum class Has {
  yes,
  no,
  to_its_solvers_tolerance,
  /// As that; a quarter of the scenes to a hundred times as much. A damping force begins with the
  /// step that finds a touch: a height that is off by δ leaves a velocity off by γ δ, and the next
  /// bounce at v comes 2 γ δ/g later, 2 γ v/g times as far off: 30 times at 1 cm/s and γ = 15/ms.
  but_for_bounces,
  mostly,    ///< where its friction lies along a slip that is no more than a rounding, it does not
  not_asked  ///< between rounding and what a user would see
};
using enum Has;

struct Row {
  const char* engine;  ///< with @: of npm, the newest version that is there
  const char* precision;
  const char* profile;
  Has mirror, quarter, turn, belt, order;
  unsigned seeds = kSeeds;
  double tolerance = 1e-8;  ///< what a solver's tolerance leaves of a symmetry [radii]
  double shape = 0;         ///< c in I = c m R² where the engine knows but one
  std::size_t steps = 120;

  double end() const { return static_cast<double>(steps) / kRate; }
};

/// `default` has friction along fixed axes, restitution by thresholds, and a plane's velocity of
/// the step before; Gauss-Seidel that does not converge has an order. `physical` has a cone where
/// the engine offers one, and enough iterations.
const std::vector<Row> kRows = {
    {"bullet", "double", "default", yes, no, no, no, no},
    {"bullet", "double", "physical", yes, yes, yes, yes, yes},
    {"bullet", "single", "default", yes, no, no, no, no},
    {"bullet", "single", "physical", yes, yes, yes, yes, yes},
    // DART's boxed LCP is solved row by row, from a start of its own.
    {"dart", "double", "default", no, no, no, no, not_asked},
    {"dart", "double", "physical", yes, yes, no, yes, yes},  // two fixed axes
    // A belt is a body of 10⁶ times the mass, which what lies on it brakes.
    {"mujoco", "double", "physical", to_its_solvers_tolerance, to_its_solvers_tolerance,
     to_its_solvers_tolerance, no, to_its_solvers_tolerance},
    {"cannon-es@", "double", "default", yes, yes, no, no, yes},  // two fixed axes
    {"cannon-es@", "double", "physical", yes, yes, no, yes, no},
    {"havok@", "single", "default", no, no, no, no, no},
    {"havok@", "single", "physical", not_asked, no, no, no, not_asked},
    {"jolt@", "single", "default", yes, yes, yes, no, no},
    {"jolt@", "single", "physical", yes, yes, yes, yes, yes},
    {"mujoco@", "double", "default", to_its_solvers_tolerance, no, no, not_asked, not_asked},
    {"mujoco@", "double", "physical", to_its_solvers_tolerance, to_its_solvers_tolerance,
     to_its_solvers_tolerance, to_its_solvers_tolerance, to_its_solvers_tolerance},
    {"mujoco", "double", "default", not_asked, no, no, no, not_asked},
    {"physx@", "single", "default", yes, no, no, no, no},
    {"physx@", "single", "physical", yes, yes, yes, no, no},
    {"rapier@", "single", "default", yes, yes, no, no, no},
    {"rapier@", "single", "physical", yes, yes, yes, no, yes},
    // Its spheres are solid. A rounding of a turned place is one of an overlap, 10⁴ times smaller.
    {"lammps", "double", "default", yes, yes, but_for_bounces, yes, yes, kSeeds, 1e-7, 0.4},
    {"lammps", "double", "physical", yes, yes, to_its_solvers_tolerance, yes, yes, kFewSeeds, 1e-7,
     0.4, 48},
    // Its solver ends at 10⁻⁴ as it ships; at 10⁻¹⁰, of which steps add up to ten times as much. By
    // their order bodies come apart however well that is solved.
    {"siconos", "double", "default", yes, to_its_solvers_tolerance, to_its_solvers_tolerance,
     to_its_solvers_tolerance, no, kFewSeeds, 1e-4},
    {"siconos", "double", "physical", yes, to_its_solvers_tolerance, to_its_solvers_tolerance,
     to_its_solvers_tolerance, no, kFewSeeds, 1e-9},
    // An integrator's steps are cut by the errors of its coordinates, accuracy 10⁻³ and 10⁻⁷ each,
    // and what a collision takes of that it makes larger: ten and a hundred times.
    {"simbody", "double", "default", yes, to_its_solvers_tolerance, no, to_its_solvers_tolerance,
     to_its_solvers_tolerance, kFewSeeds, 1e-2},
    {"simbody", "double", "physical", yes, to_its_solvers_tolerance, to_its_solvers_tolerance,
     to_its_solvers_tolerance, to_its_solvers_tolerance, kFewSeeds, 1e-5, 0, 24},
    {"ode", "double", "default", yes, yes, no, yes, yes},  // two fixed axes
    {"ode", "double", "physical", yes, to_its_solvers_tolerance, to_its_solvers_tolerance, mostly,
     to_its_solvers_tolerance},
};

/// A rounding of a position of 1 m in a radius of 1.2 mm at each step, all the same way.
double rounding(const Row& row) {
  const double epsilon = std::string(row.precision) == "single"
                             ? std::numeric_limits<float>::epsilon()
                             : std::numeric_limits<double>::epsilon();
  return static_cast<double>(row.steps) / 1.2e-3 * epsilon;
}

/// Built here, or brought by npm.
std::vector<EngineExecutable> installed() {
  test::use_test_engines();
  return find_engines();
}

/// The worker of a row, of several versions the newest; none where it is not there.
std::optional<EngineExecutable> executable_of(const Row& row) {
  const std::string name = row.engine;
  std::optional<EngineExecutable> newest;
  for (EngineExecutable& each : installed())
    if (each.precision == row.precision &&
        (name.back() == '@' ? each.engine.starts_with(name) : each.engine == name) &&
        (!newest || is_older_version(engine_version(newest->engine), engine_version(each.engine))))
      newest = std::move(each);
  return newest;
}

/// A random scene whose first ball comes to the others.
Scene meeting(unsigned seed) {
  Scene scene = test::random_scene(seed, 2 + seed % 2);
  test::Random random(seed + 2000);
  BodyState& first = scene.initial[0];
  Vector3 aim = scene.initial[1].position - first.position;
  aim.z() = 0;
  first.position.z() = scene.bodies[0].radius;
  first.velocity = random(0.3, 1) * aim.normalized();
  for (std::size_t k = 1; k < scene.initial.size(); ++k) {
    scene.initial[k].velocity *= 0.1;
    scene.initial[k].position.z() = scene.bodies[k].radius;
  }
  return scene;
}

/// The scenes of a row, each with its end.
struct Met {
  Scene scene;
  Frame end;
};

std::vector<Met> ends_of(RemoteEngine& engine, const Row& row, const Settings& settings) {
  std::vector<Met> found;
  unsigned met = 0;
  for (unsigned seed = 0; seed < row.seeds; ++seed) {
    Scene scene = meeting(seed);
    if (row.shape > 0)
      for (Sphere& body : scene.bodies) body.shape_factor = row.shape;
    const auto frames = run(engine, scene, settings, kRate, row.steps);
    met += std::ranges::any_of(frames, touch_each_other) ? 1 : 0;
    found.push_back({std::move(scene), frames.back()});
  }
  EXPECT_GE(met, row.seeds / 2);
  return found;
}

/// How far the ends of scenes and images are apart, in radii, sorted.
std::vector<double> differences(
    RemoteEngine& engine, const Row& row, const Settings& settings, const std::vector<Met>& ends,
    const std::function<test::Image(const Scene&, unsigned)>& image_of) {
  std::vector<double> found;
  for (unsigned seed = 0; seed < ends.size(); ++seed) {
    const auto& [scene, end] = ends[seed];
    const test::Image image = image_of(scene, seed);
    const Frame other = run(engine, image.scene, settings, kRate, row.steps).back();
    double worst = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      worst = test::largest_of(
          worst, test::difference(image.of(end.bodies[image.origin_of(i)]), other.bodies[i],
                                  image.scene.bodies[i].radius, 1));
    found.push_back(worst);
  }
  std::ranges::sort(found);
  return found;
}

class EngineSymmetry : public testing::TestWithParam<Row> {};

/// All of a row in one test, as engines of npm take seconds to start.
TEST_P(EngineSymmetry, IsThatOfItsRow) {
  const Row& row = GetParam();
#ifdef SLIPCHECK_SANITIZE
  if (std::string(row.engine).back() == '@') GTEST_SKIP() << "nothing of it is compiled";
#endif
  const auto executable = executable_of(row);
  if (!executable) GTEST_SKIP() << row.engine << " is not there";
  RemoteEngine engine(executable->command, test::kPatient);
  const Settings settings =
      load_profile((executable->profiles / (std::string(row.profile) + ".yaml")).string()).settings;
  const std::vector<Met> ends = ends_of(engine, row, settings);
  const auto expect = [&](const char* symmetry, Has has,
                          const std::function<test::Image(const Scene&, unsigned)>& image_of) {
    if (has == not_asked) return;
    const std::vector<double> found = differences(engine, row, settings, ends, image_of);
    if (has == no) {
      EXPECT_GT(found.back(), std::max(1e-3, rounding(row)))
          << "it has this symmetry now: " << symmetry;
      return;
    }
    // One scene may stand at a threshold, which a rounding is enough to cross.
    const std::size_t last = has == mostly ? found.size() / 2 : found.size() - 2;
    if (has == but_for_bounces) {
      EXPECT_LE(found[found.size() * 3 / 4], row.tolerance) << symmetry;
      EXPECT_LE(found[last], 100 * row.tolerance) << symmetry;
      return;
    }
    EXPECT_LE(found[last], has == to_its_solvers_tolerance ? row.tolerance : rounding(row))
        << symmetry;
  };
  expect("mirror", row.mirror,
         [&](const Scene& scene, unsigned) { return test::mirrored(scene, row.end()); });
  expect("quarter turn", row.quarter, [&](const Scene& scene, unsigned) {
    return test::turned_by(scene, row.end(), Vector2::UnitY());
  });
  expect("turn", row.turn, [&](const Scene& scene, unsigned) {
    return test::turned_by(scene, row.end(), Vector2(0.8, 0.6));
  });
  expect("belt", row.belt, [&](const Scene& scene, unsigned) {
    return test::on_a_belt(scene, row.end(), Vector2(0.25, -0.5));
  });
  expect("order of the bodies", row.order, [&](const Scene& scene, unsigned seed) {
    test::Random random(seed + 1000);
    return test::in_another_order(scene, row.end(), random);
  });
}

INSTANTIATE_TEST_SUITE_P(Engines, EngineSymmetry, testing::ValuesIn(kRows), [](const auto& row) {
  std::string name =
      std::string(row.param.engine) + "_" + row.param.precision + "_" + row.param.profile;
  std::ranges::replace_if(
      name, [](char c) { return c == '-' || c == '@'; }, '_');
  return name;
});

}  // namespace
}  // namespace slipcheck
