"""Meshes of hexahedra cut into prisms or tetrahedra, written as OpenFOAM's."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Hexahedra(NamedTuple):
    """A mesh of hexahedra: a grid of VTK, and the middles of the faces of each patch, m."""

    grid: Any
    patches: dict[str, NDArray[np.float64]]


def hexahedra(case: Path) -> Hexahedra:
    """Return the mesh of a case, with its patches in their order."""
    import pyvista

    # The reader wants a file that tells the folder.
    with tempfile.TemporaryDirectory(dir=case) as copy:
        for part in ("constant", "system"):
            shutil.copytree(case / part, Path(copy) / part)
        mark = Path(copy) / "case.foam"
        mark.touch()
        blocks = pyvista.OpenFOAMReader(mark).read()
    sides = zip(blocks["boundary"].keys(), blocks["boundary"], strict=True)
    middles = {name: np.asarray(side.cell_centers().points) for name, side in sides}
    return Hexahedra(blocks["internalMesh"], middles)


def divide(grid: Any, kind: str) -> Any:
    """Return a grid of VTK, its hexahedra cut across x into prisms or tetrahedra."""
    hexes = grid.cells.reshape(-1, 9)[:, 1:]
    points = np.asarray(grid.points, dtype=np.float64)
    # Of the three pairs of opposite faces, the one across x becomes bottom and top.
    turns = ((0, 1, 2, 3, 4, 5, 6, 7), (0, 3, 7, 4, 1, 2, 6, 5), (0, 4, 5, 1, 3, 7, 6, 2))
    along = np.stack([np.abs(points[hexes[:, t[4]], 0] - points[hexes[:, t[0]], 0]) for t in turns], axis=1)
    best = along.argmax(axis=1)
    hexes = np.take_along_axis(hexes, np.array(turns)[best], axis=1)
    # The diagonal from the corner of the smallest number: the same on both ends of each cell.
    low = np.minimum(hexes[:, :4], hexes[:, 4:]).argmin(axis=1)
    order = (low[:, None] + np.arange(4)) % 4
    hexes = np.concatenate(
        [np.take_along_axis(hexes[:, :4], order, axis=1), np.take_along_axis(hexes[:, 4:], order, axis=1)],
        axis=1,
    )
    prisms = np.concatenate([hexes[:, [0, 1, 2, 4, 5, 6]], hexes[:, [0, 2, 3, 4, 6, 7]]])
    if kind == "prisms":
        return _grid(points, 13, _upright(points, prisms))
    return _grid(points, 10, _upright(points, _tetrahedra(prisms)))


def _tetrahedra(prisms: np.ndarray) -> np.ndarray:
    """Three of each prism, every quadrangle cut from its corner of the smallest number."""
    # Turn each prism until that corner comes first (Dompierre et al., 1999).
    turns = np.array(
        [[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4],
         [3, 5, 4, 0, 2, 1], [4, 3, 5, 1, 0, 2], [5, 4, 3, 2, 1, 0]]
    )  # fmt: skip
    p = np.take_along_axis(prisms, turns[prisms.argmin(axis=1)], axis=1)
    rising = np.minimum(p[:, 1], p[:, 5]) < np.minimum(p[:, 2], p[:, 4])
    one = p[rising][:, [[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]]]
    other = p[~rising][:, [[0, 1, 2, 4], [0, 4, 2, 5], [0, 4, 5, 3]]]
    return np.concatenate([one.reshape(-1, 4), other.reshape(-1, 4)])


def _upright(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Cells with those turned over that VTK would take for inside out."""
    n = cells.shape[1]
    a, b, c, d = (points[cells[:, k]] for k in (0, 1, 2, 3))
    negative = np.einsum("ci,ci->c", np.cross(b - a, c - a), d - a) < 0.0
    swap = [0, 2, 1, 3, 5, 4] if n == 6 else [0, 2, 1, 3]
    return np.where(negative[:, None], cells[:, swap], cells)


def _grid(points: np.ndarray, kind: int, cells: np.ndarray) -> Any:
    import pyvista

    stream = np.column_stack([np.full(len(cells), cells.shape[1]), cells]).ravel()
    return pyvista.UnstructuredGrid(stream, np.full(len(cells), kind, dtype=np.uint8), points)


def write_mesh(folder: Path, grid: Any, patches: dict[str, NDArray[np.float64]]) -> None:
    """Write OpenFOAM's polyMesh, faces in the order that its solvers want.

    Parameters
    ----------
    patches
        Middles of faces of the undivided mesh on each patch; that of the nearest one is taken.
        ``wall`` and ``defaultFaces`` are walls.
    """
    from scipy.spatial import cKDTree

    from foamprb.flow.mesh.mesh import build_mesh

    mesh = build_mesh(grid)
    order = np.lexsort((mesh.neighbour, mesh.owner[: mesh.n_internal]))
    numbers = np.repeat(np.arange(len(patches)), [len(centres) for centres in patches.values()])
    patch = numbers[cKDTree(np.concatenate(list(patches.values()))).query(mesh.boundary_centres)[1]]
    order = np.concatenate([order, mesh.n_internal + np.argsort(patch, kind="stable")])
    lists = np.split(mesh.face_points, mesh.face_start[1:-1])
    shutil.rmtree(folder)
    folder.mkdir()
    note = f"nPoints:{mesh.n_points}  nCells:{mesh.n_cells}  nFaces:{len(order)}  "
    note += f"nInternalFaces:{mesh.n_internal}"

    def write(name: str, kind: str, rows: list[str]) -> None:
        head = f'FoamFile {{ version 2.0; format ascii; class {kind}; note "{note}"; object {name}; }}\n'
        (folder / name).write_text(head + f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n")

    write("points", "vectorField", [f"({x:.12g} {y:.12g} {z:.12g})" for x, y, z in mesh.points])
    write("faces", "faceList", [f"{len(lists[f])}({' '.join(map(str, lists[f]))})" for f in order])
    write("owner", "labelList", [str(mesh.owner[f]) for f in order])
    write("neighbour", "labelList", [str(mesh.neighbour[f]) for f in order[: mesh.n_internal]])
    rows, start = [], mesh.n_internal
    for k, name in enumerate(patches):
        kind = "wall" if name in ("wall", "defaultFaces") else "patch"
        size = int(np.count_nonzero(patch == k))
        rows.append(f"{name} {{ type {kind}; nFaces {size}; startFace {start}; }}")
        start += size
    write("boundary", "polyBoundaryMesh", rows)
