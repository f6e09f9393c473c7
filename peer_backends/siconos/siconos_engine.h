#pragma once

#include <memory>

#include "engine/engine.h"

namespace slipcheck::siconos {

/// Siconos, Moreau and Jean's time stepping, in double precision.
std::unique_ptr<Engine> make_siconos_engine();

}  // namespace slipcheck::siconos
