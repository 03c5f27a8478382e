"""State of a cloud: one structure of arrays with a leading particle axis.

This declaration (:data:`VARIABLES`) determines the arrays that are saved, restored and exchanged.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from concurrent.futures import ThreadPoolExecutor
from enum import IntEnum
from typing import Annotated, Any, NamedTuple, TypeAlias, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.compressibility import lame_from_bulk_modulus
from foamprb.body.material import lame_parameter
from foamprb.body.vesicle import spheroid_of_area
from foamprb.compile.record import record
from foamprb.errors import InputError

Array: TypeAlias = NDArray[Any]


class Status(IntEnum):
    """Status of a particle. All but the pending ones count as injected."""

    PENDING = 0
    ACTIVE = 1
    STUCK = 2
    ESCAPED = 3
    FAILED = 4
    RUPTURED = 5
    RELEASED = 6


class Reason(IntEnum):
    """Reason of a failure, a rupture or a release; below 16."""

    NONE = 0
    LOST = 1
    NOT_FINITE = 2
    VOLUME_RATIO = 3
    NOT_CONVERGED = 4
    STEP_TOO_SMALL = 5
    FLOW_NOT_FINITE = 6
    STRETCHED = 7
    TOO_LARGE = 8
    WALLS_TOO_MANY = 9
    SUB_STEPS = 10
    CELLS_TOO_MANY = 11
    STRETCH_REACHED = 12
    STRESS_REACHED = 13
    SHEAR_REACHED = 14
    DOSE_REACHED = 15


REASONS: dict[Reason, str] = {
    Reason.NONE: "",
    Reason.LOST: "left the mesh where no boundary face was crossed",
    Reason.NOT_FINITE: "its position, velocity or shape is not a finite number",
    Reason.VOLUME_RATIO: "its volume ratio J left [1/8, 8]",
    Reason.NOT_CONVERGED: "Newton's iteration for its shape did not converge",
    Reason.STEP_TOO_SMALL: "the error of its shape or path asks for time steps of less than Δt/1e9",
    Reason.FLOW_NOT_FINITE: "the flow's velocity or its gradient is not a finite number there",
    Reason.STRETCHED: "it is stretched beyond maxStretch",
    Reason.TOO_LARGE: "its longest semi-axis is beyond maxSize of the flow's width",
    Reason.WALLS_TOO_MANY: "it is so many cells long that the walls near it cannot be listed",
    Reason.SUB_STEPS: "it needs more than maxSubSteps time steps in one tracking step",
    Reason.CELLS_TOO_MANY: "its longest semi-axis is beyond maxCells of the cell that holds its centre",
    Reason.STRETCH_REACHED: "its stretch has reached the limit",
    Reason.STRESS_REACHED: "its elastic stress has reached the limit",
    Reason.SHEAR_REACHED: "the fluid's shear stress has reached the limit",
    Reason.DOSE_REACHED: "its dose of the fluid's shear stress has reached the limit",
}
"""Reasons in words, as the end of a sentence about a particle."""


class Variable(NamedTuple):
    """Layout and meaning of one array of the cloud."""

    shape: tuple[int, ...]
    dtype: str
    unit: str
    meaning: str
    fixed: bool = False
    """Whether steps leave it unchanged."""
    optional: bool = False
    """Whether only some models set it: without them it takes no memory of the machine and is not copied."""


@record
class Particles(NamedTuple):
    """State of n particles; every array has n rows."""

    x: Annotated[Array, Variable((3,), "f8", "m", "position of the barycentre")]
    v: Annotated[
        Array, Variable((3,), "f8", "m/s", "velocity of the barycentre; NaN if pending with the fluid's")
    ]
    F: Annotated[Array, Variable((9,), "f8", "1", "deformation gradient from that sphere, row by row")]
    A: Annotated[Array, Variable((9,), "f8", "1/s", "material velocity gradient dF/dt, row by row")]
    Q: Annotated[Array, Variable((9,), "f8", "1", "particle frame, axes as rows; any frame for a new F")]
    R: Annotated[
        Array, Variable((), "f8", "m", "radius at rest, of the sphere of the same volume", fixed=True)
    ]
    rho: Annotated[Array, Variable((), "f8", "kg/m3", "density at rest", fixed=True)]
    mu: Annotated[
        Array, Variable((), "f8", "Pa", "shear modulus of a solid; tension of a drop over R", fixed=True)
    ]
    lame: Annotated[Array, Variable((), "f8", "Pa", "Lame's first parameter of the solid", fixed=True)]
    k: Annotated[Array, Variable((), "f8", "1", "third parameter of the solid, if it has one", fixed=True)]
    eta: Annotated[Array, Variable((), "f8", "Pa s", "viscosity of the solid or drop", fixed=True)]
    gamma: Annotated[Array, Variable((), "f8", "N/m", "surface tension of the solid", fixed=True)]
    drop: Annotated[Array, Variable((), "i1", "", "1 for a drop, 0 for a solid", fixed=True)]
    F0: Annotated[Array, Variable((9,), "f8", "1", "F at rest, from the sphere of the same volume")]
    Ca: Annotated[Array, Variable((), "f8", "1", "capillary number at the reference shear rate", fixed=True)]
    t0: Annotated[Array, Variable((), "f8", "s", "time of injection", fixed=True)]
    x0: Annotated[Array, Variable((3,), "f8", "m", "position of injection", fixed=True)]
    t: Annotated[Array, Variable((), "f8", "s", "time to which the particle has come")]
    h: Annotated[Array, Variable((), "f8", "s", "time step that its error allows; 0 before the first")]
    discount: Annotated[
        Array,
        Variable((), "f8", "1", "estimated share of the error estimate of order 2 that is not an error"),
    ]
    demanding: Annotated[Array, Variable((), "i1", "", "1 if steps like its last one go to order 3, else 0")]
    substeps: Annotated[
        Array,
        Variable((), "f8", "1", "time steps per tracking step, repeated ones included, in its last stretch"),
    ]
    status: Annotated[Array, Variable((), "i1", "", "pending, active, stuck, escaped, …")]
    reason: Annotated[Array, Variable((), "i1", "", "why it failed, or reached its fate")]
    patch: Annotated[Array, Variable((), "i4", "", "patch where it stuck or left, else -1")]
    host: Annotated[Array, Variable((), "i8", "", "tetrahedron of the flow that holds it")]
    number: Annotated[Array, Variable((), "i8", "", "number in the whole cloud", fixed=True)]
    close: Annotated[
        Array, Variable((), "f8", "s", "time within two radii of a wall, if counted", optional=True)
    ]
    eddy: Annotated[
        Array, Variable((3,), "f8", "m/s", "velocity of its eddy, if there are eddies", optional=True)
    ]
    eddyTime: Annotated[
        Array, Variable((), "f8", "s", "remaining life of this eddy, or its age", optional=True)
    ]
    injector: Annotated[Array, Variable((), "i4", "", "injection model that released it", fixed=True)]
    hazard: Annotated[
        Array,
        Variable((), "f8", "1", "integral of the rate of bonds since the last change", optional=True),
    ]
    held: Annotated[Array, Variable((), "f8", "s", "time to which a bond has held", optional=True)]
    bonds: Annotated[Array, Variable((), "i4", "", "bonds formed and broken so far", optional=True)]
    dose: Annotated[
        Array,
        Variable((), "f8", "Pa s", "dose of the fluid's shear stress, if there are fates", optional=True),
    ]
    heading: Annotated[
        Array, Variable((3,), "f8", "1", "q of a swimmer's direction F·q/|F·q|, else 0", optional=True)
    ]

    B: Annotated[
        Array,
        Variable(
            (7,), "f8", "1", "quadratic mode, if there is one: 111 112 113 122 123 222 223", optional=True
        ),
    ]
    shift: Annotated[
        Array,
        Variable((3,), "f8", "m", "displacement of the surface of a solid with that mode", optional=True),
    ]

    memoryShares: Annotated[
        Array,
        Variable((0,), "f8", "1", "shares of mu that relax, the fastest first", fixed=True, optional=True),
    ]
    memoryRates: Annotated[
        Array, Variable((0,), "f8", "1/s", "their inverse relaxation times", fixed=True, optional=True)
    ]
    memory: Annotated[
        Array,
        Variable(
            (0,), "f8", "1", "faded strains D of these shares, 11 22 33 12 13 23 of each", optional=True
        ),
    ]
    modeMemory: Annotated[
        Array,
        Variable((0,), "f8", "", "faded quadratic modes of these shares, then displacements", optional=True),
    ]
    """Of a solid with memory these four have columns, see :func:`with_relaxation`."""

    largest: Annotated[
        Array, Variable((5,), "f4", "", "largest values on its path: D, 1/s, Pa, 1/(1 + gap/a), ε")
    ]
    curved: Annotated[
        Array, Variable((3,), "f8", "1/s", "sums of a |S| and |E| on its path, and their number")
    ]

    @property
    def size(self) -> int:
        """Number of particles n, the pending included."""
        return len(self.R)

    @property
    def n_times(self) -> int:
        """Number of relaxation times of the solid; 0 without memory."""
        return int(self.memoryRates.shape[1])

    @property
    def steady_modulus(self) -> NDArray[np.float64]:
        """Shear modulus of a strain that stays, Pa, (n,): without the shares that relax."""
        return np.asarray(self.mu * (1.0 - self.memoryShares.sum(axis=1)))

    @property
    def D(self) -> NDArray[np.float64]:
        """Taylor's deformation (a − c)/(a + c) of the longest and the shortest semi-axis, (n,)."""
        stretches = np.linalg.svd(self.F.reshape(-1, 3, 3), compute_uv=False)
        a, c = stretches[:, 0], stretches[:, 2]
        return np.asarray((a - c) / (a + c))

    def counts(self) -> dict[Status, int]:
        """Return the number of particles of each status; the numbers sum to :attr:`size`."""
        return {status: int(np.count_nonzero(self.status == status)) for status in Status}

    @property
    def touched(self) -> Array:
        """Whether each particle stuck where it was released, (n,)."""
        return np.asarray((self.status == Status.STUCK) & (self.t <= self.t0))

    def take(self, rows: Array | slice) -> Particles:
        """Return the particles of some rows: copies, or views for a slice."""
        return Particles(*(array[rows] for array in self))

    def copy(self) -> Particles:
        """Return the same state in arrays of its own."""
        return Particles(*(array.copy() for array in self))

    def copy_changing(
        self, into: Particles | None = None, names: Collection[str] | None = None, threads: int = 1
    ) -> Particles:
        """Return the same state with copies of the arrays that steps change.

        Parameters
        ----------
        into
            An earlier copy of as many particles, whose memory is overwritten.
        names
            Names of these arrays; by default all that any loop changes.
        threads
            Number of threads that copy.
        """

        def copied(name: str) -> Array:
            array: Array = getattr(self, name)
            place: Array | None = None if into is None else getattr(into, name)
            if place is None or place is array or place.shape != array.shape:
                return array.copy()
            np.copyto(place, array)
            return place

        # The largest first, so that all threads end at about the same time.
        changing = sorted(CHANGING if names is None else names, key=lambda name: -getattr(self, name).nbytes)
        with ThreadPoolExecutor(threads) as pool:
            copies = dict(zip(changing, pool.map(copied, changing), strict=True))
        return self._replace(**copies)


