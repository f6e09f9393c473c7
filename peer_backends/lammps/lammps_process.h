#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "physics/sphere.h"

namespace slipcheck::lammps {

/// LAMMPS has ended, or an error stopped it; the message is its own.
class LammpsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program `lmp`, which reads commands from a pipe and writes snapshots into another: no file
/// is put on a disk, and so nothing is left of it however it or this process ends. With more than
/// one rank mpirun starts it, which keeps a directory while it runs; if it is killed, that
/// stays.
class LammpsProcess {
 public:
  explicit LammpsProcess(int ranks);
  ~LammpsProcess();
  LammpsProcess(const LammpsProcess&) = delete;
  LammpsProcess& operator=(const LammpsProcess&) = delete;

  /// The name under which LAMMPS opens the pipe that snapshot() reads.
  const std::string& snapshot_file() const { return snapshot_file_; }

  void send(const std::string& commands);

  /// The name under which LAMMPS opens a file with this text, which is in memory alone and there
  /// until forget_file().
  std::string keep_file(std::string_view text);
  void forget_file();

  /// Waits for the end of a `run` and gives the CPU time of its loop, summed over ranks [s].
  /// Snapshots on the way are kept. Throws LammpsError.
  double finish_run();

  /// The states in the snapshot of this step, of so many bodies in the order of their ids. Earlier
  /// ones are passed over. Throws LammpsError.
  void read_snapshot(long step, std::vector<BodyState>& states, std::size_t bodies);

 private:
  /// Takes in what there is of both streams; waits for some.
  void wait();
  [[noreturn]] void fail();
  std::string reap();

  pid_t process_ = -1;
  int commands_ = -1, words_ = -1, snapshots_ = -1, snapshots_write_ = -1, file_ = -1;
  std::string snapshot_file_;
  std::string said_, frames_, error_;  // not yet looked at
  bool ended_ = false;
};

}  // namespace slipcheck::lammps
