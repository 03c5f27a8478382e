"""Motion of the mesh of a case, from the points that it has written."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.images import SEAM, seam
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.mesh import Mesh, with_points
from foamprb.flow.motion import Deformation, Motion, nearest_times, rates_of
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.case import available_times, find_dictionary, word_of
from foamprb.flow.read.field import FoamField
from foamprb.flow.read.times import listed
from foamprb.flow.timeline import one_period

_RIGID = 1e-4
"""Largest distance of a point from its place by a rigid motion, over the size of the piece."""
_STILL = 1e-6
"""The distance up to which a piece is at rest."""
_OF_EDGE, _ROUND_OFF = 0.01, 1e-7
"""The largest such distance over the shortest edge at a point, and the least over the size of the piece."""
_DIGITS, _SAMPLE = range(6, 12), 1000
"""Numbers of digits with which points may be written, and number of points whose digits are counted."""
_QUARTER = 0.5 * np.pi
_LIKE = 0.1
"""Largest difference between the turn by the points and that by a rate, over half a radian and the turn."""


class DeformsError(InputError):
    """A piece of the mesh does not move as a rigid body."""


class Spin(Protocol):
    """Provider of the angular velocity, 1/s, of some cells by the velocity on their walls."""

    def __call__(self, index: int, cells: NDArray[np.int64]) -> Floats | None:
        """Return it at the time of an index; None without walls that move with the mesh."""


def moving_times(folders: Mapping[str, Path], part: str) -> list[str]:
    """Return the times with an own ``points``, or another part of the mesh."""
    return [name for name, folder in folders.items() if existing(folder / "polyMesh" / part) is not None]


def moves(case: Path, region: str) -> bool:
    """Return whether the boundary of a case's mesh moves: by later points without faces, or by its kind."""
    folders = {name: case / name / region for name in available_times(case)[1:]}
    moved, root = moving_times(folders, "points"), find_dictionary(case, region, "dynamicMeshDict")
    layered = root is not None and "Topo" in word_of(root, "dynamicFvMesh")
    return bool({*moved} - {*moving_times(folders, "faces")} or (moved and layered))


def pieces_of(mesh: Mesh) -> NDArray[np.int64]:
    """Return the piece of each cell, (n_cells,): cells that faces join."""
    from scipy import sparse
    from scipy.sparse.csgraph import connected_components

    n = mesh.n_internal
    graph = sparse.coo_array((np.ones(n), (mesh.owner[:n], mesh.neighbour)), shape=(mesh.n_cells,) * 2)
    return connected_components(graph, directed=False)[1].astype(np.int64)


