#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "base/state_archive.h"

namespace slipcheck {

/// How a run is kept on its way, so that another process can go on with it.
struct Checkpoints {
  double every = 600;  ///< wall time from one to the next [s], >= 0
  std::string state;   ///< to go on from, as it was given to `write`; empty: from the start
  /// Puts a state where it lasts. What it throws is told and the run goes on.
  std::function<void(std::string_view state)> write;
};

/// When the next one is due, and what became of the last.
class CheckpointClock {
 public:
  /// `checkpoints` must outlive it.
  explicit CheckpointClock(const Checkpoints& checkpoints) : checkpoints_(&checkpoints) {}

  bool is_due() const;
  /// Takes what is in the archive.
  void write(StateArchive& archive);
  /// Why a state could not be written the last time that was tried; else empty.
  const std::string& trouble() const { return trouble_; }

 private:
  const Checkpoints* checkpoints_;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
  std::string trouble_;
};

}  // namespace slipcheck
