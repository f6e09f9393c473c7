#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/observe/assembly_observer.h"
#include "harness/observe/observables.h"
#include "reference/kept_solver.h"

namespace slipcheck {

/// How a scene's reference is kept on its way, so that another process can go on with it.
struct Checkpoints {
  double every = 600;  ///< wall time from one to the next [s], >= 0
  std::string state;   ///< to go on from, as it was given to `write`; empty: from the start
  /// Puts a state where it lasts. What it throws is told and the run goes on.
  std::function<void(std::string_view state)> write;
};

/// One of the runs that a reference is made of.
struct ObservedRun {
  SolvedRun run;
  Observables seen;
  double cpu_seconds = 0;                 ///< of all processes that had a part in it
  std::optional<Assembly> assembly = {};  ///< where that was asked for

  void exchange(StateArchive& archive);
};

/// Keeps the runs of one scene's reference: those that have finished, and of the present one its
/// solver and its observers.
class ReferenceKeeper final : public RunKeeper {
 public:
  /// `checkpoints` must outlive it. Throws BadState where their state is none.
  explicit ReferenceKeeper(const Checkpoints& checkpoints);

  /// The next run, where it has finished in a process before; else null.
  const ObservedRun* next();
  /// It begins, or goes on from what was kept. observers: writes or reads what they go on with.
  void begin(std::function<void(StateArchive&)> observers);
  void finish(const ObservedRun& run);
  /// CPU time that the present run took in processes before [s].
  double cpu_before() const { return cpu_before_; }
  /// Why a state could not be written the last time that was tried; else empty.
  const std::string& trouble() const { return trouble_; }

  StateArchive* resumed() override { return resumes_ ? &archive_ : nullptr; }
  bool is_due() override;
  void keep(const std::function<void(StateArchive&)>& write) override;

 private:
  void write(StateArchive& archive);

  const Checkpoints* checkpoints_;
  StateArchive archive_;
  bool resumes_ = false;  ///< the next run that begins is in the archive
  std::vector<ObservedRun> finished_;
  std::size_t asked_ = 0;  ///< of the finished ones
  std::function<void(StateArchive&)> observers_;
  double cpu_before_ = 0, cpu_begin_ = 0;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
  std::string trouble_;
};

}  // namespace slipcheck
