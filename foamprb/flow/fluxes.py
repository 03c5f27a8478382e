"""Correction of the interpolated velocity that keeps the volume of the fluid.

A velocity u that is interpolated between the nodes makes volume in some tetrahedra and loses it in others, so
that particles gather, above all at walls. The correction c is a field of Brezzi, Douglas and Marini's first
order (Numer. Math. 47, 217, 1985): linear in each tetrahedron, with a normal component that is continuous
across the triangles between them. Its fluxes give each tetrahedron its share of what the cell makes, which is
nothing in an incompressible flow; where the density varies, cells make and lose no mass. On a triangle c is
distributed over the free nodes, those that lie on no wall, so that walls keep their velocity at every point.
In tetrahedra, pyramids and prisms, most of whose nodes lie on walls beside one, all nodes are free: c is then
along walls. A face between cells whose nodes all lie on walls carries a uniform flux. A second part, with no
component normal to the triangles, makes the divergence the same everywhere in a tetrahedron:
¼ Σ d_k λ_k (x_k − x), with the divergence d_k of u at vertex k (:func:`foamprb.flow.walk.correction_at`).

The fluxes through the faces of the cells are the smallest change of the interpolated ones that conserves
volume; those through the triangles in a cell likewise. OpenFOAM's ``phi`` is not used: it is the velocity at
the middle of a face times the area, which exceeds the integral by the curvature of the profile.
"""

from __future__ import annotations

from copy import copy
from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import inner, plus, scale_vector
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.balance import BALANCED, CONSTANT, Balance, Mass, closed_pieces
from foamprb.flow.base import Floats, Ints
from foamprb.flow.correction import NodalFlow, area_vector, triangle_flux
from foamprb.flow.mesh.arrays import arm, point
from foamprb.flow.mesh.interfaces import face_pairs
from foamprb.flow.mesh.layer import layer_of, turn_nodes
from foamprb.flow.mesh.lists import Mask, share
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import PatchKind

_LEAST_ALONG = 0.02
"""Least cosine between a face's normal and the line of the cell centres that counts in its weight."""
_LARGEST_CHANGE = 1.0
"""Largest change of the velocity through faces; see :class:`~foamprb.flow.balance.Balanced`."""


class Sides(NamedTuple):
    """Faces of a mesh and their cells; see :class:`~foamprb.flow.mesh.mesh.Mesh`."""

    face_start: Ints
    face_points: Ints
    owner: Ints
    neighbour: Ints


class Measures(NamedTuple):
    """Measures of faces, (n_faces,), for :class:`Balance`."""

    weight: Floats
    """Conductance, m."""
    error: Floats
    """Error of the velocity out of the face, m/s."""
    area: Floats
    """Area, m²."""


def free_nodes(mesh: Mesh) -> Floats:
    """Return 1 for nodes off walls, else −1 if all cells around are simple, else 0, (n_nodes,).

    See :attr:`foamprb.flow.mesh.mesh.Mesh.simple`.
    """
    simple = np.ones(mesh.n_points, dtype=bool)
    simple[mesh.cell_points[np.repeat(~mesh.simple, np.diff(mesh.cell_point_start))]] = False
    free = np.ones(mesh.n_points + mesh.n_cells)
    on_walls = mesh.triangles[_of_kind(mesh, PatchKind.WALL)[mesh.triangle_face]]
    free[on_walls] = np.where(simple[on_walls], -1.0, 0.0)
    return free


def _of_kind(mesh: Mesh, kind: PatchKind) -> Mask:
    """Return True for boundary faces of patches of a kind, (n_boundary,)."""
    of_patches = np.array([patch.kind is kind for patch in mesh.patches], dtype=bool)
    return np.repeat(of_patches, np.diff(mesh.patch_start))


class UnbalancedFlowError(InputError):
    """No fluxes that keep mass are found, or they are not those of the flow."""


