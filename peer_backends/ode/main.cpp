#include "engine/worker.h"
#include "peer_backends/ode/ode_world.h"

int main() {
  slipcheck::peer::WorldEngine<slipcheck::ode::OdeWorld> engine;
  return slipcheck::run_worker(engine);
}
