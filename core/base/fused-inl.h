// a·b + c in one rounding, the same bits on every instruction set; included once for each.
#if defined(SLIPCHECK_FUSED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_FUSED_INL_H
#undef SLIPCHECK_FUSED_INL_H
#else
#define SLIPCHECK_FUSED_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

/// A sum, and what its rounding leaves out (Knuth).
struct ExactSum {
  HWY_ATTR HWY_INLINE ExactSum(double a, double b) : sum(a + b) {
    const double b_of_it = sum - a;
    left = (a - (sum - b_of_it)) + (b - b_of_it);
  }
  double sum, left;
};

/// What the rounding of the product a·b leaves out (Dekker, Veltkamp), if no part of it is beyond
/// what a double can be.
HWY_ATTR HWY_INLINE double LeftOfProduct(double a, double b, double product) {
  constexpr double kSplit = 0x1p27 + 1;
  const double a_up = kSplit * a, b_up = kSplit * b;
  const double a_high = a_up - (a_up - a), b_high = b_up - (b_up - b);
  const double a_low = a - a_high, b_low = b - b_high;
  return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

/// The same by sums of two: what is lost of them is rounded to odd, so that the last sum is the
/// only one that rounds (Boldo and Melquiond, IEEE Trans. Comput. 57, 462 (2008)). For numbers from
/// 1e-140 to 1e140 and zero.
HWY_ATTR HWY_INLINE double FusedBySums(double a, double b, double c) {
  const double product = a * b;
  const ExactSum low(c, LeftOfProduct(a, b, product));
  const ExactSum high(product, low.sum);
  const ExactSum left(low.left, high.left);
  auto bits = std::bit_cast<std::int64_t>(left.sum);
  const bool is_odd = (bits & 1) != 0, grows = (left.left > 0) == (left.sum > 0);
  bits += (left.left == 0 || is_odd) ? 0 : grows ? 1 : -1;
  return high.sum + std::bit_cast<double>(bits);
}

/// As std::fma() of finite numbers, by the processor where it can.
HWY_ATTR HWY_INLINE double Fused(double a, double b, double c) {
#if HWY_NATIVE_FMA
  return std::fma(a, b, c);
#else
  return FusedBySums(a, b, c);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
