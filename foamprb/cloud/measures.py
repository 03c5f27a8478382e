"""Measures of a particle: shape, orientation, rotation and load, derived from its state.

The formulas are compiled, and process particles in blocks of lanes, as in the particle loop.
Measuring a large cloud takes no memory that grows with it: :func:`contexts` gives some thousands of particles
at a time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property, partial
from types import MappingProxyType
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import sorted_frame, taylor_deformation
from foamprb.body.imex import relaxation_time
from foamprb.body.morphology import drop_stress
from foamprb.body.quadratic import bullet_amplitude
from foamprb.body.swimming import direction
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    axial,
    cofactor,
    det,
    dev,
    diagonal,
    dot,
    dot_vector,
    from_frame,
    inner,
    inverse,
    scale,
    select,
    skew,
    sym,
    to_frame,
    transpose,
)
from foamprb.body.traction import disturbance
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import (
    ROWS,
    Medium,
    at,
    load3,
    load9,
    load_integrals,
    new_block,
    new_integrals,
    resume_frames,
    store3,
    store9,
)
from foamprb.cloud.layout import LANES, Block, Row, end, offsets
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.viscosity import VaryingViscosity, viscosity_of
from foamprb.compile.link import link
from foamprb.flow.base import Flow, Sampled
from foamprb.flow.fields import Fields, FieldValues, columns_of, field_of

Floats = NDArray[np.float64]

PER_CONTEXT = 1 << 14
"""Most particles of one of :func:`contexts`; their arrays stay in the processor's cache."""


class MeasureRows(NamedTuple):
    """Rows of computed values below the rows of a block."""

    gradient: Annotated[int, Row(9, "1", "F·F₀⁻¹, the deformation gradient from the shape at rest")]
    axes: Annotated[int, Row(3, "m", "semi-axes in falling order")]
    orientation: Annotated[int, Row(4, "1", "the frame's quaternion w, x, y, z")]
    stresslet: Annotated[int, Row(6, "N m", "components xx yy zz xy yz xz")]
    spin: Annotated[int, Row(3, "1/s", "angular velocity")]
    volume_ratio: Annotated[int, Row(1, "1", "J = det F")]
    rate: Annotated[int, Row(1, "1/s", "shear rate of the fluid")]
    viscosity: Annotated[int, Row(1, "Pa s", "viscosity of the fluid")]


result = offsets(MeasureRows, ROWS)
ALL_ROWS = end(result)
_FIRST = tuple(result)
_SIZES = dict(zip(result._fields, np.diff((*result, ALL_ROWS)).tolist(), strict=True))


class FlowSamples(NamedTuple):
    """Flow at the particles of a cloud at one time; NaN where the fluid is unknown."""

    u: Floats
    """Velocity, (n, 3), m/s."""
    l_f: Floats
    """∂u_i/∂x_j, (n, 9), 1/s."""
    mu: Floats | None = None
    """Viscosity of the fluid, (n,), Pa s, if it varies."""
    fields: Mapping[str, FieldValues] = MappingProxyType({})
    """Sampled fields of the case."""


