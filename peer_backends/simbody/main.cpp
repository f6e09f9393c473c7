#include "engine/worker.h"
#include "simbody/simbody_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::simbody::make_simbody_engine()); }
