"""What the particle loop asks of a flow, and what bounds it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.tensor import Vector

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


WALLS = frozenset({"wall", "mappedWall"})
"""The types of patches that are walls: also those to which another region's wall fits."""
NEAR = 3.0
"""Gap between body and wall, in radii of the undeformed ball, from which on the wall does not count."""


class Patch(NamedTuple):
    """A named piece of the boundary, with its OpenFOAM type: wall, patch, symmetryPlane, wedge, …."""

    name: str
    type: str
    neighbour: str = ""
    """The patch to which a particle goes on that meets this one, if the two are coupled."""


Turbulence: TypeAlias = tuple[float, float, Vector, Vector]
"""k (m²/s²), ε (m²/s³), ∇k and ∇(k²/3ε) of a turbulent flow at a place."""


class Planes(NamedTuple):
    """Up to three walls: their distances, m, infinite if there is none, and unit normals into the fluid."""

    h1: float
    n1: Vector
    h2: float
    n2: Vector
    h3: float
    n3: Vector


NO_PLANES = Planes(math.inf, (0.0, 0.0, 0.0), math.inf, (0.0, 0.0, 0.0), math.inf, (0.0, 0.0, 0.0))
"""Where no wall is near."""


class Caveat(str):
    """A note on a flow that warns: what particles will not feel of it, and what that means."""

    __slots__ = ()


class PatchFaces(NamedTuple):
    """The triangles of a patch, for placing particles on it."""

    vertices: Floats
    """(n, 3, 3): triangle, vertex, coordinate; m."""
    areas: Floats
    """(n,), m²."""
    normals: Floats
    """(n, 3), unit, into the fluid."""
    velocity: Floats
    """(n, 3, 3): triangle, vertex, component; m/s, at the time that was asked for."""
    hosts: Ints
    """(n,) the host behind each triangle."""


class Tetrahedra(NamedTuple):
    """The n tetrahedra of a zone of cells, for placing particles in it."""

    volumes: Floats
    """(n,), m³; negative for a tetrahedron turned inside out."""
    hosts: Ints
    """(n,) the host that each is."""
    vertices: Callable[[Ints], Floats]
    """Returns the vertices of some hosts, (m, 4, 3): host, vertex, coordinate; m. All could be very many."""


class Sampled(Protocol):
    """Something that has a velocity and its gradient at points."""

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at time t, s."""


class Flow(Sampled, Protocol):
    """A flow: u and ∇u at a point and a time, and what bounds it.

    The ``kernels`` are plain functions that :func:`foamprb.compile.link.link` compiles into the loop;
    ``flow`` is the tuple that :meth:`arrays` gives and ``host`` the piece of the flow (a tetrahedron) that
    holds x:

    * ``sample(flow, host, x, t) -> (u, l, u_t)``: velocity, m/s, ∂u_i/∂x_j row by row, 1/s, and ∂u/∂t at the
      fixed point, m/s² (zero in a steady flow), at time t, s;
    * ``walk(flow, host, x0, x1) -> (host, fraction, patch, triangle)``: along the segment, to its end (patch
      −1), to the patch that it crosses at ``fraction``, or to failure (patch −2);
    * ``walk_on(flow, host, ahead, x0, x1)``: as ``walk``, where a way from x0 to a place near x1 led to the
      piece ``ahead``; a flow need not have it, and is walked then;
    * ``sample_ahead(flow, host, x0, x1, t) -> (ahead, room, u, l, u_t)``: the last piece of the flow on the
      way from x0 to x1, its ``sample`` at x1, and how far from x1, m, a place may be along each axis that
      this piece certainly holds, if more than 0; a flow need not have it, and is walked and sampled then;
    * ``gap(flow, host, x, F, R) -> (gap, patch, triangle)``: signed clearance between the ellipsoid and the
      nearest touchable wall; from :data:`NEAR` R on it may be infinite, with −1 and −1;
    * ``walls(flow, host, x, cut, chosen) -> planes``: the walls nearer to x than ``cut``, as
      ``foamprb.flow.planes`` has them; a flow without walls need not have it;
    * ``turbulence(flow, host, x, t) -> (k, epsilon, slope, drift)``: as :data:`Turbulence`; a flow without
      eddies need not have it;
    * ``rotation_at(flow, host) -> (omega, origin)``: angular velocity, 1/s, and a point of the axis of the
      frame in which the host is seen; a flow that is seen at rest need not have it;
    * ``curvature(flow, host, x, t) -> (u_xx, u_yy, u_zz, u_xy, u_yz, u_xz)``: second derivatives of the
      velocity, 1/(m s); a flow need not have it;
    * ``normal(flow, triangle, x) -> n``: unit normal into the fluid;
    * ``cross(flow, triangle, x) -> (host, x, turn)``: where a particle goes on that meets a triangle of a
      coupled patch at x, and the rotation of everything that has a direction;
    * ``recover(flow, x) -> host``: the host of a point, sought from nothing; −1 outside;
    * ``cell_volume(flow, host) -> V``: of the cell of a host, m³; a flow without cells need not have it.
    """

    span: tuple[float, float]
    """First and last time of the flow, s; from −∞ to ∞ when it is steady or in closed form."""
    patches: tuple[Patch, ...]
    kernels: dict[str, Callable[..., Any]]
    width: float
    """The shortest way between walls and openings along an axis of the coordinates, m; infinite without."""
    lists_walls: bool
    """Whether ``gap`` sees only the walls within the reach for which :meth:`arrays` has listed them."""
    notes: tuple[str, ...]
    """What the user should know about the flow; a :class:`Caveat` is a warning."""

    def load(self, start: float, end: float) -> float:
        """Make the flow ready from time ``start`` to ``end`` (s), at least; return until when it then is.

        The end of a tracking step may lie beyond that by a millionth of the step. The arrays that were given
        before know nothing of it: ask for :meth:`arrays` afterwards.

        Raises
        ------
        InputError
            If the flow does not reach so far, or cannot be read.
        """

    def arrays(
        self, reach: float, touchable: Sequence[int], sight: float = 0.0, seen: Sequence[int] = ()
    ) -> Any:
        """What the kernels read; ``gap`` finds the ``touchable`` patches within ``reach`` (m) of a cell.

        ``walls`` finds those that are ``seen`` to a distance of ``sight`` (m).

        It is a tuple with names, perhaps with others in it. Where the contents of a large array, of many kB,
        have changed in place, a number or a small array has changed as well.
        """

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """Put what the kernels read, as far as it is large and does not change, where ``place`` copies it."""

    def locate(self, points: Floats) -> Ints:
        """Host of each point of shape (n, 3), −1 outside."""

    def cell_size(self, hosts: Ints) -> Floats:
        """Cube root of the volume of each host's cell, m; infinite without cells."""

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Triangles of a patch at time t, s; InputError when there is no such patch, or it has none."""

    def cell_zone(self, name: str | None) -> Tetrahedra:
        """Tetrahedra of a zone of cells, or of all cells; InputError when there is no such zone."""

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """The name of the time that was read, and u (n, 3), m/s, and ∂u_i/∂x_j (n, 9), 1/s, at all nodes."""

    def turbulence_at_nodes(self) -> Floats:
        """k, ε, ∇k and ∇(k²/3ε) at all nodes, (n, 8); without rows if they were not read."""

    def traits(self) -> Mapping[str, ArrayLike]:
        """What tells the flow from another, by name: to know it again when a run is taken up."""