@dataclass(frozen=True)
class Context:
    """Particles with the values that several measures share, each computed when it is first requested.

    Parameters
    ----------
    particles
        The particles, all of them injected.
    rows
        Row numbers in the whole cloud.
    time
        Time of the state, s.
    sampled
        Returns the flow at the centres, with its viscosity.
    fields
        Returns the sampled fields of the case at the centres, by :func:`name_of_field`.
    """

    particles: Particles
    rows: NDArray[np.int64]
    time: float
    sampled: Callable[[], FlowSamples]
    fields: Callable[[], Mapping[str, FieldValues]]

    @property
    def F(self) -> Tensor:
        """Deformation gradient from the unit sphere."""
        return tuple(self.particles.F.T)

    @property
    def frame(self) -> Tensor:
        """Particle frame, axes in falling order of length."""
        return tuple(self._shape[0][:9])

    @property
    def stretches(self) -> tuple[Floats, Floats, Floats]:
        """Principal stretches, in the order of the axes."""
        return tuple(self._shape[0][9:])

    @property
    def u(self) -> Floats:
        """Velocity of the fluid at the centres, (n, 3), m/s; NaN where the fluid is unknown."""
        return self._flow.u

    @property
    def l_f(self) -> Tensor:
        """∂u_i/∂x_j of the fluid, 1/s; NaN where the fluid is unknown."""
        return tuple(self._flow.l_f.T)

    @property
    def mu(self) -> Floats:
        """Viscosity of the fluid, (n,), Pa s; NaN where it varies and the fluid is unknown."""
        assert self._flow.mu is not None
        return self._flow.mu

    def value(self, name: str) -> Floats:
        """Return one of :class:`MeasureRows`, (n, k)."""
        return (self._load if name in _OF_FLOW else self._shape)[1][name]

    @cached_property
    def _flow(self) -> FlowSamples:
        return self.sampled()

    @cached_property
    def _load(self) -> tuple[Floats, dict[str, Floats]]:
        """Frames and stretches, (12, n), and the :class:`MeasureRows`."""
        return _computed(self.particles, self._flow.l_f, self.mu)

    @cached_property
    def _shape(self) -> tuple[Floats, dict[str, Floats]]:
        """As :attr:`_load`, but without the flow if nothing else has sampled it."""
        if "_flow" in self.__dict__:
            return self._load
        n = self.particles.size
        return _computed(self.particles, np.full((n, 9), np.nan), np.full(n, np.nan))


_OF_FLOW = frozenset({"stresslet", "rate", "viscosity"})
"""The :class:`MeasureRows` that depend on the flow."""


class Measure(NamedTuple):
    """Reported quantity: its unit, and the function that computes it for all particles."""

    unit: str
    value: Callable[[Context], NDArray[Any]]
    of_flow: bool = False
    """Whether it depends on the flow at the particle."""


# ---------------------------------------------------------------------------------------------------------
# Formulas


def quaternion(Q: Tensor) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """Return the unit quaternion (w, x, y, z), w ≥ 0, of the rotation of the fixed axes onto the rows of Q.

    Of the four quaternions that follow from the sums and differences of components, that with the largest
    norm (Shepperd 1978).
    """
    wx, wy, wz = Q[5] - Q[7], Q[6] - Q[2], Q[1] - Q[3]
    xy, xz, yz = Q[1] + Q[3], Q[2] + Q[6], Q[5] + Q[7]
    ww, xx = 1.0 + Q[0] + Q[4] + Q[8], 1.0 + Q[0] - Q[4] - Q[8]
    yy, zz = 1.0 - Q[0] + Q[4] - Q[8], 1.0 - Q[0] - Q[4] + Q[8]
    upper, lower = ww >= xx, yy >= zz
    first = np.maximum(ww, xx) >= np.maximum(yy, zz)
    w = select(first, select(upper, ww, wx), select(lower, wy, wz))
    x = select(first, select(upper, wx, xx), select(lower, xy, xz))
    y = select(first, select(upper, wy, xy), select(lower, yy, yz))
    z = select(first, select(upper, wz, xz), select(lower, yz, zz))
    n = select(w < 0.0, -1.0, 1.0) / np.sqrt(w * w + x * x + y * y + z * z)
    return n * w, n * x, n * y, n * z


def circulation(l: Tensor) -> Scalar:
    """Return √det of a velocity gradient in the plane of its rotation; 0 where material does not circulate.

    In a steady shape material goes round with this angular velocity (Roscoe 1967), which is less than that of
    the :func:`axial` vector of its skew part.
    """
    n = axial(skew(l))
    n_2 = inner(n, n)
    # n·cof(l)·n is n² times the determinant in the plane across n.
    return np.sqrt(np.maximum(inner(n, dot_vector(cofactor(l), n)), 0.0) / np.maximum(n_2, 1e-300))


def sort_stage(block: Block) -> None:
    """Sort the axes of the frames by length, the longest first."""
    for i in range(LANES):
        Q, stretches = sorted_frame(load9(block, at.Q, i), load3(block, at.stretch, i))
        store9(block, at.Q, i, Q)
        store3(block, at.stretch, i, stretches)