def rigid_motion(
    source: Path,
    times: Sequence[str],
    points: Callable[[str], Floats],
    mesh: Mesh,
    zones: Mapping[str, NDArray[np.int64]],
    spin: Spin,
    period: float | None,
    named: bool = False,
) -> Motion:
    """Fit the motion of the pieces of a mesh.

    Parameters
    ----------
    source
        The case, for messages.
    times
        Names of the times of the flow.
    points
        Reads the points at a time, (n_points, 3), m.
    mesh
        The mesh at the first time.
    zones
        Cells of zones, by which pieces are named.
    spin
        Returns the angular velocity, 1/s, by the velocity on the walls of the cells of a piece at the time of
        an index; None without such walls.
    period
        Period of the flow, s.
    named
        Whether the case names rigid motions, so that edges do not count.

    Raises
    ------
    DeformsError
        A piece deforms, by more than the digits of its points.
    InputError
        A piece turns by more than 90 degrees between two times, and no wall shows how fast;
        or a period does not return the points.
    """
    piece = pieces_of(mesh)
    times = _of_one_period(source, times, points, mesh, period)
    n, count, t = len(times), int(piece.max()) + 1, np.array([float(name) for name in times])
    names = tuple(_name(p, np.flatnonzero(piece == p), zones) for p in range(count))
    of_points = np.zeros(mesh.n_points, dtype=np.int64)
    of_points[mesh.cell_points] = np.repeat(piece, np.diff(mesh.cell_point_start))
    first, n_points = mesh.points, len(points(times[0]))
    shares = np.full(mesh.n_points, np.inf) if named else _OF_EDGE * shortest_edges(mesh)
    R, s = np.tile(np.eye(3), (n, count, 1, 1)), np.zeros((n, count, 3))
    for j, name in enumerate(times[1:], 1):
        now = _same_points(source, name, points(name), n_points)
        digits = 2.0 * last_digit(now)
        for p in range(count):
            own = np.flatnonzero(of_points[: len(now)] == p)
            a, b = first[own], now[own]
            size, share = float(np.ptp(a, axis=0).max()), shares[own]
            least = max(digits, _ROUND_OFF * size)
            still = np.maximum(np.minimum(_STILL * size, share), least)
            if (np.abs(b - a).max(axis=1) <= still).all():
                continue
            R[j, p], s[j, p], miss = _fit(a, b, still)
            if (miss > np.maximum(np.minimum(_RIGID * size, share), least)).any():
                raise DeformsError(
                    f"{source}: {names[p]} of the mesh deforms: its points at {name} s are up to "
                    f"{miss.max():.3g} m off a rigid motion."
                )
    c = np.stack([_quiet_point(first[of_points == p], R[:, p], s[:, p]) for p in range(count)])
    y = np.einsum("jpab,pb->jpa", R, c) + s
    ends = [*range(n), 0] if period is not None else [*range(n)]
    t_ends = np.append(t, t[0] + period) if period is not None else t
    turns = np.zeros((len(ends) - 1, count, 3))
    for p in range(count):
        own, rate = np.flatnonzero(piece == p), None
        for k in range(len(ends) - 1):
            step, h = R[ends[k + 1], p] @ R[ends[k], p].T, float(t_ends[k + 1] - t_ends[k])
            turn = _turn_of(step)
            known = _with_whole_turns(turn, h, rate, partial(spin, cells=own), ends[k : k + 2])
            if known is None and np.linalg.norm(turn) > _QUARTER + 1e-6:
                degrees = np.degrees(np.linalg.norm(turn))
                raise InputError(
                    f"{source}: {names[p]} of the mesh turns by {degrees:.3g} degrees from {times[ends[k]]} "
                    f"to {t_ends[k + 1]:g} s, or by whole turns more or less, and no wall with "
                    "movingWallVelocity shows how fast. Allowed: at most 90 degrees from time to time."
                )
            turn = turn if known is None else known
            turns[k, p], rate = turn, turn / h
    return _with_rates(Motion(piece, names, c, R, y, turns, np.zeros_like(y), np.zeros_like(y)), t, period)


def shortest_edges(mesh: Mesh) -> Floats:
    """Return the length of the shortest edge at each point, (n_points,), m; infinite without edges."""
    points, first = mesh.face_points, mesh.face_start
    others = np.append(points[1:], 0)
    others[first[1:] - 1] = points[first[:-1]]
    lengths = np.linalg.norm(mesh.points[points] - mesh.points[others], axis=1)
    found = np.full(mesh.n_points, np.inf)
    for ends in (points, others):
        np.minimum.at(found, ends, lengths)
    return found