VARIABLES: dict[str, Variable] = {
    name: hint.__metadata__[0] for name, hint in get_type_hints(Particles, include_extras=True).items()
}

_PER_TIME = {"memoryShares": 1, "memoryRates": 1, "memory": 6, "modeMemory": 10}
"""Columns for each relaxation time of a solid."""

CHANGING = tuple(name for name, variable in VARIABLES.items() if not variable.fixed)
"""Names of the arrays that the particle loop changes."""


def empty(n: int, n_times: int = 0) -> Particles:
    """Return n pending spheres at rest, at the origin, with zero size and stiffness.

    ``n_times`` is the number of relaxation times of their solid.
    """
    arrays = {name: np.zeros((n, *v.shape), dtype=v.dtype) for name, v in VARIABLES.items()}
    arrays |= {name: np.zeros((n, m * n_times)) for name, m in _PER_TIME.items()}
    arrays["F"][:] = arrays["F0"][:] = arrays["Q"][:] = np.eye(3).ravel()
    arrays["patch"][:] = -1
    arrays["host"][:] = -1
    return Particles(**arrays)


def concatenate(parts: Iterable[Particles]) -> Particles:
    """Return one cloud of several, in order; a single one is returned as it is."""
    arrays = [list(part) for part in parts]
    if not arrays:
        return empty(0)
    if len(arrays) == 1:
        return Particles(*arrays[0])
    # One variable after the other: the parts are freed meanwhile, so that memory holds one variable twice.
    return Particles(*(np.concatenate([part.pop(0) for part in arrays]) for _ in Particles._fields))


