#include "bullet_backend/bullet_world.h"

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "bullet_backend/applied.h"
#include "bullet_backend/balls.h"
#include "bullet_backend/coefficients.h"
#include "bullet_backend/combine.h"
#include "bullet_backend/convert.h"
#include "bullet_backend/dynamics_world.h"
#include "bullet_backend/flush_denormals.h"
#include "bullet_backend/leave_outs.h"
#include "bullet_backend/margins.h"
#include "bullet_backend/next_contact.h"
#include "bullet_backend/periodic_cell.h"
#include "bullet_backend/surfaces.h"
#include "bullet_backend/touches.h"

namespace slipcheck::bullet {
namespace {

std::vector<BodyState> to_world(std::span<const BodyState> states, const WorldUnits& units) {
  std::vector<BodyState> made;
  for (const BodyState& state : states) made.push_back(units.to_world(state));
  return made;
}

BulletSettings in_force(BulletSettings settings, const LeaveOuts& leaves) {
  if (leaves.line) settings.two_friction_directions = false;
  return settings;
}

/// Bullet lays its one row of friction along y.
WorldUnits turned(WorldUnits units, const LeaveOuts& leaves) {
  if (!leaves.line) return units;
  const Vector2& line = *leaves.line;
  units.turn << line.y(), -line.x(), 0, line.x(), line.y(), 0, 0, 0, 1;
  return units;
}

/// Gap that counts as touching where steps end at contacts: what Bullet would process, but neither
/// below rounding nor more than a thousandth of a radius.
double touching_gap(const Scene& scene, const BulletSettings& settings) {
  const double radius = std::ranges::min_element(scene.bodies, {}, &Sphere::radius)->radius;
  return std::clamp(settings.contact_processing_threshold, 1e-9 * radius, 1e-3 * radius);
}

/// A contact at which a step is split is solved in a step of its own, so short that friction and
/// gravity do next to nothing in it: this part of a step, but not what Bullet takes for no time.
constexpr double kImpactStep = 1e-6;

}  // namespace

/// In the order in which they need each other; balls and surfaces leave before the world goes.
struct BulletWorld::Parts {
  Parts(const Scene& scene_in_si, const BulletSettings& chosen, double step,
        std::span<const BodyState> states, double time)
      : leaves(find_leave_outs(scene_in_si, states, chosen)),
        settings(in_force(chosen, leaves)),
        flush_denormals(settings.flush_denormals),
        units(turned(world_units(scene_in_si, chosen), leaves)),
        scene(in_world_units(scene_in_si, units)),
        time_step(step * units.time),
        start_time(time * units.time),
        cell(scene.periodic, units.turn),
        coefficients(scene, settings, time_step),
        dynamics(settings, margin_scale(scene), leaves, cell),
        surfaces(dynamics.world(), scene, units, settings),
        balls(make_balls(dynamics.world(), scene, to_world(states, units), units.turn, settings)) {
    const Vector3 gravity = units.turn * scene.gravity_vector();
    dynamics.world().setGravity(to_bullet(gravity));
    coefficients.set_gravity(gravity);
    coefficients.set_cell(cell);
    if (settings.splits_at_contacts > 0)
      next_contact.emplace(*balls, surfaces, scene, units, cell, touching_gap(scene, settings));
  }

  bool is_one_step() const { return settings.substeps == 1 && !next_contact; }

  double step_begin() const { return start_time + static_cast<double>(steps) * time_step; }

  /// One step of Bullet's, from a time since the step's begin on.
  void advance(double from, double length) {
    coefficients.set_time_step(length);
    surfaces.begin_step(step_begin() + from, length);
    coefficients.set_ground_velocity(surfaces.told_before());
    dynamics.world().stepSimulation(btScalar(length), 0);
    if (is_one_step()) return;
    look(frames.emplace_back());
    frames.back().part = (from + length) / time_step;
  }

