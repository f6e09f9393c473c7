#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "../scenes.h"
#include "../support/refusal.h"
#include "engine/lacks.h"
#include "lammps_bare.h"
#include "peer_run.h"
#include "worker_run.h"

namespace slipcheck {
namespace {

constexpr double kRate = 240;

std::string executable() { return test::peer_executable("lammps"); }

// --- the same as a bare input file ---------------------------------------------------------------

/// The states after each of so many steps.
std::vector<std::vector<BodyState>> bare(const Scene& scene, const Applied& applied,
                                         const std::string& pair, int steps) {
  const double k = number(applied, "substrate_stiffness"), c = number(applied, "substrate_damping");
  const double tangential = number(applied, "substrate_tangential_damping");
  const int inner = static_cast<int>(number(applied, "substeps"));
  const std::string in =
      test::bare_atoms(scene, {{-1, -1, -1}, {1, 1, 1}}) + pair +
      "neighbor 0.0005 nsq\nneigh_modify delay 0 every 1 check yes\n"
      "fix 1 all nve/sphere\nfix 2 all gravity 9.81 vector 0 0 -1\n" +
      fmt::format(
          "fix 3 all wall/gran granular hooke {:.17g} {:.17g} damping velocity tangential "
          "linear_nohistory {:.17g} {:.17g} limit_damping zplane 0 NULL\n",
          k, c, tangential / c, scene.substrate[0].kinetic_friction);
  auto frames = test::bare_lammps(in, 1 / kRate / inner, steps * inner, inner, scene.bodies.size());
  frames.erase(frames.begin());  // the start
  return frames;
}

void expect_same_bits(const Scene& scene, const std::string& pair, int steps) {
  RemoteEngine engine(executable(), test::kPatient);
  const Applied applied = engine.configure(scene, {}, 1 / kRate);
  const auto frames = test::peer_run(engine, scene, {}, 1 / kRate, static_cast<std::size_t>(steps));
  const auto expected = bare(scene, applied, pair, steps);
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t n = 0; n < frames.size(); ++n) {
    ASSERT_EQ(expected[n].size(), frames[n].bodies.size());
    ASSERT_EQ(std::memcmp(frames[n].bodies.data(), expected[n].data(),
                          expected[n].size() * sizeof(BodyState)),
              0)
        << "frame " << n;
  }
}

TEST(Lammps, NumbersAreThoseOfABareInputFile) {
  const Scene slide = test::slide_to_roll();
  const std::string any_pair = "pair_style gran/hooke 1e5 NULL 0 0 0 1\npair_coeff * *\n";
  expect_same_bits(slide, any_pair, 240);
  const Scene bounce = test::bouncing_ball();
  expect_same_bits(bounce, any_pair, 240);

  const Scene pair = test::head_on(0.15, -0.15, 0.9, 0.0095);
  RemoteEngine engine(executable(), test::kPatient);
  const Applied applied = engine.configure(pair, {}, 1 / kRate);
  const double mass = pair.bodies[0].mass;
  const std::string hooke = fmt::format(
      "pair_style gran/hooke {:.17g} NULL {:.17g} {:.17g} 0 1 limit_damping\n"
      "pair_coeff * *\n",
      number(applied, "pair_stiffness"), number(applied, "pair_damping") / (mass / 2),
      number(applied, "pair_tangential_damping") / (mass / 2));
  expect_same_bits(pair, hooke, 240);
}

TEST(Lammps, SpringsHaveTheRestitutionAndTheTime) {
  RemoteEngine engine(executable(), test::kPatient);
  const Scene scene = test::bouncing_ball();
  const Applied applied = engine.configure(scene, {}, 1 / kRate);
  // k of an elastic collision of 0.1 ms, and e = exp(−c τ/m) where the force ends, at 2 τ.
  const double m = scene.bodies[0].mass, k = m * M_PI * M_PI / (1e-4 * 1e-4);
  EXPECT_NEAR(number(applied, "substrate_stiffness") / k, 1, 1e-13);
  const double half_rate = number(applied, "substrate_damping") / (2 * m);
  const double omega = std::sqrt(k / m - half_rate * half_rate);
  const double tau = std::atan2(omega, half_rate) / omega;
  EXPECT_NEAR(std::exp(-2 * half_rate * tau), 0.8, 1e-12);
  EXPECT_EQ(number(applied, "substeps"), 2084);  // 50/(240 · 1e-4 s), rounded up
}

// --- maps ----------------------------------------------------------------------------------------

TEST(Lammps, ABallSlidesIntoRolling) {
  const Scene scene = test::slide_to_roll();
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, {}, 1e-3, 120);
  // t = 2 v/(7 μ g); the spring takes a few t_col to carry the weight, 0.1 ms each.
  EXPECT_NEAR(test::sliding_end(frames, 0.005, 1e-3), 2 * 0.5 / (7 * 0.2 * 9.81), 2e-4);
  EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 5.0 / 7 * 0.5, 1e-9);
  ASSERT_EQ(frames.back().touches.size(), 1u);
  EXPECT_EQ(frames.back().touches[0].second, kSubstrate);
  EXPECT_NEAR(frames.back().touches[0].normal_impulse, scene.bodies[0].mass * 9.81e-3, 1e-9);
}

