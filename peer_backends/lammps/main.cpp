#include <stdlib.h>

#include "engine/worker.h"
#include "peer_backends/lammps/lammps_engine.h"

int main() {
  // One process alone needs no daemon of Open MPI's, which does not start without a network.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  return slipcheck::run_worker(*slipcheck::lammps::make_lammps_engine());
}
