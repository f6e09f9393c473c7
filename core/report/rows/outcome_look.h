#pragma once

#include <string>

#include "report/rows/text_table.h"
#include "studies/stability/outcome.h"

namespace slipcheck {

/// How an outcome is shown: its letter says the same as its colour.
struct OutcomeLook {
  const char* letter;  ///< one column wide
  const char* brief;   ///< at most five columns wide
  const char* fill;    ///< "#0072b2"
  const char* ink;     ///< of the letter on it
};
const OutcomeLook& look_of(Outcome outcome);
Tone tone_of(Outcome outcome);

/// Whether a run that came out so is of some use: accurate or degraded.
bool is_usable(Outcome outcome);

}  // namespace slipcheck
