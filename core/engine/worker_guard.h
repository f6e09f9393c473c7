#pragma once

#include <sys/types.h>

namespace slipcheck {

// A worker dies with the thread that made it (PR_SET_PDEATHSIG), but not what the worker itself has
// started. A guard, a shell that waits for the end of a socket, kills the groups of those workers
// that are left when this program ends without having done so: by SIGKILL, or for lack of memory.
// What has left its worker's process group (setsid) is out of its reach.

/// From now on this process group is killed once this program has ended, however it does.
void guard_group(pid_t group);

/// The group's processes have been killed; before its leader is reaped, whose number another
/// process may then get.
void release_group(pid_t group);

}  // namespace slipcheck
