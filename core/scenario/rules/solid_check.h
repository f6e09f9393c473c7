#pragma once

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// Lays a cylinder's axis across its way and checks that a block or cylinder does what closed forms
/// say: it rests on the substrate, is alone, a block neither turns nor tips, a cylinder moves
/// across its axis.
void check_solid(const WrittenBody& written, const WrittenScene& scene, Body& body,
                 Reading& reading);

}  // namespace slipcheck
