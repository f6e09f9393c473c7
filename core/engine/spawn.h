#pragma once

#include <sys/types.h>

#include <cstddef>

#include "engine/worker_command.h"

namespace slipcheck {

/// A child process and this side's ends of its standard streams, all non-blocking and not
/// inherited by other children.
struct Child {
  pid_t pid = -1;
  int in = -1;   ///< a socket, so that MSG_NOSIGNAL keeps SIGPIPE away
  int out = -1;  ///< a pipe
  int err = -1;  ///< a pipe
};

/// Starts a worker in a process group of its own, with no signal blocked or ignored, no descriptor
/// but the standard ones, and of the environment only what is for workers (engine-protocol.md). It
/// is killed when the thread that starts it ends, however that comes. `memory` limits what it may
/// write to, not what it reserves [bytes]; 0 does not. Throws std::system_error.
Child spawn(const WorkerCommand& command, std::size_t memory);

}  // namespace slipcheck
