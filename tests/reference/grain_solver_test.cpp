#include "reference/steps/grain_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <ostream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "../support/extremes.h"
#include "../support/instruction_set.h"
#include "planar_scenes.h"
#include "reference/steps/grain_blocks.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_solver.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

constexpr double kRadius = 0.002;
constexpr double kStep = kCollisionTime / 50;

struct Laws {
  std::string name;
  NormalForce normal;
  ContactEnd end;
  bool rubs, on_plane;
  /// Of the plane.
  Vector2 downhill = Vector2::Zero();  // [m/s²]
  SubstrateMotion motion = {};
  bool unlike = false;  // radii
  bool lifts = false;
  double rolling = 0;  // μ_r
  bool walls = false;
};

std::string name_of(const testing::TestParamInfo<Laws>& info) { return info.param.name; }

/// Every second and third body is smaller, and stands on the plane.
void make_unlike(Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double share = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.8 : 0.4;
    scene.bodies[i].radius *= share;
    scene.bodies[i].mass *= share * share * share;
    scene.initial[i].position.z() = scene.bodies[i].radius;
  }
}

/// Bodies that may leave the plane and rebound from it; some fly in the beginning.
void make_lifting(Scene& scene, double speed) {
  scene.confined = false;
  scene.substrate[0].restitution = 0.6;
  for (std::size_t i = 0; i < scene.initial.size(); i += 3) {
    const double R = scene.bodies[i].radius;
    if (i % 2 == 0) scene.initial[i].position.z() += 0.3 * R;
    scene.initial[i].velocity.z() = i % 2 == 0 ? -speed : 0.7 * speed;
  }
}

/// Four walls, smoother than grains and one of them softer, a radius outside of such a rectangle.
void enclose(ContactScene& scene, const Vector2& least, const Vector2& most) {
  Scene& hard = scene.hard;
  const double R = hard.bodies[0].radius;
  hard.periodic.setZero();
  for (const auto& [point, normal] : {std::pair{least, Vector2(1, 0)},
                                      {least, Vector2(0, 1)},
                                      {most, Vector2(-1, 0)},
                                      {most, Vector2(0, -1)}}) {
    const Vector2 at = point - R * normal;
    hard.surfaces.push_back({PlaneShape{{at.x(), at.y(), 0}, {normal.x(), normal.y(), 0}}, {}});
    hard.on_surfaces.emplace_back();
    scene.soft_surfaces.emplace_back(scene.soft[0]);
    if (auto* rubs = std::get_if<ViscousForce>(&scene.soft_surfaces.back()->tangential))
      rubs->friction *= 0.5;
  }
  scene.soft_surfaces[2]->normal =
      LinearForce{0.5 * std::get<LinearForce>(scene.soft[0]->normal).stiffness, 0};
}

/// With as much drilling friction.
void add_rolling(Scene& scene, double coefficient) {
  scene.substrate[0].rolling = RollingFriction(coefficient);
  scene.substrate[0].drilling_length = coefficient * scene.bodies[0].radius;
}

void PrintTo(const Laws& laws, std::ostream* out) { *out << laws.name; }

/// Steel balls that fly into each other from a jittered lattice, fast and with spins.
ContactScene cluster(const Laws& laws, std::size_t side) {
  Scene hard = steel_scene(side * side);
  hard.confined = true;
  hard.downhill = laws.downhill;
  hard.motion = laws.motion;
  if (!laws.on_plane) hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
  std::mt19937_64 random(7);
  const auto symmetric = [&] { return 2 * uniform(random) - 1; };
  for (std::size_t k = 0; k < hard.initial.size(); ++k) {
    BodyState& state = hard.initial[k];
    const double x = static_cast<double>(k % side) - 0.5 * static_cast<double>(side - 1);
    const double y = static_cast<double>(k / side) - 0.5 * static_cast<double>(side - 1);
    state.position = {2.2 * kRadius * (x + 0.03 * symmetric()),
                      2.2 * kRadius * (y + 0.03 * symmetric()), kRadius};
    state.velocity = {-x + 0.3 * symmetric(), -y + 0.3 * symmetric(), 0};
    if (laws.rubs) state.angular_velocity.z() = 300 * symmetric();
    if (laws.on_plane) state.angular_velocity.head<2>() = Vector2(symmetric(), symmetric()) * 100;
  }
  if (laws.unlike) {
    make_unlike(hard);
    for (BodyState& state : hard.initial) {  // as many collisions of smaller ones
      state.position.head<2>() *= 0.85;
      state.velocity *= 3;
    }
  }
  if (laws.lifts) make_lifting(hard, 0.1);
  add_rolling(hard, laws.rolling);
  SoftContact contact{laws.normal, laws.end, NoTangentialForce{}};
  const double reduced = 0.5 * hard.bodies[0].mass;
  if (laws.rubs) contact.tangential = ViscousForce{reduced * 0.1 / kCollisionTime, 0.3};
  ContactScene scene = with_contact(std::move(hard), contact);
  if (laws.walls) {
    const double extent = 2.2 * kRadius * 0.5 * static_cast<double>(side - 1) + 0.1 * kRadius;
    enclose(scene, {-extent, -extent}, {extent, extent});
    for (std::size_t i = 1; i < scene.hard.initial.size(); i += 4)
      scene.hard.initial[i].velocity.head<2>() *= -1;  // outwards
  }
  return scene;
}

