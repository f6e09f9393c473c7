#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "reference/step_kernel.h"
#include "reference/step_loop.h"

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

/// Whether there are two bodies of these materials, which could meet.
bool can_meet(const HardScene& scene, std::size_t m, std::size_t n) {
  std::size_t in_m = 0, in_n = 0;
  for (std::size_t material : scene.material) {
    in_m += material == m;
    in_n += material == n;
  }
  return m == n ? in_m > 1 : in_m > 0 && in_n > 0;
}

bool is_plain(const HardScene& scene) {
  if (!scene.motion.is_still() || !scene.downhill.isZero(0)) return false;
  for (std::size_t material : scene.material) {
    const SubstrateContact& c = scene.substrate[material];
    if (!c.rolling.is_zero() || c.drilling_length > 0 || c.coupled_radius > 0) return false;
  }
  return true;
}

template <class Normal, class Tangential_>
std::unique_ptr<StepKernel> make(std::vector<StepLaw<Normal, Tangential_>> laws,
                                 const HardScene& scene) {
  if (is_plain(scene))
    return std::make_unique<StepLoop<Normal, Tangential_, PlainSubstrate>>(
        std::move(laws), scene.material, scene.substrate.size());
  return std::make_unique<StepLoop<Normal, Tangential_, FullSubstrate>>(
      std::move(laws), scene.material, scene.substrate.size());
}

}  // namespace

std::unique_ptr<StepKernel> make_step_kernel(const ContactScene& scene) {
  const HardScene& hard = scene.hard;
  const std::size_t materials = hard.substrate.size();
  const SoftContact* some = nullptr;
  bool mixed = false;
  for (std::size_t m = 0; m < materials; ++m)
    for (std::size_t n = 0; n <= m; ++n) {
      if (!can_meet(hard, m, n)) continue;
      const std::optional<SoftContact>& contact = scene.soft[m * materials + n];
      if (!contact)
        throw Unsupported(
            "steps of fixed length need soft contacts between all bodies that can "
            "meet; a hard one happens at an instant");
      mixed |= some && (some->normal.index() != contact->normal.index() ||
                        tangential_of(*some).index() != tangential_of(*contact).index());
      some = &*contact;
    }
  // One body alone: any law will do.
  const SoftContact none{LinearForce{}, ContactEnd::zero_overlap, NoTangentialForce{}};
  if (!some) some = &none;

  const auto laws = [&](auto example, const auto& law_of) {
    std::vector<decltype(example)> table(materials * materials, example);
    for (std::size_t k = 0; k < table.size() && k < scene.soft.size(); ++k)
      if (const std::optional<SoftContact>& contact = scene.soft[k];
          contact && can_meet(hard, k / materials, k % materials)) {
        table[k] = law_of(*contact);
        table[k].clamped = contact->end == ContactEnd::zero_force;
      }
    return table;
  };
  if (mixed) {
    using Law = StepLaw<AnyNormalForce, AnyPair>;
    return make(laws(Law{},
                     [](const SoftContact& contact) {
                       return Law{{contact.normal}, {tangential_of(contact)}, false};
                     }),
                hard);
  }
  return std::visit(
      [&](const auto& normal, const auto& tangential) {
        using Normal = std::decay_t<decltype(normal)>;
        using Surface = std::decay_t<decltype(tangential)>;
        using Law = StepLaw<Normal, Surface>;
        return make(laws(Law{normal, tangential, false},
                         [](const SoftContact& contact) {
                           return Law{std::get<Normal>(contact.normal),
                                      std::get<Surface>(tangential_of(contact)), false};
                         }),
                    hard);
      },
      some->normal, tangential_of(*some));
}

}  // namespace slipcheck