TEST(Lammps, ABallReboundsWithItsRestitution) {
  const Scene scene = test::bouncing_ball();
  RemoteEngine engine(executable(), test::kPatient);
  // A step of t_col/50 leaves 2 |ln e|/50 · ½ of the jump in the force out at most.
  EXPECT_NEAR(test::rebound(test::peer_run(engine, scene, {}, 1e-3, 150), scene), 0.8, 8e-3);
  const Settings fine = {{"collision_time", 2e-5}, {"steps_per_collision", 400.0}};
  EXPECT_NEAR(test::rebound(test::peer_run(engine, scene, fine, 1e-3, 150), scene), 0.8, 1e-3);
}

/// Friction has taken μ of the substrate's impulse from a ball that fell and slides, and that
/// impulse is m (v_z + g t), however often it came down. A force that attracts counts twice there.
TEST(Lammps, ALandingBrakesASlideByItsImpulse) {
  Scene scene = test::bouncing_ball();
  const double mu = 0.2, time = 0.06;
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = mu;
  scene.initial[0].position.z() = scene.bodies[0].radius + 0.002;
  RemoteEngine engine(executable(), test::kPatient);
  for (const double e : {0.0, 0.5, 0.8}) {
    scene.substrate[0].restitution = e;
    scene.initial[0].velocity = {1, 0, 0};
    const auto error = [&](const char* sticking_by) {
      const Settings settings = {{"sticking_by", std::string(sticking_by)}};
      const Vector3 v = test::peer_run(engine, scene, settings, 1e-3, 60).back().bodies[0].velocity;
      return (1 - v.x()) / (mu * (v.z() + 9.81 * time)) - 1;
    };
    EXPECT_NEAR(error("damping"), 0, 1e-9) << e;  // the cap is reached at once
    EXPECT_NEAR(error("spring"), 0, 0.01) << e;   // a spring has to be loaded first
  }
}

TEST(Lammps, RollingFrictionSlowsByItsCoefficient) {
  const Scene scene = test::roll_to_rest();
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, {}, 1e-3, 1000);
  const Vector3 v = frames.back().bodies[0].velocity;
  EXPECT_NEAR((0.5 - v.norm()) / (0.02 * 9.81 * 1.0), 1, 1e-4);
  EXPECT_NEAR(std::atan2(v.y(), v.x()), std::atan2(0.25, 0.4330127018922193), 1e-9);
  // People type the coefficient as it stands; LAMMPS's torque is that of a lever R.
  const auto naive =
      test::peer_run(engine, scene, {{"coefficients", std::string("fields")}}, 1e-3, 1000);
  EXPECT_NEAR((0.5 - naive.back().bodies[0].velocity.norm()) / (0.02 * 9.81 * 1.0), 5.0 / 7, 1e-3);
}

TEST(Lammps, DrillingFrictionSlowsTheSpin) {
  Scene scene = test::slide_to_roll();
  scene.initial[0].velocity.setZero();
  scene.initial[0].angular_velocity = {0, 0, 50};
  scene.substrate[0].drilling_length = 2e-5;
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, {}, 1e-3, 500);
  // I dΩ/dt = −length m g.
  const double rate = 2e-5 * 9.81 / (0.4 * 0.005 * 0.005);
  EXPECT_NEAR((50 - frames.back().bodies[0].angular_velocity.z()) / (rate * 0.5), 1, 1e-3);
}

TEST(Lammps, ABeltCarriesABallAsAStillPlaneBrakesIt) {
  Scene still = test::slide_to_roll(), belt = still;
  belt.motion = SubstrateMotion::constant({0.2, 0.1});
  belt.initial[0].velocity += Vector3(0.2, 0.1, 0);
  RemoteEngine engine(executable(), test::kPatient);
  const auto a = test::peer_run(engine, still, {}, 1e-3, 50);
  const auto b = test::peer_run(engine, belt, {}, 1e-3, 50);
  const Vector3 way = 0.05 * Vector3(0.2, 0.1, 0);
  EXPECT_LT((b.back().bodies[0].position - a.back().bodies[0].position - way).norm(), 1e-12);
}

