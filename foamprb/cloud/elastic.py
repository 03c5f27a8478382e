"""Elastic stress, surface tension and mobility of a body, for a lane of a block."""

from __future__ import annotations

from typing import Any

from foamprb.body.rosenbrock import Elasticity, elasticity, extra_elasticity
from foamprb.body.rosenbrock import extra_stress_in_frame as extra_stress
from foamprb.body.rosenbrock import kirchhoff_in_frame as kirchhoff
from foamprb.body.stokes import Mobility, mobility
from foamprb.body.surface_tension import no_stress as interface
from foamprb.body.tensor import Tensor, Vector, diagonal
from foamprb.cloud.block import Medium, at, load_integrals, viscosity_at
from foamprb.cloud.layout import LANES


def solid(block: Any, i: int) -> tuple[Any, Any, Any]:
    """Return μ_s and λ_s, Pa, and the third parameter of the solid."""
    return block[at.mu * LANES + i], block[at.lame * LANES + i], block[at.k * LANES + i]


def conservative_stress(block: Any, i: int, stretches: Vector, b_e: Tensor, J: Any) -> Tensor:
    """Kirchhoff stress of the solid and of its surface tension, Pa, in the particle frame."""
    return _with_interface(block, i, stretches, kirchhoff(b_e, J, *solid(block, i)))


def incompressible_stress(block: Any, i: int, stretches: Vector, b_e: Tensor) -> Tensor:
    """Return the same stress of an incompressible body, without its pressure."""
    return _with_interface(block, i, stretches, extra_stress(b_e, 1.0, *solid(block, i)))


def _with_interface(block: Any, i: int, stretches: Vector, tau: Tensor) -> Tensor:
    s = interface(stretches, block[at.tension * LANES + i])
    return (
        tau[0] + s[0], tau[1], tau[2],
        tau[3], tau[4] + s[1], tau[5],
        tau[6], tau[7], tau[8] + s[2],
    )  # fmt: skip


def solid_elasticity(block: Any, i: int, stretches: Vector, b_e: Tensor) -> Elasticity:
    """Return the elasticity of the solid."""
    J = stretches[0] * stretches[1] * stretches[2]
    return elasticity(diagonal(b_e), J, *solid(block, i), block[at.tension * LANES + i])


def incompressible_elasticity(block: Any, i: int, b_e: Tensor) -> Elasticity:
    """Return the same elasticity without resistance to dilation."""
    mu, _, k = solid(block, i)
    return extra_elasticity(diagonal(b_e), 1.0, mu, 0.0, k, block[at.tension * LANES + i])


def body_mobility(block: Any, i: int, medium: Medium, stretches: Vector) -> Mobility:
    """Return the mobility of an affinely deforming solid; :mod:`foamprb.cloud.drops` binds that of a drop."""
    return mobility(
        stretches, load_integrals(block, i), block[at.eta * LANES + i] / viscosity_at(block, i, medium)
    )


def mobility_deficit(block: Any, i: int, medium: Medium) -> Any:
    """Return the ``deficit`` of that mobility."""
    return 1.0 - block[at.eta * LANES + i] / viscosity_at(block, i, medium)
