#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "../../bench/grain_gas.h"
#include "../../bench/soft_bed.h"
#include "reference/piles/pile_solver.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

/// The process ends here.
struct Killed {};

/// Sums up all that is shown.
class HashSink final : public FrameSink {
 public:
  void take(double time, const Frame& frame) override {
    add(time);
    for (const BodyState& state : frame.bodies)
      for (const Vector3* v : {&state.position, &state.velocity, &state.angular_velocity})
        for (int k = 0; k < 3; ++k) add((*v)[k]);
    for (const Touch& touch : frame.touches) {
      add(touch.first);
      add(touch.second);
      add(touch.normal_impulse);
    }
    ++frames;
    touches += frame.touches.size();
  }
  void exchange(StateArchive& archive) { archive(hash, frames, touches); }

  std::uint64_t hash = 14695981039346656037u;
  std::size_t frames = 0, touches = 0;

 private:
  void add(double value) { hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u; }
};

struct Seen {
  HashSink sink;
  SolvedRun run;
  std::size_t processes = 1;
};

/// A run that is killed some frames after every so many, and goes on in another solver from what it
/// kept: what it did after that is done anew.
template <class Make>
Seen run_in_pieces(const Make& make, const RunEnd& end, std::size_t frames_a_piece) {
  Seen seen;
  std::string kept;
  while (true) {
    const std::unique_ptr<KeptSolver> solver = make();
    HashSink sink;
    if (!kept.empty()) {
      StateArchive archive{std::string_view(kept)};
      archive(sink, *solver);
      archive.finish();
    }
    std::size_t frames = 0;
    solver->set_between_frames([&] {
      if (++frames == frames_a_piece) {
        StateArchive archive;
        archive(sink, *solver);
        kept = archive.take();
      }
      if (frames == frames_a_piece + 5) throw Killed{};
    });
    try {
      seen.run = solver->run(end, &sink);
      seen.sink = sink;
      return seen;
    } catch (const Killed&) {
      ++seen.processes;
    }
  }
}

template <class Make>
void expect_same(const Make& make, const RunEnd& end, std::size_t frames_a_piece) {
  Seen whole;
  whole.run = make()->run(end, &whole.sink);
  EXPECT_TRUE(whole.run.reached) << whole.run.reason;
  EXPECT_GT(whole.run.collisions, 20u);
  EXPECT_GT(whole.sink.touches, 0u);
  const Seen pieces = run_in_pieces(make, end, frames_a_piece);
  EXPECT_GE(pieces.processes, 3u);
  EXPECT_EQ(pieces.sink.frames, whole.sink.frames);
  EXPECT_EQ(pieces.sink.hash, whole.sink.hash);
  EXPECT_EQ(pieces.run.collisions, whole.run.collisions);
  EXPECT_EQ(pieces.run.end_time, whole.run.end_time);
  if (whole.run.balance) {
    EXPECT_EQ(pieces.run.balance->dissipated, whole.run.balance->dissipated);
    EXPECT_EQ(pieces.run.balance->error(), whole.run.balance->error());
  }
}

/// Contacts that remember: few bodies in the scene's order, and many in slabs, sorted.
TEST(KeptSolver, GoesOnWithThePileThatItWas) {
  const ContactScene scene = bench::soft_bed({.count = 300, .ratio = 2});
  for (const std::size_t ordered_from : {std::size_t{2000}, std::size_t{200}}) {
    const PileSettings settings{.steps_per_contact = 20,
                                .collision_time = 2e-4,
                                .steps_per_frame = 3,
                                .ordered_from = ordered_from};
    const auto make = [&] {
      return std::make_unique<PileSolver>(scene, scene.hard.initial, settings);
    };
    expect_same(make, until_time(2500 * make()->step()), 170);
  }
}

/// Several slabs around a period: which of them the last one is beside is kept.
TEST(KeptSolver, GoesOnWithSlabsAroundAPeriod) {
  const ContactScene scene =
      bench::soft_bed({.count = 1600, .ratio = 2, .length = 60, .walls = false});
  const auto make = [&] {
    return std::make_unique<PileSolver>(scene, scene.hard.initial,
                                        PileSettings{.steps_per_contact = 20,
                                                     .collision_time = 2e-4,
                                                     .steps_per_frame = 9,
                                                     .ordered_from = 1});
  };
  expect_same(make, until_time(900 * make()->step()), 31);
}

/// A scene that is loaded before its start is not loaded again.
TEST(KeptSolver, GoesOnWithAPileThatWasPrepared) {
  ContactScene scene = bench::soft_bed({.count = 40, .gap = 1.0});
  for (BodyState& state : scene.hard.initial) {
    state.velocity.setZero();
    state.position.z() -= 5e-3;
  }
  std::size_t made = 0;
  const auto make = [&] {
    return std::make_unique<PileSolver>(scene, scene.hard.initial,
                                        PileSettings{.steps_per_frame = 2, .prepare = made++ == 0});
  };
  HashSink sink;
  PileSolver first(scene, scene.hard.initial, {.steps_per_frame = 2});
  ASSERT_NE(first.features().back().find("weights put on"), std::string::npos);
  const RunEnd end = until_time(200 * first.step());
  const SolvedRun whole = first.run(end, &sink);
  const Seen pieces = run_in_pieces(make, end, 30);
  EXPECT_GE(pieces.processes, 3u);
  EXPECT_EQ(pieces.sink.hash, sink.hash);
  EXPECT_EQ(pieces.run.balance->energy, whole.balance->energy);
}

/// Neighbours of unlike radii without memory, and grains in islands.
TEST(KeptSolver, GoesOnWithTheStepsThatItWas) {
  ContactScene bed = bench::soft_bed({.count = 120, .ratio = 2, .walls = false});
  bed.soft[0]->memory.reset();
  bed.soft[0]->tangential = ViscousForce{0.05, 0.3};
  const ContactScene grains = bench::grain_gas(600, 0.6, true);
  const auto in = [](const ContactScene& scene, double step) {
    return [&scene, step] {
      return std::make_unique<StepSolver>(scene, scene.hard.initial, StepSettings{.step = step});
    };
  };
  expect_same(in(bed, 2e-5), until_time(0.03), 400);
  expect_same(in(grains, bench::kStep), until_time(600 * bench::kStep), 170);
}

TEST(KeptSolver, RefusesBytesThatAreNoState) {
  const ContactScene scene = bench::soft_bed({.count = 40});
  PileSolver solver(scene, scene.hard.initial);
  StateArchive kept;
  kept(solver);
  const std::string state = kept.take();
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{9}, state.size() / 2, state.size() - 1}) {
    PileSolver other(scene, scene.hard.initial);
    StateArchive archive{std::string_view(state).substr(0, length)};
    EXPECT_THROW(archive(other), BadState) << length;
  }
  StateArchive longer{std::string_view(state)};
  std::size_t some = 0;
  longer(some);
  EXPECT_THROW(longer.finish(), BadState);
}

}  // namespace
}  // namespace slipcheck