TEST(Lammps, ABallCrossesTheEdgeOfAPeriodicPlane) {
  Scene scene = test::slide_to_roll();
  scene.substrate[0].kinetic_friction = scene.substrate[0].static_friction = 0;
  scene.periodic = {0.05, 0.05};
  scene.initial[0].position.x() = 0.04;
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, {}, 1e-3, 100);
  EXPECT_NEAR(frames.back().bodies[0].position.x(), 0.09, 1e-12);
}

TEST(Lammps, StatesInsideAStepAreThoseOfShorterSteps) {
  const Scene scene = test::bouncing_ball();
  RemoteEngine engine(executable(), test::kPatient);
  const Settings inner = {{"substeps", 2000.0}}, outer = {{"substeps", 500.0}};
  const auto shown = test::peer_run(engine, scene, test::with(inner, {{"frames", 4.0}}), 4e-3, 40);
  const auto apart = test::peer_run(engine, scene, outer, 1e-3, 160);
  // Those in the middle of the impact, which takes a tenth of a millisecond, are left out.
  EXPECT_GE(shown.size(), 159u);
  std::size_t n = 0;
  for (const Frame& frame : shown) {
    while (n < apart.size() && apart[n].bodies[0].position != frame.bodies[0].position) ++n;
    ASSERT_LT(n, apart.size());
    EXPECT_EQ(frame.part, n % 4 == 3 ? 1.0 : static_cast<double>(n % 4 + 1) / 4);
  }
}

TEST(Lammps, EveryStartIsTheSame) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  RemoteEngine engine(executable(), test::kPatient);
  const auto first = test::peer_run(engine, scene, {}, 1 / kRate, 30);
  std::vector<Frame> second;
  engine.start(scene.initial);
  engine.advance(30, [&](const Frame& frame) { second.push_back(frame); });
  for (std::size_t n = 0; n < first.size(); ++n)
    ASSERT_EQ(std::memcmp(first[n].bodies.data(), second[n].bodies.data(), 2 * 72), 0);
}

TEST(Lammps, TwoRanksGiveTheSame) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  RemoteEngine engine(executable(), test::kPatient);
  const auto one = test::peer_run(engine, scene, {}, 1 / kRate, 30);
  const auto two = test::peer_run(engine, scene, {{"ranks", 2.0}}, 1 / kRate, 30);
  for (std::size_t n = 0; n < one.size(); ++n)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LT((one[n].bodies[i].velocity - two[n].bodies[i].velocity).norm(), 1e-12);
}

/// Open MPI's directory that all of a user's programs share is gone for one that begins when the
/// last of the others ends. So none is in it, and nothing is left.
TEST(Lammps, SharesNoDirectoryWithOthers) {
  namespace fs = std::filesystem;
  const fs::path directory = fs::temp_directory_path() / fmt::format("lammps-{}", getpid());
  fs::create_directory(directory);
  // As the worker will see it.
  const char* const before = std::getenv("TMPDIR");
  const std::string restored = before ? before : "";
  setenv("TMPDIR", directory.c_str(), 1);
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  const auto run_two = [&] {
    RemoteEngine engine(executable(), test::kPatient);
    test::peer_run(engine, scene, {{"ranks", 2.0}}, 1 / kRate, 2);
  };
  run_two();
  // Who has not ended within a second is killed, and a busy machine may need more than that.
  for (int n = 0; n < 5 && !fs::is_empty(directory); ++n) {
    for (const auto& entry : fs::directory_iterator(directory)) fs::remove_all(entry.path());
    run_two();
  }
  EXPECT_TRUE(fs::is_empty(directory));
  RemoteEngine engine(executable(), test::kPatient);
  test::peer_run(engine, scene, {}, 1 / kRate, 2);
  EXPECT_TRUE(fs::is_empty(directory));
  test::peer_run(engine, scene, {{"ranks", 2.0}}, 1 / kRate, 2);
  EXPECT_FALSE(fs::is_empty(directory));
  for (const auto& entry : fs::directory_iterator(directory))
    EXPECT_TRUE(entry.path().filename().string().starts_with("slipcheck-lammps-")) << entry;
  test::peer_run(engine, scene, {}, 1 / kRate, 2);
  EXPECT_TRUE(fs::is_empty(directory));
  before ? setenv("TMPDIR", restored.c_str(), 1) : unsetenv("TMPDIR");
  fs::remove_all(directory);
}

