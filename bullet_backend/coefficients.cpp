#include "bullet_backend/coefficients.h"

#include <algorithm>

#include "engine/engine.h"

namespace slipcheck::bullet {
namespace {

const PairContact& box_contact(const Scene& scene, std::size_t body, int surface) {
  const Box& box = *scene.box;
  const auto& contacts =
      surface == kFloor ? box.on_floor : (surface == kWall ? box.on_wall : box.on_lid);
  return contacts[scene.material[body]];
}

const SurfaceContact& contact_with(const Scene& scene, std::size_t body, int surface) {
  return scene.on_surface(body, touched_surface(surface));
}

}  // namespace

PairCoefficients::PairCoefficients(const Scene& scene, const BulletSettings& settings,
                                   double time_step)
    : scene_(scene), settings_(settings) {
  set_time_step(time_step);
}

void PairCoefficients::set_time_step(double time_step) {
  if (time_step == time_step_) return;
  time_step_ = time_step;
  raise_.clear();
  for (const Sphere& body : scene_.bodies) {
    const double weight = body.mass * scene_.gravity * time_step;
    raise_.push_back(settings_.body == BodyKind::rigid ? std::max(1.0, weight) : 1.0);
  }
  fixed_.clear();
  if (scene_.box || !scene_.has_substrate || depends_on_motion()) return;
  for (int body = 0; body < static_cast<int>(scene_.bodies.size()); ++body)
    fixed_.push_back({friction(body, kFloor, true, 0), restitution(body, kFloor, 0),
                      rolling_friction(body, kFloor, 0, true), spinning_friction(body, kFloor)});
}

bool PairCoefficients::depends_on_motion() const {
  if (settings_.body == BodyKind::multibody) return true;  // restitution()
  return std::ranges::any_of(scene_.substrate, [this](const SubstrateContact& ground) {
    if (!ground.rolling.is_constant()) return true;
    return settings_.coefficients == CoefficientMap::pair_and_slip &&
           (ground.static_friction != ground.kinetic_friction ||
            (!ground.rolling.is_zero() && !ground.rolling_while_sliding));
  });
}

const PairContact& PairCoefficients::pair_contact(int body, int other) const {
  if (is_surface(other)) return contact_with(scene_, index(body), other).impact;
  return other < 0 ? box_contact(scene_, index(body), other)
                   : scene_.between(index(body), index(other));
}

const SubstrateContact* PairCoefficients::lasting_contact(int body, int other) const {
  if (is_substrate(other)) return &scene_.on_substrate(index(body));
  return is_surface(other) ? &contact_with(scene_, index(body), other).lasting : nullptr;
}

double PairCoefficients::gravity_onto(int other) const {
  if (other == kFloor) return scene_.gravity;
  return other == kLid ? -scene_.gravity : 0;
}

double PairCoefficients::friction(int body, int other, bool slips, double slip_speed) const {
  double mu = 0;
  const SubstrateContact* ground = lasting_contact(body, other);
  // β0 = −1, u_t' = u_t: no tangential impulse whatever μ is.
  const bool is_smooth =
      !is_substrate(other) && pair_contact(body, other).tangential_restitution == -1;
  if (is_smooth) {
    mu = 0;
  } else if (ground) {
    const bool sticks = settings_.coefficients == CoefficientMap::pair_and_slip && !slips;
    mu = sticks ? ground->static_friction : ground->kinetic_friction;
  } else {
    mu = friction_at(pair_contact(body, other).friction, slip_speed);
  }
  return settings_.friction_factor * mu;
}

bool PairCoefficients::has_friction_law(int body, int other) const {
  return !is_substrate(other) &&
         !std::holds_alternative<double>(pair_contact(body, other).friction);
}

double PairCoefficients::restitution(int body, int other, double approach_speed,
                                     double onto) const {
  double e = is_substrate(other)
                 ? scene_.on_substrate(index(body)).restitution
                 : restitution_at(pair_contact(body, other).restitution, approach_speed);
  if (settings_.body == BodyKind::multibody && e > 0) {
    const double kick = onto * time_step_;
    if (approach_speed + kick > 0) e *= approach_speed / (approach_speed + kick);
  }
  return settings_.restitution_factor * e;
}

double PairCoefficients::rolling_friction(int body, int other, double speed, bool slips) const {
  const SubstrateContact* ground = lasting_contact(body, other);
  if (!ground) return 0;
  const Sphere& sphere = scene_.bodies[index(body)];
  const bool rolls = settings_.coefficients != CoefficientMap::pair_and_slip ||
                     ground->rolling_while_sliding || !slips;
  const double mu_r = rolls ? ground->rolling(speed) : 0;
  const double rho = settings_.rolling_friction_factor * (1 + sphere.shape_factor) * mu_r *
                     sphere.radius * raise_[index(body)];
  // Of a rigid body Bullet looks at the spinning friction only where this one is > 0.
  const bool gated = settings_.body == BodyKind::rigid && spinning_friction(body, other) > 0;
  return std::max(rho, gated ? 1e-12 : 0.0);
}

double PairCoefficients::spinning_friction(int body, int other) const {
  const SubstrateContact* ground = lasting_contact(body, other);
  if (!ground) return 0;
  return settings_.spinning_friction_factor * ground->drilling_length * raise_[index(body)];
}

bool PairCoefficients::slips(int body, int other, double slip_speed, double onto) const {
  const SubstrateContact* ground = lasting_contact(body, other);  // none in a box
  const double friction = ground ? ground->kinetic_friction : 0;
  return slip_speed >
         (1 + scene_.bodies[index(body)].inverse_shape_factor()) * friction * onto * time_step_;
}

namespace {

/// One number of a law, as somebody sees it who looks at two that start with the velocity `start`
/// relative to each other.
double one_restitution(const RestitutionLaw& law, const Vector3& start) {
  if (const auto* power = std::get_if<PowerLawRestitution>(&law)) {
    return restitution_at(law, power->speed);
  }
  return restitution_at(law, start.norm());
}

BodyFields pair_fields(const PairContact& contact, const Vector3& start) {
  return {friction_at(contact.friction, start.norm()), one_restitution(contact.restitution, start),
          0, 0};
}

}  // namespace

BodyFields naive_ball(const Scene& scene, std::size_t body) {
  if (scene.box && scene.bodies.size() == 1) return naive_surface(scene, kFloor);
  const bool on_surface = !scene.has_substrate && !scene.surfaces.empty();
  const SubstrateContact& ground =
      on_surface ? scene.on_surface(body, 0).lasting : scene.on_substrate(body);
  BodyFields fields;
  fields.friction = ground.kinetic_friction;
  fields.rolling_friction = ground.rolling.points().front().coefficient;
  fields.spinning_friction = ground.drilling_length;
  fields.restitution = ground.restitution;
  if (scene.bodies.size() > 1) {
    const std::size_t other = body == 0 ? 1 : 0;
    const BodyFields with_other = pair_fields(
        scene.between(body, other), scene.initial[body].velocity - scene.initial[other].velocity);
    if (scene.box) return with_other;
    fields.restitution = with_other.restitution;
  }
  return fields;
}

BodyFields naive_surface(const Scene& scene, int surface) {
  if (!scene.box && surface == kSubstrate) {
    const SubstrateContact& ground = scene.on_substrate(0);
    return {ground.kinetic_friction, ground.restitution, 0, 0};
  }
  if (!scene.box) {
    const SurfaceContact& contact = contact_with(scene, 0, surface);
    const Vector3 velocity =
        scene.surfaces[touched_surface(surface)].motion.velocity(0, scene.initial[0].position);
    BodyFields fields = pair_fields(contact.impact, scene.initial[0].velocity - velocity);
    fields.friction = contact.lasting.kinetic_friction;
    return fields;
  }
  const bool moves = surface == kFloor || scene.box->moving_walls;
  const Vector3 velocity(0, 0, moves ? scene.box->floor.velocity(0) : 0);
  return pair_fields(box_contact(scene, 0, surface), scene.initial[0].velocity - velocity);
}

}  // namespace slipcheck::bullet
