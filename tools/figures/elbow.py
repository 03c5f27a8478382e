"""Rigid particles in OpenFOAM's elbow: foamprb against OpenFOAM's tracking, on refined meshes.

Usage: python tools/figures/elbow.py [-levels N] [-folder DIR] [-write PAGE]

The mesh of the icoFoam tutorial `elbow` is refined by cutting each triangle into four. icoFoam computes the
flow on the finest mesh; a cell of a coarser mesh has the mean of its parts. The flow is therefore the same
on all meshes, within their resolution, and only the tracking differs. 60 small and stiff particles start at
the two inlets: with foamprb's `rosenbrock`, and with icoUncoupledKinematicParcelFoam, `sphereDrag` and each
of its two interpolations of U. Their places at all seconds are compared with those of the *other* program,
on the same mesh and on the finest one.
"""

from __future__ import annotations

import argparse
import gzip
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks import pipe

from foamprb import Cloud, Escape, Medium, Models, Rebound, Status, read_case, spheres
from foamprb.cloud.patches import Interaction, Mirror
from foamprb.flow.read.openfoam import Case

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
TUTORIAL = Path("/usr/share/doc/openfoam-examples/examples/incompressible/icoFoam/elbow")
BEGIN, END = "<!-- elbow -->", "<!-- end of elbow -->"
EMPTY = "frontAndBackPlanes"
DIAMETER, DENSITY, FLUID, NU = 1e-4, 1e5, 1.0, 0.01
SECONDS = 30
SETTLED = (40.0, 10.0, 5.0, 2.0)
"""Time of icoFoam on each mesh, s, starting from the flow on the previous one."""


class Plane(NamedTuple):
    """Triangles, and the edges of each patch; front and back are empty patches."""

    points: Floats
    """(n, 2), m."""
    triangles: Ints
    edges: dict[str, Ints]
    z: tuple[float, float]

    @property
    def centres(self) -> Floats:
        """(n, 2), m."""
        return self.points[self.triangles].mean(axis=1)

    def refined(self) -> Plane:
        """Divide each triangle t into four, 4 t to 4 t + 3, and each edge into two."""
        a, b, c = self.triangles.T
        sides = np.sort(np.concatenate([[a, b], [b, c], [c, a]], axis=1).T, axis=1)
        pairs, which = np.unique(sides, axis=0, return_inverse=True)
        n, ab, bc, ca = len(self.points), *(len(self.points) + which.reshape(3, -1))
        children = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        middle = {(int(i), int(j)): n + k for k, (i, j) in enumerate(pairs)}
        edges = {}
        for name, old in self.edges.items():
            halves = [middle[int(min(i, j)), int(max(i, j))] for i, j in old]
            edges[name] = np.concatenate(
                [np.column_stack([old[:, 0], halves]), np.column_stack([halves, old[:, 1]])]
            )
        return Plane(
            np.concatenate([self.points, self.points[pairs].mean(axis=1)]),
            np.transpose(children, (2, 0, 1)).reshape(-1, 3),
            edges,
            self.z,
        )

    def write(self, path: Path) -> None:
        """Return a mesh of prisms in Gmsh's format 2.2."""
        n = len(self.points)
        nodes = np.concatenate([np.column_stack([self.points, np.full(n, z)]) for z in self.z])
        names = [EMPTY, *self.edges]
        elements = [(2, 1, row) for row in (*self.triangles, *(self.triangles[:, ::-1] + n))]
        for k, edges in enumerate(self.edges.values()):
            elements += [(3, 2 + k, row) for row in np.column_stack([edges, edges[:, ::-1] + n])]
        elements += [(6, 100, row) for row in np.column_stack([self.triangles, self.triangles + n])]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", f"{len(names) + 1}"]
        lines += [f'2 {1 + k} "{name}"' for k, name in enumerate(names)] + [
            '3 100 "fluid"',
            "$EndPhysicalNames",
        ]
        lines += [
            "$Nodes",
            f"{len(nodes)}",
            *(f"{k + 1} {x!r} {y!r} {z!r}" for k, (x, y, z) in enumerate(nodes.tolist())),
        ]
        lines += ["$EndNodes", "$Elements", f"{len(elements)}"]
        for k, (kind, tag, row) in enumerate(elements):
            lines.append(f"{k + 1} {kind} 2 {tag} {tag} {' '.join(str(i + 1) for i in row)}")
        path.write_text("\n".join([*lines, "$EndElements", ""]))


