// Scenes that an engine may refuse, but must not fall over.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

constexpr std::size_t kSteps = 20;

/// Refused with a reason, or run; then `judge` looks at the frames.
std::string take(const Trial& trial, const Scene& scene, std::size_t steps = kSteps,
                 void (*judge)(const Frames& frames) = nullptr) {
  RemoteEngine engine = trial.engine();
  try {
    const Applied applied = engine.configure(scene, {}, kStep);
    const Frames frames = run(engine, scene, steps, 0.25);
    if (judge) judge(frames);
    std::string lacks;
    for (const Lack& lack : applied.not_represented)
      lacks += (lacks.empty() ? ", not represented: " : "; ") + lack.text;
    return "runs" + lacks;
  } catch (const Refused& refused) {
    if (*refused.what() == '\0') throw Breach("it is refused without a reason");
    const Scene plain = one_sphere(0);
    engine.configure(plain, {}, kStep);
    run(engine, plain, 1);
    return fmt::format("refused: {}", refused.what());
  }
}

std::string many_bodies(const Trial& trial) { return take(trial, spheres_on_plane(400), 10); }

std::string open_box(const Trial& trial) { return take(trial, spheres_in_box()); }

std::string moving_box_with_lid(const Trial& trial) {
  Scene scene = spheres_in_box();
  scene.box->moving_walls = true;
  scene.box->lid = 0.3;
  return take(trial, scene);
}

std::string periodic_plane(const Trial& trial) {
  Scene scene = spheres_on_plane(3);
  scene.periodic = {0.3, 0.3};
  return take(trial, scene);
}

std::string tilted_plane(const Trial& trial) {
  Scene scene = spheres_on_plane(1);
  scene.downhill = {0.5, -0.8};
  return take(trial, scene);
}

constexpr double kSlope = 20 * std::numbers::pi / 180;
constexpr std::size_t kRollingSteps = 102;  // about 0.1 s

/// A solid sphere rolls down with 5/7 g sin θ. How well it rolls is what `slipcheck run` measures:
/// one that tips over a mesh's facets comes a quarter as far; here it must go down the slope at
/// all, and neither through it nor off it.
void rolls_down(const Frames& frames) {
  const double gained = 5.0 / 7 * 9.81 * std::sin(kSlope) * kRollingSteps * kStep;
  const Vector3 downhill(std::cos(kSlope), 0, -std::sin(kSlope));
  const Vector3& is = frames.back().bodies[0].velocity;
  const double along = is.dot(downhill), astray = (is - along * downhill).norm();
  if (!(along > 0.1 * gained && along < 1.5 * gained && astray < 0.2 * gained + 2 * 9.81 * kStep))
    throw Breach(fmt::format(
        "a sphere on a plane of 20 degrees has ({:.3g}, {:.3g}, {:.3g}) m/s after 0.1 s, should "
        "roll with ({:.3g}, 0, {:.3g}) m/s",
        is.x(), is.y(), is.z(), gained * downhill.x(), gained * downhill.z()));
}

std::string slope_without_substrate(const Trial& trial) {
  const Vector3 up(std::sin(kSlope), 0, std::cos(kSlope));
  Scene scene = spheres_on_plane(1);
  scene.has_substrate = false;
  scene.surfaces = {{PlaneShape{Vector3(0, 0, -1), up}, {}}};
  scene.on_surfaces = {{scene.substrate[0], {0.8, kTrialFriction, 0}}};
  scene.initial[0].position = Vector3(0, 0, -1) + kTrialRadius * up;
  return take(trial, scene, kRollingSteps, rolls_down);
}

std::string moved_plane(const Trial& trial, const SubstrateMotion& motion) {
  Scene scene = spheres_on_plane(1);
  scene.motion = motion;
  return take(trial, scene);
}

std::string belt(const Trial& trial) {
  return moved_plane(trial, SubstrateMotion::constant({0.2, -0.1}));
}

std::string shaken_plane(const Trial& trial) {
  return moved_plane(trial, SubstrateMotion::oscillation({0.01, 0.002}, 5, 0.3));
}

std::string plane_by_table(const Trial& trial) {
  return moved_plane(trial,
                     SubstrateMotion::table({{0, {0, 0}}, {0.26, {0.01, 0}}, {0.5, {0, 0}}}));
}

std::string confined(const Trial& trial) {
  Scene scene = two_that_meet(0.5);
  scene.confined = true;
  return take(trial, scene, 100);
}

std::string by_law(const Trial& trial, const RestitutionLaw& law) {
  Scene scene = two_that_meet(0.5);
  scene.pairs = {{law, 0.2, 0.5}};
  return take(trial, scene, 100);
}

std::string power_law(const Trial& trial) { return by_law(trial, PowerLawRestitution{}); }

std::string tabulated(const Trial& trial) {
  return by_law(trial, TabulatedRestitution{-2, 0.5, {3, 2, 1}, {-1, -2, -3}});
}

std::string all_frictions(const Trial& trial) {
  Scene scene = spheres_on_plane(2);
  SubstrateContact& ground = scene.substrate[0];
  ground.static_friction = 0.5;
  ground.rolling = RollingFriction({{0, 0.001}, {0.5, 0.002}});
  ground.drilling_length = 1e-4;
  ground.coupled_radius = 2e-4;
  ground.rolling_while_sliding = true;
  for (BodyState& state : scene.initial) {
    state.velocity = {0.3, 0.2, 0};
    state.angular_velocity = {5, 10, 40};
  }
  return take(trial, scene);
}

std::string two_materials(const Trial& trial) {
  Scene scene = spheres_on_plane(3);
  scene.bodies[1] = {2 * kTrialRadius, 0.01, 2.0 / 3};
  scene.initial[1].position = {0.1, 0.1, 2 * kTrialRadius};
  scene.material = {0, 1, 0};
  SubstrateContact smooth;
  scene.substrate.push_back(smooth);
  scene.pairs = {{0.8, 0.3, 0}, {0.5, 0, -1}, {0.5, 0, -1}, {0.9, 0.1, 0}};
  return take(trial, scene);
}

std::string weightless(const Trial& trial) {
  Scene scene = two_that_meet(0.5);
  scene.gravity = 0;
  return take(trial, scene, 100);
}

}  // namespace

std::vector<Check> scene_checks() {
  const char* mend =
      "Run the scene, or answer configure with {type: \"refused\", reason: text} and stay usable; "
      "what of it is "
      "not done goes into not_represented.";
  return {
      {"scene: 400 bodies", mend, many_bodies},
      {"scene: two materials", mend, two_materials},
      {"scene: no gravity", mend, weightless},
      {"scene: all frictions", mend, all_frictions},
      {"scene: restitution by a power", mend, power_law},
      {"scene: restitution by a table", mend, tabulated},
      {"scene: confined to the plane", mend, confined},
      {"scene: tilted plane", mend, tilted_plane},
      {"scene: slope without a substrate", mend, slope_without_substrate},
      {"scene: belt", mend, belt},
      {"scene: shaken plane", mend, shaken_plane},
      {"scene: plane moved by a table", mend, plane_by_table},
      {"scene: periodic plane", mend, periodic_plane},
      {"scene: open box", mend, open_box},
      {"scene: moving box with a lid", mend, moving_box_with_lid},
  };
}

}  // namespace slipcheck
