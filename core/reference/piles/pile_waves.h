#pragma once

#include <algorithm>
#include <cstddef>

namespace slipcheck {

/// The order in which the lists of slabs act and their bodies move, over several steps. A list acts
/// on the bodies of its slab and the next, in each step after the even lists beside it where it is
/// an odd one; a slab is done when what acts on its bodies has.
///
/// For the next step a list waits for these two slabs alone. So a wave goes through the slabs for
/// each step, two slabs behind that of the step before, while what it meets is in the caches still.
/// (Wavefronts and trapezoids in time, as for stencils: Frigo & Strumpen, Proc. ICS 2005, 361.)
/// Slabs are shared out into blocks: each takes of every step what needs nothing of the block
/// beside, at such an end two lists less than of the step before; then what is left around the
/// ends.
class PileWaves {
 public:
  /// is_around: the last slab is beside the first; there are an even number of them.
  PileWaves(std::size_t slabs, bool is_around, std::size_t threads)
      : slabs_(static_cast<Slab>(slabs)),
        is_around_(is_around),
        blocks_(blocks_for(static_cast<Slab>(threads))) {}

  /// Steps that may be taken at once.
  std::size_t most_steps() const {
    if (slabs_ == 1) return 1;
    if (blocks_ == 1 && !is_around_) return kMostSteps;
    Slab least = slabs_;
    for (Slab k = 0; k < blocks_; ++k) least = std::min(least, begin(k + 1) - begin(k));
    return std::clamp<std::size_t>(static_cast<std::size_t>(least + 2) / 4, 1, kMostSteps);
  }

  /// Calls act(s, j) for each list and step j < steps, and done(s, j) for each slab.
  /// each(count, work) calls work(k) for all k < count, in any order or at the same time.
  /// steps: within most_steps(). Neither throws.
  template <class Each, class Act, class Done>
  void run(const Each& each, std::size_t steps, const Act& act, const Done& done) const {
    if (slabs_ == 1) {  // few bodies: the waves would be a twentieth of a step of two
      act(0, 0);
      done(0, 0);
      return;
    }
    const Slab later = 2 * (static_cast<Slab>(steps) - 1);
    const auto inner = [&](std::size_t block) {
      const Slab first = begin(static_cast<Slab>(block)), end = begin(static_cast<Slab>(block) + 1);
      const bool meets_one = exists(first - 1), meets_next = exists(end);
      wave(first, end + later, steps, act, done, [&](Slab less) -> Reach {
        const Slab from = meets_one ? first + less : first, to = meets_next ? end - less : end;
        return {from, to, meets_one ? from + 2 : from, meets_next ? to : to + 1};
      });
    };
    const auto outer = [&](std::size_t block) {
      const Slab end = begin(static_cast<Slab>(block) + 1);
      if (!exists(end)) return;
      wave(end, end + 2 * later, steps, act, done, [&](Slab more) -> Reach {
        return {end - more, end + more, end - more, end + more + 1};
      });
    };
    each(static_cast<std::size_t>(blocks_), inner);
    each(static_cast<std::size_t>(blocks_), outer);
  }

 private:
  using Slab = std::ptrdiff_t;
  /// More gain nothing (docs/performance.md).
  static constexpr std::size_t kMostSteps = 4;
  /// Slabs of a block that can take so many steps.
  static constexpr Slab kWideBlock = 4 * static_cast<Slab>(kMostSteps) - 2;

  /// Of one step, the even slabs s whose lists act, and those before which list s − 1 acts and
  /// slabs s − 1 and s are done: each from the first one to before the second.
  struct Reach {
    Slab own, own_end, before, before_end;
  };

  Slab blocks_for(Slab threads) const {
    if (threads == 1) return 1;
    const Slab least = std::min(threads, std::max<Slab>(1, slabs_ / 2));
    return std::clamp(slabs_ / kWideBlock, least, 2 * threads);
  }
  bool exists(Slab s) const { return is_around_ || (0 <= s && s < slabs_); }
  std::size_t number(Slab s) const {
    return static_cast<std::size_t>(is_around_ ? (s + slabs_) % slabs_ : s);
  }
  /// An even slab.
  Slab begin(Slab block) const {
    return block < blocks_ ? block * slabs_ / blocks_ / 2 * 2 : slabs_;
  }

  /// `reach` by twice the step.
  template <class Act, class Done, class ReachOf>
  void wave(Slab from, Slab to, std::size_t steps, const Act& act, const Done& done,
            const ReachOf& reach) const {
    for (Slab front = from; front <= to; front += 2)
      for (std::size_t j = 0; j < steps; ++j) {
        const Slab behind = 2 * static_cast<Slab>(j), s = front - behind;
        const Reach r = reach(behind);
        if (r.own <= s && s < r.own_end) act(number(s), j);
        if (s < r.before || s >= r.before_end) continue;
        if (exists(s - 1)) {
          act(number(s - 1), j);
          done(number(s - 1), j);
        }
        if (exists(s)) done(number(s), j);
      }
  }

  Slab slabs_;
  bool is_around_;
  Slab blocks_;
};

}  // namespace slipcheck
