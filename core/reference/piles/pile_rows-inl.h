// Rows in memory as columns of vectors, and three of these as a vector in space; included once for
// each instruction set.
#if defined(SLIPCHECK_PILE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_PILE_ROWS_INL_H
#undef SLIPCHECK_PILE_ROWS_INL_H
#else
#define SLIPCHECK_PILE_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Eigen's Vector3 in each lane: sums from x on.
template <class V>
struct Lane3 {
  V x, y, z;

  friend HWY_INLINE Lane3 operator+(const Lane3& a, const Lane3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE Lane3 operator-(const Lane3& a, const Lane3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE Lane3 operator*(V factor, const Lane3& a) {
    return {factor * a.x, factor * a.y, factor * a.z};
  }
};

template <class V>
HWY_INLINE V dot(const Lane3<V>& a, const Lane3<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
HWY_INLINE Lane3<V> cross(const Lane3<V>& a, const Lane3<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class M, class V>
HWY_INLINE Lane3<V> choose(M which, const Lane3<V>& yes, const Lane3<V>& no) {
  return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
          hn::IfThenElse(which, yes.z, no.z)};
}
/// Zero elsewhere.
template <class M, class V>
HWY_INLINE Lane3<V> keep(M which, const Lane3<V>& a) {
  return {hn::IfThenElseZero(which, a.x), hn::IfThenElseZero(which, a.y),
          hn::IfThenElseZero(which, a.z)};
}

using RowTag = hn::ScalableTag<double>;
using RowVector = hn::Vec<RowTag>;
inline constexpr std::size_t kRows = hn::MaxLanes(RowTag());
static_assert(kRows <= 8);

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE void transpose(RowVector*) {}

#else

/// Four blocks of two numbers each, as columns.
HWY_INLINE void transpose_blocks(RowVector& a, RowVector& b, RowVector& c, RowVector& e) {
  const RowTag d;
  const RowVector ab_even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
  const RowVector ab_odd = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
  const RowVector ce_even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(e), c);
  const RowVector ce_odd = hn::OddEvenBlocks(e, hn::SwapAdjacentBlocks(c));
  a = hn::ConcatLowerLower(d, ce_even, ab_even);
  b = hn::ConcatLowerLower(d, ce_odd, ab_odd);
  c = hn::ConcatUpperUpper(d, ce_even, ab_even);
  e = hn::ConcatUpperUpper(d, ce_odd, ab_odd);
}

/// A square of as many rows as a vector has numbers.
HWY_INLINE void transpose(RowVector* r) {
  const RowTag d;
  RowVector low[kRows], high[kRows];  // of rows 2k and 2k+1 the even numbers, the odd ones
  for (std::size_t k = 0; k < kRows / 2; ++k) {
    low[k] = hn::InterleaveLower(d, r[2 * k], r[2 * k + 1]);
    high[k] = hn::InterleaveUpper(d, r[2 * k], r[2 * k + 1]);
  }
  if constexpr (kRows == 2) {
    r[0] = low[0], r[1] = high[0];
  } else if constexpr (kRows == 4) {
    r[0] = hn::ConcatLowerLower(d, low[1], low[0]);
    r[1] = hn::ConcatLowerLower(d, high[1], high[0]);
    r[2] = hn::ConcatUpperUpper(d, low[1], low[0]);
    r[3] = hn::ConcatUpperUpper(d, high[1], high[0]);
  } else if constexpr (kRows == 8) {
    transpose_blocks(low[0], low[1], low[2], low[3]);
    transpose_blocks(high[0], high[1], high[2], high[3]);
    for (std::size_t k = 0; k < 4; ++k) r[2 * k] = low[k], r[2 * k + 1] = high[k];
  }
}

#endif

/// Of each row the eight numbers from `from` on.
HWY_INLINE void load_rows(const double* const* row, std::size_t from, RowVector* column) {
  const RowTag d;
  for (std::size_t k = 0; k < 8; k += kRows) {
    for (std::size_t l = 0; l < kRows; ++l) column[k + l] = hn::Load(d, row[l] + from + k);
    transpose(column + k);
  }
}

/// Into rows of eight that follow each other.
HWY_INLINE void store_rows(RowVector* column, double* rows) {
  const RowTag d;
  for (std::size_t k = 0; k < 8; k += kRows) {
    transpose(column + k);
    for (std::size_t l = 0; l < kRows; ++l) hn::Store(column[k + l], d, rows + 8 * l + k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
