// The loop over candidates of gas_visit.cpp; included once for each instruction set.
#if defined(SLIPCHECK_GAS_VISIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GAS_VISIT_INL_H
#undef SLIPCHECK_GAS_VISIT_INL_H
#else
#define SLIPCHECK_GAS_VISIT_INL_H
#endif

#include <hwy/highway.h>

#include <numbers>

#include "reference/gas/gas_visit.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using GasTag = HWY_CAPPED(double, kGasGroup);
using GasBits = hn::RebindToUnsigned<GasTag>;
using GasVector = hn::Vec<GasTag>;
using GasWords = hn::Vec<GasBits>;

HWY_INLINE GasWords next_words(GasRandom& random, std::size_t lane) {
  const GasBits bits;
  std::uint64_t *pa = &random.state[0][lane], *pb = &random.state[1][lane];
  std::uint64_t *pc = &random.state[2][lane], *pd = &random.state[3][lane];
  GasWords a = hn::Load(bits, pa), b = hn::Load(bits, pb);
  GasWords c = hn::Load(bits, pc), d = hn::Load(bits, pd);
  const GasWords words = hn::Add(hn::RotateRight<41>(hn::Add(a, d)), a);
  const GasWords t = hn::ShiftLeft<17>(b);
  c = hn::Xor(c, a);
  d = hn::Xor(d, b);
  b = hn::Xor(b, c);
  a = hn::Xor(a, d);
  hn::Store(a, bits, pa);
  hn::Store(b, bits, pb);
  hn::Store(hn::Xor(c, t), bits, pc);
  hn::Store(hn::RotateRight<19>(d), bits, pd);
  return words;
}

/// The first bits of each word as a number in [1, 2).
HWY_INLINE GasVector from_one(GasWords words) {
  const GasTag d;
  const GasBits bits;
  const GasWords one = hn::Set(bits, 0x3ff0000000000000);
  return hn::BitCast(d, hn::Or(hn::ShiftRight<12>(words), one));
}

template <std::size_t kSize>
struct Components {
  GasVector at[kSize];
};

/// h = 2 (g·k) k, k the unit vector from the first to the second at contact, k·g > 0 as likely as
/// the flux along it. `words` has 43 random bits that nothing else has used.
///
/// Three dimensions: k is along g/|g| + s with s evenly on the unit sphere (Lambert's law), so
/// h = g + |g| s. s = (ρ cos α, ρ sin α, z), z even in (−1, 1); α = 2x or π + 2x, |x| < π/4, with
/// tan x from its continued fraction, right to 1e-9, and s of length 1 to rounding.
/// Two: the impact parameter b is even in (−1, 1), and k = a g/|g| + b g⊥/|g|, a = √(1 − b²).
template <std::size_t kD>
HWY_INLINE Components<kD> twice_normal(const Components<kD>& g, GasVector g2, GasWords words) {
  const GasTag d;
  const auto number = [&](double x) { return hn::Set(d, x); };
  const GasVector one = number(1);
  const GasVector b = from_one(hn::ShiftLeft<21>(words));
  const GasVector z = hn::Sub(hn::Add(b, b), number(3));
  const GasVector rest = hn::Sub(one, hn::Mul(z, z));
  if constexpr (kD == 2) {
    const GasVector a = hn::Sqrt(rest), ab = hn::Mul(a, z);
    const auto twice = [](GasVector x) { return hn::Add(x, x); };
    return {twice(hn::Sub(hn::Mul(rest, g.at[0]), hn::Mul(ab, g.at[1]))),
            twice(hn::Add(hn::Mul(rest, g.at[1]), hn::Mul(ab, g.at[0])))};
  } else {
    // 22 bits of the angle; half of the last one makes it even about its middle.
    const GasVector t = from_one(hn::ShiftLeft<42>(words));
    const GasVector x = hn::Mul(hn::Sub(t, number(1.5 - 0x1p-23)), number(0.5 * std::numbers::pi));
    const GasVector y = hn::Mul(x, x);
    const GasVector p = hn::Mul(x, hn::Add(number(945), hn::Mul(y, hn::Sub(y, number(105)))));
    const GasVector q =
        hn::Add(number(945), hn::Mul(y, hn::Sub(hn::Mul(number(15), y), number(420))));
    const GasVector pp = hn::Mul(p, p), qq = hn::Mul(q, q), pq = hn::Mul(p, q);
    // The side on which α lies is the last bit: the sign of ρ.
    const GasVector size = hn::Sqrt(g2);
    const GasVector sign = hn::BitCast(d, hn::ShiftLeft<63>(words));
    const GasVector rho = hn::Xor(hn::Div(hn::Mul(size, hn::Sqrt(rest)), hn::Add(pp, qq)), sign);
    return {hn::Add(g.at[0], hn::Mul(rho, hn::Sub(qq, pp))),
            hn::Add(g.at[1], hn::Mul(rho, hn::Add(pq, pq))), hn::Add(g.at[2], hn::Mul(size, z))};
  }
}

