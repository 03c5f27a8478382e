"""Elastic stress, surface tension, mobility and resistance of a body, for a lane of a block."""

from __future__ import annotations

import math
from typing import Any

from foamprb.body import rosenbrock
from foamprb.body.choice import choice
from foamprb.body.drag import drag
from foamprb.body.error_control import strain_by, strain_in_frame
from foamprb.body.material import (
    Material,
    derivatives,
    dilation,
    finger,
    finger_in_frame,
    finger_of_body,
    finger_of_body_in_frame,
)
from foamprb.body.membrane import WITHIN, product_of_invariants
from foamprb.body.rosenbrock import (
    Elasticity,
    elasticity,
    elasticity_by_dilation,
    elasticity_by_stress,
    extra_elasticity,
    extra_elasticity_by_dilation,
    extra_stress_in_frame,
    kirchhoff_in_frame,
    solid_stress,
)
from foamprb.body.stokes import Mobility, mobility
from foamprb.body.surface_tension import laplace_stress, no_stress
from foamprb.body.tensor import Scalar, Tensor, Vector, diagonal, scale_vector, select
from foamprb.body.vesicle import stress_of_area
from foamprb.cloud.block import STRETCHED, Medium, at, judge_law, load3, load_integrals, viscosity_at
from foamprb.cloud.layout import LANES, Block
from foamprb.compile.link import Function


def solid(block: Block, i: int) -> tuple[Any, Any, Any]:
    """Return μ_s and λ_s, Pa, and the third parameter of the solid."""
    return block[at.mu * LANES + i], block[at.lame * LANES + i], block[at.k * LANES + i]


@choice
def kirchhoff(b_e: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return the Kirchhoff stress of the solid, Pa, in the particle frame; by default of a sphere at rest."""
    return kirchhoff_in_frame(b_e, J, mu, lame, k)


@choice
def extra_stress(b_e: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return the same up to a pressure."""
    return extra_stress_in_frame(b_e, J, mu, lame, k)


@choice
def interface(stretches: Vector, tension: Scalar) -> Vector:
    """Return the principal Kirchhoff stresses by surface tension, Pa; by default none."""
    return no_stress(stretches, tension)


def functions_of_solid(material: Material, general: bool, tense: bool) -> dict[Function, Function]:
    """Return what a solid puts behind choices.

    ``general`` tells that its elastic strain is not diagonal in the particle frame: its shape at rest is no
    sphere, or it has memory. ``tense`` tells that it has surface tension.
    """
    slots: dict[Function, Function] = {derivatives: material.derivatives}
    if material.dilation is not None:
        slots |= {
            dilation: material.dilation,
            elasticity: elasticity_by_dilation,
            extra_elasticity: extra_elasticity_by_dilation,
        }
    if general:
        slots |= {finger_of_body: finger, finger_of_body_in_frame: finger_in_frame}
        slots |= {kirchhoff: rosenbrock.kirchhoff, extra_stress: rosenbrock.extra_stress}
    else:
        slots[strain_by] = strain_in_frame
    if material.stress is not None:
        slots |= dict.fromkeys((elasticity, extra_elasticity), elasticity_by_stress)
        slots |= dict.fromkeys(
            (kirchhoff, extra_stress, rosenbrock.extra_stress, solid_stress), material.stress
        )
    if material.fluid:
        slots[with_tension] = with_area_tension
    elif material.slides:
        slots[judge_law] = judge_membrane
    return slots | ({interface: laplace_stress} if tense else {})


def judge_membrane(F: Tensor, verdict: Scalar) -> Scalar:
    """Return the verdict on a shape; one outside of the tabled stretches of a membrane fails."""
    return select(product_of_invariants(F) <= WITHIN, verdict, float(STRETCHED))


@choice
def with_tension(
    _block: Block, _i: int, _m: Mobility, _stretches: Vector, sigma: Tensor, _l_f: Tensor
) -> Tensor:
    """Return the elastic stress over μ_f, 1/s, as it is: no surface keeps its area."""
    return sigma


def with_area_tension(
    block: Block, i: int, m: Mobility, stretches: Vector, _sigma: Tensor, l_f: Tensor
) -> Tensor:
    """Return the stress of the tension that keeps the area of a vesicle."""
    x, y, z = stress_of_area(m, stretches, l_f, block[at.k * LANES + i])
    return (x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z)


def conservative_stress(block: Block, i: int, stretches: Vector, b_e: Tensor, J: Any) -> Tensor:
    """Kirchhoff stress of the solid and of its surface tension, Pa, in the particle frame."""
    return _with_interface(block, i, stretches, kirchhoff(b_e, J, *solid(block, i)))


def incompressible_stress(block: Block, i: int, stretches: Vector, b_e: Tensor) -> Tensor:
    """Return the same stress of an incompressible body, without its pressure."""
    return _with_interface(block, i, stretches, extra_stress(b_e, 1.0, *solid(block, i)))


def _with_interface(block: Block, i: int, stretches: Vector, tau: Tensor) -> Tensor:
    s = interface(stretches, block[at.tension * LANES + i])
    return (
        tau[0] + s[0], tau[1], tau[2],
        tau[3], tau[4] + s[1], tau[5],
        tau[6], tau[7], tau[8] + s[2],
    )  # fmt: skip


def solid_elasticity(block: Block, i: int, stretches: Vector, b_e: Tensor) -> Elasticity:
    """Return the elasticity of the solid."""
    J = stretches[0] * stretches[1] * stretches[2]
    return elasticity(diagonal(b_e), J, *solid(block, i), block[at.tension * LANES + i])


def incompressible_elasticity(block: Block, i: int, b_e: Tensor) -> Elasticity:
    """Return the same elasticity without resistance to dilation."""
    mu, _, k = solid(block, i)
    return extra_elasticity(diagonal(b_e), 1.0, mu, 0.0, k, block[at.tension * LANES + i])


@choice
def body_mobility(block: Block, i: int, medium: Medium, stretches: Vector) -> Mobility:
    """Return the mobility of an affinely deforming solid; :mod:`foamprb.cloud.drops` has that of a drop."""
    return mobility(
        stretches, load_integrals(block, i), block[at.eta * LANES + i] / viscosity_at(block, i, medium)
    )


@choice
def mobility_deficit(block: Block, i: int, medium: Medium) -> Any:
    """Return the ``deficit`` of that mobility."""
    return 1.0 - block[at.eta * LANES + i] / viscosity_at(block, i, medium)


@choice
def hindrance_by_walls(_block: Block, _i: int) -> Tensor:
    """Return the resistance by the walls at the start of a step; by default none."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@choice
def present_hindrance(_block: Block, _i: int) -> Tensor:
    """Return the same of the walls where the lane is."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


def resistances(block: Block, i: int) -> Vector:
    """Return the principal resistances K of lane i without walls, m."""
    k = drag(load3(block, at.stretch, i), load_integrals(block, i))
    return scale_vector(block[at.R * LANES + i], k)


def volume_at_rest(block: Block, i: int) -> Scalar:
    """Return the volume of lane i at rest, m³."""
    R = block[at.R * LANES + i]
    return 4.0 / 3.0 * math.pi * R * R * R
