"""Surface tension of an affinely deforming body: the stress as derivative of γ S with respect to F.

The surface of an ellipsoid with semi-axes a, b, c is S = 4π R_G(b²c², c²a², a²b²) with Carlson's R_G. Its
derivatives need the integrals of :mod:`foamprb.body.ellipsoid` for semi-axes bc, ca, ab:
∂R_G/∂x = (χ − x α₀)/8.
"""

from __future__ import annotations

from foamprb.body.ellipsoid import integrals
from foamprb.body.tensor import Scalar, Vector


def _pulls(stretches: Vector) -> Vector:
    """Return x(χ − xα₀), y(χ − yβ₀), z(χ − zγ₀) with x = b²c² etc."""
    a, b, c = stretches
    products = (b * c, c * a, a * b)
    g = integrals(products)
    x, y, z = products[0] * products[0], products[1] * products[1], products[2] * products[2]
    return x * (g.chi - x * g.alpha[0]), y * (g.chi - y * g.alpha[1]), z * (g.chi - z * g.alpha[2])


def laplace_stress(stretches: Vector, tension: Scalar) -> Vector:
    """Return the principal Kirchhoff stresses (1/vol₀) ∂(γ S)/∂ln λ_a − 2γ/R, Pa.

    They vanish for a sphere: its inner pressure 2γ/R belongs to the reference state. An incompressible body
    is not affected by it, and a nearly incompressible one does not shrink at the start. ``stretches`` are
    λ_a, with semi-axes R λ_a; ``tension`` is γ/R, Pa, with the radius R of the sphere of equal volume.
    """
    x, y, z = _pulls(stretches)
    k = 0.75 * tension
    pressure = 2.0 * tension
    return k * (y + z) - pressure, k * (z + x) - pressure, k * (x + y) - pressure


def no_stress(_stretches: Vector, tension: Scalar) -> Vector:
    """Return zero stresses, without surface tension."""
    zero = 0.0 * tension
    return zero, zero, zero
