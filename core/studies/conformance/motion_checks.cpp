// Where there is no doubt how a sphere moves: signs, units and axes. How accurately it does is what
// `slipcheck run` measures, so that tolerances are wide here; each says how many steps it leaves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;     // of the trial scenes [m/s²]
constexpr std::size_t kTenth = 102;   // steps in about 0.1 s
constexpr double kSloppiness = 0.01;  // of any engine, beside the order of its steps

const BodyState& last(const Frames& frames) { return frames.back().bodies.front(); }

std::string millimetres(const Vector3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * v.x(), 1e3 * v.y(), 1e3 * v.z());
}
std::string speeds(const Vector3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m/s", v.x(), v.y(), v.z());
}

/// Throws Breach where a vector is further from what it should be than `most`.
void expect_near(const char* what, const Vector3& is, const Vector3& should, double most,
                 std::string (*in_words)(const Vector3&)) {
  if (!((is - should).norm() <= most))
    throw Breach(fmt::format("{} is {}, should be {}", what, in_words(is), in_words(should)));
}

/// v = v0 + g t and x = x0 + v0 t + g t²/2; Euler's method of either kind is off by g t dt/2.
void expect_fall(const Trial& trial, const Scene& scene, const Vector3& g) {
  const Frames frames = run_alone(trial, scene, kTenth);
  const BodyState& start = scene.initial[0];
  const double t = kTenth * kStep;
  const double speed = (start.velocity + g * t).norm();
  expect_near("the velocity after 0.1 s", last(frames).velocity, start.velocity + g * t,
              kSloppiness * speed + g.norm() * kStep, speeds);
  expect_near("the way after 0.1 s", last(frames).position - start.position,
              start.velocity * t + g * t * t / 2, kSloppiness * speed * t + g.norm() * t * kStep,
              millimetres);
}

std::string free_fall(const Trial& trial) {
  Scene scene = one_sphere(1, {0.5, -0.25, 0});
  scene.initial[0].angular_velocity = {1, 2, 3};
  expect_fall(trial, scene, {0, 0, -kGravity});
  return {};
}

std::string fall_downhill(const Trial& trial) {
  Scene scene = one_sphere(1);
  scene.downhill = {1.5, -2.5};
  expect_fall(trial, scene, {1.5, -2.5, -kGravity});
  return {};
}

std::string rest_stays(const Trial& trial) {
  const Scene scene = spheres_on_plane(2);
  const Frames frames = run_alone(trial, scene, 5 * kTenth);
  double farthest = 0;
  for (std::size_t i = 0; i < 2; ++i)
    farthest =
        std::max(farthest, (frames.back().bodies[i].position - scene.initial[i].position).norm());
  if (!(farthest <= kSloppiness * kTrialRadius))
    throw Breach(
        fmt::format("spheres at rest on the plane moved by {:.3g} mm in 0.5 s", 1e3 * farthest));
  return fmt::format("within {:.2g} mm in 0.5 s", 1e3 * farthest);
}

/// With Ω = k̂×v/R nothing rubs: v stays.
std::string rolling_goes_on(const Trial& trial) {
  Scene scene = one_sphere(0, {0.3, 0.4, 0});
  BodyState& start = scene.initial[0];
  start.angular_velocity = rolling_angular_velocity(start.velocity, kTrialRadius);
  const Frames frames = run_alone(trial, scene, 2 * kTenth);
  expect_near("the velocity of a sphere that rolled for 0.2 s", last(frames).velocity,
              start.velocity, 2 * kSloppiness * start.velocity.norm(), speeds);
  return {};
}

