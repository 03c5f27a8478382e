"""Solids, each a stored energy of the invariants I₁, I₂ of the elastic b and J = det F.

A solid has a shear modulus μ, Lamé's λ and, optionally, a third parameter k. The Kirchhoff stress follows
from the derivatives of the energy, τ = 2(w₁ + I₁w₂) b − 2w₂ b² + J w_J I. It and its tangent are formed in
:mod:`foamprb.body.rosenbrock`. A new solid consists of its energy, its derivatives and a line in
:data:`MATERIALS`; :func:`add_material` adds a user's solid, for which its energy or its
stress is sufficient.

The rest shape is an ellipsoid, the image of the sphere of equal volume under a symmetric F₀, det F₀ = 1. The
deformation gradient F refers to that sphere throughout. Only the elastic stress depends on F₀, through
b_e = F M Fᵀ with M = F₀⁻² (:func:`finger`).
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isinf, nan
from types import FunctionType
from typing import NamedTuple

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.membrane import FLUID, law_of, name_of, stress_of
from foamprb.body.morphology import drop_derivatives, drop_energy
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    cofactor,
    det,
    dev,
    dot,
    inverse,
    log_ratio,
    scale,
    sym,
    to_frame,
    transpose,
)
from foamprb.body.vesicle import no_elastic_stress

Derivatives = Callable[[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar], tuple[Scalar, Scalar, Scalar]]

Stress = Callable[[Tensor, Scalar, Scalar, Scalar, Scalar], Tensor]


class Parameter(NamedTuple):
    """Third parameter k of a solid: its settings entry and its range, ``lower`` < k ≤ ``upper``."""

    entry: str
    lower: float
    upper: float


class Material(NamedTuple):
    """Isotropic elastic solid."""

    energy: Callable[[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar], Scalar]
    """Stored energy per undeformed volume w₀(I₁, I₂, J, μ, λ, k), J/m³."""
    derivatives: Derivatives
    """∂w₀/∂I₁, ∂w₀/∂I₂ and ∂w₀/∂J, Pa."""
    parameter: Parameter | None = None
    dilation: Callable[[Scalar, Scalar, Scalar], Scalar] | None = None
    """J d(J w_J)/dJ of (J, μ, λ), Pa, if P = φ F + ψ(J) F⁻ᵀ with φ constant: for the paper's scheme."""
    isochoric: bool = True
    """Whether a pressure may replace λ, as in the integrator without inertia."""
    liquid: bool = False
    """Whether it is a drop, whose shape follows :mod:`foamprb.body.morphology`; μ is then σ/R."""
    membrane: bool = False
    """Whether it is a capsule, whose μ is that of :func:`modulus_of_capsule`."""
    fluid: bool = False
    """Whether that membrane is fluid and keeps its area (:mod:`foamprb.body.vesicle`); k is the excess."""
    power_law: bool = False
    """Whether its moduli are the Prony series of a power law (:mod:`foamprb.body.memory`); k is then its
    exponent."""
    compared: float = 0.94
    """Largest D in a comparison of the model with other results: for solids, Roscoe's exact ones in shear."""
    stress: Stress | None = None
    """Kirchhoff stress τ(b, J, μ, λ, k), Pa, in place of the energy: nine numbers row by row, from the
    elastic b and J = det F. An incompressible form has the same stress up to a pressure, at J = 1."""

    @property
    def slides(self) -> bool:
        """Whether it is a capsule whose membrane slides: not the solid in its place."""
        return self.membrane and self.stress is not None


def neo_hooke_energy(I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar) -> Scalar:
    """Return w₀ = ½ μ (I₁ − 3 − 2 ln J) + ½ λ ln² J, J/m³."""
    log_J = log_ratio(J)
    return 0.5 * mu * (I1 - 3.0 - 2.0 * log_J) + 0.5 * lame * log_J * log_J


