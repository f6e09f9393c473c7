#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "base/state_archive.h"
#include "physics/frame.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Many soft spheres on a plane, by StepSolver's steps: K's monolayer on a substrate, maybe tilted
/// or moving, from which grains may lift each other off, or a gas on a plane without friction.
/// Periodic or not, or between walls.
///
/// Time goes in blocks of steps. Grains that can meet none within a block do it in one go; those
/// that can are sorted into islands, which do all its steps one after the other in the nearest
/// cache. The length of a block follows from counts, not from clocks: the same scene gives the same
/// bits on every machine. Against StepSolver only the order of sums differs.
class GrainSolver {
 public:
  /// The machine's that the loop is compiled for: "AVX3".
  static std::string instruction_set();

  /// The scene must outlive the solver and have no grain_refusal(). step: h [s], > 0; threads: that
  /// share its islands, 0: one for each core; any number gives the same bits. slowest_rebound: a
  /// landing that would rebound slower does not [m/s], >= 0; nor does one slower than what gravity
  /// adds in a step.
  GrainSolver(const ContactScene& scene, std::span<const BodyState> initial, double step,
              std::size_t threads = 1, double slowest_rebound = 0);
  ~GrainSolver();
  GrainSolver(GrainSolver&&) noexcept;

  /// Throws StepTooLong where a grain moves by more than half the smallest radius in a
  /// step, or comes over a wall.
  void advance(std::size_t steps);

  double now() const;              ///< [s]
  std::size_t steps() const;       ///< since time 0
  std::size_t collisions() const;  ///< contacts of two bodies that began
  std::size_t touching() const;    ///< pairs in contact
  /// Whether no grain slips on the substrate; and nothing moves, where `rests` is asked.
  bool all_stick(bool rests) const;
  /// The world now, and what touched in the step around it.
  void show(Frame& frame);
  /// What it goes on with.
  void exchange(StateArchive& archive);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