/// v = v0 − μ g t against the slip, and Ω grows by (5/2) μ g t/R about k̂×v.
std::string sliding_slows_down(const Trial& trial) {
  const Vector3 heading(0.6, 0.8, 0);
  const Scene scene = one_sphere(0, 2 * heading);
  const Frames frames = run_alone(trial, scene, kTenth);
  const double loss = kTrialFriction * kGravity * kTenth * kStep;
  const double most = 0.05 * loss + 2 * kTrialFriction * kGravity * kStep;
  expect_near("the velocity of a sphere that slid for 0.1 s", last(frames).velocity,
              (2 - loss) * heading, most, speeds);
  const Vector3 spin = kTrialRadius * last(frames).angular_velocity;
  expect_near("R times its angular velocity", spin, 2.5 * loss * Vector3(-0.8, 0.6, 0), 2.5 * most,
              speeds);
  return {};
}

std::string rebound(const Trial& trial) {
  const Scene scene = one_sphere(0.01);  // lands after 45 ms
  const Frames frames = run_alone(trial, scene, 300);
  double lowest = 1, highest_after = 0;
  bool landed = false;
  for (const Frame& frame : frames) {
    const double height = frame.bodies[0].position.z() - kTrialRadius;
    landed |= height < 1e-3;
    lowest = std::min(lowest, height);
    if (landed) highest_after = std::max(highest_after, frame.bodies[0].velocity.z());
  }
  if (!landed) throw Breach("a sphere dropped from 10 mm does not come down");
  if (lowest < -0.5 * kTrialRadius)
    throw Breach(
        fmt::format("a sphere dropped from 10 mm goes {:.3g} mm into the plane", -1e3 * lowest));
  const double impact = std::sqrt(2 * kGravity * 0.01);
  if (highest_after > 1.5 * impact)
    throw Breach(
        fmt::format("it lands with {:.3g} m/s and leaves with {:.3g} m/s", impact, highest_after));
  return fmt::format("lands with {:.3g} m/s, leaves with up to {:.3g} m/s", impact, highest_after);
}

/// The sum of a pair's impulses [N s].
double impulse_of(const Frames& frames, int first, int second) {
  double sum = 0;
  for (const Frame& frame : frames)
    for (const Touch& touch : frame.touches)
      if (touch.first == first && touch.second == second) sum += touch.normal_impulse;
  return sum;
}

std::string touches_of_flight(const Trial& trial) {
  const Frames frames = run_alone(trial, one_sphere(1), kTenth);
  for (const Frame& frame : frames)
    if (!frame.touches.empty()) throw Breach("a sphere 1 m above the plane touches something");
  return {};
}

/// The plane carries m g: its impulses add up to m g t.
std::string touches_of_rest(const Trial& trial) {
  const Scene scene = one_sphere(0);
  const double weight = scene.bodies[0].mass * kGravity * 2 * kTenth * kStep;
  const double carried = impulse_of(run_alone(trial, scene, 2 * kTenth), 0, kSubstrate) / weight;
  if (!(std::abs(carried - 1) < 0.2))
    throw Breach(
        fmt::format("the plane's impulses on a sphere at rest are {:.3g} of m g t", carried));
  return fmt::format("{:.4g} of m g t", carried);
}

/// What the pair exchanges is what it changes: P = m Δv.
std::string touches_of_collision(const Trial& trial) {
  const Scene scene = two_that_meet(0.5);
  const Frames frames = run_alone(trial, scene, kTenth);
  const double impulse = impulse_of(frames, 0, 1);
  if (!(impulse > 0)) throw Breach("two spheres that meet have no touch of (0, 1)");
  std::size_t first = frames.size(), behind = 0;
  for (std::size_t n = 0; n < frames.size(); ++n)
    for (const Touch& touch : frames[n].touches)
      if (touch.first == 0 && touch.second == 1) first = std::min(first, n), behind = n;
  const double before = first == 0 ? 0.5 : frames[first - 1].bodies[0].velocity.x();
  const double change = before - frames[behind].bodies[0].velocity.x();
  const double share = impulse / (scene.bodies[0].mass * change);
  // The plane's friction acts in the same frames, μ g of each step.
  const double most = 0.05 + 2 * kTrialFriction * kGravity * kStep *
                                 static_cast<double>(behind - first + 1) / std::abs(change);
  if (!(std::abs(share - 1) < most))
    throw Breach(fmt::format("the impulses of the collision are {:.3g} of m Δv", share));
  return fmt::format("{:.4g} of m Δv", share);
}