def spheres(
    x: ArrayLike,
    *,
    d: ArrayLike,
    rho: ArrayLike,
    mu: ArrayLike,
    poissons_ratio: float = 0.499,
    bulk_modulus: ArrayLike | None = None,
    k: ArrayLike = 0.0,
    eta: ArrayLike = 0.0,
    gamma: ArrayLike = 0.0,
    t0: ArrayLike = 0.0,
) -> Particles:
    """Return pending spheres at rest.

    Parameters
    ----------
    x
        Positions, shape (n, 3), m.
    d, rho, mu, k, eta, gamma, t0
        Diameter (m), density (kg/m³), shear modulus (Pa), third parameter and viscosity (Pa s) of the solid,
        surface tension (N/m) and time of injection (s), one for all or (n,).
    poissons_ratio
        Poisson's ratio of the solid, below ½.
    bulk_modulus
        Bulk modulus of the solid, Pa, one for all or (n,), in place of Poisson's ratio. At a fixed ratio,
        softer solids change their volume more;
        :func:`foamprb.body.compressibility.sufficient_bulk_modulus` keeps it.

    Examples
    --------
    >>> p = spheres([[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0]], d=5e-6, rho=1050.0, mu=[100.0, 200.0])
    >>> p.size, p.mu.tolist()
    (2, [100.0, 200.0])
    """
    p = empty(len(np.asarray(x)))
    p.x[:] = p.x0[:] = x
    p.R[:] = np.asarray(d) / 2.0
    p.rho[:], p.mu[:], p.k[:], p.eta[:], p.gamma[:] = rho, mu, k, eta, gamma
    if bulk_modulus is None:
        p.lame[:] = lame_parameter(p.mu, poissons_ratio)
    else:
        p.lame[:] = lame_from_bulk_modulus(np.asarray(bulk_modulus, dtype=float), p.mu)
    p.t0[:] = p.t[:] = t0
    return p


