#include "peer_backends/shared/contact_values.h"

namespace slipcheck::peer {
namespace {

std::size_t index(int body) { return static_cast<std::size_t>(body); }

bool is_substrate(const Scene& scene, int other) { return other == kFloor && !scene.box; }
bool is_surface(const Scene& scene, int other) { return other < kFloor && !scene.box; }

double friction_of(const PairContact& pair) {
  return pair.tangential_restitution == -1 ? 0 : std::get<double>(pair.friction);
}

double one_restitution(const RestitutionLaw& law, double speed) {
  const auto* power = std::get_if<PowerLawRestitution>(&law);
  return restitution_at(law, power ? power->speed : speed);
}

double speed_at_start(const Scene& scene, int body, int other) {
  const Vector3& velocity = scene.initial[index(body)].velocity;
  if (other >= 0) return (velocity - scene.initial[index(other)].velocity).norm();
  if (is_surface(scene, other)) {
    const SurfaceMotion& motion = scene.surfaces[touched_surface(other)].motion;
    return (velocity - motion.velocity(0, scene.initial[index(body)].position)).norm();
  }
  const bool moves = other == kFloor || scene.box->moving_walls;
  return (velocity - Vector3(0, 0, moves ? scene.box->floor.velocity(0) : 0)).norm();
}

}  // namespace

const PairContact& pair_contact(const Scene& scene, int body, int other) {
  if (other >= 0) return scene.between(index(body), index(other));
  if (is_surface(scene, other)) return scene.on_surface(index(body), touched_surface(other)).impact;
  const Box& box = *scene.box;
  const auto& contacts =
      other == kFloor ? box.on_floor : (other == kWall ? box.on_wall : box.on_lid);
  return contacts[scene.material[index(body)]];
}

const SubstrateContact* lasting_contact(const Scene& scene, int body, int other) {
  if (is_substrate(scene, other)) return &scene.on_substrate(index(body));
  if (!is_surface(scene, other)) return nullptr;
  return &scene.on_surface(index(body), touched_surface(other)).lasting;
}

ContactValues exact_values(const Scene& scene, int body, int other, const ContactMotion& motion,
                           SlipRule rule) {
  const SubstrateContact* ground = lasting_contact(scene, body, other);
  if (!ground) {
    const PairContact& pair = pair_contact(scene, body, other);
    return {friction_of(pair), restitution_at(pair.restitution, motion.approach), 0, 0};
  }
  const Sphere& sphere = scene.bodies[index(body)];
  const bool told_apart = rule == SlipRule::told_apart;
  const bool sticks = told_apart && !motion.slips;
  const bool rolls = !told_apart || ground->rolling_while_sliding || !motion.slips;
  const double mu_r = rolls ? ground->rolling(motion.speed) : 0;
  ContactValues values{sticks ? ground->static_friction : ground->kinetic_friction,
                       ground->restitution, (1 + sphere.shape_factor) * mu_r * sphere.radius,
                       ground->drilling_length};
  if (is_surface(scene, other)) {
    const PairContact& impact = pair_contact(scene, body, other);
    values.restitution = restitution_at(impact.restitution, motion.approach);
    if (impact.tangential_restitution == -1) values.friction = 0;
  }
  return values;
}

ContactValues typed_values(const Scene& scene, int body, int other) {
  const SubstrateContact* ground = lasting_contact(scene, body, other);
  if (!ground) {
    const PairContact& pair = pair_contact(scene, body, other);
    return {std::get<double>(pair.friction),
            one_restitution(pair.restitution, speed_at_start(scene, body, other)), 0, 0};
  }
  ContactValues values{ground->kinetic_friction, ground->restitution,
                       ground->rolling.points().front().coefficient, ground->drilling_length};
  if (is_surface(scene, other))
    values.restitution = one_restitution(pair_contact(scene, body, other).restitution,
                                         speed_at_start(scene, body, other));
  return values;
}

double slip_stopped_in(const Scene& scene, int body, int other, double onto, double time_step) {
  return (1 + scene.bodies[index(body)].inverse_shape_factor()) *
         lasting_contact(scene, body, other)->kinetic_friction * onto * time_step;
}

}  // namespace slipcheck::peer