class Run(NamedTuple):
    """Places of all particles at each second, (times, n, 2), NaN outside the flow."""

    name: str
    level: int
    dt: float
    places: Floats


def sh(case: Path, *words: str) -> None:
    """Run one of OpenFOAM's programs."""
    with (case / f"log.{words[0]}").open("w") as log:
        subprocess.run([*words, "-case", str(case)], check=True, stdout=log, stderr=log)


def change(path: Path, entries: Mapping[str, object]) -> None:
    """Change entries of a dictionary."""
    text = path.read_text()
    for key, value in entries.items():
        text = re.sub(rf"(\n{key}\s+)[^;]+", rf"\g<1>{value}", text)
    path.write_text(text)


def tutorial(case: Path) -> Plane:
    """Copy the tutorial, and read its mesh."""
    shutil.copytree(TUTORIAL, case)
    for file in case.rglob("*.gz"):
        file.with_suffix("").write_bytes(gzip.decompress(file.read_bytes()))
    sh(case, "fluentMeshToFoam", str(case / "elbow.msh"))
    mesh = Case(case).mesh("0").mesh
    low = mesh.points[:, 2] < mesh.points[:, 2].mean()
    numbers = np.cumsum(low) - 1
    cells = mesh.cell_points.reshape(-1, 6)
    triangles = numbers[cells[low[cells]].reshape(-1, 3)]
    turned = area(mesh.points[low, :2], triangles) < 0.0
    triangles[turned] = triangles[turned, ::-1]
    edges = {}
    for k, patch in enumerate(mesh.patches):
        if patch.name != EMPTY:
            faces = np.arange(mesh.patch_start[k], mesh.patch_start[k + 1]) + mesh.n_internal
            corners = mesh.face_points[mesh.face_start[faces][:, None] + np.arange(4)]
            edges[patch.name] = numbers[corners[low[corners]].reshape(-1, 2)]
    z = mesh.points[:, 2]
    return Plane(mesh.points[low, :2], triangles, edges, (float(z.min()), float(z.max())))


def write_mesh(plane: Plane, case: Path) -> None:
    """Put a mesh into a case, with OpenFOAM's converter."""
    plane.write(case / "mesh.msh")
    sh(case, "gmshToFoam", str(case / "mesh.msh"))
    boundary = case / "constant/polyMesh/boundary"
    text = boundary.read_text()
    for name in (EMPTY, *plane.edges):
        kind = "empty" if name == EMPTY else "wall" if name.startswith("wall") else "patch"
        text = re.sub(rf"(\b{name}\s*\{{[^}}]*?type\s+)\w+", rf"\g<1>{kind}", text)
    boundary.write_text(text)


def order(plane: Plane, case: Path) -> Ints:
    """Return the triangle of each cell of a case."""
    centres = read_case(case, "0").mesh.centres[:, :2]
    distance, triangle = cKDTree(plane.centres).query(centres)
    if distance.max() > 1e-4 or len(np.unique(triangle)) < len(plane.triangles):
        raise SystemExit(f"{case}: the cells are not those that were written")
    return np.asarray(triangle, dtype=np.int64)


def read_u(path: Path) -> Floats:
    """Return the cell values of an ascii vector field."""
    text = path.read_text()
    match = re.search(r"internalField\s+nonuniform List<vector>\s*\d+\s*\((.*?)\n\)", text, re.DOTALL)
    if match is None:
        raise SystemExit(f"{path}: no list of vectors")
    return np.array(match[1].replace("(", " ").replace(")", " ").split(), dtype=float).reshape(-1, 3)