  /// SI.
  void look(Frame& frame) {
    frame.bodies.clear();
    for (std::size_t i = 0; i < balls->count(); ++i)
      frame.bodies.push_back(units.from_world(balls->state(i)));
    find_touches(dynamics.dispatcher(), scene.box.has_value(), frame.touches);
    for (Touch& touch : frame.touches) touch.normal_impulse /= units.impulse();
  }

  /// A step that ends where bodies touch and goes on from there.
  void advance_by_contacts(double from, double length) {
    const double end = from + length;
    const double impact = std::max(kImpactStep * length, 4 * double(SIMD_EPSILON));
    for (int split = 0; split < settings.splits_at_contacts; ++split) {
      const double until = next_contact->after(step_begin() + from, end - from);
      if (until >= end - from - impact) break;
      const double part = std::max(until, impact);
      // To push an overlap out within so short a step would be an explosion.
      btScalar& push = dynamics.world().getSolverInfo().m_erp2;
      const btScalar kept = std::exchange(push, until < impact ? btScalar(0) : push);
      advance(from, part);
      push = kept;
      from += part;
    }
    advance(from, end - from);
  }

  LeaveOuts leaves;
  BulletSettings settings;
  FlushDenormals flush_denormals;  // once for all: for each step it would cost a hundredth
  WorldUnits units;
  Scene scene;
  double time_step, start_time;
  std::size_t steps = 0;
  PeriodicCell cell;
  PairCoefficients coefficients;
  DynamicsWorld dynamics;
  Surfaces surfaces;
  std::unique_ptr<Balls> balls;
  std::optional<NextContact> next_contact;
  std::vector<Frame> frames;  // of the last step, where it has several parts
};

BulletWorld::BulletWorld(const Scene& scene, const BulletSettings& settings, double time_step,
                         std::span<const BodyState> states, double time)
    : parts_(std::make_unique<Parts>(scene, settings, time_step, states, time)) {
  const auto set_fields = [](btCollisionObject& object, const BodyFields& fields) {
    object.setFriction(btScalar(fields.friction));
    object.setRestitution(btScalar(fields.restitution));
    object.setRollingFriction(btScalar(fields.rolling_friction));
    object.setSpinningFriction(btScalar(fields.spinning_friction));
  };
  if (settings.coefficients == CoefficientMap::fields) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      set_fields(parts_->balls->object(i), naive_ball(parts_->scene, i));
    for (btRigidBody* surface : parts_->surfaces.bodies())
      set_fields(*surface, naive_surface(parts_->scene, surface->getUserIndex()));
    combine_as_shipped();
  } else {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      parts_->balls->object(i).setUserPointer(&parts_->coefficients);
    combine_by_pair();
  }
}

BulletWorld::~BulletWorld() = default;

void BulletWorld::step() {
  Parts& parts = *parts_;
  parts.frames.clear();
  const int substeps = parts.settings.substeps;
  const double length = parts.time_step / substeps;
  for (int k = 0; k < substeps; ++k) {
    if (parts.next_contact)
      parts.advance_by_contacts(k * length, length);
    else
      parts.advance(k * length, length);
  }
  ++parts.steps;
}

std::span<const Frame> BulletWorld::parts() const {
  const auto& frames = parts_->frames;
  return std::span(frames).first(frames.empty() ? 0 : frames.size() - 1);
}

void BulletWorld::read(Frame& frame) const {
  if (parts_->frames.empty())
    parts_->look(frame);
  else
    frame = parts_->frames.back();
  frame.part = 1;
}

Settings BulletWorld::applied() const {
  const Parts& parts = *parts_;
  return applied_settings(parts.dynamics.world(), parts.scene, parts.settings, parts.units,
                          parts.time_step);
}

std::vector<std::string> BulletWorld::left_out() const {
  return bullet::left_out(parts_->leaves, parts_->scene, parts_->settings);
}

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

std::string bullet_precision() { return sizeof(btScalar) == sizeof(double) ? "double" : "single"; }

bool is_no_time(double time_step) { return btFuzzyZero(btScalar(time_step)); }

}  // namespace slipcheck::bullet
