"""Vesicles: liquid in a fluid membrane that keeps its area.

The sliding of a fluid membrane costs nothing, so that only the area A of the affine body counts. Its tension
Σ is what keeps A: with the stress T = dev (Σ/V) ∂A/∂h of :mod:`foamprb.body.surface_tension`, Ȧ = 0 is linear
in Σ. In steady tank-treading the membrane takes up no power, which is the balance of Keller and Skalak (J.
Fluid Mech. 120, 1982). Bending is left out.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from foamprb.body.stokes import Mobility, velocity_gradient
from foamprb.body.surface_tension import laplace_stress
from foamprb.body.tensor import ZERO, Scalar, Tensor, Vector, ddot, dev, dot_vector, sym

_LEAST = 1e-12


def stress_of_area(m: Mobility, stretches: Vector, l_f: Tensor, excess: Scalar) -> Vector:
    """Return the principal stresses of the tension over μ_f, 1/s, in the particle frame.

    Parameters
    ----------
    m
        Mobility of the shape.
    l_f
        Velocity gradient of the fluid, 1/s.
    excess
        A/R² − 4π. An area that differs by errors of steps returns to it at the rate of the strain.
    """
    t = laplace_stress(stretches, 1.0)
    l_s, d_f = velocity_gradient(m, ZERO, l_f), dev(sym(l_f))
    # 3 Ȧ/(4π R²) and 3 (A − A₀)/(4π R²).
    rate = t[0] * l_s[0] + t[1] * l_s[4] + t[2] * l_s[8]
    surplus = 0.5 * (t[0] + t[1] + t[2]) - (3.0 / (4.0 * math.pi)) * excess
    n = dot_vector(m.normal, t)
    response = np.minimum(t[0] * n[0] + t[1] * n[1] + t[2] * n[2], -_LEAST)
    tension = -(rate + np.sqrt(2.0 * ddot(d_f, d_f)) * surplus) / response
    return tension * t[0], tension * t[1], tension * t[2]


def no_elastic_stress(b: Tensor, _J: Scalar, mu: Scalar, _lame: Scalar, _k: Scalar) -> Tensor:
    """Return the :attr:`foamprb.body.material.Material.stress` of a fluid membrane without its tension: 0."""
    zero = 0.0 * mu * b[0]
    return zero, zero, zero, zero, zero, zero, zero, zero, zero


def spheroid_of_area(excess: float) -> float:
    """Return the long stretch of the prolate spheroid of the volume of a unit sphere with A = 4π + excess."""
    from scipy.optimize import brentq

    def surplus(x: Any) -> float:
        t = laplace_stress((x, x**-0.5, x**-0.5), 1.0)
        return float(4.0 * math.pi / 6.0 * sum(t)) - excess

    return float(brentq(surplus, 1.0, 1e3, xtol=1e-13))