/// A plane that swings as sin(2π f t) carries a sphere along at t = 0, and back half a period
/// later.
std::string clock(const Trial& trial) {
  Scene scene = one_sphere(0);
  constexpr double kFrequency = 1;
  scene.motion = SubstrateMotion::oscillation({0.1, 0}, kFrequency, 0);
  for (const double turn : {1.0, -1.0}) {
    const double time = turn > 0 ? 0 : 0.5 / kFrequency;
    const double v = last(run_alone(trial, scene, 50, time)).velocity.x();
    if (!(turn * v > 0.01))
      throw Breach(fmt::format(
          "started at {:g} s on a plane that moves with {:+.3g} m/s, a sphere has {:+.3g} m/s "
          "after 50 ms",
          time, turn * 0.628, v));
  }
  return {};
}

/// Of tan θ = 3/4 and μ = 0.3 > (2/7) tan θ: it rolls down with (5/7) g sin θ, and the slope
/// carries m g cos θ.
std::string rolls_down_surface(const Trial& trial) {
  const Scene scene = sphere_on_slope();
  const Frames frames = run_alone(trial, scene, kTenth);
  const double t = kTenth * kStep, speed = 5.0 / 7 * 0.6 * kGravity * t;
  expect_near("the velocity of a sphere that rolled down a surface for 0.1 s",
              last(frames).velocity, speed * Vector3(0.8, 0, -0.6),
              5 * kSloppiness * speed + kGravity * kStep, speeds);
  const double load = scene.bodies[0].mass * 0.8 * kGravity * t;
  const double carried = impulse_of(frames, 0, surface_touch(1)) / load;
  if (!(std::abs(carried - 1) < 0.2))
    throw Breach(fmt::format("the impulses of surface 1 are {:.3g} of m g cos θ t", carried));
  return fmt::format("carries {:.4g} of m g cos θ t", carried);
}

}  // namespace

std::vector<Check> motion_checks() {
  return {
      {"free fall",
       "Gravity is m/s² along −z and acts on every body from the first step; lengths are metres, "
       "velocities m/s. No damping, no speed limit.",
       free_fall},
      {"gravity along the plane", "Add downhill to gravity along x and y.", fall_downhill},
      {"rest stays",
       "A sphere whose centre is R above z = 0 touches the plane and stays: no sinking, margin or "
       "drift.",
       rest_stays},
      {"rolling goes on",
       "Angular velocities are rad/s about the axes x, y, z, right-handed: a sphere that rolls "
       "along "
       "+x turns about +y.",
       rolling_goes_on},
      {"sliding slows down",
       "Kinetic friction with the plane is μ_k times the normal force, against the slip of the "
       "lowest "
       "point, and turns a solid sphere of I = shape_factor m R².",
       sliding_slows_down},
      {"rebound", "A sphere that comes down stops at or leaves the plane z = 0.", rebound},
      {"touches in flight", "Report touches of this step alone, with an impulse > 0.",
       touches_of_flight},
      {"touches at rest",
       "Give impulses in N s, not forces: the sum over a body's contact points with the plane in "
       "the step.",
       touches_of_rest},
      {"touches of a collision",
       "Report a pair of bodies that collide in the frame that shows their new velocities, once.",
       touches_of_collision},
      {"rolling down a surface",
       "A surface is where its point and normal say and has its own friction; a touch with surface "
       "k "
       "has fffffffe - k for its second body.",
       rolls_down_surface},
      {"clock", "Let the plane begin at the time that start gives, not at 0.", clock},
  };
}

}  // namespace slipcheck