double largest_difference(const std::vector<BodyState>& a, const std::vector<BodyState>& b,
                          double radius = kRadius) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = test::largest_of(largest, (a[i].position - b[i].position).norm() / radius,
                               (a[i].velocity - b[i].velocity).norm(),
                               radius * (a[i].angular_velocity - b[i].angular_velocity).norm());
  return largest;
}

class GrainLaws : public testing::TestWithParam<Laws> {};

/// Every step of both solvers is the same but for rounding, which collisions multiply: by how much,
/// runs tell that begin 1e-13 of the extent aside. A thousand roundings of such positions move a
/// grain by so much, if all go one way; three times that, as these runs begin aside in some
/// directions of many. Gives how many contacts began.
std::size_t expect_steps_of_step_solver(const ContactScene& scene, double extent, double step,
                                        std::span<const std::size_t> counts) {
  const double radius = scene.hard.bodies[0].radius;
  EXPECT_EQ(grain_refusal(scene, scene.hard.initial), "");
  const StepSettings settings{.step = step, .general = true};
  GrainSolver grains(scene, scene.hard.initial, step);
  StepSolver steps(scene, scene.hard.initial, settings);
  std::mt19937_64 random(3);
  std::vector<StepSolver> beside;
  for (int k = 0; k < 4; ++k) {
    std::vector<BodyState> aside = scene.hard.initial;
    for (BodyState& state : aside) {
      const double angle = 2 * M_PI * uniform(random);
      state.position.head<2>() += 1e-13 * extent * Vector2(std::cos(angle), std::sin(angle));
    }
    beside.emplace_back(scene, aside, settings);
  }
  Frame frame;
  std::size_t n = 0;
  for (const std::size_t count : counts) {
    n += count;
    grains.advance(count);
    // What begins now is counted with the next step, by StepSolver with the last one.
    const double t = static_cast<double>(n) * step;
    const std::size_t collisions = steps.run(until_time(t - step), nullptr).collisions;
    EXPECT_EQ(steps.run(until_time(t), nullptr).steps, n);
    grains.show(frame);
    double multiplied = 0;
    for (StepSolver& each : beside) {
      each.run(until_time(t), nullptr);
      multiplied = std::max(multiplied, largest_difference(each.states(), steps.states(), radius));
    }
    EXPECT_LT(largest_difference(frame.bodies, steps.states(), radius), 3 * multiplied) << n;
    EXPECT_EQ(grains.collisions(), collisions) << n;
  }
  return grains.collisions();
}

TEST_P(GrainLaws, StepsAsStepSolverDoes) {
  constexpr std::size_t kCounts[] = {2, 7, 100, 400, 400};
  EXPECT_GT(expect_steps_of_step_solver(cluster(GetParam(), 6), 14 * kRadius, kStep, kCounts), 40u);
}

const double kMass = 7850 * 4 * M_PI / 3 * kRadius * kRadius * kRadius;
const NormalForce kLinear =
    linear_contact(0.5 * kMass, 0.9, kCollisionTime, ContactEnd::zero_overlap).normal;
const NormalForce kClamped =
    linear_contact(0.5 * kMass, 0.6, kCollisionTime, ContactEnd::zero_force).normal;
/// As stiff at 1 % of the radius.
const double kModulus = std::get<LinearForce>(kLinear).stiffness / std::sqrt(0.01 * kRadius);

/// Twice in the thousand steps of these tests; static friction holds what rolls for a part of it.
const double kPeriod = 500 * kStep;
const auto kShaken = SubstrateMotion::oscillation({1e-4, 5e-5}, 1 / kPeriod, 0.4);
const auto kJerked = SubstrateMotion::table(
    {{10 * kStep, {0, 0}}, {200.5 * kStep, {1e-3, 0}}, {600 * kStep, {1e-3, -1e-3}}});

