#include "reference/forces/contact_events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

using What = ContactWatch::What;

ContactScales scales_of(const ContactScene& scene, std::span<const BodyState> initial,
                        const ContactSettings& settings,
                        std::span<const InitialContact> overlapping) {
  ContactScales scales;
  double radius = 0;
  for (const Sphere& sphere : scene.hard.bodies) radius = std::max(radius, sphere.radius);
  // A scene in which nothing moves has the speed of a fall through a thousandth of its size.
  const double least = 1e-3 * std::sqrt(2 * scene.hard.gravity * radius);
  scales.speed =
      std::max({speed_scale(scene.hard, initial), release_speed(scene, overlapping), least, 1e-30});
  scales.slip_floor = 100 * settings.tolerance * scales.speed;
  scales.rebound_fraction = settings.cut_offs * EventSettings{}.collapse_fraction;
  scales.slowest_landing = settings.cut_offs * EventSettings{}.landing_fraction * scales.speed;
  return scales;
}

}  // namespace

ContactEvents::ContactEvents(const ContactScene& scene, std::span<const BodyState> initial,
                             const ContactSettings& settings,
                             std::span<const InitialContact> overlapping)
    : scene_(&scene),
      state_(scene, initial, settings.start, scales_of(scene, initial, settings, overlapping),
             overlapping),
      integrator_(state_, settings.tolerance) {}

// --- what happens --------------------------------------------------------------------------------

void ContactEvents::perform(const Happening& happening, FrameSink* sink, SolvedRun& run) {
  if (happening.touch) {
    ++run.events;
    handle_touch(*happening.touch, sink, run);
    integrator_.begin_stretch();
    return;
  }
  if (happening.roots.empty() && !happening.kink) return;
  ++run.events;
  const bool shows_before =
      std::any_of(happening.roots.begin(), happening.roots.end(),
                  [](const auto& root) { return root.first.what == What::landing; });
  if (happening.kink) {
    // The last instant at which the substrate has the velocity before.
    show(sink, std::nextafter(state_.time, -kNever));
    state_.feel_substrate_jump();
  } else if (shows_before) {
    show(sink, state_.time);
  }
  bool landed = false;
  for (const auto& [item, direction] : happening.roots) {
    handle_root(item, direction);
    landed |= item.what == What::landing;
  }
  state_.settle();
  integrator_.begin_stretch();
  if (landed) {
    // A body that bounces shows its touch in the frame after the landing.
    for (const auto& [item, direction] : happening.roots)
      if (item.what == What::landing && !state_.dynamics().modes[item.index].on_plane())
        frame_.touches.push_back(
            {static_cast<int>(item.index), kSubstrate, scene_->hard.bodies[item.index].mass});
  }
  // A contact is shown once more at its end.
  show(sink, state_.time);
  ends_now_.clear();
  std::vector<std::size_t> ended;
  for (const auto& [item, direction] : happening.roots)
    if (item.what == What::contact_end) ended.push_back(item.index);
  if (ended.empty()) return;
  std::sort(ended.rbegin(), ended.rend());
  for (std::size_t index : ended) state_.end_contact(index);
  state_.settle();
}

void ContactEvents::handle_touch(const NextTouch& touch, FrameSink* sink, SolvedRun& run) {
  state_.project();
  const auto& soft = scene_->between(touch.first, touch.second);
  const bool is_impact = !soft || (soft->after_impact && state_.meet(touch.first, touch.second));
  if (is_impact || !soft->after_impact) ++run.collisions;
  if (!is_impact) {
    show(sink, state_.time);
    state_.begin_contact(touch.first, touch.second);
    state_.settle();
    show(sink, state_.time);  // the first touch may lift a body already
    return;
  }
  show(sink, state_.time);
  const CollisionResult result = state_.collide_now(touch.first, touch.second);
  if (result.altered) ++run.collapses;
  state_.hand_impulses_on();
  state_.settle();
  show(sink, state_.time,
       Touch{static_cast<int>(touch.first), static_cast<int>(touch.second),
             std::max(result.impulse.norm(), 1e-300)});
}

void ContactEvents::handle_root(const ContactWatch::Item& item, int direction) {
  const std::size_t i = item.index;
  switch (item.what) {
    case What::landing:
      state_.land_now(i);
      break;
    case What::lift_off:
      if (scene_->hard.confined)
        state_.dynamics().modes[i].normal_sign = direction;
      else
        state_.lift_off(i);
      break;
    case What::slip_end:
      state_.end_slip(i);
      break;
    case What::slip_develops:
      state_.dynamics().modes[i].slip_begins = false;
      break;
    case What::slip_begin:
      state_.begin_slip(i);
      break;
    case What::roll_end:
      state_.end_roll(i);
      break;
    case What::roll_begin:
      state_.begin_roll(i);
      break;
    case What::spin_end:
      state_.end_spin(i);
      break;
    case What::spin_begin:
      state_.begin_spin(i);
      break;
    case What::force_end:
      state_.clamp_contact(i);
      ends_now_.push_back(i);
      break;
    case What::force_begin:
      state_.release_contact(i);
      break;
    case What::edge:
      state_.cross_edge(i, item.edge, direction > 0);
      break;
    case What::contact_end:  // performed last, by perform()
    case What::roll_kink:
    case What::slip_dies_out:
    case What::greatest_overlap:
      break;
  }
}

// --- what is shown -------------------------------------------------------------------------------

void ContactEvents::show(FrameSink* sink, double time, std::optional<Touch> hit) {
  if (!sink) {
    frame_.touches.clear();
    return;
  }
  frame_.bodies = state_.bodies();
  const auto& dynamics = state_.dynamics();
  for (std::size_t i = 0; i < dynamics.modes.size(); ++i)
    if (dynamics.modes[i].on_plane())
      frame_.touches.push_back({static_cast<int>(i), kSubstrate, scene_->hard.bodies[i].mass});
  for (std::size_t c = 0; c < dynamics.contacts.size(); ++c) {
    const ContactMode& contact = dynamics.contacts[c];
    const bool acts = !contact.clamped || std::ranges::count(ends_now_, c) > 0;
    frame_.touches.push_back(
        {static_cast<int>(contact.first), static_cast<int>(contact.second), acts ? 1e-300 : 0});
  }
  if (hit) frame_.touches.push_back(*hit);
  sink->take(time, frame_);
  frame_.touches.clear();
}

/// A slide that begins and ends without slip shows in no event's frame: one is shown on its way.
void ContactEvents::reveal_slides(FrameSink* sink) {
  const auto& modes = state_.dynamics().modes;
  seen_sliding_.resize(modes.size(), false);
  bool reveal = false;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i].kind != BodyMode::Kind::sliding) {
      seen_sliding_[i] = false;
    } else if (!seen_sliding_[i]) {
      const double slip = state_.dynamics().slip(i, state_.y.data()).norm();
      reveal |= seen_sliding_[i] = slip > 1e-6 * state_.scales().speed;
    }
  }
  if (reveal) show(sink, state_.time);
}

}  // namespace slipcheck