class Conservation:
    """Operator from u and ∇u at the nodes of a mesh to the fluxes through its faces that keep volume.

    Parameters
    ----------
    mesh
        The mesh.
    sliding
        Whether walls slide: nothing flows through them. Otherwise the velocity of a wall makes a flux, as of
        a piston.
    """

    def __init__(self, mesh: Mesh, sliding: bool = False) -> None:
        self.n_faces = len(mesh.owner)
        self._mesh, self._nodes, self._free = mesh, mesh.nodes, free_nodes(mesh)
        self._layer = layer_of(mesh)
        self._closed, walls = _of_kind(mesh, PatchKind.MIRROR), _of_kind(mesh, PatchKind.WALL)
        # The flux through an open face may change.
        self._open = ~(self._closed | walls)
        self._closed |= walls & sliding
        ends = (walls | _of_kind(mesh, PatchKind.OPENING))[mesh.triangle_face]
        self._ends = np.unique(mesh.triangles[ends])
        self._coupled = np.concatenate([np.empty(0, dtype=np.intp), *(c.faces for c in mesh.couplings)])
        self._open[self._coupled] = False
        self._pairs = face_pairs(mesh)
        self._closed_pieces = closed_pieces(mesh, self._pairs, self._open)

    def at(self, mesh: Mesh) -> Conservation:
        """Return the operator for the mesh with its points at other places, without couplings that change."""
        other = copy(self)
        other._mesh, other._nodes = mesh, mesh.nodes
        return other

    def __call__(
        self,
        u: Floats,
        l: Floats,
        mass: Mass | None = CONSTANT,
        where: object = "flow",
        frame: tuple[Floats, Floats] | None = None,
        fastest: float = 0.0,
    ) -> Floats:
        """Return the flux out of the owner of each face, (n_faces,), m³/s.

        Parameters
        ----------
        u, l
            Velocity (n_nodes, 3), m/s, and its gradient (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, 1/s.
        mass
            Density of the fluid. None if it varies but is not known: cells then keep the volume that the
            interpolation makes.
        where
            Source of the velocity, for the message.
        frame
            Velocity and its gradient at the nodes of frames in which the mesh is at rest: the fluxes are
            relative to them. A frame keeps volume.
        fastest
            Largest speed of the mesh at any time, m/s, against which velocities are small.

        Raises
        ------
        UnbalancedFlowError
            If no fluxes are found that keep mass, or if they are not those of the flow.
        """
        mesh = self._mesh
        at = self._at_nodes(u, l)
        sides, fluxes, integrate = sides_of(mesh), np.empty(self.n_faces), link(face_fluxes)

        def faces(low: int, high: int) -> None:
            integrate(low, high, at, sides, fluxes)

        share(len(fluxes), faces)
        if not np.isfinite(fluxes).all():
            raise UnbalancedFlowError(f"the velocity of {where} is not finite at some nodes of the mesh.")
        carried = np.zeros(self.n_faces)
        if frame is not None:
            of_frame = self._at_nodes(*frame)
            share(self.n_faces, lambda low, high: integrate(low, high, of_frame, sides, carried))
            fluxes -= carried
        outer = fluxes[mesh.n_internal :]
        outer[self._closed] = 0.0
        # What leaves through a coupled patch enters through its partner.
        crossing = self._pairs.crossing(outer)
        outer[self._coupled] = self._pairs.total(crossing)[self._coupled]
        if mass is not None:
            measures = _measured(mesh, at, sides, fluxes + carried)
            balance = Balance(mesh, self._pairs, measures, fluxes, self._open, self._closed_pieces)
            speed = max(fastest, float(np.linalg.norm(u[self._ends], axis=1).max(initial=0.0)))
            left, change, iterations = balance(crossing, mass, speed)
            if not (left <= 10.0 * BALANCED and change <= _LARGEST_CHANGE):
                raise UnbalancedFlowError(
                    f"the fluxes of {where} cannot be balanced: after {iterations} iterations the "
                    f"correction of the velocity is {change:.2g} times the flow, and cells make or lose "
                    f"{left:.2g} times the flow through their faces (root mean squares; allowed: "
                    f"{_LARGEST_CHANGE:g} and {10.0 * BALANCED:g}). Without the correction followers gather, "
                    "and stick at walls. Possible causes: a velocity that is no solution of the flow "
                    "equations, a mesh that moves, a gas that expands by heat or reactions (no rho, or p "
                    "and T), or cells without volume (see checkMesh)."
                )
        return fluxes

    def _at_nodes(self, u: Floats, l: Floats) -> NodalFlow:
        layer, l = self._layer, l.reshape(-1, 3, 3)
        if layer is not None and len(layer.axis):
            # Of a wedge those along the middle plane, and out of it as far as the distance from the axis
            # grows: flat faces have the same velocity at all depths.
            u, l = u.copy(), l.copy()
            turn_nodes(layer.turns, u)
            turn_nodes(layer.turns, l)
            plane = np.eye(3) - np.outer(layer.normal, layer.normal)
            u, l = u @ plane, plane @ l @ plane
            turn_nodes(layer.turns, u, back=True)
        return NodalFlow(self._nodes, u, l.reshape(-1, 9), self._free[:, None], 0, 0, 0, 0)


def sides_of(mesh: Mesh) -> Sides:
    """Return the faces of a mesh and their cells."""
    return Sides(*(getattr(mesh, name) for name in Sides._fields))


def _measured(mesh: Mesh, at: NodalFlow, sides: Sides, fluxes: Floats) -> Floats:
    """Return the results of :func:`weigh_faces`, (3, n_faces)."""
    measures, weigh = np.empty((3, len(fluxes))), link(weigh_faces)
    given = at.x, at.u, mesh.n_points, mesh.boundary_centres
    share(len(fluxes), lambda low, high: weigh(low, high, *given, sides, fluxes, Measures(*measures)))
    return measures


def face_fluxes(begin: int, end: int, at: NodalFlow, sides: Sides, fluxes: Floats) -> None:
    """Integrate the interpolated velocity over the triangles of faces, m³/s."""
    start, points = sides.face_start, sides.face_points
    for f in range(begin, end):
        base, total = points[start[f]], 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            total += triangle_flux(at, base, points[k], points[k + 1])
        fluxes[f] = total


def weigh_faces(
    begin: int,
    end: int,
    nodes: Floats,
    u: Floats,
    n_points: int,
    boundary_centres: Floats,
    sides: Sides,
    fluxes: Floats,
    measures: Measures,
) -> None:
    """Measure the faces from ``begin`` to before ``end``."""
    start, points, owner, neighbour = sides.face_start, sides.face_points, sides.owner, sides.neighbour
    for f in range(begin, end):
        s = 0.0, 0.0, 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            s = plus(s, area_vector(nodes, points[start[f]], points[k], points[k + 1]))
        size = max(np.sqrt(inner(s, s)), 1e-300)
        o = n_points + owner[f]
        v, x = point(u, o), point(nodes, o)
        if f < neighbour.shape[0]:
            other = n_points + neighbour[f]
            v, d = scale_vector(0.5, plus(v, point(u, other))), arm(nodes, other, x)
        else:
            d = arm(boundary_centres, f - neighbour.shape[0], x)
        reach = max(inner(d, d), 1e-300)
        measures.weight[f] = max(inner(s, d), _LEAST_ALONG * size * np.sqrt(reach)) / reach
        measures.error[f] = (inner(s, v) - fluxes[f]) / size
        measures.area[f] = size