/// The law of a vector of pairs; `kConstant`: e, β0 and μ are numbers.
template <bool kConstant>
class BounceOfLanes {
 public:
  explicit BounceOfLanes(const GasLaw& law) : law_(law) {}

  /// e and η where `accepted`, at the speeds of the contact point.
  HWY_INLINE void operator()(hn::Mask<GasTag> accepted, GasVector u_n, GasVector u_t, GasVector& e,
                             GasVector& stick) const {
    const GasTag d;
    if constexpr (kConstant) {
      const double restitution = std::get<double>(law_.hard.restitution);
      const double friction = std::get<double>(law_.hard.friction);
      e = hn::Set(d, restitution);
      const GasVector cap = hn::Set(d, 0.5 * friction * (1 + restitution));
      const GasVector slow = hn::Set(d, 1e-300);
      stick =
          hn::Min(hn::Set(d, law_.largest_stick()), hn::Div(hn::Mul(cap, u_n), hn::Max(u_t, slow)));
    } else {
      alignas(64) double normal[kGasGroup], tangential[kGasGroup], here[kGasGroup] = {};
      hn::Store(u_n, d, normal);
      hn::Store(u_t, d, tangential);
      hn::Store(hn::IfThenElseZero(accepted, hn::Set(d, 1)), d, here);
      for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
        if (here[k] == 0) continue;
        const GasBounce bounce = law_.at(normal[k], tangential[k]);
        normal[k] = bounce.restitution;
        tangential[k] = bounce.stick;
      }
      e = hn::Load(d, normal);
      stick = hn::Load(d, tangential);
    }
  }

 private:
  const GasLaw& law_;
};

