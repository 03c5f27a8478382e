"""Capsules: liquid in an elastic membrane that slides under its tangential load.

The body deforms affinely. Within its surface the membrane moves until it balances the tangential load by
fluid and liquid. The stress of the body is then an isotropic function of b,

    T = μ dev[φ₁ b − φ₂ b⁻¹],    φ_a = Σ c_a,ij Xⁱ Yʲ  (i + j ≤ 3),    X = ln(I₁/3),  Y = ln(I₂/3)

with I₁ = tr b and I₂ = tr b⁻¹ at det b = 1, and μ of :func:`foamprb.body.material.modulus_of_capsule`. The
coefficients of ``membrane.txt`` hold to 10⁻³ |T| where I₁ I₂ ≤ :data:`WITHIN`.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from foamprb.body.stokes import inverse_cube_root
from foamprb.body.tensor import Scalar, Tensor, cofactor, ddot, log_ratio

LARGEST_STRETCH = 2.2
"""Largest stretch of the tabled shapes."""
WITHIN = 26.5
"""Largest I₁ I₂ of the tabled shapes; that of a uniaxial stretch of 2.2 or its inverse."""
MOST_C = 50.0
"""Largest tabled C of Skalak's law."""
_NAME, _NEO_HOOKEAN, _SKALAK = "capsule", "neoHookean", "Skalak"
FLUID = "fluid"
"""Law of a membrane without elasticity (:mod:`foamprb.body.vesicle`)."""
_LAWS = (_NEO_HOOKEAN, _SKALAK, FLUID)

Coefficients: TypeAlias = tuple[float, ...]


def name_of(law: str, C: float = 0.0) -> str:
    """Return the name of the material: ``capsule neoHookean``, ``capsule Skalak 1``; else ``capsule``."""
    return f"{_NAME} {law} {C:.12g}" if law == _SKALAK else f"{_NAME} {law}" if law in _LAWS else _NAME


def law_of(name: str) -> tuple[str, float]:
    """Return the law and C from the name of a material; raise KeyError if it is none of a membrane."""
    word, law, *numbers = [*name.split(), "", ""][:3]
    if name == name_of(_NEO_HOOKEAN):
        return _NEO_HOOKEAN, 0.0
    with suppress(ValueError):
        if (word, law) == (_NAME, _SKALAK) and 0.0 <= float(numbers[0]) <= MOST_C:
            return _SKALAK, float(numbers[0])
    raise KeyError(name)


def poissons_ratio_of(law: str, C: float) -> float:
    """Return the surface Poisson's ratio of small strains: ½, and C/(1 + C) of Skalak's law."""
    return 0.5 if law == _NEO_HOOKEAN else C / (1.0 + C)


def _table(law: str) -> tuple[Any, Any]:
    """Return ln(1 + C) of the tabled membranes of a law, (m,), and their rows; of neo-Hooke's one twice."""
    rows = np.loadtxt(Path(__file__).with_name("membrane.txt"))
    return ([0.0, 1.0], rows[[0, 0]]) if law == _NEO_HOOKEAN else (np.log1p(rows[1:, 0]), rows[1:])


@cache
def coefficients(law: str, C: float) -> tuple[Coefficients, Coefficients]:
    """Return c₁ and c₂ in the order 00 01 10 02 11 20 03 12 21 30, by a spline in ln(1 + C)."""
    from scipy.interpolate import CubicSpline

    x, rows = _table(law)
    c = CubicSpline(x, rows[:, 1:21])(np.log1p(C))
    return tuple(c[:10].tolist()), tuple(c[10:].tolist())


def _polynomial(X: Scalar, Y: Scalar, c: Coefficients) -> Scalar:
    in_Y = c[0] + Y * (c[1] + Y * (c[3] + Y * c[6]))
    return in_Y + X * (c[2] + Y * (c[4] + Y * c[7]) + X * (c[5] + Y * c[8] + X * c[9]))


@cache
def stress_of(law: str, C: float) -> Callable[..., Tensor]:
    """Return the :attr:`foamprb.body.material.Material.stress` of a membrane; a pressure λ ln J resists J."""
    first, second = coefficients(law, C)

    def membrane_stress(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar) -> Tensor:
        s = inverse_cube_root(J)
        s = s * s
        c = cofactor(b)
        # b and its inverse at det b = 1 are s b and s² cof b.
        I1, I2 = s * (b[0] + b[4] + b[8]), s * s * (c[0] + c[4] + c[8])
        X, Y = log_ratio(I1 * (1.0 / 3.0)), log_ratio(I2 * (1.0 / 3.0))
        f, g = mu * _polynomial(X, Y, first), mu * _polynomial(X, Y, second)
        p = (g * I2 - f * I1) * (1.0 / 3.0) + lame * log_ratio(J)
        f, g = f * s, g * s * s
        return (
            f * b[0] - g * c[0] + p, f * b[1] - g * c[1], f * b[2] - g * c[2],
            f * b[3] - g * c[3], f * b[4] - g * c[4] + p, f * b[5] - g * c[5],
            f * b[6] - g * c[6], f * b[7] - g * c[7], f * b[8] - g * c[8] + p,
        )  # fmt: skip

    return membrane_stress


def product_of_invariants(F: Tensor) -> Scalar:
    """Return I₁ I₂ of a deformation gradient with det F = 1, 9 at rest."""
    c = cofactor(F)
    return ddot(F, F) * ddot(c, c)


def least_tensions(F: Any, law: str, C: float) -> Scalar:
    """Return the least principal tension of membranes over G_s, (n,), for F (n, 9); NaN beyond the table.

    A membrane without bending stiffness wrinkles where it is negative.
    """
    from scipy.interpolate import RegularGridInterpolator

    b = F.reshape(-1, 3, 3) @ F.reshape(-1, 3, 3).transpose(0, 2, 1)
    h = 0.5 * np.log(np.maximum(np.linalg.eigvalsh(b), 1e-300))[:, ::-1]
    h = h - h.mean(axis=1, keepdims=True)
    size = np.sqrt(2.0 / 3.0 * (h * h).sum(axis=1))
    # h_k = size cos(ψ − 2πk/3), with ψ from 0 for the longest body to 60° for the flattest.
    psi = np.arctan2(h[:, 1] - h[:, 2], np.sqrt(3.0) * h[:, 0])
    x, rows = _table(law)
    tensions = np.zeros((len(x), 7, 17))
    tensions[..., 1:] = rows[:, 21:].reshape(-1, 7, 16)
    axes = x, np.arange(7) * np.pi / 18.0, np.arange(17) * 0.05
    at = np.stack([np.full_like(size, np.log1p(C)), np.clip(psi, 0.0, np.pi / 3.0), size], axis=1)
    return RegularGridInterpolator(axes, tensions, bounds_error=False)(at)
