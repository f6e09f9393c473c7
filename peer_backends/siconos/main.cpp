#include "engine/worker.h"
#include "siconos/siconos_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::siconos::make_siconos_engine()); }