def report_stage(block: Block) -> None:
    """Compute the values that need frames, stretches and their integrals.

    The stresslet is S = V μ_f dev sym s̃(d, w), the body's extra stress times volume (Batchelor 1970), where
    s̃ is Jeffery's disturbance (B.5), the far field of which is the stresslet; a drop has its own.
    """
    for i in range(LANES):
        F, Q, stretches = load9(block, at.new_F, i), load9(block, at.Q, i), load3(block, at.stretch, i)
        store9(block, result.gradient, i, dot(F, inverse(load9(block, at.F0, i))))
        w, x, y, z = quaternion(Q)
        block[result.orientation * LANES + i] = w
        store3(block, result.orientation + 1, i, (x, y, z))
        J, R = det(F), block[at.R * LANES + i]
        store3(block, result.axes, i, (R * stretches[0], R * stretches[1], R * stretches[2]))
        block[result.volume_ratio * LANES + i] = J
        l, body = load9(block, at.l, i), dot(load9(block, at.A, i), inverse(F))
        block[result.rate * LANES + i] = shear_rate(l)
        # The axial vector of w_s = skw(A F⁻¹) (A.3).
        store3(block, result.spin, i, axial(skew(body)))
        # Of the flow relative to the body.
        relative = to_frame(Q, add(l, scale(-1.0, body)))
        s, _ = disturbance(stretches, load_integrals(block, i), dev(sym(relative)), skew(relative))
        volume = 4.0 / 3.0 * np.pi * R * R * R * J
        S = from_frame(Q, scale(volume * block[result.viscosity * LANES + i], dev(sym(s))))
        store3(block, result.stresslet, i, diagonal(S))
        store3(block, result.stresslet + 3, i, (S[1], S[5], S[2]))


def drop_stage(block: Block) -> None:
    """Replace the stresslet by that of drops."""
    for i in range(LANES):
        l, R = load9(block, at.l, i), block[at.R * LANES + i]
        F = load9(block, at.new_F, i)
        body = dot(load9(block, at.A, i), inverse(F))
        mu = block[result.viscosity * LANES + i]
        Ca = mu * block[result.rate * LANES + i] / block[at.mu * LANES + i]
        s = drop_stress(block[at.eta * LANES + i] / mu, Ca, dev(sym(l)), sym(body), dot(F, transpose(F)))
        S = scale(4.0 / 3.0 * np.pi * R * R * R * mu, s)
        store3(block, result.stresslet, i, diagonal(S))
        store3(block, result.stresslet + 3, i, (S[1], S[5], S[2]))


def measure_block(
    F: Floats,
    A: Floats,
    Q: Floats,
    F0: Floats,
    R: Floats,
    modulus: Floats,
    eta: Floats,
    drop: NDArray[np.int8],
    l: Floats,
    mu: Floats,
    block: Floats,
    frames: Floats,
    tables: tuple[Floats, ...],
) -> None:
    """Compute the frames, the stretches and the :class:`MeasureRows` of n particles.

    Parameters
    ----------
    F, A, Q, F0, R, modulus, eta, drop
        As in :class:`~foamprb.cloud.state.Particles`.
    l
        ∂u_i/∂x_j of the fluid, (n, 9), 1/s.
    mu
        Viscosity of the fluid, (n,), Pa s.
    block
        Working memory, (ALL_ROWS · LANES,).
    frames
        Takes 9 rows of the frame and 3 of the stretches, (12, n).
    tables
        Take the :class:`MeasureRows`, each (n, k).
    """
    n = F.shape[0]
    for start in range(0, n, LANES):
        for i in range(LANES):
            # The last particle fills the lanes that are left, so that all go the same way.
            k = min(start + i, n - 1)
            for c in range(9):
                block[(at.new_F + c) * LANES + i] = F[k, c]
                block[(at.A + c) * LANES + i] = A[k, c]
                block[(at.frame + c) * LANES + i] = Q[k, c]
                block[(at.F0 + c) * LANES + i] = F0[k, c]
                block[(at.l + c) * LANES + i] = l[k, c]
            block[at.R * LANES + i] = R[k]
            block[result.viscosity * LANES + i] = mu[k]
            block[at.mu * LANES + i], block[at.eta * LANES + i] = modulus[k], eta[k]
        resume_frames(block)
        sort_stage(block)
        new_integrals(block)
        report_stage(block)
        # A cloud is of drops or of solids.
        if drop[start]:
            drop_stage(block)
        m = min(LANES, n - start)
        for c in range(9):
            for i in range(m):
                frames[c, start + i] = block[(at.Q + c) * LANES + i]
        for c in range(3):
            for i in range(m):
                frames[9 + c, start + i] = block[(at.stretch + c) * LANES + i]
        for q in range(len(tables)):
            values, first = tables[q], _FIRST[q]
            for i in range(m):
                for c in range(values.shape[1]):
                    values[start + i, c] = block[(first + c) * LANES + i]


