#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace slipcheck {

/// A child process and this side's ends of its standard streams, all non-blocking and not
/// inherited by other children.
struct Child {
  pid_t pid = -1;
  int in = -1;   ///< a socket, so that MSG_NOSIGNAL keeps SIGPIPE away
  int out = -1;  ///< a pipe
  int err = -1;  ///< a pipe
};

/// Starts an executable without arguments in a process group of its own, with no signal blocked or
/// ignored. `address_space` limits its virtual memory [bytes]; 0 does not. Throws
/// std::system_error.
Child spawn(const std::filesystem::path& executable, std::size_t address_space);

}  // namespace slipcheck