def last_digit(points: Floats) -> float:
    """Return the unit of the last of at least six digits of the largest coordinate, m; 0 if it has all."""
    x = np.abs(points[:: 1 + len(points) // _SAMPLE])
    x = x[x > 0.0]
    for digits in _DIGITS:
        unit = 10.0 ** (np.floor(np.log10(x)) - digits + 1.0)
        if (np.abs(x / unit - np.rint(x / unit)) < 1e-3).all():
            return float(unit.max(initial=0.0))
    return 0.0


def _of_one_period(
    source: Path, times: Sequence[str], points: Callable[[str], Floats], mesh: Mesh, period: float | None
) -> Sequence[str]:
    """Return the times of a period; InputError if the points are others where the next one begins."""
    if period is None:
        return times
    given, size = [float(name) for name in times], float(np.ptp(mesh.points, axis=0).max())
    n = len(one_period(given, period))
    again = [times[k] for k in range(n, len(times)) if abs(given[k] - given[0] - period) < 1e-6 * period]
    for name in again[:1]:
        off = float(np.abs(points(name) - points(times[0])).max())
        if off > _RIGID * size:
            raise InputError(
                f"{source}: a period of {period:g} s does not return the points of the mesh: they are up "
                f"to {off:.3g} m off at {name} s. Allowed: a period of the motion, or none."
            )
    return times[:n]


def _same_points(source: Path, time: str, now: Floats, n: int) -> Floats:
    """Return points; InputError if their number is not n."""
    if len(now) != n:
        raise InputError(
            f"{source}: the mesh has {len(now)} points at {time} s and {n} before, with the same faces. "
            "Allowed: the same number of points at all times."
        )
    return now


def deformation_of(
    source: Path,
    times: Sequence[str],
    points: Callable[[str], Floats],
    mesh: Mesh,
    period: float | None,
    surfaces: Sequence[PatchSurface] = (),
) -> Deformation:
    """Read the motion of a mesh that deforms; see :func:`rigid_motion`, and :func:`sliding_patches`.

    Raises
    ------
    InputError
        The number of points changes, a period does not return them, or coupled patches do not move alike.
    """
    ends = (PatchKind.WALL, PatchKind.OPENING)
    kinds = np.array([patch.kind in ends for patch in mesh.patches], dtype=bool)
    own = np.unique(mesh.triangles[kinds[mesh.triangle_patch]])
    rows = np.full(mesh.n_points, -1, dtype=np.int32)
    rows[own] = np.arange(len(own))
    times = _of_one_period(source, times, points, mesh, period)
    sliding: set[tuple[int, int]] = set()
    past, ways, before = np.empty((len(times), len(own), 6)), np.empty(len(times) - 1), mesh.points
    for j, name in enumerate(times):
        now = _same_points(source, name, points(name), mesh.n_points)
        sliding |= sliding_patches(source, name, mesh, now, surfaces)
        past[j, :, :3] = now[own]
        if j > 0:
            ways[j - 1] = np.linalg.norm(now - before, axis=1).max()
        before = now
    motion = Deformation(tuple(map(float, times)), period, ways, rows, past, frozenset(sliding))
    for j in range(len(times)):
        past[j, :, 3:] = motion.rates(j, lambda k: past[k, :, :3])
    return motion


def require_uncoupled(source: Path, mesh: Mesh) -> None:
    """Raise InputError if a mesh with other faces at other times has coupled patches other than wedges."""
    coupled = [mesh.patches[c.patch] for c in mesh.couplings if mesh.patches[c.patch].type != "wedge"]
    if coupled:
        raise InputError(
            f"{source}: the mesh has other faces at other times, and its patch {coupled[0].name} "
            f"({coupled[0].type}) is coupled. Allowed: coupled patches of meshes that keep their faces."
        )


def sliding_patches(
    source: Path, time: str, mesh: Mesh, now: Floats, surfaces: Sequence[PatchSurface]
) -> set[tuple[int, int]]:
    """Return pairs of coupled patches, each way, that have slid on each other at a time.

    Other points of coupled patches must lie on their images, or move with these as one rigid body. Patches
    slide if those of ``surfaces`` are coupled as before with the points now.

    Raises
    ------
    InputError
        Points are off their images.
    """
    sliding: set[tuple[int, int]] = set()
    for c in mesh.couplings:
        if mesh.patches[c.patch].type == "wedge" or c.patch > c.other or not len(c.faces):
            continue
        here, there, _ = seam(mesh, c)
        a, b = (np.unique(mesh.triangles[mesh.triangle_patch == patch]) for patch in (c.patch, c.other))
        off, most = np.inf, SEAM * c.size
        if c.matching or (len(np.unique(here)) == len(a) and len(np.unique(there)) == len(b)):
            off = float(np.abs(now[here] @ c.turn.T + c.shift - now[there]).max(initial=0.0))
        if off > most and not c.matching:
            then, later = (np.concatenate([x[a] @ c.turn.T + c.shift, x[b]]) for x in (mesh.points, now))
            off = float(_fit(then, later, 0.0)[2].max())
        if off > most and surfaces and not c.matching:
            again = with_points(mesh, now, surfaces, str(source)).couplings
            same = [d for d in again if (d.patch, d.other) == (c.patch, c.other)]
            if any(np.allclose(d.turn, c.turn) and np.abs(d.shift - c.shift).max() <= most for d in same):
                sliding |= {(c.patch, c.other), (c.other, c.patch)}
                continue
        if off > most:
            patch, other = mesh.patches[c.patch], mesh.patches[c.other]
            raise InputError(
                f"{source}: the mesh deforms, and at {time} s points of its {patch.type} patch {patch.name} "
                f"are up to {off:.3g} m off those of {other.name}. Allowed: coupled patches that move alike, "
                "and cyclicAMI patches that slide on each other."
            )
    return sliding


def _with_whole_turns(
    turn: Floats, h: float, rate: Floats | None, spin: Callable[[int], Floats | None], ends: Sequence[int]
) -> Floats | None:
    """Return the rotation vector of an interval, h s long, that fits a known rate; None if none fits.

    Known are the rate of the interval before, and those on walls at the ends.
    """
    for j in (-1, *ends):
        guess = rate if j < 0 else spin(j)
        if guess is not None:
            near = nearest_turn(turn, guess * h)
            if np.linalg.norm(near - guess * h) <= _LIKE * (0.5 + np.linalg.norm(guess) * h):
                return near
    return None


def _with_rates(motion: Motion, t: Floats, period: float | None) -> Motion:
    """Return the motion with its rates, of the polynomials through up to five times."""
    n, count = motion.y.shape[:2]
    around = range(-2, n + 2) if period is not None else range(n)
    level = [(j % n, j // n * (period or 0.0)) for j in around]
    times = [float(t[j]) + shift for j, shift in level]
    for at in range(n):
        here = at + (2 if period is not None else 0)
        near = nearest_times(len(level), here)
        rows = [level[k][0] for k in near]
        motion.velocity[at] = rates_of([times[k] for k in near], motion.y[rows], here - near[0])
        # The rotation vector to another time is the one nearest to the sum of those on the way.
        since = np.zeros((len(near), count, 3))
        for way in (1, -1):
            total = np.zeros((count, 3))
            for k in range(here, near[-1] if way > 0 else near[0], way):
                index = level[k][0] if way > 0 else level[k - 1][0]
                total = total + way * motion.turns[index % len(motion.turns)]
                for p in range(count):
                    step = motion.Q[level[k + way][0], p] @ motion.Q[at, p].T
                    since[k + way - near[0], p] = nearest_turn(_turn_of(step), total[p])
        motion.omega[at] = rates_of([times[k] for k in near], since, here - near[0])
    return motion


def _turn_of(R: Floats) -> Floats:
    """Return the rotation vector of a rotation matrix."""
    from scipy.spatial.transform import Rotation

    turn: Floats = Rotation.from_matrix(R).as_rotvec()
    return turn


def nearest_turn(turn: Floats, guess: Floats) -> Floats:
    """Return the rotation vector of the same rotation that is nearest to a guess."""
    angle = float(np.linalg.norm(turn))
    axis = turn / angle if angle > 1e-9 else guess / max(float(np.linalg.norm(guess)), 1e-300)
    whole = np.round((guess @ axis - angle) / (2.0 * np.pi))
    near: Floats = (angle + 2.0 * np.pi * whole) * axis
    return near


def _fit(a: Floats, b: Floats, least: Floats | float) -> tuple[Floats, Floats, Floats]:
    """Return the rigid motion b = R·a + s of best fit (Kabsch 1976), and the distances from it, (n,).

    A motion without rotation whose distances are up to ``least``, m, counts as one.
    """
    middle, other = a.mean(axis=0), b.mean(axis=0)
    miss = np.abs(b - a - (other - middle)).max(axis=1)
    if (miss <= least).all():
        return np.eye(3), other - middle, miss
    u, _, v = np.linalg.svd((a - middle).T @ (b - other))
    sign = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))])
    R: Floats = (u @ sign @ v).T
    s: Floats = other - R @ middle
    return R, s, np.abs(a @ R.T + s - b).max(axis=1)


