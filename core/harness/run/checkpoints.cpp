#include "harness/run/checkpoints.h"

#include <exception>

namespace slipcheck {

bool CheckpointClock::is_due() const {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - written_;
  return since.count() >= checkpoints_->every;
}

void CheckpointClock::write(StateArchive& archive) {
  trouble_.clear();
  try {
    checkpoints_->write(archive.take());
  } catch (const std::exception& fault) {
    trouble_ = fault.what();
  }
  // From its end on: writing may take longer than the time between two.
  written_ = std::chrono::steady_clock::now();
}

}  // namespace slipcheck