INSTANTIATE_TEST_SUITE_P(
    All, GrainLaws,
    testing::Values(
        Laws{"unlike", kLinear, ContactEnd::zero_overlap, true, true, {0, 0}, {}, true},
        Laws{"unlike_smooth", kLinear, ContactEnd::zero_overlap, false, true, {0, 0}, {}, true},
        Laws{"unlike_gas", kClamped, ContactEnd::zero_force, true, false, {0, 0}, {}, true},
        Laws{"unlike_shaken",
             HertzForce{kModulus},
             ContactEnd::zero_overlap,
             true,
             true,
             {0.3, 1},
             kShaken,
             true},
        Laws{"lifting", kLinear, ContactEnd::zero_overlap, true, true, {0, 0}, {}, false, true},
        Laws{
            "lifting_unlike", kClamped, ContactEnd::zero_force, true, true, {0, 0}, {}, true, true},
        Laws{"lifting_smooth",
             kLinear,
             ContactEnd::zero_overlap,
             false,
             true,
             {0, 0},
             {},
             false,
             true},
        Laws{
            "lifting_ice", kLinear, ContactEnd::zero_overlap, true, false, {0, 0}, {}, false, true},
        Laws{"lifting_shaken",
             HertzForce{kModulus},
             ContactEnd::zero_overlap,
             true,
             true,
             {0.3, 1},
             kShaken,
             true,
             true},
        Laws{"rolling",
             kLinear,
             ContactEnd::zero_overlap,
             true,
             true,
             {0, 0},
             {},
             false,
             false,
             0.02},
        Laws{"rolling_smooth",
             kLinear,
             ContactEnd::zero_overlap,
             false,
             true,
             {0, 0},
             {},
             false,
             false,
             0.2},
        Laws{"rolling_lifting",
             kClamped,
             ContactEnd::zero_force,
             true,
             true,
             {0, 0},
             {},
             true,
             true,
             0.02},
        Laws{"rolling_shaken",
             kLinear,
             ContactEnd::zero_overlap,
             true,
             true,
             {-1, 0.5},
             kShaken,
             true,
             true,
             0.02},
        Laws{"walls",
             kLinear,
             ContactEnd::zero_overlap,
             true,
             true,
             {0, 0},
             {},
             false,
             false,
             0,
             true},
        Laws{"walls_smooth",
             kLinear,
             ContactEnd::zero_overlap,
             false,
             false,
             {0, 0},
             {},
             false,
             false,
             0,
             true},
        Laws{"walls_lifting",
             kClamped,
             ContactEnd::zero_force,
             true,
             true,
             {0, 0},
             {},
             true,
             true,
             0,
             true},
        Laws{"walls_rolling",
             kLinear,
             ContactEnd::zero_overlap,
             true,
             true,
             {0, 0},
             {},
             true,
             true,
             0.02,
             true},
        Laws{"smooth", kLinear, ContactEnd::zero_overlap, false, false},
        Laws{"smooth_clamped", kClamped, ContactEnd::zero_force, false, false},
        Laws{"smooth_on_plane", kLinear, ContactEnd::zero_overlap, false, true},
        Laws{"rough", kLinear, ContactEnd::zero_overlap, true, false},
        Laws{"rough_on_plane", kLinear, ContactEnd::zero_overlap, true, true},
        Laws{"clamped_on_plane", kClamped, ContactEnd::zero_force, true, true},
        Laws{"hertz", HertzForce{kModulus}, ContactEnd::zero_overlap, true, false},
        Laws{"viscoelastic_on_plane", ViscoelasticForce{kModulus, 1e-6}, ContactEnd::zero_force,
             true, true},
        Laws{"compact", CompactViscoelasticForce{kModulus, 1e-6}, ContactEnd::zero_force, false,
             true},
        Laws{"tilted", kLinear, ContactEnd::zero_overlap, true, true, {0.3, -2}},
        Laws{"slippery_slope", kLinear, ContactEnd::zero_overlap, true, false, {3, 1}},
        Laws{"shaken", kClamped, ContactEnd::zero_force, true, true, {0, 0}, kShaken},
        Laws{"shaken_slope", kLinear, ContactEnd::zero_overlap, false, true, {-1, 0.5}, kShaken},
        Laws{"belt",
             kLinear,
             ContactEnd::zero_overlap,
             true,
             true,
             {0, 0},
             SubstrateMotion::constant({0.4, -0.2})},
        Laws{"jerked", kLinear, ContactEnd::zero_overlap, true, true, {0, 0}, kJerked}),
    name_of);

/// K's App. C: spheres that meet too slowly to slide part as heavier ones do, of (1+A)/A m. Static
/// friction holds them: what each has to bear, F/((1+A) m) with F = ω' v m' and A = 5/2, is twice
/// what kinetic friction could.
TEST(GrainSolver, SpheresThatStaticFrictionHoldsPartAsHeavierOnes) {
  constexpr double kA = 2.5, kG = 9.81, kMuK = 0.1, kMuS = 0.5;
  const double reduced = 0.5 * kMass, heavier = reduced * (1 + kA) / kA;
  const auto law =
      LinearContact::with_collision_time(reduced, 0.9, kCollisionTime, ContactEnd::zero_overlap);
  const LinearContact rolling(heavier, law.stiffness(), law.damping_rate() * reduced / heavier,
                              ContactEnd::zero_overlap);
  const double frequency = M_PI / rolling.collision_time();
  const double force = 2 * kMuK * kG * (1 + kA) * kMass;
  const double v = 0.5 * force / (heavier * frequency);  // of each
  ASSERT_LT(force, 0.5 * kMuS * kG * (1 + kA) * kMass);
  ContactScene scene =
      colliding(v, -v, 0.9, kCollisionTime, NoTangentialForce{}, kRadius + v * kStep);
  scene.hard.confined = true;
  ASSERT_EQ(grain_refusal(scene, scene.hard.initial), "");
  GrainSolver grains(scene, scene.hard.initial, kStep);
  grains.advance(static_cast<std::size_t>(1.2 * rolling.collision_time() / kStep) + 3);
  Frame after;
  grains.show(after);
  ASSERT_EQ(grains.collisions(), 1u);
  // Second order in a step, (π/60)².
  EXPECT_NEAR(closing(after.bodies) / (-2 * v), rolling.restitution(), 0.01);
}

