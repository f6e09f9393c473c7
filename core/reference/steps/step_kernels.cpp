#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "reference/steps/grain_loop.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_kernel.h"
#include "reference/steps/step_laws.h"
#include "reference/steps/step_loop.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

using Tangential = std::variant<SmoothPair, ViscousPair, PrintedAsperityPair, PassiveAsperityPair>;

Tangential tangential_of(const SoftContact& contact) {
  return std::visit(
      [](const auto& law) -> Tangential {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (std::is_same_v<Law, ViscousForce>)
          return ViscousPair{law};
        else if constexpr (std::is_same_v<Law, AsperityForce>) {
          if (law.form == AsperityForce::Form::passive) return PassiveAsperityPair{law};
          return PrintedAsperityPair{law};
        } else {
          return SmoothPair{};
        }
      },
      contact.tangential);
}

/// Whether there are two bodies of two rows, which could meet.
class CanMeet {
 public:
  explicit CanMeet(const Scene& scene) : in_(scene.row_count()) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) ++in_[scene.row_of(i)];
  }
  bool operator()(std::size_t m, std::size_t n) const {
    return in_[m] > 0 && in_[n] > (m == n ? 1u : 0u);
  }

 private:
  std::vector<std::size_t> in_;
};

bool is_plain(const Scene& scene) {
  if (!scene.motion.is_still() || !scene.downhill.isZero(0)) return false;
  return std::ranges::all_of(scene.material, [&](std::size_t material) {
    return is_coulomb_alone(scene.substrate[material]);
  });
}

/// Without friction, and so that no body leaves the plane: it may not, or nothing pushes it up.
bool is_bare(const ContactScene& contacts, std::span<const BodyState> initial) {
  const Scene& scene = contacts.hard;
  if (!is_plain(scene)) return false;
  for (std::size_t material : scene.material)
    if (scene.substrate[material].static_friction > 0) return false;
  if (scene.confined) return true;
  for (const auto* table : {&contacts.soft, &contacts.soft_surfaces})
    for (const auto& contact : *table)
      if (contact && !std::holds_alternative<NoTangentialForce>(contact->tangential)) return false;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].radius != scene.bodies[0].radius ||
        initial[i].position.z() != scene.bodies[i].radius || initial[i].velocity.z() != 0)
      return false;
  return true;
}

const char* name_of(const NormalForce& force) {
  static constexpr const char* kNames[] = {"linear normal force", "Hertz's normal force",
                                           "power law as normal force", "viscoelastic normal force",
                                           "compact viscoelastic normal force"};
  return kNames[force.index()];
}
const char* name_of(const Tangential& law) {
  static constexpr const char* kNames[] = {"no tangential force, no torque",
                                           "viscous tangential force with Coulomb's cap",
                                           "printed asperities", "passive asperities"};
  return kNames[law.index()];
}

bool is_of_grains(const ContactScene& scene, std::span<const BodyState> initial,
                  const StepSettings& settings) {
  const bool many = scene.hard.bodies.size() > settings.most_in_all_pairs;
  return !settings.general && (many || !scene.hard.periodic.isZero(0)) &&
         grain_refusal(scene, initial).empty();
}

using AnyLaw = StepLaw<AnyNormalForce, AnyPair>;

AnyLaw any_law(const SoftContact& contact) {
  return {{contact.normal}, {tangential_of(contact)}, contact.end == ContactEnd::zero_force};
}

std::unique_ptr<StepSurfaces> make_surfaces(const ContactScene& scene) {
  if (scene.hard.surfaces.empty()) return nullptr;
  std::vector<AnyLaw> laws;
  for (const std::optional<SoftContact>& contact : scene.soft_surfaces)
    laws.push_back(contact ? any_law(*contact) : AnyLaw{});
  return std::make_unique<StepSurfaces>(scene.hard, std::move(laws));
}

/// Throws where a contact that lasts is none of the fixed-step solver's.
void require_known(const SoftContact& contact) {
  if (std::holds_alternative<ImpactAngleForce>(contact.tangential))
    throw Unsupported(
        "steps of fixed length know no tangential model hard; compare.reference may be "
        "contact");
  if (caps_apart(contact.tangential))
    throw Unsupported("steps of fixed length know no caps apart; compare.reference may be contact");
}

void require_known_surfaces(const ContactScene& scene) {
  for (const Surface& surface : scene.hard.surfaces)
    if (!surface.motion.is_still())
      throw Unsupported(
          "steps of fixed length know no surfaces that move; compare.reference may be contact");
  for (std::size_t i = 0; i < scene.hard.bodies.size(); ++i)
    for (std::size_t s = 0; s < scene.hard.surfaces.size(); ++s) {
      if (scene.soft_surfaces.empty() || !scene.on_surface(i, s))
        throw Unsupported(
            "steps of fixed length need soft contacts with surfaces; a hard one happens at an "
            "instant");
      require_known(*scene.on_surface(i, s));
    }
}

