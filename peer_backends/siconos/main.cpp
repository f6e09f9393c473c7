#include "engine/worker.h"
#include "peer_backends/siconos/siconos_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::siconos::make_siconos_engine()); }
