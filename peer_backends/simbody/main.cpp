#include "engine/worker.h"
#include "peer_backends/simbody/simbody_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::simbody::make_simbody_engine()); }
