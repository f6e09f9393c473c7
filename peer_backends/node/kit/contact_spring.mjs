// The contact as a spring with a dashpot that only pushes.
//
// ẍ = -2 ζ ω ẋ - ω² x from x = 0 with velocity -v until ẍ = 0, when the force would begin to pull.
// With ζ = cos α the roots are ω e^(±i (π - α)), so ẍ is as sin(ω t sin α - 2 α) and
//   t = 2 α/(ω sin α),   e = -ẋ(t)/ẋ(0) = exp(-2 α cot α);
// beyond ζ = 1 likewise with ζ = cosh a: e = exp(-2 a coth a). At ζ = 1 both give e^-2.

/// e of a damping ratio ζ >= 0.
export function restitutionOf(zeta) {
  if (zeta === 1) return Math.exp(-2);
  if (zeta > 1) {
    const a = Math.acosh(zeta);
    return Math.exp((-2 * a * zeta) / Math.sinh(a));
  }
  const alpha = Math.acos(zeta);
  return Math.exp((-2 * alpha * zeta) / Math.sin(alpha));
}

/// ζ of 0 < e <= 1.
export function dampingRatioOf(e) {
  let low = 0;
  let high = Math.cosh(1 - Math.log(e)); // e < exp(-2 a) there
  while (high - low > 1e-15 * high) {
    const middle = (low + high) / 2;
    if (middle === low || middle === high) break;
    if (restitutionOf(middle) > e) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/// ω t, how long it pushes; ζ < 1.
export function contactTime(zeta) {
  const alpha = Math.acos(zeta);
  return (2 * alpha) / Math.sin(alpha);
}
