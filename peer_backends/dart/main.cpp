#include "engine/worker.h"
#include "peer_backends/dart/dart_world.h"

int main() {
  slipcheck::peer::WorldEngine<slipcheck::dart_engine::DartWorld> engine;
  return slipcheck::run_worker(engine);
}
