#include "studies/stability/outcome.h"

namespace slipcheck {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::accurate:
      return "accurate";
    case Outcome::degraded:
      return "degraded";
    case Outcome::drifting:
      return "drifting";
    case Outcome::energy_growing:
      return "energy growing";
    case Outcome::tunnelled:
      return "tunnelled";
    case Outcome::exploded:
      return "exploded";
    case Outcome::not_finite:
      return "NaN";
    case Outcome::timed_out:
      return "timed out";
    case Outcome::crashed:
      return "crashed";
    case Outcome::refused:
      return "refused";
  }
  return "";
}

}  // namespace slipcheck
