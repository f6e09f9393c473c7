#include "peer_backends/ode/ode_contacts.h"

#include <algorithm>

namespace slipcheck::ode {
namespace {

Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

/// A length that gets no row of its own at 0: a row without an axis would have no limits.
double row_or_none(double length) { return length > 0 ? length : -1; }

}  // namespace

ContactRules::ContactRules(const Scene& scene, const OdeSettings& settings, double time_step)
    : scene_(scene), settings_(settings), time_step_(time_step) {}

peer::ContactValues ContactRules::values(int body, int other,
                                         const peer::ContactMotion& motion) const {
  if (settings_.coefficients == CoefficientMap::fields)
    return peer::typed_values(scene_, body, other);
  const bool told_apart = settings_.coefficients == CoefficientMap::pair_and_slip;
  return peer::exact_values(scene_, body, other, motion,
                            told_apart ? peer::SlipRule::told_apart : peer::SlipRule::ignored);
}

void ContactRules::fill(dContact& contact, const Ball& ball, const Partner& partner) const {
  const BodyState &first = ball.state, &second = partner.state;
  const int body = ball.index, other = partner.index;
  const Vector3 point = to_vector(contact.geom.pos), normal = to_vector(contact.geom.normal);
  Vector3 slip =
      first.velocity + first.angular_velocity.cross(point - first.position) - second.velocity;
  if (other >= 0) slip -= second.angular_velocity.cross(point - second.position);
  const double approach = -normal.dot(slip);
  slip += approach * normal;
  Vector3 motion = first.velocity - second.velocity;
  motion -= motion.dot(normal) * normal;
  const Vector3 pull = scene_.gravity_vector();

  peer::ContactMotion seen{std::max(0.0, approach), motion.norm(), true};
  bool slides = true;
  if (peer::lasting_contact(scene_, body, other)) {
    const double onto = std::max(0.0, -normal.dot(pull));
    slides = slip.norm() > peer::slip_stopped_in(scene_, body, other, onto, time_step_);
    seen.slips = slides || ball.hit;
    // A face at rest moves by rounding alone, and on a diagonal a pyramid holds up to √2 too much.
    if (!slides && scene_.bodies[static_cast<std::size_t>(body)].shape == Shape::block)
      motion = pull - pull.dot(normal) * normal;
  }
  const peer::ContactValues numbers = values(body, other, seen);

  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactBounce | (settings_.approx1 ? dContactApprox1 : 0);
  surface.mu = numbers.friction;
  surface.bounce = numbers.restitution;
  surface.bounce_vel = settings_.bounce_vel;
  if (numbers.rolling > 0 || numbers.drilling > 0) {
    surface.mode |= dContactRolling | dContactMu2;
    surface.mu2 = numbers.friction;
    surface.rho = surface.rho2 = row_or_none(numbers.rolling);
    surface.rhoN = row_or_none(numbers.drilling);
  }
  direct(contact, other, slides ? slip : Vector3::Zero(), motion,
         other < 0 ? second.velocity : Vector3::Zero());
}

void ContactRules::direct(dContact& contact, int other, const Vector3& slip, const Vector3& motion,
                          const Vector3& surface) const {
  const bool along_motion = settings_.friction_direction == FrictionDirection::motion;
  const bool moves = other < 0 && surface != Vector3::Zero();
  if (!along_motion && !moves) return;
  const Vector3& wanted = slip != Vector3::Zero() ? slip : motion;
  Vector3 first;
  if (along_motion && wanted.squaredNorm() > 0) {
    first = wanted.normalized();
  } else {
    dVector3 p, q;
    dPlaneSpace(contact.geom.normal, p, q);
    first = to_vector(p);
  }
  contact.surface.mode |= dContactFDir1;
  for (int k = 0; k < 3; ++k) contact.fdir1[k] = first[k];
  if (!moves) return;
  const Vector3 normal = to_vector(contact.geom.normal), second = normal.cross(first);
  contact.surface.mode |= dContactMotion1 | dContactMotion2 | dContactMotionN;
  contact.surface.motion1 = surface.dot(first);
  contact.surface.motion2 = surface.dot(second);
  contact.surface.motionN = surface.dot(normal);
}

}  // namespace slipcheck::ode
