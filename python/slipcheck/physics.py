"""Closed forms and contact laws over arrays: the very functions that the reference is compiled of.

Every argument is a number or an array; shapes broadcast as numpy's do, and the result has the common shape (a number where all
are numbers). All values are SI. Letters in brackets: K is Kondic 1999, B Brilliantov et al. 1996 (docs/model.md).
"""

from __future__ import annotations

from typing import Dict, Union

import numpy
from numpy.typing import ArrayLike, NDArray

try:
    from . import _reference
except ImportError as missing:
    raise ImportError("slipcheck.physics needs the package's compiled module, which a pure Python wheel has not: "
                      f"see docs/python.md ({missing})") from missing

__all__ = [
    "compact_viscoelastic_force", "effective_mass", "effective_restitution", "exponential_friction",
    "head_on_rolling_velocity", "head_on_velocity_after", "hertz_duration", "hertz_force", "hertz_largest_overlap",
    "linear_force", "linear_restitution", "power_force", "power_law_restitution", "slide_to_roll",
    "symmetric_sliding_distance", "viscoelastic_force", "viscous_friction",
]

Number = Union[float, NDArray[numpy.float64]]


def head_on_velocity_after(v_i: ArrayLike, v_j: ArrayLike, restitution: ArrayLike) -> Number:
    """v^f_i = ½[(1 − e) v_i + (1 + e) v_j] [m/s] of two equal spheres on one line; e in [0, 1]."""
    return _reference.head_on_velocity_after(v_i, v_j, restitution)


def head_on_rolling_velocity(v_i: ArrayLike, v_j: ArrayLike, restitution: ArrayLike, A: ArrayLike = 2.5,
                             spin_exchange: ArrayLike = 0.0) -> Number:
    """v^s_i [m/s] once sphere i rolls again; A = m R²/I [-], spin_exchange c of K (55) [-]."""
    return _reference.head_on_rolling_velocity(v_i, v_j, restitution, A, spin_exchange)


def effective_restitution(restitution: ArrayLike, A: ArrayLike = 2.5) -> Number:
    """e_eff = (A e_n − 1)/(1 + A) [-]: what two rolling spheres keep of their relative velocity once both roll again."""
    return _reference.effective_restitution(restitution, A)


def symmetric_sliding_distance(relative_speed: ArrayLike, restitution: ArrayLike, kinetic_friction: ArrayLike,
                               gravity: ArrayLike = 9.81, A: ArrayLike = 2.5) -> Number:
    """K (44) [m]: s of each of two spheres that meet at v and −v, relative_speed = 2v [m/s]; gravity [m/s²]."""
    return _reference.symmetric_sliding_distance(relative_speed, restitution, kinetic_friction, gravity, A)


def slide_to_roll(velocity: ArrayLike, angular_velocity: ArrayLike, radius: float, kinetic_friction: float,
                  gravity: float = 9.81, shape_factor: float = 0.4) -> Dict[str, NDArray[numpy.float64]]:
    """Spheres that slide on a level, still substrate until they roll.

    Parameters
    ----------
    velocity, angular_velocity
        At the start [m/s], [rad/s]; shape (n, 3).
    radius, kinetic_friction, gravity, shape_factor
        R [m], μ_k [-], g [m/s²], I/(m R²) [-]; all > 0.

    Returns
    -------
    dict
        ``slip``, ``rolling_velocity`` [m/s] and ``displacement`` [m] of shape (n, 3); ``sliding_time`` [s], ``sliding_distance``
        [m] and ``energy_change`` |v^f|² − |v^s|² [m²/s²] of shape (n,).
    """
    return _reference.slide_to_roll(velocity, angular_velocity, radius, kinetic_friction, gravity, shape_factor)


def linear_force(overlap: ArrayLike, rate: ArrayLike, stiffness: ArrayLike, damping: ArrayLike = 0.0) -> Number:
    """K (2): F_N = k ξ + c ξ̇ [N]; overlap ξ [m], rate ξ̇ [m/s], k [N/m], c [N s/m]."""
    return _reference.linear_force(overlap, rate, stiffness, damping)


def hertz_force(overlap: ArrayLike, modulus: ArrayLike) -> Number:
    """F_N = ρ ξ^{3/2} [N]; ρ [N/m^1.5]."""
    return _reference.hertz_force(overlap, modulus)


def power_force(overlap: ArrayLike, rate: ArrayLike, modulus: ArrayLike, viscosity: ArrayLike = 0.0,
                alpha: ArrayLike = 1.5, gamma: ArrayLike = 0.5) -> Number:
    """K (B1): F_N = E ξ^α + η ξ^γ ξ̇ [N]; E [N/m^α], η [N s/m^(1+γ)]."""
    return _reference.power_force(overlap, rate, modulus, viscosity, alpha, gamma)


def viscoelastic_force(overlap: ArrayLike, rate: ArrayLike, modulus: ArrayLike, dissipation_time: ArrayLike) -> Number:
    """B (24): F_N = ρ (ξ^{3/2} + (3/2) A √ξ ξ̇) [N]; A [s]."""
    return _reference.viscoelastic_force(overlap, rate, modulus, dissipation_time)


def compact_viscoelastic_force(overlap: ArrayLike, rate: ArrayLike, modulus: ArrayLike,
                               dissipation_time: ArrayLike) -> Number:
    """B (25): F_N = ρ (ξ + A ξ̇)^{3/2} [N]."""
    return _reference.compact_viscoelastic_force(overlap, rate, modulus, dissipation_time)


def viscous_friction(slip: ArrayLike, normal: ArrayLike, damping: ArrayLike, friction: ArrayLike) -> Number:
    """K (4), (6): |F_T| = min(c |u|, ν_s |F_N|) [N]; slip u [m/s], normal F_N [N], c [N s/m], ν_s [-]."""
    return _reference.viscous_friction(slip, normal, damping, friction)


def power_law_restitution(speed: ArrayLike, coefficient: ArrayLike = 0.32, exponent: ArrayLike = 0.234,
                          reference_speed: ArrayLike = 0.01) -> Number:
    """min(1, coefficient (g/reference_speed)^−exponent) [-]; speed g [m/s], > 0. The defaults: ice, Bridges, Hatzes and Lin."""
    return _reference.power_law_restitution(speed, coefficient, exponent, reference_speed)


def exponential_friction(slip: ArrayLike, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Number:
    """μ = a + b e^(−c v) [-]; slip v [m/s], >= 0, c [s/m]."""
    return _reference.exponential_friction(slip, a, b, c)


def effective_mass(first: ArrayLike, second: ArrayLike) -> Number:
    """m1 m2/(m1 + m2) [kg]."""
    return _reference.effective_mass(first, second)


def hertz_duration(mass: ArrayLike, modulus: ArrayLike, speed: ArrayLike) -> Number:
    """B (A13): duration [s] of an elastic collision; effective mass [kg], ρ [N/m^1.5], speed [m/s], > 0."""
    return _reference.hertz_duration(mass, modulus, speed)


def hertz_largest_overlap(mass: ArrayLike, modulus: ArrayLike, speed: ArrayLike) -> Number:
    """Deepest overlap [m] of that collision."""
    return _reference.hertz_largest_overlap(mass, modulus, speed)


def linear_restitution(mass: ArrayLike, stiffness: ArrayLike, damping_rate: ArrayLike) -> Number:
    """e_n = exp(−γ t_col/2) [-] of the linear contact that ends at zero overlap; effective mass m̄ [kg], k [N/m], γ = c/m̄ [1/s]."""
    return _reference.linear_restitution(mass, stiffness, damping_rate)
