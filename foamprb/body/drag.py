"""Drag of Stokes flow on an ellipsoid, and the step of the barycentre.

A drag law gives the principal resistances K_a, a length each: f_D = μ_f K·(u − v), K = Qᵀ diag(K_a) Q (30).
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from types import FunctionType

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import Integrals, integrals
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    dot_vector,
    plus,
    reciprocals,
    scale_vector,
    select,
    vector_dot,
)


def oberbeck(semi_axes: Vector, g: Integrals) -> Vector:
    """Return the exact resistances of an ellipsoid, K_a = 16π/(χ + α_a r_a²).

    Oberbeck (1876), Kim & Karrila (1991). ``semi_axes`` and ``g`` are a, b, c and their integrals, in the
    unit of length of the result. A sphere of radius R has 6πR.
    """
    a, b, c = semi_axes
    alpha, beta, gamma = g.alpha
    k = 16.0 * pi
    r = reciprocals((g.chi + alpha * a * a, g.chi + beta * b * b, g.chi + gamma * c * c))
    return k * r[0], k * r[1], k * r[2]


def brenner_prolate(semi_axes: Vector, _g: Integrals) -> Vector:
    """Return the resistances of the prolate spheroid of longest and shortest axis, K = π r_min k (D.1, D.2).

    Both short axes are replaced by the shortest, as in the paper's Appendix D. A sheared soft particle is
    triaxial; its size is therefore underestimated. (D.1) and (D.2) are :func:`oberbeck` for two equal axes.
    """
    a, b, c = semi_axes
    longest = np.maximum(a, np.maximum(b, c))
    shortest = np.minimum(a, np.minimum(b, c))
    spheroid = (longest, shortest, shortest)
    along, across, _ = oberbeck(spheroid, integrals(spheroid))
    first = a >= longest
    second = (b >= longest) & (a < longest)
    third = (a < longest) & (b < longest)
    return select(first, along, across), select(second, along, across), select(third, along, across)


@choice
def drag(semi_axes: Vector, g: Integrals) -> Vector:
    """Return the principal resistances of the drag law; by default :func:`oberbeck`."""
    return oberbeck(semi_axes, g)


def reduced_gravity(J: Scalar, rho_s: Scalar, rho_f: Scalar, gravity: Vector) -> Vector:
    """Return the acceleration by gravity less buoyancy, a_G = (1 − J ρ_f/ρ_s) g (28), (35), m/s².

    ``rho_s`` is the density of the undeformed solid; that of the deformed one is ρ_s/J.
    """
    beta = 1.0 - J * rho_f / rho_s
    return beta * gravity[0], beta * gravity[1], beta * gravity[2]


def implicit_euler(v: Vector, u: Vector, Q: Tensor, rate: Vector, acceleration: Vector, dt: Scalar) -> Vector:
    """Return the barycentre velocity after an implicit Euler step, in closed form (43).

    (1 + Δt rate_a) v'_a = v_a + Δt (a_G,a + rate_a u_a) along each principal axis.

    Parameters
    ----------
    v, u
        Velocities of particle and fluid, m/s, inertial frame.
    Q, rate
        Particle frame (rows) and μ_f K_a/m, 1/s, along its axes.
    acceleration
        By all forces except drag, m/s².
    dt
        Time step, s. The new position is x + Δt v' (36).
    """
    load_p, u_p = dot_vector(Q, plus(v, scale_vector(dt, acceleration))), dot_vector(Q, u)
    r = reciprocals((1.0 + dt * rate[0], 1.0 + dt * rate[1], 1.0 + dt * rate[2]))
    new = (
        (load_p[0] + dt * rate[0] * u_p[0]) * r[0],
        (load_p[1] + dt * rate[1] * u_p[1]) * r[1],
        (load_p[2] + dt * rate[2] * u_p[2]) * r[2],
    )
    return vector_dot(new, Q)


Drag = Callable[[Vector, Integrals], Vector]

DRAGS: dict[str, Drag] = {"oberbeck": oberbeck, "brennerProlate": brenner_prolate}


def add_drag(name: str, law: Drag) -> Drag:
    """Add a law of drag to :data:`DRAGS`, for ``ellipsoidDrag { type name; }`` and :class:`Models`.

    Parameters
    ----------
    name
        A word.
    law
        ``law(semi_axes, g)`` returns the three principal resistances K_a, in the unit of the semi-axes, as
        :func:`oberbeck` does, which it may call; ``g`` are the integrals of the ellipsoid. It is compiled: a
        plain function of module level, of arithmetic and numpy functions.

    Raises
    ------
    ValueError
        If the name is taken, or the function is not plain, fails, or its resistances are not three positive
        numbers that grow with the size and follow the axes.
    """
    if name in DRAGS:
        raise ValueError(f"the drag {name} exists already")
    if not name.isidentifier() or not isinstance(law, FunctionType) or law.__closure__:
        raise ValueError(f"drag {name}: a word and a plain function of module level are needed")
    tried = {axes: law(axes, integrals(axes)) for axes in ((3.0, 2.0, 1.0), (6.0, 4.0, 2.0), (1.0, 3.0, 2.0))}
    k, larger, turned = (np.array(values, dtype=float) for values in tried.values())
    if k.shape != (3,) or not (k > 0.0).all():
        raise ValueError(f"drag {name}: at the semi-axes 3, 2, 1 it is {k}, not three positive numbers")
    if not np.allclose(larger, 2.0 * k, rtol=1e-9):
        raise ValueError(f"drag {name}: a body of twice the size has {larger}, not twice {k}")
    if not np.allclose(turned, k[[2, 0, 1]], rtol=1e-9):
        raise ValueError(f"drag {name}: at the semi-axes 1, 3, 2 it is {turned}, not {k[[2, 0, 1]]}")
    DRAGS[name] = law
    return law