ContactScene periodic_gas(std::size_t n, double fraction, bool on_plane, double restitution) {
  ContactScene scene = with_contact(smooth_gas(n, fraction, {restitution, 0.0, -1.0}), {});
  SoftContact& contact = *scene.soft[0];
  contact = linear_contact(0.5, restitution, 1e-2, ContactEnd::zero_overlap);
  if (on_plane) {
    scene.hard.substrate[0].static_friction = scene.hard.substrate[0].kinetic_friction = 0.02;
    contact.tangential = ViscousForce{5, 0.3};
  }
  return scene;
}

struct Driven {
  std::string name;
  Vector2 downhill;  // [m/s²]
  SubstrateMotion motion;
  bool unlike = false;  // radii
  bool lifts = false;
  double rolling = 0;  // μ_r
  bool walls = false;
};

void PrintTo(const Driven& driven, std::ostream* out) { *out << driven.name; }

class GrainsOn : public testing::TestWithParam<Driven> {};

/// Few meet, so that they glide in blocks: some slide, others roll and are held, all the time or
/// but for the largest accelerations of the plane.
TEST_P(GrainsOn, GlideAsStepSolverDoes) {
  constexpr double kMu = 0.5;
  ContactScene scene = periodic_gas(300, GetParam().unlike ? 0.5 : 0.3, true, 0.9);
  Scene& hard = scene.hard;
  hard.downhill = GetParam().downhill;
  hard.motion = GetParam().motion;
  const double mu = GetParam().walls ? 0.05 : kMu;  // so that more come to them
  hard.substrate[0].static_friction = 1.2 * mu;
  hard.substrate[0].kinetic_friction = mu;
  if (GetParam().unlike) make_unlike(hard);
  if (GetParam().lifts) make_lifting(hard, 0.5);
  add_rolling(hard, GetParam().rolling);
  const Vector2 length = hard.periodic;
  if (GetParam().walls) {  // close around
    Vector2 least = length, most = Vector2::Zero();
    for (const BodyState& state : hard.initial) {
      least = least.cwiseMin(state.position.head<2>());
      most = most.cwiseMax(state.position.head<2>());
    }
    enclose(scene, least, most);
  }
  for (std::size_t i = 0; i < hard.initial.size(); i += 2) {  // as it rolls on the plane
    BodyState& state = hard.initial[i];
    const Vector2 v = state.velocity.head<2>() - hard.motion.velocity(0).head<2>();
    state.angular_velocity.head<2>() = Vector2(-v.y(), v.x()) / hard.bodies[i].radius;
  }
  constexpr std::size_t kCounts[] = {1, 10, 100, 1000, 1000};
  EXPECT_GT(expect_steps_of_step_solver(scene, length.x(), 2e-4, kCounts), 10u);
}

INSTANTIATE_TEST_SUITE_P(
    All, GrainsOn,
    testing::Values(
        Driven{"still", {0, 0}, {}}, Driven{"unlike", {0, 0}, {}, true},
        Driven{"unlike_shaken", {0.5, 0}, SubstrateMotion::oscillation({0.1, 0.05}, 2, 0.4), true},
        Driven{"lifting", {0, 0}, {}, false, true},
        Driven{"lifting_unlike", {0, 0}, {}, true, true},
        Driven{"lifting_slope", {1, 0.4}, {}, false, true},
        Driven{"lifting_shaken",
               {0, 0},
               SubstrateMotion::oscillation({0.1, 0.05}, 2, 0.4),
               true,
               true},
        Driven{"rolling", {0, 0}, {}, false, false, 0.005},
        Driven{"rolling_lifting", {0, 0}, {}, true, true, 0.05},
        Driven{"rolling_shaken",
               {0.5, 0},
               SubstrateMotion::oscillation({0.1, 0.05}, 2, 0.4),
               true,
               false,
               0.02},
        Driven{"walls", {0, 0}, {}, false, false, 0, true},
        Driven{"walls_lifting", {0, 0}, {}, true, true, 0.005, true}, Driven{"slope", {1, 0.4}, {}},
        Driven{"steep", {3, -20}, {}},
        Driven{"shaken", {0, 0}, SubstrateMotion::oscillation({0.1, 0.05}, 2, 0.4)},
        Driven{"fast", {0.5, 0}, SubstrateMotion::oscillation({0.02, 0.02}, 8, 1)},
        Driven{"belt", {0, 0}, SubstrateMotion::constant({2, -0.3})},
        Driven{"jerked",
               {0, 0.2},
               SubstrateMotion::table({{0.05, {0, 0}}, {0.1, {0.05, 0}}, {0.31, {0.05, 0.4}}})}),
    [](const auto& each) { return each.param.name; });

