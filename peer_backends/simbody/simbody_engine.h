#pragma once

#include <memory>

#include "engine/engine.h"

namespace slipcheck::simbody {

/// Simbody, in double precision, its steps as long as its accuracy asks for.
std::unique_ptr<Engine> make_simbody_engine();

}  // namespace slipcheck::simbody
