"""Steady flow with rotating zones of cells, in the frozen-rotor approximation.

In a zone everything is relative to the rotor: the velocity is u − Ω × (x − x₀), its gradient l − W with
W·a = Ω × a, and the rotating walls are at rest. Particles that enter or leave a zone are not turned or moved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector, dot_vector, minus, plus, vector_product
from foamprb.compile.record import record
from foamprb.flow.base import Floats, Ints, PatchFaces, Turbulence
from foamprb.flow.kernels import named
from foamprb.flow.mesh.arrays import MeshArrays, no_mesh, point
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.sampling import sample_with, with_velocity
from foamprb.flow.series import SeriesFlow, host_ahead
from foamprb.flow.viscosity import viscosity as viscosity_mesh
from foamprb.flow.walk import STEADY, parts
from foamprb.flow.walk import curvature as curvature_mesh
from foamprb.flow.walk import turbulence as turbulence_mesh


class RotatingZone(NamedTuple):
    """Rotating zone of cells."""

    name: str
    cells: NDArray[np.int64]
    omega: tuple[float, float, float]
    """Ω, 1/s."""
    origin: tuple[float, float, float]
    """A point of the axis, m."""


@record
class RotatingArrays(NamedTuple):
    """Arrays of the flow that the kernels read."""

    mesh: MeshArrays
    zone: NDArray[np.int16]
    """(n_cells,) number of each cell's zone, 0 for none."""
    omega: Floats
    """(n_zones + 1, 3), 1/s; zeros first."""
    origin: Floats
    """(n_zones + 1, 3), m."""


def rotation_at(flow: RotatingArrays, host: int) -> tuple[Vector, Vector]:
    """Return Ω, 1/s, and a point of the axis, m, of the frame of a host."""
    z = flow.zone[flow.mesh.tets[host, 0] - flow.mesh.n_points]
    return point(flow.omega, z), point(flow.origin, z)


def sample(flow: RotatingArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Return velocity, m/s, and gradient, 1/s, relative to the frame of the host."""
    u, c, l = parts(flow.mesh, host, x)
    w, o = rotation_at(flow, host)
    u = minus(plus(u, c), vector_product(w, minus(x, o)))
    l = (
        l[0], l[1] + w[2], l[2] - w[1],
        l[3] - w[2], l[4], l[5] + w[0],
        l[6] + w[1], l[7] - w[0], l[8],
    )  # fmt: skip
    return u, l, minus(STEADY, dot_vector(l, c))


def turbulence(flow: RotatingArrays, host: int, x: Vector, t: float) -> Turbulence:
    """See :func:`foamprb.flow.walk.turbulence`; the same in all frames."""
    return turbulence_mesh(flow.mesh, host, x, t)


def viscosity(flow: RotatingArrays, host: int, x: Vector, t: float) -> tuple[float, Vector]:
    """See :func:`foamprb.flow.viscosity.viscosity`; the same in all frames."""
    return viscosity_mesh(flow.mesh, host, x, t)


def curvature(flow: RotatingArrays, host: int, x: Vector, t: float) -> Curvature:
    """See :func:`foamprb.flow.walk.curvature`; the same in all frames."""
    return curvature_mesh(flow.mesh, host, x, t)


def sample_ahead(
    flow: RotatingArrays, host: int, x0: Vector, x1: Vector, t1: float
) -> tuple[int, float, int, Vector, Tensor, Vector]:
    """See :func:`foamprb.flow.kernels.sample_ahead`."""
    last, entered = host_ahead(flow, host, x0, x1)
    u, l, u_t = sample(flow, last, x1, t1)
    return last, 0.0, entered, u, l, u_t


class RotatingFlow(MeshFlow):
    """:class:`MeshFlow` with absolute velocities at the nodes and rotating zones of cells.

    Parameters
    ----------
    rotating
        The zones; a cell in several belongs to the last one.
    mesh, u, l, notes, zones, time, turbulence
        See :class:`MeshFlow`.
    """

    kernels = SeriesFlow.kernels | named(sample, sample_ahead, curvature, turbulence, viscosity, rotation_at)

    def __init__(self, rotating: Sequence[RotatingZone], mesh: Mesh, *given: Any, **options: Any) -> None:
        super().__init__(mesh, *given, **options)
        self.rotating = tuple(rotating)
        self._zone = np.zeros(mesh.n_cells, dtype=np.int16)
        for number, zone in enumerate(rotating, 1):
            self._zone[zone.cells] = number
        still = (0.0, 0.0, 0.0)
        self._omega = np.array([still, *(zone.omega for zone in rotating)], dtype=float)
        self._origin = np.array([still, *(zone.origin for zone in rotating)], dtype=float)

    @staticmethod
    def nothing() -> RotatingArrays:  # type: ignore[override]
        """See :meth:`MeshFlow.nothing`."""
        return RotatingArrays(no_mesh(), np.empty(0, dtype=np.int16), np.empty((0, 3)), np.empty((0, 3)))

    def arrays(  # type: ignore[override]
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> RotatingArrays:
        """Return the arrays of :meth:`MeshFlow.arrays` with the zones."""
        mesh = super().arrays(reach, touchable, sight, seen)
        return RotatingArrays(mesh, self._zone, self._omega, self._origin)

    def traits(self) -> Mapping[str, ArrayLike]:
        """See :meth:`MeshFlow.traits`; with the zones."""
        return {**super().traits(), "zone": self._zone, "omega": self._omega, "origin": self._origin}

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """See :meth:`MeshFlow.sample`; relative to the frames of the hosts."""
        return sample_with(sample, self.arrays(), points, hosts, t)

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """See :meth:`MeshFlow.patch_faces`; velocities are relative to the frames of the hosts."""
        return with_velocity(super().patch_faces(name, t), self, t)