# ---------------------------------------------------------------------------------------------------------
# Measures


def shear_rate_at(flow: Flow, p: Particles, time: float) -> Floats:
    """Return the shear rate γ̇ of the flow at the particles at ``time`` (s), (n,), 1/s."""
    rate = np.empty(p.size)
    for start in range(0, p.size, PER_CONTEXT):
        part = slice(start, start + PER_CONTEXT)
        gradient = flow.sample(p.x[part], p.host[part], time)[1].reshape(-1, 9)
        rate[part] = shear_rate(tuple(gradient.T))  # type: ignore[arg-type]
    return rate


def carrier_velocity(p: Particles, u: Floats) -> Floats:
    """Return the velocity of the fluid that carries particles, (n, 3), m/s: u and that of their eddies."""
    return u + p.eddy


def swimming_direction(p: Particles) -> Floats:
    """Return the directions in which particles swim, (n, 3), unit vectors; 0 if they do not."""
    return np.stack(direction(tuple(p.F.T), tuple(p.heading.T)), axis=1)


def shape_stokes_number(p: Particles, flow: Flow, mu: float | Floats, time: float) -> float:
    """Return the largest γ̇ τ_s of the particles at ``time`` (s) in a fluid of viscosity μ_f (Pa s)."""
    if p.size == 0:
        return 0.0
    rate = shear_rate_at(flow, p, time)
    return float((rate * relaxation_time(p.rho, p.R, mu, p.eta)).max())


def path_stokes_number(p: Particles, flow: Flow, medium: Medium, time: float) -> float:
    """Return the largest τ_p w/L of the particles at ``time`` (s), with τ_p = 2 ρ_s R²/(9 μ_f).

    w is the slip at the release or the settling speed, so that τ_p w is the distance in which drag stops a
    particle. L is the flow's width; without walls the number is zero. The medium is that at the particles
    (:func:`foamprb.cloud.viscosity.medium_at`).
    """
    if p.size == 0 or not flow.width < math.inf:
        return 0.0
    tau = 2.0 * p.rho * p.R**2 / (9.0 * medium.mu)
    slip = tau * np.abs(1.0 - medium.rho / p.rho) * np.linalg.norm(medium.gravity)
    launched = np.flatnonzero(np.isfinite(p.v[:, 0]) & (p.host >= 0))
    for start in range(0, len(launched), PER_CONTEXT):
        rows = launched[start : start + PER_CONTEXT]
        u = carrier_velocity(p.take(rows), flow.sample(p.x[rows], p.host[rows], time)[0])
        slip[rows] = np.maximum(slip[rows], np.linalg.norm(p.v[rows] - u, axis=1))
    return float((tau * slip).max() / flow.width)


def _value(name: str) -> Callable[[Context], Floats]:
    """Return a function that reads a value of :class:`MeasureRows` by its name."""
    return lambda c: c.value(name) if _SIZES[name] > 1 else c.value(name)[:, 0]


def _circulation(c: Context) -> Floats:
    return np.asarray(circulation(dot(tuple(c.particles.A.T), inverse(c.F))))


def _glyph(c: Context) -> Floats:
    """Return the columns of R F, one after the other, (n, 9), m."""
    p = c.particles
    return np.asarray((p.R[:, None] * p.F).reshape(-1, 3, 3).swapaxes(1, 2).reshape(-1, 9))


