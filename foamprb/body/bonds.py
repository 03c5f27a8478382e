"""Kinetics of bonds between a body and a wall (Bell, Science 200, 618, 1978).

A body in contact forms a bond at the rate k_on. It lasts at the rate k_off exp(F x_b/k_B T), with the force F
of the fluid on the body and the reactive length x_b. A change happens when the integral of its rate over time
reaches a random number of the exponential distribution, which is drawn once: so it does not depend on steps.
"""

from __future__ import annotations

from math import pi

import numpy as np

from foamprb.body.brownian import BOLTZMANN
from foamprb.body.philox import Word, philox, uniform
from foamprb.body.tensor import Scalar

GOLDMAN = 1.7005
"""Drag of a sphere that touches a wall in shear over 6π μ R² γ̇ (Goldman, Cox & Brenner 1967)."""
_LOW, _HALF, _NONE = np.uint64(0xFFFFFFFF), np.uint64(32), np.uint64(0)


def exponential_deviate(particle: Word, change: Word, key: tuple[Word, Word]) -> Scalar:
    """Return a random number of mean 1 for a particle and the number of its changes so far."""
    words = philox((particle & _LOW, particle >> _HALF, change, _NONE), key)
    return -np.log(uniform(words[0]))


def force_on_held_sphere(R: Scalar, shear_rate: Scalar, mu: Scalar) -> Scalar:
    """Return the force of a fluid in shear on a sphere that is held at a wall, N."""
    return GOLDMAN * 6.0 * pi * mu * R * R * shear_rate


def sensitivity(xb: float, T: float) -> float:
    """Return x_b/(k_B T), 1/N."""
    return xb / (BOLTZMANN * T)


def off_rate(k_off: Scalar, force: Scalar, per_force: Scalar) -> Scalar:
    """Return Bell's rate k_off exp(F x_b/k_B T), 1/s, at most e⁶⁰⁰ k_off, a number that is still finite."""
    return k_off * np.exp(np.minimum(force * per_force, 600.0))
