"""A steady flow with rotating zones of cells, as particles see it in the frozen-rotor picture.

In a zone all is seen from the rotor: the velocity is u − Ω × (x − x₀), its gradient l − W with W·a = Ω × a,
and the walls that turn with it stand still. Nothing is turned or moved where a particle enters or leaves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector, minus, vector_product
from foamprb.flow.base import Floats, Ints, PatchFaces, Turbulence
from foamprb.flow.mesh.arrays import MeshArrays, no_mesh
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.sampling import sample_with
from foamprb.flow.series import cell_volume, cross, gap, normal, recover, walk, walk_on, walls
from foamprb.flow.walk import curvature as curvature_mesh
from foamprb.flow.walk import sample as sample_mesh
from foamprb.flow.walk import turbulence as turbulence_mesh

__all__ = ["RotatingFlow", "RotatingZone"]


class RotatingZone(NamedTuple):
    """A zone of cells that turns."""

    name: str
    cells: NDArray[np.int64]
    omega: tuple[float, float, float]
    """Ω, 1/s."""
    origin: tuple[float, float, float]
    """A point of the axis, m."""


class RotatingArrays(NamedTuple):
    """What the kernels read."""

    mesh: MeshArrays
    zone: NDArray[np.int16]
    """(n_cells,) number of the zone of each cell, 0 for none."""
    omega: Floats
    """(n_zones + 1, 3), 1/s; zeros first."""
    origin: Floats
    """(n_zones + 1, 3), m."""


def rotation_at(flow: RotatingArrays, host: int) -> tuple[Vector, Vector]:
    """Ω, 1/s, and a point of the axis, m, of the frame in which a host is seen."""
    z = flow.zone[flow.mesh.tets[host, 0] - flow.mesh.n_points]
    w, o = flow.omega, flow.origin
    return (w[z, 0], w[z, 1], w[z, 2]), (o[z, 0], o[z, 1], o[z, 2])


def sample(flow: RotatingArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, and gradient, 1/s, relative to the frame of the host; steady there."""
    u, l, _ = sample_mesh(flow.mesh, host, x, t)
    w, o = rotation_at(flow, host)
    u = minus(u, vector_product(w, minus(x, o)))
    l = (
        l[0], l[1] + w[2], l[2] - w[1],
        l[3] - w[2], l[4], l[5] + w[0],
        l[6] + w[1], l[7] - w[0], l[8],
    )  # fmt: skip
    return u, l, (0.0, 0.0, 0.0)


def turbulence(flow: RotatingArrays, host: int, x: Vector, t: float) -> Turbulence:
    """:func:`foamprb.flow.walk.turbulence`, the same in all frames."""
    return turbulence_mesh(flow.mesh, host, x, t)


def curvature(flow: RotatingArrays, host: int, x: Vector, t: float) -> Curvature:
    """:func:`foamprb.flow.walk.curvature`, the same in all frames: a rotation has no second derivatives."""
    return curvature_mesh(flow.mesh, host, x, t)


class RotatingFlow(MeshFlow):
    """A :class:`MeshFlow` whose velocities at the nodes are absolute, and rotating zones of its cells.

    Parameters
    ----------
    rotating
        The zones; of a cell in several the last counts.
    mesh, u, l, notes, zones, time, turbulence
        As of a :class:`MeshFlow`.
    """

    kernels: dict[str, Callable[..., Any]] = {  # noqa: RUF012
        "sample": sample,
        "curvature": curvature,
        "walk": walk,
        "walk_on": walk_on,
        "gap": gap,
        "walls": walls,
        "normal": normal,
        "cross": cross,
        "recover": recover,
        "cell_volume": cell_volume,
        "turbulence": turbulence,
        "rotation_at": rotation_at,
    }

    def __init__(
        self,
        rotating: Sequence[RotatingZone],
        mesh: Mesh,
        u: Floats,
        l: Floats,
        notes: Iterable[str] = (),
        zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
        time: str = "",
        turbulence: Floats | None = None,
    ) -> None:
        super().__init__(mesh, u, l, notes, zones, time, turbulence)
        self.rotating = tuple(rotating)
        self._zone = np.zeros(mesh.n_cells, dtype=np.int16)
        for number, zone in enumerate(rotating, 1):
            self._zone[zone.cells] = number
        still = (0.0, 0.0, 0.0)
        self._omega = np.array([still, *(zone.omega for zone in rotating)], dtype=float)
        self._origin = np.array([still, *(zone.origin for zone in rotating)], dtype=float)

    @staticmethod
    def nothing() -> RotatingArrays:  # type: ignore[override]
        """What the kernels read where there is no flow, for which they can be compiled."""
        return RotatingArrays(no_mesh(), np.empty(0, dtype=np.int16), np.empty((0, 3)), np.empty((0, 3)))

    def arrays(  # type: ignore[override]
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> RotatingArrays:
        """As of a :class:`MeshFlow`, with the zones."""
        mesh = super().arrays(reach, touchable, sight, seen)
        return RotatingArrays(mesh, self._zone, self._omega, self._origin)

    def traits(self) -> Mapping[str, ArrayLike]:
        """Mesh, velocities and zones, by name."""
        return {**super().traits(), "zone": self._zone, "omega": self._omega, "origin": self._origin}

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """As of a :class:`MeshFlow`, relative to the frames of the hosts."""
        return sample_with(sample, self.arrays(), points, hosts, t)

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """As of a :class:`MeshFlow`, with velocities relative to the frames of the hosts."""
        faces = super().patch_faces(name, t)
        corners = faces.vertices.reshape(-1, 3)
        velocity, _ = self.sample(corners, np.repeat(faces.hosts, 3), t)
        return faces._replace(velocity=velocity.reshape(-1, 3, 3))
