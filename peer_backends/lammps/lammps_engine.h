#pragma once

#include <memory>

#include "engine/engine.h"

namespace slipcheck::lammps {

/// LAMMPS, the program `lmp`, in double precision.
std::unique_ptr<Engine> make_lammps_engine();

}  // namespace slipcheck::lammps
