#pragma once

#include <cstddef>

#include "harness/run/checkpoints.h"
#include "harness/run/engine_run.h"

namespace slipcheck {

/// One run of an engine of which nothing is looked at but what the bodies are as a whole, at
/// `samples` >= 2 even times from the start to the scene's last time, or to the end of a reference
/// that came to one before. Of the steps in between nothing comes over; the record's rate is raised
/// so that a whole number of them leads from one sample to the next. What is seen is the record's
/// assembly; a state that is not finite, or that has left all bounds, makes it unstable.
///
/// With checkpoints it is kept at samples: what was seen and the bodies' states, from which the
/// engine goes on as from a start at that time. What it holds beside states (lists of neighbours,
/// springs, impulses to begin with) begins anew, so that not the bits of a run in one piece come
/// out; a warning says so. Throws what RemoteEngine throws, and Refused for a state of another
/// version of the engine.
void run_whole(RemoteEngine& engine, const EnsembleTask& task, std::size_t samples,
               EngineRecord& record, const Checkpoints* checkpoints = nullptr);

}  // namespace slipcheck