/// Contacts of several groups of islands are open from one block to the next.
TEST(GrainSolver, ContactsOfManyIslandsGoOn) {
  const ContactScene scene = periodic_gas(1000, 0.65, true, 0.9);
  constexpr std::size_t kCounts[] = {1, 400, 20, 20, 20, 20};
  EXPECT_GT(expect_steps_of_step_solver(scene, scene.hard.periodic.x(), 2e-4, kCounts), 100u);
}

/// What happens does not depend on where the cell's edges lie. Shifting all positions changes their
/// rounding, and each of the one or two collisions of a grain multiplies that by about 10.
TEST(GrainSolver, EdgesOfThePeriodicCellAreNowhere) {
  ContactScene scene = periodic_gas(300, 0.3, true, 0.9);
  const Vector3 shift(0.37 * scene.hard.periodic.x(), 0.71 * scene.hard.periodic.y(), 0);
  std::vector<BodyState> shifted = scene.hard.initial;
  for (BodyState& state : shifted) state.position += shift;
  GrainSolver here(scene, scene.hard.initial, 2e-4), there(scene, shifted, 2e-4);
  here.advance(5000);
  there.advance(5000);
  EXPECT_GT(here.collisions(), 100u);
  EXPECT_EQ(here.collisions(), there.collisions());
  Frame a, b;
  here.show(a);
  there.show(b);
  for (BodyState& state : b.bodies) state.position -= shift;
  EXPECT_LT(largest_difference(a.bodies, b.bodies) * kRadius, 1e-10);
}

/// Without friction of any kind nothing acts on spins, wherever grains have come to lie in memory.
TEST(GrainSolver, SpinsOfSmoothGrainsStay) {
  ContactScene scene = periodic_gas(300, 0.3, false, 0.9);
  for (std::optional<SoftContact>& contact : scene.soft) contact->tangential = NoTangentialForce{};
  for (std::size_t i = 0; i < scene.hard.initial.size(); ++i) {
    const auto k = static_cast<double>(i);
    scene.hard.initial[i].angular_velocity = {1 + k, 2 - k, 3 + 2 * k};
  }
  ASSERT_EQ(grain_refusal(scene, scene.hard.initial), "");
  GrainSolver solver(scene, scene.hard.initial, 2e-4);
  solver.advance(5000);
  EXPECT_GT(solver.collisions(), 100u);
  Frame frame;
  solver.show(frame);
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    EXPECT_EQ(frame.bodies[i].angular_velocity, scene.hard.initial[i].angular_velocity) << i;
}

/// The solver leaves out of a block's steps what meets none if all go straight on. So a blow has to
/// find its way through grains of which none but the first two would have met; here all lie within
/// what that first one flies in a block, side by side and off the line. A pair alone parts as well,
/// in a step that may be the first of a block. Idle grains make blocks long.
TEST(GrainSolver, ABlowReachesGrainsThatNoneWouldHaveMet) {
  constexpr double kSpeed = 0.2;
  constexpr std::size_t kRow = 6, kAll = 3000, kSteps = 1000;
  ContactScene scene = colliding(kSpeed, 0, 0.9, kCollisionTime, NoTangentialForce{}, kRadius);
  scene.hard = steel_scene(kRow + 2);
  scene.hard.confined = true;
  std::vector<BodyState>& initial = scene.hard.initial;
  for (std::size_t k = 1; k < kRow; ++k)
    initial[k] =
        rolling_at(2.0001 * kRadius * static_cast<double>(k), 0.02 * kRadius * (k % 2), 0, 0);
  initial[0] = rolling_at(-30 * kSpeed * kStep, 0, kSpeed, 0);
  initial[kRow] = rolling_at(0, 6 * kRadius, kSpeed, 0);
  initial[kRow + 1] = rolling_at(2.01 * kRadius, 6 * kRadius, -kSpeed, 0);
  StepSolver steps(scene, initial, {kStep});
  ASSERT_EQ(steps.run(until_time(kSteps * kStep), nullptr).steps, kSteps);

  ContactScene many = scene;
  many.hard.bodies.resize(kAll, scene.hard.bodies[0]);
  many.hard.material.resize(kAll, 0);
  for (std::size_t k = kRow + 2; k < kAll; ++k)
    many.hard.initial.push_back(rolling_at(4 * kRadius * static_cast<double>(k % 50),
                                           4 * kRadius * static_cast<double>(5 + k / 50), 0, 0));
  ASSERT_EQ(grain_refusal(many, many.hard.initial), "");
  for (const std::size_t at_once : {std::size_t{1}, kSteps}) {
    GrainSolver grains(many, many.hard.initial, kStep);
    for (std::size_t n = 0; n < kSteps; n += at_once) grains.advance(at_once);
    Frame frame;
    grains.show(frame);
    frame.bodies.resize(kRow + 2);
    EXPECT_GE(grains.collisions(), kRow);
    EXPECT_GT(frame.bodies[kRow - 1].velocity.x(), 0.1 * kSpeed);
    EXPECT_LT(frame.bodies[kRow].velocity.x(), 0);
    // A thousand roundings, each of which five collisions multiply.
    EXPECT_LT(largest_difference(frame.bodies, steps.states()), 1e-9) << at_once;
  }
}