def write_u(case: Path, u: Floats) -> None:
    """Replace the values of ``0/U``."""
    values = "\n".join(f"({a:.17g} {b:.17g} {c:.17g})" for a, b, c in u.tolist())
    field = f"internalField nonuniform List<vector> {len(u)} (\n{values}\n);"
    path = case / "0/U"
    path.write_text(re.sub(r"internalField[^;]*;", field, path.read_text()))


def solve(folder: Path, levels: int) -> list[Path]:
    """Return cases of all meshes with the flow of the finest one, the coarsest first."""
    base = folder / "base"
    planes = [tutorial(base)]
    for _ in range(levels - 1):
        planes.append(planes[-1].refined())
    u: Floats = np.empty((0, 3))
    cases = []
    for level, plane in enumerate(planes):
        case = folder / f"level{level}"
        for name in ("0", "system"):
            shutil.copytree(base / name, case / name)
        (case / "constant").mkdir()
        shutil.copy(base / "constant/transportProperties", case / "constant")
        end, dt = SETTLED[level], 0.05 / 2**level
        control = {"endTime": end, "deltaT": dt, "writeInterval": round(end / dt), "writePrecision": 15}
        change(case / "system/controlDict", control)
        write_mesh(plane, case)
        triangle = order(plane, case)
        if level > 0:
            write_u(case, np.repeat(u, 4, axis=0)[triangle])
        sh(case, "icoFoam")
        u = np.empty((len(plane.triangles), 3))
        u[triangle] = read_u(case / f"{end:g}/U")
        cases.append(case)
    for case, plane in zip(reversed(cases), reversed(planes), strict=True):
        write_u(case, u[order(plane, case)])
        areas = area(plane.points, plane.triangles)
        if case is not cases[0]:
            u = (u * areas[:, None]).reshape(-1, 4, 3).sum(axis=1) / areas.reshape(-1, 4, 1).sum(axis=1)
    return cases


def area(points: Floats, triangles: Ints) -> Floats:
    """Return the area of each triangle, m², negative if clockwise."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    p, q = b - a, c - a
    return np.asarray(0.5 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]))


def starts(case: Path) -> Floats:
    """Return 60 places near the inlets, half at each."""
    z = read_case(case, "0").mesh.points[:, 2].mean()
    share = (np.arange(30) + 0.5) / 30.0
    left = np.column_stack([np.full(30, 0.5), 16.0 * share, np.full(30, z)])
    below = np.column_stack([52.6 + 3.9 * share, np.full(30, -4.3), np.full(30, z)])
    return np.concatenate([left, below])


PATCHES = """
    "wall.*" { type rebound; e 1; mu 0; }
    "(velocity|pressure).*" { type escape; }
    frontAndBackPlanes { type none; }