template <std::size_t kD, bool kSpins, bool kConstant>
HWY_ATTR void visit_lanes(const GasLaw& law, double shape_factor, GasRandom& random,
                          GasVisit& visit) {
  constexpr std::size_t kS = !kSpins ? 0 : kD == 3 ? 3 : 1;
  constexpr std::size_t kStride = kGasGroup * (kD + kS);
  const GasTag d;
  const GasBits bits;
  const std::size_t lanes = hn::Lanes(d);
  const BounceOfLanes<kConstant> bounce(law);
  const GasVector fastest = hn::Set(d, visit.majorant * visit.majorant);
  const GasVector by_shape = hn::Set(d, 1 / shape_factor);
  GasVector overtaken = hn::Zero(d);
  GasVector collided = hn::Zero(d);
  const GasVector one = hn::Set(d, 1);
  const std::size_t count = visit.groups.size();
  std::array<std::uint64_t, kGasGroup> picks{};
  for (std::size_t m = 0; m < visit.candidates; ++m) {
    if (m % kGasGroup == 0) picks = random.next();
    const std::uint64_t pick = picks[m % kGasGroup];
    const std::size_t a = ((pick & 0xffffffff) * count) >> 32;
    std::size_t b = (((pick >> 32) & 0x1fffffff) * (count - 1)) >> 29;
    b += b >= a;
    const std::size_t facing = pick >> 61;
    double* const first = visit.particles + visit.groups[a] * kStride;
    double* const second = visit.particles + visit.groups[b] * kStride;
    const auto turn =
        hn::IndicesFromVec(bits, hn::Xor(hn::Iota(bits, 0), hn::Set(bits, facing & (lanes - 1))));
    for (std::size_t at = 0; at < kGasGroup; at += lanes) {
      double* const pi = first + at;
      double* const pj = second + (at ^ (facing & ~(lanes - 1)));
      const auto load = [&](const double* from, std::size_t c)
                            HWY_ATTR { return hn::Load(d, from + c * kGasGroup); };
      const auto faced = [&](GasVector v) HWY_ATTR {
        return hn::BitCast(d, hn::TableLookupLanes(hn::BitCast(bits, v), turn));
      };
      Components<kD> vi, vj, g;
      GasVector g2 = hn::Zero(d);
      for (std::size_t c = 0; c < kD; ++c) {
        vi.at[c] = load(pi, c);
        vj.at[c] = faced(load(pj, c));
        g.at[c] = hn::Sub(vi.at[c], vj.at[c]);
        g2 = hn::Add(g2, hn::Mul(g.at[c], g.at[c]));
      }
      const GasWords words = next_words(random, at);
      const GasVector u = hn::Sub(from_one(words), hn::Set(d, 1 - 0x1p-53));
      const auto accepted = hn::Lt(hn::Mul(hn::Mul(u, u), fastest), g2);
      overtaken = hn::Add(overtaken, hn::IfThenElseZero(hn::Gt(g2, fastest), one));
      collided = hn::Add(collided, hn::IfThenElseZero(accepted, one));
      const Components<kD> h = twice_normal<kD>(g, g2, words);

      GasVector e = one, stick = hn::Zero(d);
      if constexpr (!kSpins && kConstant) {
        e = hn::Set(d, std::get<double>(law.hard.restitution));
        const GasVector part =
            hn::IfThenElseZero(accepted, hn::Mul(hn::Set(d, 0.25), hn::Add(one, e)));
        for (std::size_t c = 0; c < kD; ++c) {
          const GasVector impulse = hn::Mul(part, h.at[c]);
          hn::Store(hn::Sub(vi.at[c], impulse), d, pi + c * kGasGroup);
          hn::Store(faced(hn::Add(vj.at[c], impulse)), d, pj + c * kGasGroup);
        }
        continue;
      }
      GasVector h2 = hn::Zero(d);
      for (std::size_t c = 0; c < kD; ++c) h2 = hn::Add(h2, hn::Mul(h.at[c], h.at[c]));
      const GasVector h_size = hn::Sqrt(h2);
      const GasVector u_n = hn::Mul(hn::Set(d, 0.5), h_size);
      // The slip of the contact point, u_t = g − (g·k) k + W×k, W the sum of both w.
      Components<kD> k, slip;
      GasVector u_t = hn::Zero(d);
      Components<kS + 1> wi, wj, sum;
      if constexpr (kSpins) {
        const GasVector to_unit = hn::Div(one, hn::Max(h_size, hn::Set(d, 1e-300)));
        for (std::size_t c = 0; c < kD; ++c) {
          k.at[c] = hn::Mul(to_unit, h.at[c]);
          slip.at[c] = hn::Sub(g.at[c], hn::Mul(hn::Set(d, 0.5), h.at[c]));
        }
        for (std::size_t c = 0; c < kS; ++c) {
          wi.at[c] = load(pi, kD + c);
          wj.at[c] = faced(load(pj, kD + c));
          sum.at[c] = hn::Add(wi.at[c], wj.at[c]);
        }
        if constexpr (kD == 2) {
          slip.at[0] = hn::Sub(slip.at[0], hn::Mul(sum.at[0], k.at[1]));
          slip.at[1] = hn::Add(slip.at[1], hn::Mul(sum.at[0], k.at[0]));
        } else {
          for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t x = (c + 1) % 3, y = (c + 2) % 3;
            slip.at[c] = hn::Add(slip.at[c],
                                 hn::Sub(hn::Mul(sum.at[x], k.at[y]), hn::Mul(sum.at[y], k.at[x])));
          }
        }
        for (std::size_t c = 0; c < kD; ++c) u_t = hn::Add(u_t, hn::Mul(slip.at[c], slip.at[c]));
        u_t = hn::Sqrt(u_t);
      }
      bounce(accepted, u_n, u_t, e, stick);
      const GasVector part =
          hn::IfThenElseZero(accepted, hn::Mul(hn::Set(d, 0.25), hn::Add(one, e)));
      stick = hn::IfThenElseZero(accepted, stick);
      for (std::size_t c = 0; c < kD; ++c) {
        GasVector impulse = hn::Mul(part, h.at[c]);
        if constexpr (kSpins) impulse = hn::Add(impulse, hn::Mul(stick, slip.at[c]));
        hn::Store(hn::Sub(vi.at[c], impulse), d, pi + c * kGasGroup);
        hn::Store(faced(hn::Add(vj.at[c], impulse)), d, pj + c * kGasGroup);
      }
      if constexpr (kSpins) {
        // Δw = −(η/q) k×u_t of both.
        const GasVector turned = hn::Mul(stick, by_shape);
        for (std::size_t c = 0; c < kS; ++c) {
          const std::size_t x = kD == 2 ? 0 : (c + 1) % 3, y = kD == 2 ? 1 : (c + 2) % 3;
          const GasVector change =
              hn::Mul(turned, hn::Sub(hn::Mul(k.at[x], slip.at[y]), hn::Mul(k.at[y], slip.at[x])));
          hn::Store(hn::Sub(wi.at[c], change), d, pi + (kD + c) * kGasGroup);
          hn::Store(faced(hn::Sub(wj.at[c], change)), d, pj + (kD + c) * kGasGroup);
        }
      }
    }
  }
  alignas(64) double counts[2][kGasGroup] = {};
  hn::Store(collided, d, counts[0]);
  hn::Store(overtaken, d, counts[1]);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    visit.collisions += static_cast<std::size_t>(counts[0][lane]);
    visit.overtaken += static_cast<std::size_t>(counts[1][lane]);
  }
}

template <std::size_t kD>
HWY_INLINE GasSquares squares_of_lanes(const GasLayout& layout, const GasVisit& visit) {
  const GasTag d;
  GasVector most = hn::Zero(d);
  alignas(64) double sums[kGasGroup];
  for (std::size_t at = 0; at < kGasGroup; at += hn::Lanes(d)) {
    GasVector sum = hn::Zero(d);
    for (const std::uint32_t group : visit.groups) {
      const double* from = visit.particles + group * layout.stride() + at;
      GasVector v2 = hn::Zero(d);
      for (std::size_t c = 0; c < kD; ++c) {
        const GasVector v = hn::Load(d, from + c * kGasGroup);
        v2 = hn::Add(v2, hn::Mul(v, v));
      }
      most = hn::Max(most, v2);
      sum = hn::Add(sum, v2);
    }
    hn::Store(sum, d, sums + at);
  }
  GasSquares squares{hn::GetLane(hn::MaxOfLanes(d, most)), 0};
  for (const double sum : sums) squares.sum += sum;
  return squares;
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