/// Two that come to touch within the 51st step, though they do not straight on, and part as
/// StepSolver has them.
void expect_meeting_in_a_block(const ContactScene& scene) {
  ASSERT_EQ(grain_refusal(scene, scene.hard.initial), "");
  GrainSolver grains(scene, scene.hard.initial, kStep);
  StepSolver steps(scene, scene.hard.initial, {.step = kStep, .general = true});
  grains.advance(1);
  grains.advance(50);  // one block
  ASSERT_EQ(steps.run(until_time(51 * kStep), nullptr).steps, 51u);
  Frame frame;
  grains.show(frame);
  EXPECT_EQ(grains.collisions(), 1u);
  EXPECT_LT(largest_difference(frame.bodies, steps.states()), 1e-12);
}

/// Nor do those meet straight on that friction accelerates: two that spin at rest come together by
/// μ_k g t² within a block.
TEST(GrainSolver, FrictionDrivesGrainsTogetherWithinABlock) {
  constexpr double kMuG = 0.1 * 9.81;
  const double after = 40 * kStep;
  ContactScene scene = colliding(0, 0, 0.9, kCollisionTime, NoTangentialForce{},
                                 kRadius + 0.5 * kMuG * after * after);
  scene.hard.confined = true;
  for (std::size_t k = 0; k < 2; ++k)
    scene.hard.initial[k].angular_velocity.y() = k == 0 ? 99 : -99;
  expect_meeting_in_a_block(scene);
}

/// Nor those that rolling friction does: one before which it brakes.
TEST(GrainSolver, RollingFrictionDrivesGrainsTogetherWithinABlock) {
  constexpr double kMuG = 0.5 * 9.81;
  const double after = 40 * kStep;
  ContactScene scene = colliding(0.3, 0.3, 0.9, kCollisionTime, NoTangentialForce{},
                                 kRadius + 0.25 * kMuG * after * after);
  scene.hard.confined = true;
  scene.hard.substrate[0].kinetic_friction = 0.01;
  scene.hard.substrate.push_back(scene.hard.substrate[0]);
  scene.hard.substrate[1].rolling = RollingFriction(0.5);
  scene.hard.material = {0, 1};
  scene.hard.pairs.resize(4, scene.hard.pairs[0]);
  scene.soft.resize(4, scene.soft[0]);
  expect_meeting_in_a_block(scene);
}

/// Nor those that a landing does: one that spins and comes down after ten steps gets 0.1 m/s.
TEST(GrainSolver, ALandingDrivesGrainsTogetherWithinABlock) {
  constexpr double kFall = 1, kMu = 0.1;
  ContactScene scene = colliding(0, 0, 0.9, kCollisionTime, NoTangentialForce{},
                                 kRadius + 0.5 * kMu * kFall * 30 * kStep);
  BodyState& falls = scene.hard.initial[0];
  falls.position.z() = kRadius + 10 * kFall * kStep;
  falls.velocity.z() = -kFall;
  falls.angular_velocity.y() = 990;
  expect_meeting_in_a_block(scene);
}

/// Nor those before which one lands that rolls, as rolling friction brakes it by up to 0.5 m/s.
TEST(GrainSolver, ALandingThatRollsBrakesAGrainWithinABlock) {
  constexpr double kFall = 1, kRoll = 0.5, kSpeed = 0.8;
  ContactScene scene = colliding(kSpeed, kSpeed, 0.9, kCollisionTime, NoTangentialForce{},
                                 kRadius + 0.5 * kRoll * kFall * 30 * kStep);
  scene.hard.substrate[0].kinetic_friction = 0.01;
  scene.hard.substrate[0].rolling = RollingFriction(kRoll);
  BodyState& falls = scene.hard.initial[1];
  falls.position.z() = kRadius + 10 * kFall * kStep;
  falls.velocity.z() = -kFall;
  expect_meeting_in_a_block(scene);
}