def _quiet_point(points: Floats, R: Floats, s: Floats) -> Floats:
    """Return the point of a piece that moves least; of several the nearest to its middle."""
    middle: Floats = points.mean(axis=0)
    change = R - np.eye(3)
    matrix = np.einsum("jba,jbc->ac", change, change)
    scale = float(np.trace(matrix))
    if scale == 0.0:
        return middle
    right = -np.einsum("jba,jb->a", change, s + change @ middle)
    point: Floats = middle + np.linalg.solve(matrix + 1e-9 * scale * np.eye(3), right)
    return point


def _name(p: int, cells: NDArray[np.int64], zones: Mapping[str, NDArray[np.int64]]) -> str:
    same = [
        name for name, of_zone in zones.items() if len(of_zone) == len(cells) and set(of_zone) == set(cells)
    ]
    inside = f"{same[0]}, " if same else ""
    return f"piece {p + 1} ({inside}{len(cells)} cells)"


def moves_rigidly(case: Path, region: str) -> bool:
    """Return whether the dictionary of a case moves pieces of its mesh as rigid bodies."""
    root = find_dictionary(case, region, "dynamicMeshDict")
    keys = ("dynamicFvMesh", "motionSolver", "solver")
    return root is not None and any("olidBody" in word_of(root, key) for key in keys)


