#pragma once

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// The motion that the cue of a written body gives it (cue_stroke.h). Faults: a cue without what it
/// needs, a tip that misses the ball or slips off, a ball that does not rest on the substrate.
void strike(const WrittenBody& written, const WrittenScene& scene, Body& body, Reading& reading);

}  // namespace slipcheck