/// Nor those that a slope drives: a solid sphere that rolls behind a hollow one. Static friction
/// alone does it, as both are held.
TEST(GrainSolver, ASlopeDrivesGrainsTogetherWithinABlock) {
  constexpr double kDownhill = 10, kSolid = 5.0 / 7, kHollow = 3.0 / 5;  // 1/(1+q)
  const double after = 40 * kStep;
  ContactScene scene = colliding(0, 0, 0.9, kCollisionTime, NoTangentialForce{},
                                 kRadius + 0.25 * (kSolid - kHollow) * kDownhill * after * after);
  scene.hard.confined = true;
  scene.hard.substrate[0].kinetic_friction = 0;
  scene.hard.substrate[0].static_friction = 0.6;
  const bool first_is_left =
      scene.hard.initial[0].position.x() < scene.hard.initial[1].position.x();
  scene.hard.bodies[first_is_left ? 1 : 0].shape_factor = 2.0 / 3;
  scene.hard.downhill = {kDownhill, 0};
  expect_meeting_in_a_block(scene);
}

/// Two unlike grains that rub, with spins, cross the plane's edge one after the other, where they
/// are sorted anew, as a third one is so fast that the list does not last. The end of a contact,
/// here in any of the steps from there on, takes back what it did in the one before.
TEST(GrainSolver, AContactGoesOnWhereItsGrainsAreSortedAnew) {
  constexpr double kLength = 40 * kRadius, kSpeed = 3;
  Scene hard = steel_scene(3);
  hard.confined = true;
  hard.periodic = {kLength, kLength};
  hard.bodies[1].radius *= 0.5;
  hard.bodies[1].mass *= 0.125;
  const SoftContact contact = {kLinear, ContactEnd::zero_overlap,
                               ViscousForce{0.05 * kMass / kCollisionTime, 0.3}};
  const double x = kLength - kSpeed * 38 * kStep, reach = 2 * std::sqrt(0.5) * kRadius;
  for (int k = 0; k < 30; ++k) {
    const double apart = reach + (1 + k) * kStep;  // at 1 m/s
    hard.initial[0] = rolling_at(x - apart, 5 * kRadius, kSpeed + 1, 0);
    hard.initial[1] = rolling_at(x, 5.05 * kRadius, kSpeed, 0, 0.5 * kRadius);
    hard.initial[1].angular_velocity = {300, 100, -800};
    hard.initial[2] = rolling_at(0.5 * kLength, 30 * kRadius, -300, 0);
    const ContactScene scene = with_contact(hard, contact);
    constexpr std::size_t kCounts[] = {100};
    EXPECT_EQ(expect_steps_of_step_solver(scene, kLength, kStep, kCounts), 1u) << k;
  }
}

/// Forces between grains are equal and opposite, and without friction nothing else acts.
TEST(GrainSolver, KeepsMomentum) {
  const ContactScene scene = periodic_gas(1000, 0.6, false, 0.9);
  GrainSolver solver(scene, scene.hard.initial, 2e-4);
  Frame frame;
  const auto momentum = [&] {
    solver.show(frame);
    Vector3 sum = Vector3::Zero();
    for (const BodyState& state : frame.bodies) sum += state.velocity;
    return sum;
  };
  const Vector3 before = momentum();
  solver.advance(2000);
  EXPECT_GT(solver.collisions(), 1000u);
  // 1000 velocities of about 1, summed after some thousand roundings.
  EXPECT_LT((momentum() - before).norm(), 1e-11);
}

/// Elastic contacts give back what they took: between collisions the energy is what it was, but for
/// the error of a collision of 50 steps, of second order in the step and of either sign.
TEST(GrainSolver, ElasticGasKeepsItsEnergyInSecondOrder) {
  const ContactScene scene = periodic_gas(1000, 0.2, false, 1.0);
  const auto loss = [&](double step) {
    GrainSolver solver(scene, scene.hard.initial, step);
    Frame frame;
    const auto energy = [&] {
      solver.show(frame);
      double sum = 0;
      for (const BodyState& state : frame.bodies) sum += 0.5 * state.velocity.squaredNorm();
      for (const Touch& touch : frame.touches) {
        if (touch.second == kSubstrate) continue;
        const double force = touch.normal_impulse / step;
        sum += 0.5 * force * force / std::get<LinearForce>(scene.soft[0]->normal).stiffness;
      }
      return sum;
    };
    const double before = energy();
    solver.advance(static_cast<std::size_t>(std::round(1 / step)));
    EXPECT_GT(solver.collisions(), 100u);
    return std::abs(energy() / before - 1);
  };
  EXPECT_LT(loss(2e-4), 1e-4);
  EXPECT_LT(loss(5e-5), 1e-5);
}

/// Every instruction set does the same operations on each grain.
class GrainKernelsFor : public testing::TestWithParam<const char*> {};

