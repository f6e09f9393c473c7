#include "engine/worker.h"
#include "lammps/lammps_engine.h"

int main() { return slipcheck::run_worker(*slipcheck::lammps::make_lammps_engine()); }