MEASURES: dict[str, Measure] = {
    "U": Measure("m/s", lambda c: c.particles.v),
    "d": Measure("m", lambda c: 2.0 * c.particles.R),
    "rho": Measure("kg/m3", lambda c: c.particles.rho),
    "age": Measure("s", lambda c: c.particles.t - c.particles.t0),
    "origId": Measure("", lambda c: c.rows),
    "active": Measure("", lambda c: c.particles.status == Status.ACTIVE),
    "deformationGradient": Measure("1", _value("gradient")),
    "glyph": Measure("m", _glyph),
    "semiAxes": Measure("m", _value("axes")),
    "orientation": Measure("1", _value("orientation")),
    "taylorDeformation": Measure("1", lambda c: taylor_deformation(c.stretches[0], c.stretches[2])),
    "stresslet": Measure("N m", _value("stresslet"), of_flow=True),
    "J": Measure("1", _value("volume_ratio")),
    "angularVelocity": Measure("1/s", _value("spin")),
    "circulation": Measure("1/s", _circulation),
    "shearRate": Measure("1/s", _value("rate"), of_flow=True),
    "capillaryNumber": Measure("1", lambda c: c.mu * c.value("rate")[:, 0] / c.particles.mu, of_flow=True),
    "status": Measure("", lambda c: c.particles.status),
    "reason": Measure("", lambda c: c.particles.reason),
    "patch": Measure("", lambda c: c.particles.patch),
    "injector": Measure("", lambda c: c.particles.injector),
    "Uc": Measure("m/s", lambda c: carrier_velocity(c.particles, c.u), of_flow=True),
    "Ur": Measure("m/s", lambda c: c.particles.v - carrier_velocity(c.particles, c.u), of_flow=True),
    "muc": Measure("Pa s", lambda c: c.mu, of_flow=True),
    "swimmingDirection": Measure("1", lambda c: swimming_direction(c.particles)),
    "quadraticShape": Measure("1", lambda c: c.particles.B),
    "bulletAmplitude": Measure("1", lambda c: bullet_amplitude(tuple(c.particles.B.T))),
}
"""Every reported quantity by the name under which it is written, OpenFOAM's where it has one.

``deformationGradient`` is F·F₀⁻¹, from the shape at rest; ``glyph`` is what ParaView's Tensor Glyph draws
as the deformed unit sphere; ``orientation`` is the :func:`quaternion` of the frame; ``taylorDeformation`` is
that of the longest and the shortest axis; the components of ``stresslet`` are xx yy zz xy yz xz;
``angularVelocity`` is that of the skew part of the body's velocity gradient, and :func:`circulation` that of
points on its surface;
``capillaryNumber`` is that of the shear rate where the particle is; ``Uc`` and ``Ur`` are the velocity of the
fluid at the centre and the particle's velocity relative to it, and ``muc`` is the fluid's viscosity there;
``swimmingDirection`` is 0 without swimming, as are the components 111 112 113 122 123 222 223 of the
``quadraticShape``, and its ``bulletAmplitude`` ε, without that mode.
"""
OF_RATES = ("stresslet", "angularVelocity", "circulation")
"""Measures that depend on dF/dt."""
_TAKEN = frozenset(MEASURES) | frozenset(
    (
        "id", "d", "rho", "Ca", "t0", "x0", "y0", "z0", "t1", "x1", "y1", "z1", "fate", "patch",
        "a", "b", "c", "D", "time", "injector", "maxD", "maxShearRate", "maxShearStress", "maxReynolds",
        "minGap", "curvatureNumber", "maxBulletAmplitude", "touchedAtRelease",
    )
)  # fmt: skip


def name_of_field(name: str) -> str:
    """Return the name under which a field of the case is written: with a c, as ``rhoc``, if it is taken."""
    return name_of_field(f"{name}c") if name in _TAKEN else name


def fields_at(flow: Sampled, x: Floats, hosts: NDArray[Any], t: Any) -> dict[str, FieldValues]:
    """Return the sampled fields of a flow at points (n, 3) in hosts (n,), −1 for none, by name; no gradients.

    The times t, s, are one for all or (n,).
    """
    columns = [column for column in columns_of(flow) if column.name == field_of(column.name)]
    if not columns:
        return {}
    if len(x) == 0:
        return {name_of_field(c.name): FieldValues(np.empty((0, c.components)), c.unit) for c in columns}
    source: Any = flow
    fields: Fields = source.fields(float(np.min(t)), float(np.max(t)))
    values = fields.at(x, hosts, t)
    return {name_of_field(c.name): values[c.name] for c in columns}


