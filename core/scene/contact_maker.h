#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/hard_contact.h"
#include "scenario/scenario.h"
#include "scene/contact_scene.h"
#include "scene/restitution_curve.h"
#include "scene/scene_outline.h"

namespace slipcheck {

/// Two classes of bodies that can meet, or one and a surface of the box.
struct ClassPair {
  Sphere first, second;
  const Material& first_material;
  const Material& second_material;

  double mass() const { return effective_mass(first, second); }      ///< [kg]
  double radius() const { return effective_radius(first, second); }  ///< [m]
  /// ρ of Hertz [N/m^1.5]; the materials must have their elastic constants.
  double hertz() const;
  /// A of the pair [s] from that of each material, and the same constants.
  double dissipation(double first_time, double second_time) const;
};

/// The same bits in whichever order, by material and size.
ClassPair class_pair(const Scenario& scenario, const BodyClass& first, const BodyClass& second);

/// A class and a flat floor, wall or lid that does not give way, as the limit of a second sphere
/// without bounds in mass and radius: m_eff = m, R_eff = R, 1/κ = 1 + 1/q. It is as elastic and
/// viscous as the body's own material.
ClassPair surface_pair(const Scenario& scenario, const BodyClass& body);

/// Gives one contact of a scenario to each pair of classes that has it. What is the same for all of
/// them, a root or a curve, is found with the first; then several threads may ask.
class ContactMaker {
 public:
  /// Both must outlive the maker.
  ContactMaker(const Scenario& scenario, const BodyContact& contact)
      : scenario_(scenario), contact_(contact) {}

  const BodyContact& contact() const { return contact_; }
  bool is_soft() const { return !std::holds_alternative<HardNormal>(contact_.normal); }
  /// A hard one whose restitution is that of the viscoelastic law.
  bool is_viscoelastic_restitution() const;

  /// Throws BadScenario for a restitution that the law cannot reach, and for a damping beside which
  /// there is no elastic force.
  SoftContact soft(const ClassPair& pair) const;
  /// The same where two bodies that stand for these have been found to be within the bounds.
  SoftContact unchecked(const ClassPair& pair) const;
  /// The hard contact that comes closest to a soft one.
  PairContact hard_equivalent(const SoftContact& soft, const ClassPair& pair) const;
  PairContact hard(const ClassPair& pair) const;
  /// The law behind a hard restitution `viscoelastic`.
  static ViscoelasticForce hard_viscoelastic(const ClassPair& pair);

 private:
  ContactEnd end() const;
  /// What the contact remembers, where it does.
  std::optional<ContactMemory> memory(const NormalForce& normal, const ClassPair& pair) const;
  std::string written_place(std::initializer_list<const char*> keys) const;
  void check_stiffness(const SoftContact& made, const ClassPair& pair) const;
  void check_damping(const SoftContact& made, const ClassPair& pair) const;
  NormalForce normal(const HardNormal& model, const ClassPair& pair) const;
  NormalForce normal(const LinearNormal& model, const ClassPair& pair) const;
  NormalForce normal(const HertzNormal& model, const ClassPair& pair) const;
  NormalForce normal(const PowerNormal& model, const ClassPair& pair) const;
  NormalForce normal(const ViscoelasticNormal& model, const ClassPair& pair) const;
  /// Over the impact speed, of the normal law alone.
  RestitutionLaw restitution_of(const SoftContact& soft, const ClassPair& pair) const;
  NormalForce with_given_restitution(const NormalForce& force, const ClassPair& pair,
                                     double restitution, double speed) const;
  RestitutionCurve& curve(const ScaledLaw& law) const;

  const Scenario& scenario_;
  const BodyContact& contact_;
  mutable std::optional<double> dissipation_;  // D at the speed that the restitution is given for
  mutable std::optional<RestitutionCurve> curve_;  // one law for all pairs
};

}  // namespace slipcheck
