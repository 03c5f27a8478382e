"""Dimensionless groups of a run, and a warning for each that is out of the model's range."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.imex import relaxation_time
from foamprb.body.material import MATERIALS, STEADY_CAPILLARY
from foamprb.body.morphology import drop_growth
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import DuctLift, RectangularDuctLift
from foamprb.cloud.integrators.registry import INTEGRATORS, SMALL_STOKES
from foamprb.cloud.measures import as_slice, path_stokes_number, shear_rate_at
from foamprb.cloud.state import Particles
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import medium_at, viscosity_at_nodes
from foamprb.flow.base import Flow
from foamprb.flow.nodes import NodeValues
from foamprb.flow.read.caveats import PHASES, TURBULENT
from foamprb.flow.read.openfoam import INSTANT
from foamprb.settings.settings import Settings
from foamprb.settings.solution import Solution

_MOST_NODES, _SMALL_SHARE = 20_000, 0.01
_STIFF = 1e8
"""Approximate largest μ_s Δt/μ_f without shorter steps by round-off, without inertia."""
_HOLD_OF_TENSION = 0.5
"""Shear modulus over γ/R that holds a body in extension as surface tension does, which alone does so up to
μ_f γ̇ R/γ = 0.16 in uniaxial and 0.18 in planar extension."""
_SHORT_STEPS, _SMALL_TOLERANCE, _OFTEN = (1, 2), 1e-6, 20
"""``maxDeltaT`` in Δt, tolerance, and Δt between writes with which a run costs more than twice as much; from
``tools/benchmark -only observed``."""
_MANY_STEPS = 1e7
"""Least number of steps of a particle above which the user is warned."""
_SMALL_BODY, _LAMINAR = 1e-3, 1e4
"""Least size of a body over its cell, and largest Reynolds number of a steady laminar flow, without a
warning."""
_VISCOUS = 5.0
"""Viscosity ratio of capsules above which their membranes are compressed in steady shear."""
_LIGHT = 20.0
"""Density below which a fluid is a gas, and a solid is unlikely, kg/m³."""
_OF_GASES = (4e-6, 2e-4)
"""Range of the viscosities of gases, Pa s."""
SMALL_REYNOLDS = 0.1
"""Largest particle Reynolds number without a warning; the model assumes Stokes flow around the particle."""


class Groups(NamedTuple):
    """Ranges (smallest, largest) over the particles of one injection model at their release."""

    n: int
    shear_rate: tuple[float, float]
    """γ̇, 1/s."""
    capillary: tuple[float, float]
    """μ_f γ̇/μ_s (52)."""
    reynolds: tuple[float, float]
    """γ̇ d²/ν (53)."""
    stokes: tuple[float, float]
    """Shape Stokes number γ̇ τ_s."""
    step: tuple[float, float]
    """Δt/τ_s."""
    size: tuple[float, float]
    """d over the size of the cell at release."""
    path: tuple[float, float]
    """Stokes number of the path, the largest; see :func:`foamprb.cloud.measures.path_stokes_number`."""
    stiffness: tuple[float, float]
    """μ_s Δt/μ_f."""
    ratio: tuple[float, float] = (0.0, 0.0)
    """Viscosity of the body over that of the fluid."""
    extending: float = 0.0
    """Share of the flow in which the softest particle has no steady shape; see :func:`_extending`."""


def extension_rates(flow: Flow) -> NDArray[np.float64]:
    """Return the rate of extension at some nodes: the largest real part of the eigenvalues of ∇u, 1/s.

    It is zero in simple shear, where every solid has a steady shape.
    """
    gradient = _at_few_nodes(flow).l.reshape(-1, 3, 3)
    rates: NDArray[np.float64] = np.linalg.eigvals(gradient).real.max(axis=1)
    return rates


def _at_few_nodes(flow: Flow) -> NodeValues:
    values = flow.at_some_nodes()
    return values.take(slice(None, None, max(1, len(values.u) // _MOST_NODES)))


def dimensionless_groups(cloud: Cloud, injector: int, extension: NDArray[np.float64]) -> Groups:
    """Return the dimensionless groups of the particles that one injection model releases.

    Parameters
    ----------
    cloud, injector
        The cloud, and the index of the injection model.
    extension
        :func:`extension_rates` of the flow.
    """
    parts = [(p.size, _ranges(cloud, p)) for p in cloud.map_by_id(_released_by, injector) if p.size]
    ranges = np.array([limits for _, limits in parts]) if parts else np.full((1, 9, 2), np.nan)
    lowest, largest = ranges[:, :, 0].min(axis=0), ranges[:, :, 1].max(axis=0)
    rate, capillary, reynolds, stokes, step, size, path, stiffness, ratio = (
        (float(low), float(high)) for low, high in zip(lowest, largest, strict=True)
    )
    n, extending = sum(size for size, _ in parts), _extending(cloud, injector, extension)
    return Groups(n, rate, capillary, reynolds, stokes, step, size, path, stiffness, ratio, extending)


def _ranges(cloud: Cloud, p: Particles) -> list[tuple[float, float]]:
    """Return the ranges of :class:`Groups` for some particles."""
    medium = medium_at(cloud.medium, cloud.flow, p, cloud.time)
    gamma = shear_rate_at(cloud.flow, p, cloud.time)
    tau = relaxation_time(p.rho, p.R, medium.mu, p.eta)
    groups = (
        gamma,
        medium.mu * gamma / p.mu,
        gamma * 4.0 * p.R**2 * medium.rho / medium.mu,
        gamma * tau,
        cloud.dt / tau,
        2.0 * p.R / cloud.flow.cell_size(p.host),
        np.array([path_stokes_number(p, cloud.flow, medium, cloud.time)]),
        p.mu * cloud.dt / medium.mu,
        p.eta / medium.mu,
    )
    return [_range(values) for values in groups]


def _range(values: NDArray[np.float64]) -> tuple[float, float]:
    return float(values.min()), float(values.max())


def _released_by(p: Particles, injector: int) -> Particles:
    return p.take(as_slice(np.flatnonzero(p.injector == injector)))


def _softest_of(p: Particles, injector: int) -> list[tuple[float, float]]:
    """Return modulus in extension, Pa, and viscosity, Pa s, of the softest particle that a model releases."""
    rows = np.flatnonzero(p.injector == injector)
    if len(rows) == 0:
        return []
    moduli = (p.steady_modulus + _HOLD_OF_TENSION * p.gamma / p.R)[rows]
    softest = np.argmin(moduli)
    return [(float(moduli[softest]), float(p.eta[rows[softest]]))]


def _extending(cloud: Cloud, injector: int, extension: NDArray[np.float64]) -> float:
    """Return the share of the nodes where the softest particle has no steady shape.

    A solid has none beyond a capillary number of extension. A drop breaks up where it grows faster than its
    surface tension restores it. Membranes have no such limit.
    """
    softest = [softness for of_rank in cloud.map_ranks(_softest_of, injector) for softness in of_rank]
    if len(extension) == 0 or not softest or MATERIALS[cloud.models.material].slides:
        return 0.0
    values = _at_few_nodes(cloud.flow)
    mu = np.asarray(viscosity_at_nodes(cloud.medium.mu, values))
    modulus, eta = min(softest, key=lambda softness: softness[0])
    times = mu / modulus
    if MATERIALS[cloud.models.material].liquid:
        ratio = eta / mu
        l: Any = tuple(values.l.T)
        growth, limit = drop_growth(l, ratio, times)
        growing = np.stack(np.broadcast_arrays(*growth), axis=-1).reshape(-1, 3, 3)
        return float(np.mean(np.linalg.eigvals(growing).real.max(axis=1) > limit))
    return float(np.mean(np.sqrt(3.0) * extension * times > STEADY_CAPILLARY))


def doubtful_densities(settings: Settings) -> list[str]:
    """Return a sentence for each density that is probably in g/cm³."""
    fluid, sentences = settings.fluid, []
    low, high = _OF_GASES
    if fluid.nu is not None and fluid.rho < _LIGHT and not low <= fluid.rho * fluid.nu <= high:
        sentences.append(
            f"the density of the fluid is {fluid.rho:g} kg/m3 and its viscosity {fluid.rho * fluid.nu:.3g} "
            f"Pa s, which no gas has. {_in_grams(fluid.rho)}"
        )
    for injection in settings.injections:
        rho = injection.rho0 if isinstance(injection.rho0, float | int) else injection.rho0.limits[1]
        if rho < _LIGHT and not MATERIALS[injection.solid.type].liquid:
            sentences.append(
                f"injection model {injection.name}: rho0 is {rho:g} kg/m3, less than solids have. "
                f"{_in_grams(rho)}"
            )
    return sentences


def _in_grams(rho: float) -> str:
    return f"If {rho:g} g/cm3 are meant: {1000.0 * rho:g} kg/m3."


def doubtful_lengths(settings: Settings, cloud: Cloud, size: float) -> list[str]:
    """Return a warning if bodies or the Reynolds number show that lengths in mm were read as m.

    Turbulent flows, phases and instants of unsteady flows may have any Reynolds number, and large cells.

    Parameters
    ----------
    settings, cloud
        The input, and the cloud before its first step.
    size
        Largest diameter over the size of its cell; NaN without particles.
    """
    flow, others = cloud.flow, (TURBULENT, PHASES, INSTANT)
    excused = settings.dispersion or settings.solution.transient or settings.fluid.varying is not None
    if excused or any(note.startswith(others) for note in flow.notes):
        return []
    speed = float(np.linalg.norm(flow.at_some_nodes().u, axis=1).max(initial=0.0))
    reynolds = speed * flow.width / settings.fluid.nu if settings.fluid.nu else 0.0
    signs = [f"bodies of {size:.2g} cells"] if size < _SMALL_BODY else []
    if math.isfinite(reynolds) and reynolds > _LAMINAR:
        signs.append(f"a Reynolds number of {reynolds:.2g} in a laminar flow of {flow.width:.3g} m")
    return [f"the flow has {' and '.join(signs)}. Are its lengths in m?"] if signs else []


def outside_flow(settings: Settings, flow: Flow) -> list[str]:
    """Return a sentence for each plane of a cloud function, or middle of a duct, that misses the flow."""
    planes: dict[str, list[tuple[Any, Any]]] = {}
    for name, function in settings.functions.items():
        if hasattr(function, "origin") and hasattr(function, "normal"):
            planes[f"cloudFunctions/{name}: its plane"] = [(function.origin, function.normal)]
    for name, force in settings.forces.items():
        if isinstance(force, DuctLift | RectangularDuctLift):
            planes[f"particleForces/{name}: its axis or middle plane"] = [
                (force.origin, normal) for normal in force.normals
            ]
    low, high = flow.bounds
    sentences = []
    for what, missed in planes.items():
        for origin, normal in missed:
            # Products of a normal and the sides of a box are the farthest at its corners.
            ends = np.stack([low - origin, high - origin]) * normal
            if np.isfinite(ends).all() and not ends.min(axis=0).sum() <= 0.0 <= ends.max(axis=0).sum():
                corners = " to ".join("({:.3g} {:.3g} {:.3g})".format(*corner) for corner in (low, high))
                sentences.append(f"{what} misses the flow, which is in {corners} m.")
                break
    return sentences


def late_releases(settings: Settings, cloud: Cloud, injector: int, n: int, more: int) -> list[str]:
    """Return a sentence if some particles of an injection model are due after the end of the run.

    The cloud has n of its particles; ``more`` are not stored.
    """
    end, injection = settings.solution.endTime, settings.injections[injector]
    late, n = sum(cloud.map_ranks(_count_late, injector, end)) + more, n + more
    if not late:
        return []
    which = f"{late} of {n} particles are" if late < n else f"none of {n} particles is"
    when = "due at or after" if late < n else "released before"
    duration = getattr(injection.model, "duration", 0.0)
    lasting = f" and lasts {duration:g} s" if duration else ""
    start = max(injection.model.SOI, cloud.start)
    return [
        f"injection model {injection.name}: {which} {when} endTime, {end:g} s: injection begins at "
        f"{start:g} s{lasting}."
    ]


def _count_late(p: Particles, injector: int, end: float) -> int:
    return int(np.count_nonzero((p.injector == injector) & (p.t0 >= end)))


def costly_settings(solution: Solution, cloud: Cloud, steps: int) -> list[str]:
    """Return a sentence for each setting that more than doubles the cost of a run of ``steps`` deltaT."""
    sentences, tolerance = [], cloud.tolerance
    longest_step = cloud.tracker.stride or cloud.tracker.stretch_steps
    if steps > _MANY_STEPS * longest_step:
        sentences.append(
            f"solution: the run is {steps:.3g} deltaT, and no step is longer than {longest_step} deltaT: a "
            f"particle takes {steps / longest_step:.2g} steps or more until endTime. Use a longer deltaT; "
            "foamprb init proposes one."
        )
    adaptive = INTEGRATORS[cloud.models.integrator].adaptive
    if adaptive and solution.stride in _SHORT_STEPS:
        longest = solution.maxDeltaT / cloud.dt
        sentences.append(
            f"solution: maxDeltaT is {longest:.3g} deltaT, and no step is longer: a run costs several times "
            "that without maxDeltaT, where the tolerance limits steps."
        )
    if adaptive and tolerance <= _SMALL_TOLERANCE:
        more = (Models.tolerance / tolerance) ** (1.0 / 3.0)
        sentences.append(
            f"solution: with the tolerance {tolerance:g} steps are about {more:.2g} times as many as with "
            f"the default, {Models.tolerance:g}."
        )
    if solution.writeInterval < _OFTEN * solution.deltaT:
        sentences.append(
            f"solution: results are written every {solution.writeInterval / solution.deltaT:.3g} deltaT, "
            f"which costs more than the particles; from {_OFTEN} on it does not."
        )
    return sentences


def validity_warnings(
    g: Groups,
    integrator: str,
    where: str,
    liquid: bool = False,
    membrane: bool = False,
    vesicle: bool = False,
) -> list[str]:
    """Return a sentence, with its number, for each group that is out of the model's range.

    Parameters
    ----------
    g, integrator
        The groups, and the integrator of the shape.
    where
        Beginning of the sentences, e.g. ``injection model inlet``.
    liquid, membrane, vesicle
        Whether the particles are drops; capsules whose membrane resists changes of its area little; vesicles.
    """
    sentences = []
    scheme = INTEGRATORS[integrator]
    if g.step[1] > scheme.stable_steps:
        sentences.append(
            f"{where}: deltaT is {g.step[1]:.3g} times the shape's relaxation time; the integrator is stable "
            f"only below about {scheme.stable_steps:g}, less for elongated particles."
        )
    if not scheme.inertia and g.stokes[1] > 10 * SMALL_STOKES:
        sentences.append(
            f"{where}: the shape Stokes number is {g.stokes[1]:.3g}; the integrator {integrator} leaves out "
            "the inertia of the solid, which matters there."
        )
    if not scheme.inertia and g.path[1] > 10 * SMALL_STOKES:
        sentences.append(
            f"{where}: drag stops the particles within {g.path[1]:.3g} times the width of the flow; the "
            f"integrator {integrator} leaves out their inertia: use rosenbrock."
        )
    if not scheme.inertia and g.stiffness[1] > _STIFF:
        sentences.append(
            f"{where}: the shear modulus is {g.stiffness[1]:.2g} times mu/deltaT; above about {_STIFF:g} "
            f"round-off shortens the steps of {integrator}. A body of Ca = 1e-6 is as good as rigid."
        )
    if g.reynolds[1] > SMALL_REYNOLDS:
        sentences.append(
            f"{where}: the particle Reynolds number is {g.reynolds[1]:.3g}; the traction and the drag are "
            f"those of Stokes flow, which needs it small (below {SMALL_REYNOLDS:g})."
        )
    if membrane and g.ratio[1] > _VISCOUS:
        sentences.append(
            f"{where}: the liquid of the capsules is {g.ratio[1]:.3g} times as viscous as the fluid; above "
            f"about {_VISCOUS:g} their membrane is compressed at any shear rate, and wrinkles."
        )
    if vesicle and g.capillary[1] < 1.0:
        sentences.append(
            f"{where}: the capillary number by bendingModulus is {g.capillary[1]:.3g} at most; below about 1 "
            "bending, which is left out, determines the shape."
        )
    if g.extending > _SMALL_SHARE:
        share = f"{where}: in {100 * g.extending:.3g} % of the flow"
        sentences.append(
            f"{share} a drop has no steady shape: one that stays there breaks up, and fails at maxStretch."
            if liquid
            else f"{share} the capillary number is beyond {STEADY_CAPILLARY:g} in extension, where a body "
            "has no steady shape: one that stays there is stretched on and on, and fails at maxStretch."
        )
    return sentences
