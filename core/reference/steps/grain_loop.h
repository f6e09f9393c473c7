#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/steps/grain_solver.h"
#include "reference/steps/step_kernel.h"

namespace slipcheck {

/// The loop over the steps of many bodies in a plane: GrainSolver behind StepSolver.
class GrainLoop final : public StepKernel {
 public:
  /// The scene must outlive this and have no grain_refusal().
  GrainLoop(const ContactScene& scene, std::size_t threads) : scene_(&scene), threads_(threads) {}

  void find_forces(StepWorld& world) override;
  void advance(StepWorld& world, std::size_t steps, StepStop stop) override;
  bool is_met(const StepWorld& world, StepStop stop) const override;
  void show(const StepWorld& world, Frame& frame, bool with_touches) override;
  std::vector<std::string> features() const override;
  void exchange(StateArchive& archive, StepWorld& world) override;

 private:
  const ContactScene* scene_;
  std::size_t threads_;
  std::optional<GrainSolver> solver_;  ///< from the bodies of the first StepWorld seen
};

}  // namespace slipcheck