WRITTEN = ("U", "d", "rho", "age", "origId", "glyph", "status", "reason", "patch", "injector")
"""Names of the measures that every file of a cloud contains."""
REQUESTED = tuple(name for name in MEASURES if name not in WRITTEN)
"""Names of the measures that files contain on request only."""


def context(
    particles: Particles,
    flow: Sampled | FlowSamples,
    mu: float | VaryingViscosity,
    time: float,
    ids: NDArray[np.int64] | None = None,
) -> Context:
    """Prepare the injected particles of a cloud for measuring.

    Parameters
    ----------
    particles
        The whole cloud, or a part of it.
    flow
        The flow around them, or what it was there.
    mu
        Viscosity of the fluid, Pa s, or a model of it; values sampled with the flow take its place.
    time
        Time of the state, s.
    ids
        Row numbers of a part in the whole cloud.
    """
    return _prepare(particles, injected(particles), flow, mu, time, ids)


def contexts(
    particles: Particles,
    flow: Sampled | FlowSamples,
    mu: float | VaryingViscosity,
    time: float,
    ids: NDArray[np.int64] | None = None,
) -> Iterator[Context]:
    """Prepare the injected particles of a cloud part by part; an empty cloud gives one empty context.

    Parameters
    ----------
    particles, flow, mu, time, ids
        As in :func:`context`.
    """
    rows = injected(particles)
    for i in range(number_of_contexts(len(rows))):
        yield _prepare(particles, rows[i * PER_CONTEXT : (i + 1) * PER_CONTEXT], flow, mu, time, ids)