template <class Normal, class Tangential_>
std::unique_ptr<StepKernel> make(StepLaws<Normal, Tangential_> laws, const ContactScene& contacts,
                                 std::span<const BodyState> initial, const StepSettings& settings,
                                 std::vector<std::string> features) {
  using Pairs = StepPairs<Normal, Tangential_>;
  const Scene& scene = contacts.hard;
  const std::size_t bodies = scene.bodies.size();
  std::unique_ptr<StepNeighbours> neighbours;
  if (bodies > settings.most_in_all_pairs || contacts.own || !scene.periodic.isZero(0))
    neighbours = std::make_unique<StepNeighbours>(scene.periodic,
                                                  sharing_threads(contacts, initial, settings));
  Pairs pairs = neighbours ? Pairs(std::move(laws)) : Pairs(std::move(laws), bodies);
  const auto loop = [&](auto substrate, const char* name) -> std::unique_ptr<StepKernel> {
    features.emplace_back(name);
    if (neighbours) features.emplace_back("many bodies: neighbours in cells by radius");
    if (contacts.own) features.emplace_back("each two bodies have a contact of their own");
    if (!scene.surfaces.empty()) features.emplace_back("surfaces at rest");
    return std::make_unique<StepLoop<Pairs, decltype(substrate)>>(
        std::move(pairs), std::move(neighbours), make_surfaces(contacts), std::move(features));
  };
  if (settings.general) return loop(FullSubstrate{}, "any substrate");
  if (is_bare(contacts, initial))
    return loop(BareSubstrate{}, "level, still substrate without friction or lift-off");
  if (is_plain(scene))
    return loop(PlainSubstrate{}, "level, still substrate with Coulomb friction");
  return loop(FullSubstrate{}, "any substrate");
}

}  // namespace

bool StepWorld::is_met(StepStop stop) const {
  if (touching > 0) return false;
  for (const StepBody& b : bodies) {
    if (!b.sticks) return false;
    if (stop == StepStop::rest &&
        (b.velocity.head<2>() != around.velocity || b.angular_velocity.z() != 0))
      return false;
  }
  return true;
}

std::size_t sharing_threads(const ContactScene& scene, std::span<const BodyState> initial,
                            const StepSettings& settings) {
  const std::size_t many =
      is_of_grains(scene, initial, settings) ? settings.grains_shared_from : settings.shared_from;
  return scene.hard.bodies.size() >= many ? settings.threads : 1;
}

std::unique_ptr<StepKernel> make_step_kernel(const ContactScene& scene,
                                             std::span<const BodyState> initial,
                                             const StepSettings& settings) {
  const Scene& hard = scene.hard;
  const bool general = settings.general;
  const std::size_t rows = hard.row_count();
  const CanMeet can_meet(hard);
  const SoftContact* some = nullptr;
  bool mixed = false;
  for (std::size_t m = 0; m < rows; ++m)
    for (std::size_t n = 0; n <= m; ++n) {
      if (!can_meet(m, n)) continue;
      const std::optional<SoftContact>& contact = scene.soft[m * rows + n];
      if (!contact)
        throw Unsupported(
            "steps of fixed length need soft contacts between all bodies that can "
            "meet; a hard one happens at an instant");
      require_known(*contact);
      mixed |= some && (some->normal.index() != contact->normal.index() ||
                        tangential_of(*some).index() != tangential_of(*contact).index());
      some = &*contact;
    }
  require_known_surfaces(scene);
  if (is_of_grains(scene, initial, settings))
    return std::make_unique<GrainLoop>(scene, sharing_threads(scene, initial, settings));
  // One body alone: any law will do.
  const SoftContact none{LinearForce{}, ContactEnd::zero_overlap, NoTangentialForce{}};
  if (!some) some = &none;

  if (mixed || general) {
    return make(StepLaws<AnyNormalForce, AnyPair>(scene, AnyLaw{}, can_meet, any_law), scene,
                initial, settings, {"any normal force", "any tangential force"});
  }
  return std::visit(
      [&](const auto& normal, const auto& tangential) {
        using Normal = std::decay_t<decltype(normal)>;
        using Rubbing = std::decay_t<decltype(tangential)>;
        using Law = StepLaw<Normal, Rubbing>;
        return make(
            StepLaws<Normal, Rubbing>(scene, Law{normal, tangential, false}, can_meet,
                                      [](const SoftContact& contact) {
                                        return Law{std::get<Normal>(contact.normal),
                                                   std::get<Rubbing>(tangential_of(contact)),
                                                   false};
                                      }),
            scene, initial, settings, {name_of(some->normal), name_of(tangential_of(*some))});
      },
      some->normal, tangential_of(*some));
}

}  // namespace slipcheck
