#pragma once

#include <cstddef>

#include "scenario/scenario.h"

namespace slipcheck {

/// How the solver is chosen and what it keeps to.
struct ReferenceSettings {
  Compare::Reference asked = Compare::Reference::automatic;
  double most_events = Run{}.most_events;                  ///< [1/s], as of Run
  double steps_per_contact = Compare{}.steps_per_contact;  ///< as of Compare
  /// Takes the loops that leave out nothing of what a scene may have: they give the same, to the
  /// last bit or to rounding.
  bool general = false;
  /// That share each step of one scene of many soft contacts; 0: one for each core. The results are
  /// the same bits.
  std::size_t threads = 1;
};

/// What a scene asks for.
inline ReferenceSettings reference_settings(const Scenario& scenario, bool general = false,
                                            std::size_t threads = 1) {
  return {scenario.compare.reference, scenario.run.most_events, scenario.compare.steps_per_contact,
          general, threads};
}

}  // namespace slipcheck
