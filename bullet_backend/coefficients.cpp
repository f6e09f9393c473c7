#include "bullet_backend/coefficients.h"

#include <algorithm>

#include "engine/engine.h"

namespace slipcheck::bullet {

PairCoefficients::PairCoefficients(const HardScene& scene, double time_step) : scene_(scene) {
  for (const Sphere& body : scene_.bodies) {
    raise_.push_back(std::max(1.0, body.mass * scene_.gravity * time_step));
  }
}

double PairCoefficients::friction(int body, int other) const {
  if (other == kSubstrate) return scene_.on_substrate(index(body)).kinetic_friction;
  const PairContact& pair = scene_.between(index(body), index(other));
  // β0 = −1, u_t' = u_t: no tangential impulse whatever μ is.
  return pair.tangential_restitution == -1 ? 0 : pair.friction;
}

double PairCoefficients::restitution(int body, int other, double approach_speed) const {
  if (other == kSubstrate) return scene_.on_substrate(index(body)).restitution;
  return restitution_at(scene_.between(index(body), index(other)).restitution, approach_speed);
}

double PairCoefficients::rolling_friction(int body, int other, double speed) const {
  if (other != kSubstrate) return 0;
  const Sphere& sphere = scene_.bodies[index(body)];
  const double mu_r = scene_.on_substrate(index(body)).rolling(speed);
  const double rho = (1 + sphere.shape_factor) * mu_r * sphere.radius * raise_[index(body)];
  // Bullet looks at the spinning friction only where this one is > 0.
  const double gate = spinning_friction(body, other) > 0 ? 1e-12 : 0;
  return std::max(rho, gate);
}

double PairCoefficients::spinning_friction(int body, int other) const {
  if (other != kSubstrate) return 0;
  return scene_.on_substrate(index(body)).drilling_length * raise_[index(body)];
}

namespace {

/// The speed at which somebody who wants one number looks at the law between two bodies.
double reference_speed(const HardScene& scene, std::size_t i, std::size_t j) {
  const RestitutionLaw& law = scene.between(i, j).restitution;
  if (const auto* power = std::get_if<PowerLawRestitution>(&law)) return power->speed;
  return (scene.initial[i].velocity - scene.initial[j].velocity).norm();
}

}  // namespace

BodyFields naive_ball(const HardScene& scene, std::size_t body) {
  const SubstrateContact& ground = scene.on_substrate(body);
  BodyFields fields;
  fields.friction = ground.kinetic_friction;
  fields.rolling_friction = ground.rolling.points().front().coefficient;
  fields.spinning_friction = ground.drilling_length;
  fields.restitution = ground.restitution;
  if (scene.bodies.size() > 1) {
    const std::size_t other = body == 0 ? 1 : 0;
    fields.restitution =
        restitution_at(scene.between(body, other).restitution, reference_speed(scene, body, other));
  }
  return fields;
}

BodyFields naive_plane(const HardScene& scene) {
  const SubstrateContact& ground = scene.on_substrate(0);
  return {ground.kinetic_friction, ground.restitution, 0, 0};
}

}  // namespace slipcheck::bullet