TEST(Lammps, CpuTimeIsThatOfTheSteps) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  RemoteEngine engine(executable(), test::kPatient);
  engine.configure(scene, {}, 1 / kRate);
  const auto short_runs = engine.time_steps(scene.initial, 0, 10, 3);
  const auto long_runs = engine.time_steps(scene.initial, 0, 100, 3);
  // 2084 steps of LAMMPS's in each, a tenth of a microsecond and more.
  EXPECT_GT(short_runs[2], 10 * 2084 * 1e-7);
  EXPECT_GT(long_runs[2], 4 * short_runs[2]);
}

// --- what LAMMPS cannot --------------------------------------------------------------------------

TEST(Lammps, NeedsNoNetwork) {
  if (std::system("unshare --map-root-user --net true 2>/dev/null") != 0)
    GTEST_SKIP() << "this machine gives no network namespaces";
  const auto worker = std::filesystem::temp_directory_path() / fmt::format("lammps-{}", getpid());
  std::ofstream(worker) << "#!/bin/sh\nexec unshare --map-root-user --net '" << executable()
                        << "'\n";
  std::filesystem::permissions(worker, std::filesystem::perms::owner_all);
  {
    RemoteEngine engine(worker.string());
    EXPECT_NE(engine.info().version, "unknown");
    EXPECT_EQ(test::peer_run(engine, test::slide_to_roll(), {}, 1 / kRate, 2).size(), 2u);
  }
  std::filesystem::remove(worker);
}

TEST(Lammps, AShakenSubstrateCarriesABallThatRolls) {
  constexpr double kBegin = 0.03;
  const Scene scene = test::ball_on_shaker(kBegin);
  RemoteEngine engine(executable(), test::kPatient);
  const Applied applied = engine.configure(scene, {}, 1 / kRate);
  // Damping in place of sticking leaves the slip 2/7 m a_S/γ_t.
  const double slip = 2.0 / 7 * scene.bodies[0].mass * scene.motion.largest_acceleration() /
                      number(applied, "substrate_tangential_damping");
  ASSERT_LT(slip, 1e-3 * scene.motion.largest_speed());
  EXPECT_LT(test::shaker_error(engine, scene, kBegin, kRate), 2.0 / 7 * 1.1 * slip);
}

TEST(Lammps, RefusesWithTheReason) {
  RemoteEngine engine(executable(), test::kPatient);
  const auto refusal = [&](const EngineScene& scene, const Settings& settings = {}) {
    return test::refusal_of<Refused>([&] { engine.configure(scene, settings, 1e-3); });
  };
  Scene scene = test::slide_to_roll();
  scene.bodies[0].shape_factor = 2.0 / 3;
  EXPECT_TRUE(refusal(scene).starts_with("lammps: atoms of style sphere are solid"));
  scene = test::slide_to_roll();
  scene.motion = SubstrateMotion::table({{0, {0, 0}}, {1, {0.1, 0}}});
  EXPECT_EQ(refusal(scene), "lammps: a substrate that moves by a table, whose velocity jumps");
  EXPECT_TRUE(refusal(test::slide_to_roll(), {{"collision_time", 0.0}})
                  .starts_with("lammps: the scene has hard contacts"));
  EngineScene soft(test::head_on(0.15, -0.15, 0.9));
  soft.soft = SoftContacts{{SoftContact{PowerForce{1e9, 0, 1.4, 0.5}, ContactEnd::zero_overlap,
                                        NoTangentialForce{}, false}},
                           {}};
  EXPECT_EQ(refusal(soft), "lammps: it has no normal force with a power of the overlap to choose");
  soft.soft = SoftContacts{{SoftContact{ViscoelasticForce{1e9, 1e-6}, ContactEnd::zero_overlap,
                                        ViscousForce{1, 0.5}, false}},
                           {}};
  EXPECT_TRUE(refusal(soft).starts_with("lammps: its tangential damping goes with its normal one"));
}

TEST(Lammps, SaysWhatIsNotRepresented) {
  Scene scene = test::roll_to_rest();
  scene.substrate[0].static_friction = 0.5;
  RemoteEngine engine(executable(), test::kPatient);
  const auto texts = texts_of(engine.configure(scene, {}, 1e-3).not_represented);
  EXPECT_EQ(texts, (std::vector<std::string>{
                       "static friction (one coefficient, and damping below its limit)",
                       "rolling friction only while rolling (it acts while sliding too)",
                       "restitution below 0.01",
                       "contacts without duration (the substrate is a spring)"}));
}

}  // namespace
}  // namespace slipcheck
