// What the contacts of a scene are in MuJoCo's terms. A contact is a soft constraint,
//   a + d (b v + k x) = (1 - d) a0,
// with the impedance d of solimp and b, k of solref (mj_makeImpedance in
// engine_core_constraint.c); there is no coefficient of restitution, solref makes one.

import {
  FLOOR,
  contactOf,
  frictionOf,
  groundOf,
  lastingOf,
  pairRestitution,
  restitutionAt,
  rollingAt,
  rollingLength,
  surfaceRestitution,
} from '../../kit/contacts.mjs';
import { contactTime, dampingRatioOf } from '../../kit/contact_spring.mjs';

/// What a contact's coefficients are in MuJoCo's terms.
class ReboundRule {
  constructor(settings, timeStep) {
    this.settings = settings;
    this.timeStep = timeStep;
  }

  /// solref for a coefficient of restitution. In its negative form it is -k d, -b d for d the
  /// impedance, which is taken for that of an overlap beyond the width: ω² = -solref[0]/d, 2 ζ ω =
  /// -solref[1].
  solref(e) {
    const { restitution, time_constant, damping_ratio, impedance } = this.settings;
    if (restitution === 'one_step') return this.#inOneStep(e);
    if (restitution === 'none' || e === 0) return [time_constant, damping_ratio];
    const zeta = dampingRatioOf(e);
    const omega = this.#frequency(zeta);
    return [-impedance * omega * omega, -2 * zeta * omega];
  }

  /// Of the rows of friction; only an elliptic cone has them by themselves. Slip decays over
  /// slip_time, or one step stops it or turns u into -β0 u.
  solrefFriction(beta0) {
    const { restitution, slip_time } = this.settings;
    if (restitution !== 'one_step') return [0, 0];
    if (slip_time > this.timeStep) return [0, -1 / slip_time];
    return [0, -(1 + Math.max(beta0, 0)) / this.timeStep];
  }

  /// v' = v - d dt b v = -e v.
  #inOneStep(e) {
    const { overlap_push, impedance } = this.settings;
    return [(-impedance * overlap_push) / this.timeStep ** 2, -(1 + e) / this.timeStep];
  }

  /// ω by the shipped k = 1/(d time_constant damping_ratio)², or by the duration of the rebound.
  #frequency(zeta) {
    const { contact_steps, time_constant, damping_ratio, impedance } = this.settings;
    if (contact_steps > 0 && zeta < 1) return contactTime(zeta) / (contact_steps * this.timeStep);
    return 1 / (Math.sqrt(impedance) * time_constant * damping_ratio);
  }
}

/// What MuJoCo takes for a contact: rows, their coefficients and how they answer.
export class ContactTerms {
  constructor(scene, settings, timeStep) {
    this.scene = scene;
    this.settings = settings;
    this.rule = new ReboundRule(settings, timeStep);
  }

  /// Between a body and another or a surface; the numbers of a law are those at these speeds [m/s].
  of(i, j, speeds = {}) {
    const { friction, drilling, rolling, restitution, beta0 } = this.#coefficients(i, j, speeds);
    return {
      condim: this.#condim(friction, drilling, rolling),
      friction: [friction, friction, drilling, rolling, rolling],
      solref: this.rule.solref(restitution),
      solreffriction: this.rule.solrefFriction(beta0),
      restitution,
    };
  }

  isOnSubstrate(j) {
    return j === FLOOR && !this.scene.box;
  }

  /// That or a surface beside it: where a body may lie.
  isOnGround(j) {
    return j < 0 && !this.scene.box;
  }

  restitutionLaw(i, j) {
    return this.isOnSubstrate(j)
      ? groundOf(this.scene, i).restitution
      : contactOf(this.scene, i, j).restitution;
  }

  #coefficients(i, j, { approach, along = 0 }) {
    const { scene } = this;
    if (this.isOnSubstrate(j)) {
      const { kinetic_friction, drilling_length, rolling, restitution } = groundOf(scene, i);
      return {
        friction: kinetic_friction,
        drilling: drilling_length,
        rolling: rollingLength(scene.bodies[i], rollingAt(rolling, along)),
        restitution,
        beta0: 0,
      };
    }
    const contact = contactOf(scene, i, j);
    const atStart = () => (j < 0 ? surfaceRestitution(scene, i, j) : pairRestitution(scene, i, j));
    const restitution =
      approach === undefined ? atStart() : restitutionAt(contact.restitution, approach);
    const lasting = this.isOnGround(j) ? lastingOf(scene, i, j) : undefined;
    const isSmooth = frictionOf(contact) === 0 && contact.friction > 0;
    return {
      friction: lasting && !isSmooth ? lasting.kinetic_friction : frictionOf(contact),
      drilling: lasting?.drilling_length ?? 0,
      rolling: lasting ? rollingLength(scene.bodies[i], rollingAt(lasting.rolling, along)) : 0,
      restitution,
      beta0: contact.tangential_restitution,
    };
  }

  #condim(friction, drilling, rolling) {
    if (this.settings.condim !== 'by_need') return Number(this.settings.condim);
    if (rolling > 0) return 6;
    if (drilling > 0) return 4;
    return friction > 0 ? 3 : 1;
  }
}
