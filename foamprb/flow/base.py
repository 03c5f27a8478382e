"""Interface between the particle loop and a flow."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.tensor import Vector
from foamprb.dictionary.patterns import matches
from foamprb.flow.nodes import Ends, Function, NodeValues
from foamprb.flow.patches import PatchKind, kind_of_type

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


NEAR = 3.0
"""Gap between body and wall, in radii of the undeformed ball, beyond which the wall is ignored."""


class Patch(NamedTuple):
    """Named part of the boundary, with its OpenFOAM type: wall, patch, symmetryPlane, wedge, …."""

    name: str
    type: str
    neighbour: str = ""
    """Patch on which a particle continues, if the two are coupled."""
    groups: frozenset[str] = frozenset()
    """Groups of the case to which it belongs."""
    faceless: bool = False

    @property
    def kind(self) -> PatchKind:
        """Return the kind of the patch."""
        if self.faceless:
            return PatchKind.FACELESS
        return PatchKind.PASSABLE if self.neighbour else kind_of_type(self.type)


def patches_named(patches: Sequence[Patch], word: str) -> list[int]:
    """Return the indices of the patches of a name, or else of a group, or whose names a pattern matches."""
    for is_named in (
        lambda patch: patch.name == word,
        lambda patch: word in patch.groups,
        lambda patch: matches(word, patch.name),
    ):
        if numbers := [k for k, patch in enumerate(patches) if is_named(patch)]:
            return numbers
    return []


Turbulence: TypeAlias = tuple[float, float, Vector, Vector]
"""k (m²/s²), ε (m²/s³), ∇k and ∇(k²/3ε) of a turbulent flow at a point."""


class Planes(NamedTuple):
    """Up to three walls: distances, m, infinite for no wall, and unit normals into the fluid."""

    h1: float
    n1: Vector
    h2: float
    n2: Vector
    h3: float
    n3: Vector


NO_PLANES = Planes(math.inf, (0.0, 0.0, 0.0), math.inf, (0.0, 0.0, 0.0), math.inf, (0.0, 0.0, 0.0))
"""Value where no wall is near."""


FAULTS = ("movingMesh", "pseudoTime", "unbalanced")
"""Faults of a flow by which fates are worthless: errors, unless ``solution/accept`` names them."""


class Caveat(str):
    """Warning about a property of a flow that particles will not feel."""

    __slots__ = ("fault",)
    fault: str
    """One of :data:`FAULTS`; empty for a warning that ends no run."""

    def __new__(cls, text: str, fault: str = "") -> Self:
        """Return a warning with its fault."""
        caveat = super().__new__(cls, text)
        caveat.fault = fault
        return caveat


class PatchFaces(NamedTuple):
    """Triangles of a patch, for placing particles on it."""

    vertices: Floats
    """(n, 3, 3): triangle, vertex, coordinate; m."""
    areas: Floats
    """(n,), m²."""
    normals: Floats
    """(n, 3), unit, into the fluid."""
    velocity: Floats
    """(n, 3, 3): triangle, vertex, component; m/s, at the requested time."""
    hosts: Ints
    """(n,) host behind each triangle."""


class Tetrahedra(NamedTuple):
    """The n tetrahedra of a zone of cells, for placing particles in it."""

    volumes: Floats
    """(n,), m³; negative for an inverted tetrahedron."""
    hosts: Ints
    """(n,) host of each."""
    vertices: Callable[[Ints], Floats]
    """Returns the vertices of some hosts, (m, 4, 3): host, vertex, coordinate; m."""


class Sampled(Protocol):
    """Provider of the velocity and its gradient at points."""

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Return velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at time t, s."""


class Flow(Sampled, Protocol):
    """Velocity and its gradient at a point and a time, and the boundary of the flow.

    The ``kernels`` are plain functions that :func:`foamprb.compile.link.link` compiles for the loop, with
    names and parameters of :mod:`foamprb.flow.kernels`. Their argument ``flow`` is the tuple of
    :meth:`arrays`. One more is ``gap(flow, host, x, F, R, mode) -> (gap, patch, triangle)``: the signed
    clearance between the ellipsoid {x + R F·ξ: ξ·ξ ≤ 1}, or the surface of a quadratic mode, and the nearest
    touchable wall; beyond :data:`NEAR` R it may be infinite, with −1 and −1. A flow has ``sample`` and
    ``gap``; others may be missing.
    """

    span: tuple[float, float]
    """First and last time of the flow, s; −∞ to ∞ if it is steady or in closed form."""
    patches: tuple[Patch, ...]
    kernels: dict[str, Callable[..., Any]]
    width: float
    """Shortest distance between walls and openings along a coordinate axis, m; infinite without."""
    bounds: tuple[Floats, Floats]
    """Smallest and largest coordinates, (3,) each, m."""
    lists_walls: bool
    """True if ``gap`` finds only the walls within the reach given to :meth:`arrays`."""
    notes: tuple[str, ...]
    """Sentences for the user about the flow; a :class:`Caveat` is a warning."""

    def load(self, start: float, end: float) -> float:
        """Load the flow from time ``start`` to ``end`` (s) at least; return the end of the loaded interval.

        The end of a tracking step may exceed it by a millionth of the step. Arrays that were returned before
        are outdated: call :meth:`arrays` afterwards.

        Raises
        ------
        InputError
            The flow does not cover this interval, or cannot be read.
        """

    def arrays(
        self, reach: float, touchable: Sequence[int], sight: float = 0.0, seen: Sequence[int] = ()
    ) -> Any:
        """Return the arrays for the kernels, a named tuple, perhaps with others in it.

        ``gap`` finds the ``touchable`` patches within ``reach`` (m) of a cell, and ``walls`` those that are
        ``seen`` within a distance of ``sight`` (m). If the contents of a large array (many kB) have changed
        in place since the last call, a number or a small array has changed as well.
        """

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """Replace large constant arrays for the kernels by the copies that ``place`` returns."""

    def locate(self, points: Floats, t: ArrayLike | None = None) -> Ints:
        """Return the host of each point of shape (n, 3), −1 outside.

        The times t, s, are one for all or (n,), by default the first; they matter where the mesh moves.
        """

    def cell_size(self, hosts: Ints) -> Floats:
        """Return the cube root of the volume of each host's cell, m; infinite without cells."""

    def cell_size_at(self, patches: Sequence[int]) -> float:
        """Return the median width of the cells at patches, given by index, m; 0 without any."""

    def times_within(self, start: float, end: float) -> Sequence[float]:
        """Return the times between ``start`` and ``end``, s, between which the flow is linear in time."""

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Return the triangles of a patch at time t, s; InputError if there is no such patch or no faces."""

    def cell_zone(self, name: str | None, t: float | None = None) -> Tetrahedra:
        """Return the tetrahedra of a zone of cells, or of all cells, at the time t, s, by default the first.

        InputError if there is no such zone.
        """

    def at_some_nodes(self) -> NodeValues:
        """Return the values at some nodes, evenly spread over their numbers."""

    def ends_at_nodes(self, function: Function) -> Ends:
        """Return the smallest and the largest values at all nodes of the quantities of a function."""

    def gradient_jumps(self) -> NDArray[np.int64]:
        """Return counts of faces by the jump of ∇u at the first time; see :mod:`foamprb.flow.jumps`."""

    def roughness(self) -> float:
        """Return the roughness of ∇u at the end of the loaded interval, 1; see :mod:`foamprb.flow.jumps`."""

    def traits(self) -> Mapping[str, ArrayLike]:
        """Return the arrays and numbers by which a resumed run recognises the flow, by name."""