def number_of_contexts(n: int) -> int:
    """Return the number of :func:`contexts` of n injected particles."""
    return max(1, -(-n // PER_CONTEXT))


def injected(particles: Particles) -> NDArray[np.int64]:
    """Return the rows of the injected particles."""
    return np.flatnonzero(particles.status != Status.PENDING)


def released(particles: Particles, flow: Sampled, time: float) -> Particles:
    """Return the same particles, with the particles due at ``time`` (s) injected.

    They move with the fluid's velocity if none is given, and do not yet turn or deform.
    """
    now = (particles.status == Status.PENDING) & (particles.t0 <= time)
    carried = np.flatnonzero(now & np.isnan(particles.v[:, 0]))
    v = particles.v.copy()
    for start in range(0, len(carried), PER_CONTEXT):
        rows = carried[start : start + PER_CONTEXT]
        v[rows] = flow.sample(particles.x[rows], particles.host[rows], time)[0]
    return particles._replace(status=np.where(now, Status.ACTIVE, particles.status).astype(np.int8), v=v)


def measure(c: Context, names: Collection[str] = tuple(MEASURES)) -> dict[str, NDArray[Any]]:
    """Return some of the :data:`MEASURES` by name, by default all, in their order."""
    # The measures of the flow first: the kernel computes the shape with them.
    order = sorted(names, key=lambda name: not MEASURES[name].of_flow)
    values = {name: np.asarray(MEASURES[name].value(c)) for name in order}
    return {name: values[name] for name in MEASURES if name in values}


def shapes(particles: Particles) -> tuple[Floats, Floats]:
    """Return semi-axes (n, 3), m, and D (n,) of particles of any status."""
    p = particles._replace(status=np.full_like(particles.status, Status.ACTIVE))
    unknown = FlowSamples(np.full((p.size, 3), np.nan), np.full((p.size, 9), np.nan), None, {})
    pairs = [
        (MEASURES["semiAxes"].value(c), MEASURES["taylorDeformation"].value(c))
        for c in contexts(p, unknown, math.nan, math.nan)
    ]
    axes, D = (np.concatenate(parts) for parts in zip(*pairs, strict=True))
    return axes, D


def flow_samples(
    particles: Particles,
    flow: Sampled,
    time: float,
    mu: float | VaryingViscosity = math.nan,
    names: Collection[str] = tuple(MEASURES),
) -> FlowSamples:
    """Return the flow at a time (s) at the injected particles of a cloud, for some of the :data:`MEASURES`.

    Its viscosity is sampled if it varies, its velocity if one of the measures depends on the flow.
    """
    u, l_f = np.full((particles.size, 3), np.nan), np.full((particles.size, 9), np.nan)
    mu_f = np.full(particles.size, np.nan) if isinstance(mu, VaryingViscosity) else None
    rows = injected(particles)
    fields = fields_at(flow, particles.x, particles.host, time)
    for start in range(0, len(rows), PER_CONTEXT) if any(MEASURES[name].of_flow for name in names) else ():
        part = as_slice(rows[start : start + PER_CONTEXT])
        x, hosts = particles.x[part], particles.host[part]
        u[part], l_f[part] = _sampled(x, hosts, flow, time)
        if mu_f is not None:
            mu_f[part] = viscosity_of(mu, flow, x, hosts, l_f[part], time)
    return FlowSamples(u, l_f, mu_f, fields)


def _prepare(
    particles: Particles,
    rows: NDArray[np.int64],
    flow: Sampled | FlowSamples,
    mu: float | VaryingViscosity,
    time: float,
    ids: NDArray[np.int64] | None,
) -> Context:
    index = as_slice(rows)
    p = particles.take(index)
    return Context(
        p,
        rows if ids is None else ids[rows],
        time,
        partial(_samples, p, index, flow, mu, time),
        partial(_fields, p, index, flow, time),
    )


def _samples(
    p: Particles, index: Any, flow: Sampled | FlowSamples, mu: float | VaryingViscosity, time: float
) -> FlowSamples:
    """Return the flow at particles with its viscosity; they are some rows of stored samples."""
    if isinstance(flow, FlowSamples):
        u, l, mu_f = flow.u[index], flow.l_f[index], None if flow.mu is None else flow.mu[index]
    else:
        (u, l), mu_f = _sampled(p.x, p.host, flow, time), None
    if mu_f is None:
        mu_f = np.full(p.size, viscosity_of(mu, flow, p.x, p.host, l, time))
    return FlowSamples(u, l, mu_f)


def _fields(p: Particles, index: Any, flow: Sampled | FlowSamples, time: float) -> dict[str, FieldValues]:
    """Return the sampled fields at particles; they are some rows of stored samples."""
    if isinstance(flow, FlowSamples):
        return {name: FieldValues(f.values[index], f.unit) for name, f in flow.fields.items()}
    return fields_at(flow, p.x, p.host, time)


def _computed(p: Particles, l: Floats, mu: Floats) -> tuple[Floats, dict[str, Floats]]:
    """Return the results of the kernel: frames and stretches, (12, n), and the :class:`MeasureRows`."""
    frames, block = np.empty((12, p.size)), new_block(ALL_ROWS)
    values = {name: np.empty((p.size, size)) for name, size in _SIZES.items()}
    _kernel()(
        p.F, p.A, p.Q, p.F0, p.R, p.mu, p.eta, p.drop, l, mu, block, frames, tuple(values.values())
    )  # fmt: skip
    return frames, values


@cache
def _kernel() -> Any:
    return link(measure_block)


def as_slice(rows: NDArray[np.int64]) -> NDArray[np.int64] | slice:
    """Return consecutive rows as a slice, which avoids a copy; others as they are."""
    n = len(rows)
    follow = n > 0 and rows[-1] - rows[0] == n - 1 and bool((np.diff(rows) == 1).all())
    return slice(rows[0], rows[-1] + 1) if follow else rows


def _sampled(x: Floats, hosts: NDArray[np.int32], flow: Sampled, time: float) -> tuple[Floats, Floats]:
    """Return u, (n, 3), and ∂u_i/∂x_j, (n, 9), at points; NaN outside the flow."""
    inside = (hosts >= 0) & np.isfinite(x).all(axis=1)
    velocity, gradient = np.full((len(x), 3), np.nan), np.full((len(x), 9), np.nan)
    if inside.any():
        u, l = flow.sample(x, hosts, time) if inside.all() else flow.sample(x[inside], hosts[inside], time)
        velocity[inside], gradient[inside] = u, l.reshape(-1, 9)
    return velocity, gradient
