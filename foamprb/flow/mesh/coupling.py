"""Coupled patches and wedges: pairs of faces, and the motion that carries one patch onto the other.

The faces of cyclic patches and of wedges match one to one. The surfaces of cyclicAMI patches coincide but are
cut into different faces: each face continues in all faces of the other patch that it overlaps.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats, Patch
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.lists import Index

# Tolerance of the distance of the image of a face from its partner, as a fraction of the face's size.
_MATCH = 1e-2
# Smaller rotations are round-off of single precision.
_NO_TURN = 1e-5
# Tolerance of the distance between surfaces cut differently, as a fraction of a face's size.
_APART = 0.25
# Fraction of the area of a cyclicAMI patch that must lie on its neighbour.
_COVERED = 0.95


class Coupling(NamedTuple):
    """Pair of patches of which the second continues the first: x → turn·x + shift."""

    patch: int
    other: int
    faces: Index
    """(n,) boundary faces of the first patch."""
    partners: Index
    """(n,) boundary faces of the second that continue them."""
    turn: Floats
    """(3, 3), a rotation."""
    shift: Floats
    """(3,), m."""
    matching: bool = True
    """True if the faces match one to one; otherwise a partner is the face nearest to the middle."""
    size: float = np.inf
    """Square root of the smallest area of a face, m."""

    def reverse(self) -> Coupling:
        """Return the coupling from the second patch to the first, of matching faces."""
        return Coupling(
            self.other, self.patch, self.partners, self.faces, self.turn.T, -self.turn.T @ self.shift
        )


def couple(
    patches: Sequence[Patch],
    patch_start: Index,
    centres: Floats,
    areas: Floats,
    surfaces: Sequence[PatchSurface],
    source: str,
) -> tuple[tuple[Patch, ...], tuple[Coupling, ...]]:
    """Match the faces of coupled patches with those of their neighbours, and of wedges with each other.

    The motion is computed from the faces, whatever the case states, except for cyclicAMI patches: their
    motion is stated, and its sense is computed. Cyclic patches match face by face in their order, as in
    OpenFOAM; faces of wedges match the nearest ones. Wedges and cyclicAMI patches that do not match are left
    uncoupled.

    Parameters
    ----------
    patches, patch_start
        The patches, and the first boundary face of each.
    centres, areas
        Centres (n_boundary, 3) and outward area vectors (n_boundary, 3) of the boundary faces, m and m².
    surfaces
        The patches' faces in the same order, if the mesh has named patches.
    source
        Name of the mesh for messages.

    Returns
    -------
    patches, couplings
        The patches with their coupled neighbours; the couplings, each with its reverse.

    Raises
    ------
    InputError
        A cyclic patch names no neighbour, or the two do not match.
    """
    named = [patch._replace(neighbour="") for patch in patches]
    names = [patch.name for patch in patches]
    faces = [np.arange(*patch_start[i : i + 2]) for i in range(len(patches))]
    found: list[Coupling] = []
    for i, patch in enumerate(patches):
        if patch.type not in ("cyclic", "cyclicAMI") or not patch.neighbour or patch.faceless:
            continue
        if patch.neighbour not in names:
            raise InputError(
                f"{source}: neighbourPatch {patch.neighbour} of the {patch.type} patch {patch.name} is not "
                f"there. {suggestion(patch.neighbour, names)}"
            )
        j = names.index(patch.neighbour)
        if patches[j].type != patch.type or patches[j].neighbour != patch.name or i == j:
            raise InputError(
                f"{source}: {patch.name} names {patch.neighbour} as its neighbour, but {patch.neighbour} is "
                f"of type {patches[j].type} with the neighbour {patches[j].neighbour or '(none)'}."
            )
        if i < j and patch.type == "cyclicAMI":
            found += _interface((i, j), (faces[i], faces[j]), centres, areas, surfaces)
        elif i < j:
            coupling = _cyclic(i, j, faces[i], faces[j], centres, areas)
            if coupling is None:
                raise InputError(
                    f"{source}: the faces of the cyclic patches {patch.name} ({len(faces[i])}) and "
                    f"{patch.neighbour} ({len(faces[j])}) do not fit onto each other."
                )
            found += [coupling, coupling.reverse()]
    wedges = [i for i, patch in enumerate(patches) if patch.type == "wedge" and len(faces[i])]
    while wedges:
        i = wedges.pop(0)
        for j in wedges:
            coupling = _wedge(i, j, faces[i], faces[j], centres, areas)
            if coupling is not None:
                found += [coupling, coupling.reverse()]
                wedges.remove(j)
                break
    for coupling in found:
        named[coupling.patch] = patches[coupling.patch]._replace(neighbour=names[coupling.other])
    areas_of = np.linalg.norm(areas, axis=1)
    sized = [c._replace(size=float(np.sqrt(areas_of[c.faces].min(initial=np.inf)))) for c in found]
    return tuple(named), tuple(sized)


def _cyclic(i: int, j: int, a: Index, b: Index, centres: Floats, areas: Floats) -> Coupling | None:
    """Return the rigid motion of best fit (Kabsch, Acta Cryst. A32, 1976, 922) of centres and normals."""
    if len(a) != len(b):
        return None
    if len(a) == 0:
        return Coupling(i, j, a, b, np.eye(3), np.zeros(3))
    x, y = centres[a], centres[b]
    p, q = x - x.mean(axis=0), y - y.mean(axis=0)
    m, n = _units(areas[a]), -_units(areas[b])
    spread = max(float(np.mean(np.sum(p * p, axis=1))), 1e-300)
    matrix = q.T @ p / spread + n.T @ m
    strength = np.linalg.svd(matrix, compute_uv=False)
    if strength[1] < 1e-9 * strength[0]:
        # A single face, or a row of them, leaves a rotation undetermined: take the smallest one.
        matrix += 1e-9 * strength[0] * np.eye(3)
    left, _, right = np.linalg.svd(matrix)
    sign = np.sign(np.linalg.det(left @ right))
    turn = left @ np.diag([1.0, 1.0, sign]) @ right
    if np.abs(turn - np.eye(3)).max() < _NO_TURN:
        turn = np.eye(3)
    shift = y.mean(axis=0) - turn @ x.mean(axis=0)
    coupling = Coupling(i, j, a, b, turn, shift)
    return coupling if _fits(coupling, centres, areas) else None


def _interface(
    pair: tuple[int, int],
    faces: tuple[Index, Index],
    centres: Floats,
    areas: Floats,
    surfaces: Sequence[PatchSurface],
) -> list[Coupling]:
    """Return both couplings of two cyclicAMI patches; none if one does not lie on the other."""
    if min(len(f) for f in faces) == 0:
        return []
    turn, shift = _stated_motion(surfaces[pair[0]], *_summed(faces[0], centres, areas),
                                 *_summed(faces[1], centres, areas))  # fmt: skip
    found = []
    for one, motion in ((0, (turn, shift)), (1, (turn.T, -turn.T @ shift))):
        a, b = faces[one], faces[1 - one]
        images = centres[a] @ motion[0].T + motion[1]
        nearest, places = closest(surfaces[pair[1 - one]].surface, images)
        area = np.linalg.norm(areas[a], axis=1)
        partners = b[nearest]
        size = np.sqrt(np.maximum(area, np.linalg.norm(areas[partners], axis=1)))
        lies = np.linalg.norm(images - places, axis=1) <= _APART * size
        if area[lies].sum() < _COVERED * area.sum():
            return []
        found.append(Coupling(pair[one], pair[1 - one], a, partners, *motion, matching=False))
    return found


def closest(surface: Any, points: Floats) -> tuple[Index, Floats]:
    """Return the cell of a surface that is closest to each point, and the place in it that is, m."""
    from vtkmodules.vtkCommonCore import reference
    from vtkmodules.vtkCommonDataModel import vtkCellLocator

    locator = vtkCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    cell: Any = reference(0)
    sub_cell: Any = reference(0)
    distance: Any = reference(0.0)
    nearest, places = np.empty(len(points), dtype=np.intp), np.empty((len(points), 3))
    for k, point in enumerate(points):
        place = [0.0, 0.0, 0.0]
        locator.FindClosestPoint(point, place, cell, sub_cell, distance)
        nearest[k], places[k] = int(cell), place
    return nearest, places


def _summed(faces: Index, centres: Floats, areas: Floats) -> tuple[Floats, Floats]:
    """Return the centroid, m, and the summed area vector, m², of boundary faces."""
    area = np.linalg.norm(areas[faces], axis=1)
    centroid: Floats = np.average(centres[faces], axis=0, weights=area)
    total: Floats = areas[faces].sum(axis=0)
    return centroid, total


def _stated_motion(
    surface: PatchSurface, x: Floats, m: Floats, y: Floats, n: Floats
) -> tuple[Floats, Floats]:
    """Return the stated rotation and shift, in the sense that carries centroid x and area m to y and −n."""
    from scipy.spatial.transform import Rotation

    stated = surface.transform
    turn, shift = np.eye(3), np.zeros(3)
    if stated.kind == "translational":
        given = y - x if stated.separation is None else np.array(stated.separation)
        shift = min((given, -given), key=lambda s: float(np.linalg.norm(x + s - y)))
    elif stated.kind == "rotational" and np.linalg.norm(stated.axis) > 0.0:
        axis, centre = np.array(stated.axis) / np.linalg.norm(stated.axis), np.array(stated.centre)
        # The sides of a sector face apart; a side that winds about the axis is located by its centroid.
        flat = min(_arm(m, axis), _arm(n, axis)) > _MATCH * float(np.linalg.norm(m))
        p, q = (m, -n) if flat else (x - centre, y - centre)
        p, q = p - (p @ axis) * axis, q - (q @ axis) * axis
        angle = float(np.arctan2(axis @ np.cross(p, q), p @ q))
        if stated.angle is not None:
            angle = np.copysign(abs(stated.angle), angle)
        turn = Rotation.from_rotvec(angle * axis).as_matrix()
        shift = centre - turn @ centre
    return turn, shift


def _arm(v: Floats, axis: Floats) -> float:
    """Return the length of the part of v across an axis."""
    return float(np.linalg.norm(v - (v @ axis) * axis))


def _wedge(i: int, j: int, a: Index, b: Index, centres: Floats, areas: Floats) -> Coupling | None:
    """Return the rotation about the line in which the planes of two wedge patches meet."""
    from scipy.spatial import KDTree

    if len(a) != len(b):
        return None
    m, n = (_units(areas[faces].sum(axis=0)) for faces in (a, b))
    axis = np.cross(m, -n)
    sine = float(np.linalg.norm(axis))
    if sine < _NO_TURN:
        return None
    axis /= sine
    cosine = float(-m @ n)
    # Rodrigues' formula; the rows e_k × a form the matrix of a × ….
    turn = cosine * np.eye(3) + sine * np.cross(np.eye(3), axis) + (1.0 - cosine) * np.outer(axis, axis)
    x, y = centres[a].mean(axis=0), centres[b].mean(axis=0)
    line = np.linalg.solve(np.stack([m, n, axis]), [m @ x, n @ y, 0.0])
    shift = line - turn @ line
    nearest = np.asarray(KDTree(centres[b]).query(centres[a] @ turn.T + shift)[1])
    if len(np.unique(nearest)) != len(b):
        return None
    coupling = Coupling(i, j, a, b[nearest], turn, shift)
    return coupling if _fits(coupling, centres, areas) else None


def _fits(coupling: Coupling, centres: Floats, areas: Floats) -> bool:
    """Return True if the image of every face lies on its partner, with the same area and facing it."""
    size = np.sqrt(np.linalg.norm(areas[coupling.faces], axis=1))
    off = centres[coupling.faces] @ coupling.turn.T + coupling.shift - centres[coupling.partners]
    turned = areas[coupling.faces] @ coupling.turn.T + areas[coupling.partners]
    return bool(
        np.all(np.linalg.norm(off, axis=1) <= _MATCH * size)
        and np.all(np.linalg.norm(turned, axis=1) <= 2.0 * _MATCH * size**2)
    )


def _units(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    units: Floats = vectors / np.where(length > 0.0, length, 1.0)
    return units
