#pragma once

#include "base/json_fields.h"
#include "studies/tuning/tuning_journal.h"

namespace slipcheck {

/// But for the reason.
template <class Fields>
void describe(Fields& f, RunScore& score) {
  f("worst", score.worst);
  f("observable", score.observable);
  f("deviation", score.deviation);
  f("failed", score.failed);
  f("cpu_seconds", score.cpu_seconds);
  f("simulated_seconds", score.simulated_seconds);
}

template <class Fields>
void describe(Fields& f, TuningJournal::Answer& answer) {
  describe(f, answer.score);
  f("reason", answer.score.reason);
  f("seconds", answer.seconds);
}

}  // namespace slipcheck