def drops(x: Any, *, d: Any, rho: Any, gamma: Any, eta: Any, t0: Any = 0.0) -> Particles:
    """Return pending drops at rest, for the material ``drop``.

    Parameters
    ----------
    x
        Positions, shape (n, 3), m.
    d, rho, gamma, eta, t0
        Diameter (m), density (kg/m³), surface tension (N/m), viscosity (Pa s) and time of injection (s), one
        for all or (n,).
    """
    p = spheres(x, d=d, rho=rho, mu=2.0 * np.asarray(gamma) / np.asarray(d), eta=eta, t0=t0)
    p.drop[:] = 1
    return p


def set_rest_shape(
    p: Particles, ratios: ArrayLike, axes: ArrayLike = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
) -> None:
    """Turn spheres at rest into ellipsoids of the same volume, in place.

    Parameters
    ----------
    p
        Particles, changed in place.
    ratios
        Semi-axes at rest up to a common factor, (3,) or (n, 3).
    axes
        Their directions, unit vectors as the rows of a rotation, (3, 3) or (n, 3, 3).
    """
    a = np.broadcast_to(np.asarray(ratios, dtype=float), (p.size, 3))
    E = np.broadcast_to(np.asarray(axes, dtype=float), (p.size, 3, 3))
    stretches = a / np.cbrt(a.prod(axis=1, keepdims=True))
    p.F[:] = p.F0[:] = np.einsum("nai,na,naj->nij", E, stretches, E).reshape(-1, 9)


def set_excess_area(p: Particles, excess_area: float, bending_modulus: float = 1e-19) -> None:
    """Make prolate vesicles along x of spheres, for the material ``capsule fluid``.

    Parameters
    ----------
    p
        Spheres at rest.
    excess_area
        Area of the membrane over R², less 4π.
    bending_modulus
        κ of the membrane, J. It is no part of the model; κ/R³ is the modulus of capillary numbers.

    Raises
    ------
    InputError
        If the excess is not above 0, or above 20.
    """
    if not 0.0 < excess_area <= 20.0:
        raise InputError(f"excess_area is {excess_area:g}. Allowed: a number > 0 and <= 20.")
    x = spheroid_of_area(excess_area)
    p.mu[:], p.k[:] = bending_modulus / p.R**3, excess_area
    p.F[:] = np.diag([x, x**-0.5, x**-0.5]).ravel()


def with_relaxation(p: Particles, moduli: Any, times: Any, n_times: int | None = None) -> Particles:
    """Return particles whose solid has relaxing moduli beside those that it has, at rest for a long time.

    The shear modulus of sudden strains, :attr:`Particles.mu`, is the sum of all; that of small strains is
    mu₀ + Σ G_k exp(−t/T_k), with mu₀ that of ``p``. Poisson's ratio is kept.

    Parameters
    ----------
    p
        Particles without relaxing moduli.
    moduli
        G_k, (m,) or (n, m), Pa.
    times
        T_k, (m,), s.
    n_times
        Columns of the arrays of the memory, m by default.

    Examples
    --------
    >>> p = spheres([[0.0, 0.0, 0.0]], d=5e-6, rho=1050.0, mu=100.0)
    >>> p = with_relaxation(p, [200.0, 100.0], [1e-3, 1e-2])
    >>> p.mu.tolist(), p.memoryShares.tolist(), p.memoryRates.tolist()
    ([400.0], [[0.5, 0.25]], [[1000.0, 100.0]])
    """
    T = np.asarray(times, dtype=float)
    G = np.broadcast_to(np.asarray(moduli, dtype=float), (p.size, len(T)))
    order, m = np.argsort(T), len(T) if n_times is None else n_times
    total = p.mu + G.sum(axis=1)
    arrays = {name: np.zeros((p.size, columns * m)) for name, columns in _PER_TIME.items()}
    arrays["memoryShares"][:, : len(T)] = G[:, order] / total[:, None]
    arrays["memoryRates"][:, : len(T)] = 1.0 / T[order]
    return p._replace(mu=total, lame=p.lame * (total / p.mu), **arrays)
