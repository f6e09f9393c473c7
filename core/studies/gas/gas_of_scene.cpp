#include "studies/gas/gas_of_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "reference/pair/pair_batch.h"
#include "scenario/contact_models.h"
#include "scenario/fault.h"
#include "scene/contact_maker.h"
#include "scene/contact_scene.h"
#include "scene/obstacles.h"

namespace slipcheck {
namespace {

// Of the speed at the start: ε^N and ε^T of slower and faster collisions are those of these.
constexpr double kSlowestOfMap = 1e-5, kFastestOfMap = 20;

double root_mean_square(const Scene& scene) {
  double sum = 0;
  for (const BodyState& state : scene.initial) sum += state.velocity.squaredNorm();
  return std::sqrt(sum / static_cast<double>(scene.initial.size()));
}

std::optional<double> speed_exponent_of(const NormalForce& force) {
  if (std::holds_alternative<HertzForce>(force)) return std::nullopt;  // e = 1
  return impact_scales(force, 1, 1).law.speed_exponent();
}

}  // namespace

GasOfScene gas_of_scene(const Scenario& scenario, std::optional<double> speed) {
  const ContactScene scene = make_contact_scene(scenario);
  const SceneOutline outline = make_outline(scenario);
  const BodyClass& first = outline.classes[scene.hard.material[0]];
  const BodyContact* contact = find_contact(scenario, first.material, first.material);
  if (!contact)
    throw BadScenario({fault_of(
        scenario, "contacts",
        fmt::format("must have one between {0} and {0}: a gas is of the first body's kind",
                    first.material))});

  GasOfScene made;
  made.sphere = scene.hard.bodies[0];
  made.speed = root_mean_square(scene.hard);
  made.contact = contact->path;
  made.law = hard_gas(scene.hard.between(0, 0), made.sphere);
  const std::optional<SoftContact>& soft = scene.between(0, 0);
  const auto& e = made.law.hard.restitution;
  if (!soft) {
    const ContactMaker maker(scenario, *contact);
    if (std::holds_alternative<double>(e))
      made.speed_exponent = 0;
    else if (maker.is_viscoelastic_restitution() && !made.law.rough())
      made.speed_exponent = 0.2;
    return made;
  }
  made.soft = true;
  if (std::holds_alternative<NoTangentialForce>(soft->tangential)) {
    made.speed_exponent = speed_exponent_of(soft->normal);
    return made;
  }
  if (!can_batch(*soft)) {
    Obstacles obstacles(scenario);
    obstacles.add(contact->path + ".tangential",
                  "has no map of restitution coefficients beside this normal model", "power");
    obstacles.throw_any();
  }
  const double v = speed.value_or(made.speed);
  if (v > 0) made.law.map.emplace(*soft, made.sphere, kSlowestOfMap * v, kFastestOfMap * v);
  return made;
}

}  // namespace slipcheck
