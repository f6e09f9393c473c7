#pragma once

#include "harness/run/reference_run.h"

namespace slipcheck::test {

/// The reference of a scene with hard contacts.
inline ReferenceResult run_hard(const Scene& scene, const RunEnd& end,
                                const std::vector<std::string>& names) {
  const ContactScene contacts = with_hard_contacts(scene);
  return run_reference(ReferenceSolver(contacts, Compare::Reference::automatic), end, names);
}

}  // namespace slipcheck::test