TEST_P(GrainKernelsFor, SameBitsOnEveryInstructionSet) {
  ContactScene scene = periodic_gas(500, 0.6, true, 0.8);
  if (GetParam() == std::string("unlike")) make_unlike(scene.hard);
  if (GetParam() == std::string("lifting")) make_lifting(scene.hard, 0.5);
  if (GetParam() == std::string("rolling")) add_rolling(scene.hard, 0.02);
  if (GetParam() == std::string("walls")) {
    scene.hard.confined = false;
    enclose(scene, {0, 0}, scene.hard.periodic);
  }
  if (GetParam() == std::string("driven")) {
    scene.hard.downhill = {0.2, 0};
    scene.hard.motion = SubstrateMotion::oscillation({0.1, 0.2}, 1, 0);
  }
  std::vector<BodyState> first;
  for (const std::int64_t target : test::InstructionSet::all()) {
    const test::InstructionSet set(target);
    GrainSolver solver(scene, scene.hard.initial, 2e-4);
    solver.advance(1500);
    Frame frame;
    solver.show(frame);
    if (first.empty()) first = frame.bodies;
    EXPECT_EQ(largest_difference(first, frame.bodies), 0) << hwy::TargetName(target);
  }
}

INSTANTIATE_TEST_SUITE_P(All, GrainKernelsFor,
                         testing::Values("plain", "driven", "unlike", "lifting", "rolling",
                                         "walls"),
                         [](const auto& each) { return std::string(each.param); });

/// Beyond the limit of the linear contact, 2/ω0 = (2/π) t_col, energy grows until grains jump over
/// each other; that is told and does not go on for ever.
/// A block looks at all pairs, however short it is: a list is used up by none that is much shorter
/// than the others.
TEST(GrainSolver, BlocksUseUpTheListInEqualParts) {
  for (const std::size_t covered : {5, 13, 14, 27, 33, 100}) {  // steps
    constexpr double kFastest = 1, kFaster = 1.1;
    GrainBlocks blocks(kStep, 0, 0, false);
    blocks.took(10, 600, 100, {kFastest});
    // The thickest skin, 0.6 diameters: the ways of two in so many steps and a half.
    const double ways = 2 * kFaster * kFastest * kStep * (static_cast<double>(covered) + 0.5);
    blocks.renew(10, ways / 0.6, 1e-9);
    std::vector<std::size_t> lengths;
    while (const std::size_t length = blocks.next(1000, 10000, 10000, 100)) {
      lengths.push_back(length);
      blocks.took(length, 200 + 40 * length, 100, {kFastest});
    }
    EXPECT_EQ(std::accumulate(lengths.begin(), lengths.end(), std::size_t{0}), covered);
    const auto [least, most] = std::ranges::minmax(lengths);
    EXPECT_GE(2 * least, most) << covered;
    EXPECT_LE(most, 13u);  // √((10⁴ + 10⁴ + 40·200)/(4·40)), what costs least
  }
}

TEST(GrainSolver, StepsBeyondTheLimitOfStabilityEnd) {
  const ContactScene scene = periodic_gas(100, 0.6, false, 1.0);
  GrainSolver stable(scene, scene.hard.initial, 0.3 * 1e-2);
  stable.advance(5000);
  GrainSolver unstable(scene, scene.hard.initial, 1.3 * 2 / M_PI * 1e-2);
  EXPECT_THROW(unstable.advance(1'000'000), StepTooLong);
}

TEST(StepSolver, ARunInStepsThatAreTooLongHasFailed) {
  const ContactScene scene = periodic_gas(100, 0.6, false, 1.0);
  StepSolver solver(scene, scene.hard.initial, {.step = 1.3 * 2 / M_PI * 1e-2});
  const SolvedRun run = solver.run(until_time(1e4), nullptr);
  EXPECT_TRUE(run.failed);
  EXPECT_FALSE(run.reached);
  EXPECT_NE(run.reason.find("more than half a radius in a step"), std::string::npos) << run.reason;
}

TEST(GrainSolver, TellsWhatItDoesNotTake) {
  const auto refusal = [](auto change) {
    ContactScene scene = periodic_gas(9, 0.1, true, 0.9);
    change(scene);
    return grain_refusal(scene, scene.hard.initial);
  };
  EXPECT_EQ(refusal([](ContactScene&) {}), "");
  const auto expect = [&](const char* reason, auto change) {
    const std::string found = refusal(change);
    EXPECT_NE(found.find(reason), std::string::npos) << found;
  };
  expect("depends on the speed", [](ContactScene& s) {
    s.hard.substrate[0].rolling = RollingFriction({{0, 0.1}, {1, 0.2}});
  });
  expect("bodies that slide", [](ContactScene& s) {
    s.hard.substrate[0].rolling = RollingFriction(0.1);
    s.hard.substrate[0].rolling_while_sliding = true;
  });
  expect("share their friction", [](ContactScene& s) { s.hard.substrate[0].coupled_radius = 0.1; });
  expect("not all contacts", [](ContactScene& s) { s.soft[0].reset(); });
  expect("asperities", [](ContactScene& s) { s.soft[0]->tangential = AsperityForce{0.1, 1e-3}; });
  expect("above", [](ContactScene& s) { s.hard.initial[3].position.z() = 0.6; });
  expect("high", [](ContactScene& s) {
    s.hard.confined = false;
    s.hard.initial[3].position.z() = 5;
  });
}

}  // namespace
}  // namespace slipcheck
