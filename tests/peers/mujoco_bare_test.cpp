// MuJoCo by its own API and a model typed by hand, beside the worker.

#include <mujoco/mujoco.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "peer_run.h"

namespace slipcheck::test {
namespace {

/// `%G`, `%M`, `%I` stand for gravity, and mass and moment of inertia of the scene's balls.
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
  return text;
}

States run_bare_mujoco(const Scene& scene, const std::string& xml, int steps) {
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
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      data->qvel[6 * i + static_cast<std::size_t>(k)] = scene.initial[i].velocity[k];
      data->qvel[6 * i + 3 + static_cast<std::size_t>(k)] = scene.initial[i].angular_velocity[k];
    }
  States states;
  for (int n = 0; n < steps; ++n) {
    mj_step(model, data);
    auto& now = states.emplace_back();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const mjtNum *q = data->qpos + 7 * i, *v = data->qvel + 6 * i;
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

}  // namespace
}  // namespace slipcheck::test
