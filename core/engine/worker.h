#pragma once

#include "engine/engine.h"

namespace slipcheck {

/// The main function of a worker: answers the harness's requests on standard input with replies on
/// standard output (protocol.h) until it is told to quit or the input ends. Returns the exit code.
///
/// From here on the process's standard output goes to its standard error, so that a library that
/// prints cannot spoil the replies, and the process dies with the one that started it.
/// What the engine throws becomes a reply; only Refused leaves the run possible.
int run_worker(Engine& engine);

}  // namespace slipcheck
