// MuJoCo by its own API and a model typed by hand, beside the worker.

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "peer_run.h"

namespace slipcheck::test {
namespace {

/// `%G`, `%M`, `%I` stand for gravity, and mass and moment of inertia of the scene's balls, `%H`
/// and `%J` for those of a body that carries a belt, a million times as heavy.
std::string filled_in(std::string text, const Scene& scene) {
  const Sphere& sphere = scene.bodies[0];
  const auto fill = [&](const std::string& mark, double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", value);
    for (std::size_t at; (at = text.find(mark)) != std::string::npos;)
      text.replace(at, mark.size(), digits.data());
  };
  fill("%G", scene.gravity);
  fill("%M", sphere.mass);
  fill("%I", sphere.moment_of_inertia());
  fill("%H", 1e6 * sphere.mass);
  fill("%J", 1e6 * sphere.mass * 100 * 100);
  return text;
}

/// With a `belt`, its body is the first.
States run_bare_mujoco(const Scene& scene, const std::string& xml, int steps, double belt = 0) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("slipcheck-bare-" + std::to_string(getpid()) + ".xml");
  std::ofstream(file) << filled_in(xml, scene);
  std::array<char, 1000> error{};
  mjModel* model = mj_loadXML(file.c_str(), nullptr, error.data(), error.size());
  std::filesystem::remove(file);
  if (!model) {
    ADD_FAILURE() << error.data();
    return {};
  }
  mjData* data = mj_makeData(model);
  const std::size_t first = belt != 0 ? 1 : 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      data->qvel[6 * (first + i) + k] = scene.initial[i].velocity[axis];
      data->qvel[6 * (first + i) + 3 + k] = scene.initial[i].angular_velocity[axis];
    }
  const std::vector<mjtNum> home(data->qpos, data->qpos + 7 * first);
  States states;
  for (int n = 0; n < steps; ++n) {
    std::copy(home.begin(), home.end(), data->qpos);
    if (belt != 0) {
      const std::array<mjtNum, 6> moves = {belt, 0, 0, 0, 0, 0};
      std::copy(moves.begin(), moves.end(), data->qvel);
      data->qfrc_applied[2] = 1e6 * scene.bodies[0].mass * scene.gravity;
    }
    mj_step(model, data);
    auto& now = states.emplace_back();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const mjtNum *q = data->qpos + 7 * (first + i), *v = data->qvel + 6 * (first + i);
      mjtNum spin[3];
      mju_rotVecQuat(spin, v + 3, q + 3);
      now.push_back({{q[0], q[1], q[2]}, {v[0], v[1], v[2]}, {spin[0], spin[1], spin[2]}});
    }
  }
  mj_deleteData(data);
  mj_deleteModel(model);
  return states;
}

TEST(MujocoBare, SlideToRoll) {
  const Scene scene = bundled_scene("slide-to-roll");
  const std::string xml = R"(<mujoco>
    <option timestep="0.004166666666666667" gravity="0 0 -%G"/>
    <worldbody>
      <geom name="ground" type="plane" size="0 0 1"/>
      <body pos="0 0 0.005"><freejoint/>
        <inertial pos="0 0 0" mass="%M" diaginertia="%I %I %I"/>
        <geom name="ball" type="sphere" size="0.005"/></body>
    </worldbody>
    <contact><pair geom1="ground" geom2="ball" condim="3" friction="0.2 0.2 0 0 0"/></contact>
  </mujoco>)";
  expect_as_bare("mujoco", scene, run_bare_mujoco(scene, xml, 240));
}

TEST(MujocoBare, BouncingBall) {
  const Scene scene = bundled_scene("bouncing-ball");
  const std::string xml = R"(<mujoco>
    <option timestep="0.004166666666666667" gravity="0 0 -%G"/>
    <worldbody>
      <geom name="ground" type="plane" size="0 0 1"/>
      <body pos="0 0 0.06"><freejoint/>
        <inertial pos="0 0 0" mass="%M" diaginertia="%I %I %I"/>
        <geom name="ball" type="sphere" size="0.01"/></body>
    </worldbody>
    <contact><pair geom1="ground" geom2="ball" condim="3" friction="0.3 0.3 0 0 0"/></contact>
  </mujoco>)";
  expect_as_bare("mujoco", scene, run_bare_mujoco(scene, xml, 240));
}

TEST(MujocoBare, TwoRollingBallsMeet) {
  const Scene scene = bundled_scene("symmetric-30cms");
  const std::string xml = R"(<mujoco>
    <option timestep="0.004166666666666667" gravity="0 0 -%G"/>
    <worldbody>
      <geom name="ground" type="plane" size="0 0 1"/>
      <body pos="-0.0095 0 0.002"><freejoint/>
        <inertial pos="0 0 0" mass="%M" diaginertia="%I %I %I"/>
        <geom name="i" type="sphere" size="0.002"/></body>
      <body pos="0.0095 0 0.002"><freejoint/>
        <inertial pos="0 0 0" mass="%M" diaginertia="%I %I %I"/>
        <geom name="j" type="sphere" size="0.002"/></body>
    </worldbody>
    <contact>
      <pair geom1="ground" geom2="i" condim="3" friction="0.1 0.1 0 0 0"/>
      <pair geom1="i" geom2="j" condim="1"/>
      <pair geom1="ground" geom2="j" condim="3" friction="0.1 0.1 0 0 0"/>
    </contact>
  </mujoco>)";
  expect_as_bare("mujoco", scene, run_bare_mujoco(scene, xml, 240));
}

TEST(MujocoBare, APlateAPegAndABelt) {
  // A belt is a box behind its face on a body that is put back before each step, with its velocity.
  const double belt = -0.5;
  const Scene scene = plate_peg_and_belt(0.3, 0, belt);
  const std::string xml = R"(<mujoco>
    <option timestep="0.004166666666666667" gravity="0 0 -%G"/>
    <statistic meaninertia="%M"/>
    <worldbody>
      <geom name="plate" type="box" size="0.1 0.1 1e-10" pos="0 0 0.1" contype="0" conaffinity="0"/>
      <geom name="peg" type="sphere" size="0.05" pos="0.25 0 -0.03" contype="0" conaffinity="0"/>
      <body pos="0 0 -0.6"><freejoint/>
        <inertial pos="0 0 0" mass="%H" diaginertia="%J %J %J"/>
        <geom name="belt" type="box" size="1e4 1e4 0.5" contype="0" conaffinity="0"/></body>
      <body pos="0 0 0.12"><freejoint/>
        <inertial pos="0 0 0" mass="%M" diaginertia="%I %I %I"/>
        <geom name="ball" type="sphere" size="0.02" contype="0" conaffinity="0"/></body>
    </worldbody>
    <contact>
      <pair geom1="plate" geom2="ball" condim="3" friction="0.3 0.3 0 0 0"/>
      <pair geom1="peg" geom2="ball" condim="3" friction="0.3 0.3 0 0 0"/>
      <pair geom1="belt" geom2="ball" condim="3" friction="0.3 0.3 0 0 0"/>
    </contact>
  </mujoco>)";
  expect_as_bare("mujoco", scene, run_bare_mujoco(scene, xml, 240, belt));
}

}  // namespace
}  // namespace slipcheck::test
