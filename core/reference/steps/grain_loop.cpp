#include "reference/steps/grain_loop.h"

#include <vector>

#include "reference/steps/grain_scene.h"

namespace slipcheck {

void GrainLoop::find_forces(StepWorld& world) {
  if (!solver_) {
    std::vector<BodyState> states;
    states.reserve(world.bodies.size());
    for (const StepBody& body : world.bodies)
      states.push_back({body.position, body.velocity, body.angular_velocity});
    std::vector<StepBody>().swap(world.bodies);  // before there is memory for grains
    solver_.emplace(*scene_, states, world.step, threads_, world.slowest_rebound);
  }
  world.touching = solver_->touching();
}

void GrainLoop::advance(StepWorld& world, std::size_t steps, StepStop stop) {
  find_forces(world);
  const std::size_t before = solver_->steps();
  if (stop == StepStop::never) {
    solver_->advance(steps);
  } else {
    for (std::size_t k = 0; k < steps && !is_met(world, stop); ++k) solver_->advance(1);
  }
  world.n += solver_->steps() - before;
  world.collisions = solver_->collisions();
  world.touching = solver_->touching();
}

bool GrainLoop::is_met(const StepWorld&, StepStop stop) const {
  return solver_->touching() == 0 && solver_->all_stick(stop == StepStop::rest);
}

void GrainLoop::show(const StepWorld&, Frame& frame, bool) { solver_->show(frame); }

/// The world has no bodies any more: the solver has them.
void GrainLoop::exchange(StateArchive& archive, StepWorld& world) {
  find_forces(world);
  archive(world);
  solver_->exchange(archive);
}

std::vector<std::string> GrainLoop::features() const {
  const GrainFeatures has = grain_features(*scene_, scene_->hard.initial);
  const std::string friction =
      has.rolls ? "Coulomb, rolling and drilling friction" : "Coulomb friction";
  const std::string lift = has.lifts ? " and lift-off" : ", no lift-off";
  return {
      has.any_normal ? "any normal force" : "linear normal force",
      has.rubs ? "viscous tangential force with Coulomb's cap" : "no tangential force, no torque",
      has.driven     ? "tilted or moving substrate with " + friction + lift
      : has.on_plane ? "level, still substrate with " + friction + lift
                     : "level, still substrate without friction or lift-off",
      has.lifts   ? "centres at any height"
      : has.radii ? "unlike radii: each centre stays at its height"
                  : "one radius, centres in a plane: no z",
      has.walls ? "walls upright on the substrate" : "no walls",
      "many bodies: neighbours, islands, " + GrainSolver::instruction_set()};
}

}  // namespace slipcheck
