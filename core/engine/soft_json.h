#pragma once

#include <array>

#include "engine/alternatives_json.h"
#include "engine/contact_json.h"
#include "engine/engine_scene.h"

/// The fields of contacts that last in messages: a member `soft` of the scene.
namespace slipcheck {

template <>
inline constexpr std::array kNamesOf<ContactEnd> = {"zero_overlap", "zero_force"};
template <>
inline constexpr std::array kNamesOf<ViscousForce::Caps> = {"together", "apart"};
template <>
inline constexpr std::array kNamesOf<AsperityForce::Form> = {"printed", "passive"};

template <>
inline constexpr std::array kWordsOf<NormalForce> = {"linear", "hertz", "power", "viscoelastic",
                                                     "compact_viscoelastic"};
template <>
inline constexpr std::array kWordsOf<TangentialForce> = {"none", "viscous", "asperity",
                                                         "impact_angle"};

template <class Fields>
void describe(Fields& f, LinearForce& force) {
  f("stiffness", force.stiffness, kAboveZero);
  f("damping", force.damping, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, HertzForce& force) {
  f("modulus", force.modulus, kAboveZero);
}

template <class Fields>
void describe(Fields& f, PowerForce& force) {
  f("modulus", force.modulus, kAboveZero);
  f("viscosity", force.viscosity, kNotBelowZero);
  f("alpha", force.alpha, NumberRange{1});
  f("gamma", force.gamma, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, ViscoelasticForce& force) {
  f("modulus", force.modulus, kAboveZero);
  f("dissipation_time", force.dissipation_time, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, CompactViscoelasticForce& force) {
  f("modulus", force.modulus, kAboveZero);
  f("dissipation_time", force.dissipation_time, kNotBelowZero);
}

template <class Fields>
void describe(Fields&, NoTangentialForce&) {}

template <class Fields>
void describe(Fields& f, ViscousForce& force) {
  f("damping", force.damping, kNotBelowZero);
  f("friction", force.friction, kNotBelowZero);
  f("caps", force.caps);
}

template <class Fields>
void describe(Fields& f, AsperityForce& force) {
  f("friction", force.friction, kNotBelowZero);
  f("size", force.size, kAboveZero);
  f("form", force.form);
}

template <class Fields>
void describe(Fields& f, ImpactAngleForce& force) {
  f("friction", force.friction, kNotBelowZero);
  f("tangential_restitution", force.tangential_restitution, NumberRange{-1, 1});
  f("mass_ratio", force.mass_ratio, kAboveZero);
  describe_restitution(f, force.restitution);
}

template <>
inline constexpr std::array kNamesOf<SpringFriction::Form> = {"constant", "mindlin",
                                                              "mindlin_displacement"};

template <class Fields>
void describe(Fields& f, SpringFriction& spring) {
  f("form", spring.form);
  f("stiffness", spring.stiffness, kNotBelowZero);
  f("damping", spring.damping, kNotBelowZero);
  f("damping_ratio", spring.damping_ratio, kNotBelowZero);
  f("static_friction", spring.static_friction, kNotBelowZero);
  f("kinetic_friction", spring.kinetic_friction, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, SpringTorque& spring) {
  f("stiffness", spring.stiffness, kNotBelowZero);
  f("damping", spring.damping, kNotBelowZero);
  f("length", spring.length, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, ContactMemory& memory) {
  f("sliding", memory.sliding);
  f("rolling", memory.rolling);
  f("drilling", memory.drilling);
}

template <class Fields>
void describe(Fields& f, SoftContact& contact) {
  const auto law = [&](const char* key, auto& force) {
    f.object(key, [&](auto& fields) { describe_alternative(fields, "model", force); });
  };
  law("normal", contact.normal);
  law("tangential", contact.tangential);
  f("ends_at", contact.end);
  f("after_impact", contact.after_impact);
  f("memory", contact.memory);
}

/// A list with null where the contact is hard.
template <class Fields>
void describe_soft_list(Fields& f, const char* key,
                        std::vector<std::optional<SoftContact>>& contacts) {
  if constexpr (Fields::kReads) {
    contacts.clear();
    for (const JsonNode& item : f[key].items()) {
      auto& contact = contacts.emplace_back();
      if (!item.json().is_null()) contact = read_finite<SoftContact>(item);
    }
  } else {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& contact : contacts)
      list.push_back(contact ? message_json(*contact) : nlohmann::json());
    f(key, list);
  }
}

template <class Fields>
void describe(Fields& f, SoftContacts& soft) {
  describe_soft_list(f, "pairs", soft.pairs);
  describe_soft_list(f, "on_floor", soft.box.on_floor);
  describe_soft_list(f, "on_wall", soft.box.on_wall);
  describe_soft_list(f, "on_lid", soft.box.on_lid);
  const char* const on_surfaces = "on_surfaces";
  bool any = false;
  if constexpr (Fields::kReads)
    any = f.has(on_surfaces);
  else
    for (const auto& contact : soft.surfaces) any = any || contact;
  if (any) describe_soft_list(f, on_surfaces, soft.surfaces);
}

}  // namespace slipcheck