def note_of_deformation(motion: Deformation, mesh: Mesh) -> str | Caveat:
    """Return a sentence about the motion of the mesh, a warning if points pass many cells a write."""
    most, size = float(motion.ways.max()), float(np.cbrt(np.median(mesh.volumes)))
    note = (
        f"the mesh deforms: points move by up to {most:.3g} m from time to time, {most / size:.2g} times the "
        "width of a cell"
    )
    hint = ". Errors decrease with the fourth power of the time between writes."
    return Caveat(note + hint) if most > size else f"T{note[1:]}."


def notes_of(motion: Motion, size: float) -> str:
    """Return a sentence about the motion of each piece in a mesh of a size, m."""
    parts = []
    for p, name in enumerate(motion.names):
        angles = np.linalg.norm(motion.turns[:, p], axis=1)
        ways = np.linalg.norm(np.diff(motion.y[:, p], axis=0), axis=1)
        omega = motion.omega[:, p][np.linalg.norm(motion.omega[:, p], axis=1).argmax()]
        most = float(np.linalg.norm(omega))
        text = []
        if angles.max() > 0.0:
            axis = " ".join(f"{x:.4g}" for x in np.round(omega / max(most, 1e-300), 6) + 0.0)
            changes = "up to " if np.ptp(angles) > 1e-3 * angles.max() else ""
            degrees = f"{np.degrees(angles.max()):.3g} degrees a write"
            text.append(f"turns with {changes}{most:.5g} rad/s about ({axis}), {degrees}")
        if ways.max(initial=0.0) > 2.0 * _STILL * size:
            text.append(f"moves by up to {ways.max():.3g} m a write")
        parts.append(f"{name} {' and '.join(text) or 'is at rest'}")
    return f"The mesh moves: {'; '.join(parts)}."


def require_points(names: Sequence[str], moved: Sequence[str], source: Path) -> None:
    """Raise InputError if some of the times have no points although others do."""
    missing = [name for name in names if name not in moved]
    if missing:
        raise InputError(
            f"{source}: the mesh moves, but polyMesh/points is missing at the times {listed(missing)}. "
            "Allowed: points at each time."
        )


def with_moving_walls(
    motion: Motion, index: int, whole: CaseMesh, field: FoamField, boundary: Floats
) -> Floats:
    """Return the velocities of the boundary faces with that of the piece where a wall moves with the mesh.

    OpenFOAM's ``movingWallVelocity`` lags by half a step of the solver.
    """
    values, rows = boundary.copy(), _of_moving_walls(whole, field)
    mesh = whole.mesh
    pieces = motion.piece[mesh.owner[mesh.n_internal :][rows]]
    values[rows] = motion.speed(index, mesh.boundary_centres[rows], pieces)
    return values


def spin_of_walls(
    whole: CaseMesh, field: FoamField, boundary: Floats, cells: NDArray[np.int64]
) -> Floats | None:
    """Return the angular velocity, 1/s, of the walls of some cells that move with the mesh; None without any.

    It is that of best fit to v + Ω × x.
    """
    mesh, rows = whole.mesh, _of_moving_walls(whole, field)
    rows = rows[np.isin(mesh.owner[mesh.n_internal :][rows], cells)]
    if len(rows) == 0:
        return None
    x = mesh.boundary_centres[rows]
    x = x - x.mean(axis=0)
    # Ω × x is linear in Ω.
    across = np.stack([np.cross(axis, x) for axis in np.eye(3)], axis=2)
    columns = np.concatenate([across, np.tile(np.eye(3), (len(x), 1, 1))], axis=2).reshape(-1, 6)
    found: Floats = np.linalg.lstsq(columns, boundary[rows].reshape(-1), rcond=None)[0]
    return found[:3]


def nodes_of_moving_walls(whole: CaseMesh, field: FoamField) -> NDArray[np.integer[Any]]:
    """Return the nodes of the walls that move with the mesh."""
    faces = _of_moving_walls(whole, field)
    nodes: NDArray[np.integer[Any]] = np.unique(
        whole.mesh.triangles[np.isin(whole.mesh.triangle_face, faces)]
    )
    return nodes


def _of_moving_walls(whole: CaseMesh, field: FoamField) -> NDArray[np.intp]:
    """Return the boundary faces on which the velocity is that of the mesh."""
    found = [np.empty(0, dtype=np.intp)]
    for patch, first in zip(whole.patches, whole.mesh.patch_start, strict=False):
        entry = field.of(patch)
        if entry is not None and entry.type == "movingWallVelocity":
            found.append(np.arange(first, first + patch.faces))
    return np.concatenate(found)