def neo_hooke_derivatives(
    _I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return ½ μ, 0 and (λ ln J − μ)/J, Pa: P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ (24); the paper prints F⁻¹ once."""
    return 0.5 * mu, 0.0 * mu, (lame * log_ratio(J) - mu) / J


def neo_hooke_dilation(_J: Scalar, _mu: Scalar, lame: Scalar) -> Scalar:
    """Return J dψ/dJ = λ for ψ = λ ln J − μ, Pa."""
    return lame


def _mooney_rivlin_moduli(mu: Scalar, lame: Scalar, k: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """Return c₁ = ½ μ(1 − k), c₂ = ½ μ k and λ' = λ − 4c₂, Pa, so that λ is that of small strains."""
    return 0.5 * mu * (1.0 - k), 0.5 * mu * k, lame - 2.0 * mu * k


def mooney_rivlin_energy(I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Scalar:
    """Return w₀ = c₁(I₁ − 3) + c₂(I₂ − 3) − (2c₁ + 4c₂) ln J + ½ λ' ln² J, J/m³; k = c₂/(c₁ + c₂)."""
    log_J = log_ratio(J)
    c1, c2, bulk = _mooney_rivlin_moduli(mu, lame, k)
    shear = c1 * (I1 - 3.0) + c2 * (I2 - 3.0) - (2.0 * c1 + 4.0 * c2) * log_J
    return shear + 0.5 * bulk * log_J * log_J


def mooney_rivlin_derivatives(
    _I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return c₁, c₂ and (λ' ln J − 2c₁ − 4c₂)/J, Pa."""
    c1, c2, bulk = _mooney_rivlin_moduli(mu, lame, k)
    return c1, c2, (bulk * log_ratio(J) - 2.0 * c1 - 4.0 * c2) / J


def saint_venant_kirchhoff_energy(
    I1: Scalar, I2: Scalar, _J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> Scalar:
    """Return w₀ = ½ λ tr² E + μ E:E with E = ½(Fᵀ F − I), J/m³."""
    trace = 0.5 * (I1 - 3.0)
    return 0.5 * lame * trace * trace + 0.25 * mu * (I1 * I1 - 2.0 * I2 - 2.0 * I1 + 3.0)


def saint_venant_kirchhoff_derivatives(
    I1: Scalar, _I2: Scalar, _J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return ¼ λ(I₁ − 3) + ½ μ(I₁ − 1), −½ μ and 0, Pa."""
    return 0.25 * lame * (I1 - 3.0) + 0.5 * mu * (I1 - 1.0), -0.5 * mu, 0.0 * mu


def gent_energy(I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Scalar:
    """Return w₀ = −½ μ k ln(1 − (I₁ − 3)/k) − μ ln J + ½ (λ − 2μ/k) ln² J (after Gent 1996), J/m³."""
    log_J = log_ratio(J)
    bulk = lame - 2.0 * mu / k
    return -0.5 * mu * k * np.log(1.0 - (I1 - 3.0) / k) - mu * log_J + 0.5 * bulk * log_J * log_J


def gent_derivatives(
    I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return ½ μ k/(k − I₁ + 3), 0 and ((λ − 2μ/k) ln J − μ)/J, Pa; infinite for I₁ ≥ 3 + k."""
    room = np.maximum(k - I1 + 3.0, 0.0)
    return 0.5 * mu * k / room, 0.0 * mu, ((lame - 2.0 * mu / k) * log_ratio(J) - mu) / J


@choice
def derivatives(
    I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return the :attr:`Material.derivatives` of the solid, Pa."""
    return neo_hooke_derivatives(I1, I2, J, mu, lame, k)


@choice
def dilation(J: Scalar, mu: Scalar, lame: Scalar) -> Scalar:
    """Return the :attr:`Material.dilation` of the solid, Pa."""
    return neo_hooke_dilation(J, mu, lame)


def unknown(*_: Scalar) -> Scalar:
    """Return NaN in place of the energy and its derivatives, if a solid is given by its stress."""
    return nan


class Materials(dict[str, Material]):
    """Solids by name. Membranes have names of :func:`foamprb.body.membrane.name_of`, and are not listed."""

    def __missing__(self, name: str) -> Material:
        """Return the capsule with the law of the membrane in its name; raise KeyError for another name."""
        if name == name_of(FLUID):
            return Material(unknown, unknown, membrane=True, fluid=True, stress=no_elastic_stress)
        return Material(unknown, unknown, membrane=True, compared=0.5, stress=stress_of(*law_of(name)))


MATERIALS = Materials(
    {
        "neoHooke": Material(neo_hooke_energy, neo_hooke_derivatives, dilation=neo_hooke_dilation),
        "mooneyRivlin": Material(
            mooney_rivlin_energy, mooney_rivlin_derivatives, Parameter("mooneyRatio", 0.0, 1.0)
        ),
        "saintVenantKirchhoff": Material(
            saint_venant_kirchhoff_energy, saint_venant_kirchhoff_derivatives, isochoric=False
        ),
        "gent": Material(gent_energy, gent_derivatives, Parameter("stretchLimit", 0.0, inf)),
        "drop": Material(drop_energy, drop_derivatives, liquid=True, compared=0.34),
        "capsule": Material(
            neo_hooke_energy, neo_hooke_derivatives, dilation=neo_hooke_dilation, membrane=True, compared=0.3
        ),
        "powerLaw": Material(
            neo_hooke_energy, neo_hooke_derivatives, dilation=neo_hooke_dilation, power_law=True
        ),
    }
)
"""Solids by their names in the settings."""


STEADY_CAPILLARY = 0.3
"""Approximate largest μ_f γ̇/μ_s at which a neo-Hookean sphere has a steady shape in uniaxial extension."""
_STEP = 1e-30


def _complex_step(
    I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return the derivatives of ``energy``, exact to round-off: Im w(x + ih)/h (Squire & Trapp 1998)."""
    ih = _STEP * 1j
    return (
        energy(I1 + ih, I2, J, mu, lame, k).imag / _STEP,
        energy(I1, I2 + ih, J, mu, lame, k).imag / _STEP,
        energy(I1, I2, J + ih, mu, lame, k).imag / _STEP,
    )


energy = neo_hooke_energy


def add_material(
    name: str,
    energy: Callable[[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar], Scalar] | None = None,
    derivatives: Derivatives | None = None,
    *,
    stress: Stress | None = None,
    parameter: Parameter | None = None,
    dilation: Callable[[Scalar, Scalar, Scalar], Scalar] | None = None,
    isochoric: bool = True,
) -> Material:
    """Add a solid to :data:`MATERIALS`, for selection by name in settings and :class:`Models`.

    Parameters
    ----------
    name
        A word.
    energy, derivatives, stress, parameter, dilation, isochoric
        See :class:`Material`; energy or stress. The functions are compiled. They must be plain ones of
        module level, of arithmetic, numpy functions and :func:`foamprb.body.tensor.log_ratio`. Without
        ``derivatives`` the energy is differentiated by complex steps; it must then be analytic (no ``abs``,
        ``max``, ``where``).

    Raises
    ------
    ValueError
        If the name is taken, a function is not plain, the derivatives are not those of the energy, the stress
        is not that of an isotropic solid, the solid is not free of stress at rest, or ``mu`` is not its shear
        modulus there.
    """
    if name in MATERIALS:
        raise ValueError(f"the solid {name} exists already")
    if (energy is None) == (stress is None):
        raise ValueError(f"solid {name}: it needs an energy or a stress")
    for function in (energy, derivatives, dilation, stress):
        if function is not None and (not isinstance(function, FunctionType) or function.__closure__):
            raise ValueError(f"solid {name}: {function!r} is not a plain function of module level")
    if stress is not None:
        material = Material(unknown, unknown, parameter, None, isochoric, stress=stress)
        _check_stress(name, stress, _some_parameter(material))
        MATERIALS[name] = material
        return material
    assert energy is not None
    if derivatives is None:
        scope = {**globals(), "energy": energy}
        derivatives = FunctionType(_complex_step.__code__, scope, _complex_step.__name__)
    material = Material(energy, derivatives, parameter, dilation, isochoric)
    _check_material(name, material)
    MATERIALS[name] = material
    return material


def _some_parameter(material: Material) -> float:
    """Return a third parameter with which a solid is tried."""
    if material.parameter is None:
        return 0.0
    lower, upper = material.parameter.lower, material.parameter.upper
    # A range without an end is probed far from its start, where a limit of stretch, say, is no obstacle.
    return lower + 100.0 if isinf(upper) else 0.5 * (lower + upper)


def _check_stress(name: str, stress: Stress, k: float) -> None:
    mu, lame, h = 1.0, 3.0, 1e-6
    at_rest = np.array(stress(_IDENTITY, 1.0, mu, lame, k))
    if at_rest.shape != (9,) or not np.abs(at_rest).max() < 1e-9:
        raise ValueError(f"solid {name}: at rest its stress is {at_rest} mu, not nine times 0")
    sheared = stress((1.0, h, 0.0, h, 1.0, 0.0, 0.0, 0.0, 1.0), 1.0, mu, lame, k)
    if not abs(sheared[1] / h - mu) < 1e-5:
        raise ValueError(f"solid {name}: its shear modulus at rest is {sheared[1] / h:.6g} mu, not mu")
    # A turn about an axis that is none of the frame's.
    Q = (2 / 3, -1 / 3, 2 / 3, 2 / 3, 2 / 3, -1 / 3, -1 / 3, 2 / 3, 2 / 3)
    b = (1.3, 0.1, -0.2, 0.1, 0.9, 0.15, -0.2, 0.15, 1.1)
    turned = stress(to_frame(Q, b), 1.1, mu, lame, k)
    if not np.allclose(turned, to_frame(Q, stress(b, 1.1, mu, lame, k)), rtol=1e-9, atol=1e-9):
        raise ValueError(f"solid {name}: its stress does not turn with b, as that of an isotropic solid")


_IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def _check_material(name: str, material: Material) -> None:
    mu, lame, k = 1.0, 3.0, _some_parameter(material)
    w1, w2, wJ = material.derivatives(3.0, 3.0, 1.0, mu, lame, k)
    stress = 2.0 * w1 + 4.0 * w2 + wJ
    if not abs(stress) < 1e-9:
        raise ValueError(f"solid {name}: at rest its stress is {stress:.3g} mu, not 0")
    if not abs(2.0 * (w1 + w2) - mu) < 1e-9:
        raise ValueError(f"solid {name}: its shear modulus at rest is {2.0 * (w1 + w2):.9g} mu, not mu")
    h = 1e-5
    for at in ((3.0, 3.0, 1.0), (3.3, 3.2, 1.02), (4.0, 4.5, 0.97)):
        derivatives = material.derivatives(*at, mu, lame, k)
        for i in range(3):
            ends = [[x + s * h * (j == i) for j, x in enumerate(at)] for s in (1, -1)]
            up, down = (material.energy(I1, I2, J, mu, lame, k) for I1, I2, J in ends)
            slope = (up - down) / (2.0 * h)
            if not abs(derivatives[i] - slope) < 1e-6 * (1.0 + abs(slope)):
                raise ValueError(
                    f"solid {name}: at (I1, I2, J) = {at} derivative {i + 1} of its energy is {slope:.9g}, "
                    f"not {derivatives[i]:.9g}"
                )


def finger_of_sphere(F: Tensor, _M: Tensor) -> Tensor:
    """Return b_e = F Fᵀ for a sphere as rest shape: :func:`finger` for M = I."""
    return dot(F, transpose(F))


def finger(F: Tensor, M: Tensor) -> Tensor:
    """Return the elastic left Cauchy–Green (Finger) tensor b_e = F M Fᵀ, in the frame of F's first index.

    F is the deformation gradient from the sphere of equal volume, M = (F₀ F₀)⁻¹ with the symmetric F₀ of the
    rest shape.
    """
    return dot(dot(F, M), transpose(F))


def finger_of_sphere_in_frame(stretches: Vector, _G: Tensor, _M: Tensor) -> Tensor:
    """Return b_e for a sphere as rest shape, in the particle frame: :func:`finger_in_frame` for M = I."""
    x, y, z = stretches
    return (x * x, 0.0, 0.0, 0.0, y * y, 0.0, 0.0, 0.0, z * z)


def finger_in_frame(_stretches: Vector, G: Tensor, M: Tensor) -> Tensor:
    """Return :func:`finger` in the particle frame, where the stretches are known; G = Q·F."""
    return finger(G, M)


@choice
def finger_of_body(F: Tensor, M: Tensor) -> Tensor:
    """Return b_e = F M Fᵀ; by default of a sphere at rest."""
    return finger_of_sphere(F, M)


@choice
def finger_of_body_in_frame(stretches: Vector, G: Tensor, M: Tensor) -> Tensor:
    """Return the same in the particle frame; by default of a sphere at rest."""
    return finger_of_sphere_in_frame(stretches, G, M)


def metric_at_rest(F0: Tensor) -> Tensor:
    """Return M = F₀⁻¹ F₀⁻ᵀ of :func:`finger`."""
    inverted = inverse(F0)
    return dot(inverted, transpose(inverted))


def viscous_stress(l_s: Tensor, eta: Scalar) -> Tensor:
    """Return the viscous Cauchy stress 2 η_s dev d_s of a Kelvin–Voigt solid, Pa, in any frame.

    ``l_s`` is the velocity gradient of the body, 1/s, ``eta`` the viscosity of the solid, Pa s: Roscoe's
    (1967) η₁.
    """
    return scale(2.0 * eta, dev(sym(l_s)))


def invariants(b: Tensor) -> tuple[Scalar, Scalar]:
    """Return I₁ = tr b and I₂ = ½(I₁² − b:b) of b = F Fᵀ."""
    I1 = b[0] + b[4] + b[8]
    off = b[1] * b[1] + b[2] * b[2] + b[5] * b[5]
    return I1, b[0] * b[4] + b[4] * b[8] + b[8] * b[0] - off


def stored_energy(material: Material, F: Tensor, mu: Scalar, lame: Scalar, k: Scalar = 0.0) -> Scalar:
    """Return the stored energy per undeformed volume of a deformation gradient, J/m³."""
    I1, I2 = invariants(dot(F, transpose(F)))
    return material.energy(I1, I2, det(F), mu, lame, k)


def piola(material: Material, F: Tensor, mu: Scalar, lame: Scalar, k: Scalar = 0.0) -> Tensor:
    """Return the Piola stress P = ∂w₀/∂F = 2(w₁ + I₁w₂) F − 2w₂ b F + w_J cof F (20), Pa."""
    b, J = dot(F, transpose(F)), det(F)
    I1, I2 = invariants(b)
    w1, w2, wJ = material.derivatives(I1, I2, J, mu, lame, k)
    return add(add(scale(2.0 * (w1 + I1 * w2), F), scale(-2.0 * w2, dot(b, F))), scale(wJ, cofactor(F)))


def lame_parameter(mu: Scalar, poissons_ratio: Scalar) -> Scalar:
    """Return λ_s = 2 μ ν/(1 − 2ν), Pa, of a solid with shear modulus μ and Poisson's ratio ν < ½."""
    return 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio)


def modulus_of_capsule(G_s: Scalar, nu_s: Scalar, R: Scalar) -> Scalar:
    """Return the shear modulus of the solid sphere whose small steady deformation is that of a capsule, Pa.

    (1 + ν_s)/(2 + ν_s) G_s/R: in simple shear D = 5/4 (2 + ν_s)/(1 + ν_s) μ_f γ̇ R/G_s, for any viscosity of
    the liquid inside (Barthès-Biesel 1980).

    Parameters
    ----------
    G_s, nu_s
        Surface shear modulus, N/m, and surface Poisson's ratio of the membrane.
    R
        Radius, m.
    """
    return (1.0 + nu_s) / (2.0 + nu_s) * G_s / R
