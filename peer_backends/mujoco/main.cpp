#include "engine/worker.h"
#include "peer_backends/mujoco/mujoco_world.h"

int main() {
  slipcheck::peer::WorldEngine<slipcheck::mujoco::MujocoWorld> engine;
  return slipcheck::run_worker(engine);
}