"""


def openfoam(case: Path, level: int, scheme: str, dt: float) -> Run:
    """Track with OpenFOAM."""
    copy = case.with_name(f"{case.name}-{scheme}-{dt:g}")
    shutil.copytree(case / "0", copy / "0")
    shutil.copytree(case / "constant", copy / "constant")
    shutil.copytree(case / "system", copy / "system")
    x = starts(case)
    pipe.write_dictionaries(copy, NU, FLUID, 0.0)
    pipe.write_parcels(copy, x, DIAMETER, DENSITY, PATCHES, scheme, "analytical")
    pipe.write_control(copy, dt, SECONDS, round(1.0 / dt))
    sh(copy, "icoUncoupledKinematicParcelFoam")
    places = np.full((SECONDS, len(x), 2), np.nan)
    for t in range(SECONDS):
        cloud_folder = copy / f"{t + 1}/lagrangian/kinematicCloud"
        who = [int(word) for word in _list(cloud_folder / "origId")]
        where = [line.strip("(").split(")")[0].split() for line in _list(cloud_folder / "positions")]
        places[t, who] = np.array(where, dtype=float).reshape(-1, 3)[:, :2]
    return Run(f"OpenFOAM, {scheme}", level, dt, places)


def _list(path: Path) -> list[str]:
    """Return the lines of an ascii list; a list of equal numbers has one line."""
    text = path.read_text()
    same = re.search(r"\n(\d+)\s*\{(\S+)\}", text)
    if same:
        return [same[2]] * int(same[1])
    match = re.search(r"\n\d+\s*\n?\((.*)\)", text, re.DOTALL)
    return match[1].strip().splitlines() if match else []


def foamprb(case: Path, level: int, dt: float) -> Run:
    """Track stiff bodies with foamprb."""
    flow, x = read_case(case, "0"), starts(case)
    p = spheres(x, d=DIAMETER, rho=DENSITY, mu=1e6)
    p.v[:] = 0.0
    actions: list[Interaction] = [
        Mirror() if patch.name == EMPTY else Rebound() if patch.name.startswith("wall") else Escape()
        for patch in flow.patches
    ]
    models = Models(integrator="rosenbrock", touching="centre")
    cloud = Cloud(p, flow, Medium(FLUID * NU, FLUID, (0.0, 0.0, 0.0)), actions, dt, models, 1)
    places = np.full((SECONDS, p.size, 2), np.nan)
    for t in range(SECONDS):
        cloud.advance(round(1.0 / dt))
        active = p.status == Status.ACTIVE
        places[t, active] = p.x[active, :2]
    return Run("foamprb", level, dt, places)


def distances(a: Run, b: Run) -> Floats:
    """Return the distances of a particle between two runs, at all common times, m."""
    apart = np.linalg.norm(a.places - b.places, axis=2)
    return np.asarray(apart[np.isfinite(apart)])


def fates(a: Run, b: Run) -> int:
    """Return the number of particles with the same final fate in both runs."""
    ends = (np.isfinite(run.places[-1, :, 0]) for run in (a, b))
    return int(np.equal(*ends).sum())


def table(runs: Sequence[Run], cells: Sequence[int]) -> str:
    """Compare each run with the other program's on the same mesh and on the finest mesh."""
    finest = {(run.name, run.level): run for run in sorted(runs, key=lambda run: -run.dt)}
    rows = [
        "| program | cells | step, s | on the same mesh: median, m | 95 % | fates alike "
        "| on the finest: median, m | 95 % | fates alike |",
        f"|---|---|---|{'---|' * 6}",
    ]
    for run in sorted(runs, key=lambda run: (run.name, run.level, -run.dt)):
        other = "OpenFOAM, cellPoint" if run.name == "foamprb" else "foamprb"
        row = [run.name, f"{cells[run.level]}", f"{run.dt:g}"]
        for reference in (finest[other, run.level], finest[other, len(cells) - 1]):
            row += [f"{x:.2g}" for x in np.percentile(distances(run, reference), [50, 95])]
            row.append(f"{fates(run, reference)} of {run.places.shape[1]}")
        rows.append(f"| {' | '.join(row)} |")
    return "\n".join(rows)


def compare(folder: Path, levels: int) -> tuple[list[Run], list[int]]:
    """Return all runs, and the numbers of cells."""
    cases = solve(folder, levels)
    cells = [len(read_u(case / "0/U")) for case in cases]
    runs = [foamprb(cases[0], 0, 0.1)]
    runs += [foamprb(case, level, 0.01) for level, case in enumerate(cases)]
    for scheme in ("cell", "cellPoint"):
        runs += [openfoam(cases[0], 0, scheme, dt) for dt in (0.1, 0.01)]
        runs += [openfoam(case, level, scheme, 0.0025) for level, case in enumerate(cases)]
    return runs, cells


def main() -> None:
    """Compare, and print or write the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-levels", type=int, default=3, choices=(2, 3, 4), help="number of meshes [3]")
    parser.add_argument("-folder", type=Path, help="folder to keep the cases in [none]")
    parser.add_argument("-write", type=Path, metavar="PAGE", help=f"write the table after {BEGIN} of a page")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        text = table(*compare(options.folder or Path(folder), options.levels))
    print(text)
    if options.write:
        before, _, after = options.write.read_text().partition(BEGIN)
        options.write.write_text(f"{before}{BEGIN}\n{text}\n{END}{after.partition(END)[2]}")


if __name__ == "__main__":
    main()
