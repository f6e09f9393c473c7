#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/frame.h"
#include "reference/forces/contact_integrator.h"
#include "reference/forces/contact_solver.h"
#include "reference/forces/contact_state.h"
#include "reference/initial_contacts.h"
#include "reference/solver.h"

namespace slipcheck {

/// What ContactSolver's bodies do: they are carried from event to event, each of which changes what
/// they are in and is shown.
class ContactEvents {
 public:
  using Happening = ContactIntegrator::Happening;

  /// Only the pairs in `overlapping` are in contact at the start; others that overlap meet where
  /// they approach. The scene must outlive this.
  ContactEvents(const ContactScene& scene, std::span<const BodyState> initial,
                const ContactSettings& settings, std::span<const InitialContact> overlapping);

  const ContactState& state() const { return state_; }
  const ContactIntegrator& integrator() const { return integrator_; }

  /// On to the end of a step, `limit` [s] at most, or what happens before. Throws
  /// IntegrationFailure.
  Happening advance(double limit) { return integrator_.advance(limit); }
  /// Does what has happened, shows `sink`, where given, the frames before and after it, and counts
  /// it in `run`.
  void perform(const Happening& happening, FrameSink* sink, SolvedRun& run);
  /// Sets what rolling and resting bodies obey exactly.
  void project() { state_.project(); }

  void show(FrameSink* sink, double time, std::optional<Touch> hit = std::nullopt);
  void reveal_slides(FrameSink* sink);

 private:
  void handle_touch(const NextTouch& touch, FrameSink* sink, SolvedRun& run);
  void handle_root(const ContactWatch::Item& item, int direction);

  const ContactScene* scene_;
  ContactState state_;
  ContactIntegrator integrator_;
  std::vector<std::size_t> ends_now_;  ///< contacts whose force has just fallen to zero
  std::vector<bool> seen_sliding_;     ///< a frame has shown this body's present slide
  Frame frame_;
};

}  // namespace slipcheck
