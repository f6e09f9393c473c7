#include "reference/forces/contact_look_ahead.h"

#include <algorithm>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// When this comes to what `has_come` tells of what has happened.
template <class HasCome>
double look_for(ContactEvents& events, double limit, std::size_t most_events, HasCome has_come) {
  SolvedRun run;
  while (events.state().time < limit && run.events < most_events) {
    const ContactEvents::Happening happening = events.advance(limit);
    if (has_come(happening)) return events.state().time;
    events.perform(happening, nullptr, run);
  }
  return kNever;
}

}  // namespace

double look_for_contact(ContactEvents& events, double limit, std::size_t most_events) {
  const auto lands = [](const auto& root) {
    return root.first.what == ContactWatch::What::landing;
  };
  return look_for(events, limit, most_events, [&](const ContactEvents::Happening& happening) {
    return happening.touch || std::ranges::any_of(happening.roots, lands);
  });
}

double look_for_collision(ContactEvents& events, double limit, double slowest,
                          std::size_t most_events) {
  return look_for(events, limit, most_events, [&](const ContactEvents::Happening& happening) {
    if (!happening.touch) return false;
    const BodyState a = events.state().body(happening.touch->first);
    const BodyState b = events.state().body(happening.touch->second);
    const Vector3 n = (a.position - b.position).normalized();
    return -n.dot(a.velocity - b.velocity) >= slowest;
  });
}

}  // namespace slipcheck
