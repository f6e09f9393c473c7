#pragma once

#include <cstddef>

#include "physics/contact/linear_contact.h"

namespace slipcheck {

/// The linear contact ξ̈ + γ ξ̇ + ω0² ξ = 0 that ends where its force is zero (LinearContact,
/// zero_force), as the engines with compliant contacts word it.
///
/// MuJoCo: without other forces a contact obeys ξ̈ = −d B ξ̇ − d² K ξ, d the impedance (solimp),
/// where d is constant (solimp d d …), with B = 2/(d timeconst), K = 1/(d timeconst dampratio)²,
/// or, given as negative numbers, B = damping/d, K = stiffness/d² (MuJoCo's documentation, "Solver
/// parameters"). So d drops out, and the masses do:
///   γ = 2/timeconst = damping,  ω0 = 1/(timeconst dampratio) = √stiffness.

/// A pair `solref`: (timeconst [s], dampratio [-]), both > 0, or (−stiffness [1/s²], −damping
/// [1/s]), both <= 0.
struct SolRef {
  double first = 0, second = 0;
};

/// The positive form; γ > 0, else there is none and both are infinite and 0.
SolRef time_solref(const LinearContact& contact);
/// The negative form.
SolRef stiffness_solref(const LinearContact& contact);

/// What MuJoCo makes of a solref in steps of `time_step` [s], > 0: with `refsafe`, its default, a
/// timeconst below 2 time_step is taken for that; the negative form is left as it is.
/// reduced_mass [kg] > 0 only sets stiffness() of the result.
LinearContact contact_of_solref(const SolRef& solref, double reduced_mass, double time_step);

/// ODE's soft contact, and what Bullet makes of a contact stiffness k [N/m] and damping c [N s/m]
/// in steps of h [s]: ERP = h k/(h k + c), CFM = 1/(h k + c) [s/kg] (ODE manual, "Soft constraint";
/// btSequentialImpulseConstraintSolver::setupContactConstraint).
struct ErpCfm {
  double erp = 0, cfm = 0;
};
ErpCfm erp_cfm(const LinearContact& contact, double time_step);

/// c = γ m̄ [N s/m].
double damping_constant(const LinearContact& contact);

/// How an engine steps such a contact.
enum class ContactStep {
  force_at_start,  ///< MuJoCo, Euler: ξ̇' = ξ̇ + h min(0, −γ ξ̇ − ω0² ξ), where ξ > 0
  force_at_end,    ///< ODE: the same with ξ' and ξ̇' on the right, where ξ > 0
  foreseen,  ///< Bullet: as ODE; a gap that the step closes is a contact of ω0² + γ/h by its
             ///< overlap
};

/// Coefficients of restitution over the phase of the first contact in a step.
struct ReboundRange {
  double least = 0, median = 0, most = 0;
};

/// Of `phases` runs, >= 1, that meet at any speed, without gravity, in steps of `time_step` [s], >
/// 0: the recurrence of the engine's step, until they part. 0 where they do not within a million
/// steps.
ReboundRange rebounds(const LinearContact& contact, ContactStep step, double time_step,
                      std::size_t phases = 64);
/// The one that has passed `phase` of a step, in (0, 1), when it touches.
double rebound(const LinearContact& contact, ContactStep step, double time_step, double phase);

}  // namespace slipcheck
