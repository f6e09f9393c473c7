#include "engine/worker.h"
#include "peer_backends/lammps/lammps_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::lammps::make_lammps_engine()); }
