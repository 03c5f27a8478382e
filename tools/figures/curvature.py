"""Errors of the flow's second derivatives on meshes of pipes.

Usage: python tools/figures/curvature.py PIPE BEND prints the table of docs/flow.md. PIPE and BEND are runs
of ``cases/pipe`` and of ``cases/snappy``, whose first leg is a pipe; further meshes are those of
tools/benchmark, and of gmsh. The values at the cells are exact, or those of the solver.

Fields are Poiseuille's velocity, and rotating cells across the pipe with a flow along it, of wave number
2/radius. S is the part of the second derivatives that deforms a sphere, ∇²u the part of Faxén's correction.
Errors are root mean squares over that of the exact values at random places in the core (r < 0.8 radii) and
near the wall.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks import pipe
from figures import simple_cells

import foamprb
from foamprb.body.quadratic import parts, square
from foamprb.compile.link import link
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.field import VELOCITY_FIELD
from foamprb.flow.read.openfoam import Case, velocities
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.walk import curvature

Floats = NDArray[np.float64]
BENCHMARKS = ("5k", "40k", "300k")
POINTS = 40_000
CORE = 0.8
LEG = (0.001, 0.009)
"""Places in ``cases/snappy`` along the axis, m."""


class Pipe(NamedTuple):
    """Mesh of a pipe about the x axis."""

    name: str
    mesh: Mesh
    radius: float
    """m."""
    ends: tuple[float, float]
    """Range of the places along the axis, m."""
    solved: tuple[Floats, Floats] | None = None
    """Velocities of a solver at the cells and at the boundary, m/s."""


def cells_across(x: Floats, radius: float) -> Floats:
    """Return rotating cells with a flow along them, 1 m/s."""
    y, z = 2.0 / radius * x[:, 1], 2.0 / radius * x[:, 2]
    return np.stack([np.cos(y) * np.cos(z), np.sin(y) * np.cos(z), -np.cos(y) * np.sin(z)], axis=1)


def poiseuille(x: Floats, radius: float) -> Floats:
    """Return Poiseuille's velocity along x, of the mean of tools/benchmark, m/s."""
    u = np.zeros_like(x)
    u[:, 0] = 2.0 * pipe.MEAN * (1.0 - (x[:, 1] ** 2 + x[:, 2] ** 2) / radius**2)
    return u


FIELDS = {"Poiseuille": poiseuille, "cells": cells_across}


def differences(field: Callable[[Floats, float], Floats], x: Floats, radius: float) -> tuple[Any, ...]:
    """Return the second derivatives of a field, 1/(m s), by central differences."""
    h = 1e-3 * radius

    def second(i: int, j: int) -> Floats:
        a, b = h * np.eye(3)[i], h * np.eye(3)[j]
        return (
            field(x + a + b, radius)
            - field(x + a - b, radius)
            - field(x - a + b, radius)
            + field(x - a - b, radius)
        ) / (4.0 * h * h)

    return tuple(tuple(second(i, j).T) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)))


def all_curvatures(flow: Any, hosts: NDArray[np.int32], x: Floats, values: Floats) -> None:
    """Write the second derivatives at points in tetrahedra, (n, 18), 1/(m s)."""
    for i in range(len(hosts)):
        at_point = curvature(flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), 0.0)
        for j in range(6):
            for k in range(3):
                values[i, 3 * j + k] = at_point[j][k]


def random_places(p: Pipe) -> tuple[Floats, Floats]:
    """Return random places in a pipe, (n, 3), m, and their distances from the axis over the radius."""
    random = np.random.default_rng(0)
    share, angle = 0.98 * np.sqrt(random.random(POINTS)), 2.0 * np.pi * random.random(POINTS)
    x = random.uniform(*p.ends, POINTS)
    return np.column_stack([x, p.radius * share * np.cos(angle), p.radius * share * np.sin(angle)]), share


def rows_of(p: Pipe) -> Iterator[str]:
    """Yield rows of the table."""
    mesh, reconstruct = p.mesh, Reconstruction(p.mesh)
    x, share = random_places(p)
    width = float(np.cbrt(np.median(mesh.volumes))) / p.radius
    sources: list[tuple[str, str, tuple[Floats, Floats]]] = []
    for name, field in FIELDS.items():
        cells, boundary = field(mesh.centres, p.radius), field(mesh.boundary_centres, p.radius)
        if field is poiseuille:
            for patch, first, last in zip(mesh.patches, mesh.patch_start, mesh.patch_start[1:], strict=False):
                if patch.type == "wall":
                    boundary[first:last] = 0.0
        sources.append((name, "exact", (cells, boundary)))
    if p.solved is not None:
        sources.append(("Poiseuille", "solver", p.solved))
    for name, source, values in sources:
        u, l = reconstruct(*values)
        flow = MeshFlow(mesh, u, l, curvatures=mean_curvatures(mesh, l))
        hosts = flow.locate(x)
        inside = hosts >= 0
        places = x[inside]
        core = share[inside] < CORE
        table = np.empty((len(places), 18))
        link(all_curvatures)(flow.arrays(), hosts[inside], places, table)
        ours = parts(tuple(tuple(table[:, 3 * j : 3 * j + 3].T) for j in range(6)))  # type: ignore[arg-type]
        theirs = parts(differences(FIELDS[name], places, p.radius))  # type: ignore[arg-type]
        shape = square(tuple(a - b for a, b in zip(ours.S, theirs.S, strict=True))), square(theirs.S)  # type: ignore[arg-type]
        v, w = np.array(ours.v), np.array(theirs.v)
        errors = [shape, (((v - w) ** 2).sum(axis=0), (w**2).sum(axis=0))]
        cells = [
            f"{100.0 * np.sqrt(error[part].mean() / exact[part].mean()):.1f}"
            for error, exact in errors
            for part in (core, ~core)
        ]
        yield f"| {p.name} | {mesh.n_cells} | {width:.2f} | {name}, {source} | {' | '.join(cells)} |"


def solved(case: Path) -> tuple[Mesh, tuple[Floats, Floats]]:
    """Return the mesh of a case and its last velocities."""
    opened = Case(case)
    name = opened.select_time("latestTime")
    read = opened.mesh(name)
    return read.mesh, velocities(opened.field(name, "U", VELOCITY_FIELD), read)


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("pipe", type=Path, metavar="PIPE", help="run of cases/pipe")
    parser.add_argument("bend", type=Path, metavar="BEND", help="run of cases/snappy")
    options = parser.parse_args()
    print(
        "| mesh | cells | width of a cell, radii | field, values | S core, % | S wall | ∇²u core | ∇²u wall |"
    )
    print("|---|---|---|---|---|---|---|---|")

    def report(*arguments: Any) -> None:
        print(*rows_of(Pipe(*arguments)), sep="\n", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        os.environ["FOAMPRB_BENCHMARK_DIR"] = folder
        for name in BENCHMARKS:
            mesh = foamprb.read_case(pipe.case(name)).mesh
            report("hexahedra", mesh, pipe.RADIUS, (pipe.LENGTH / 3.0, pipe.LENGTH / 1.5))
    mesh, values = solved(options.pipe)
    length = float(mesh.points[:, 0].max())
    report("cases/pipe", mesh, pipe.RADIUS, (0.2 * length, 0.8 * length), values)
    report("cases/snappy", solved(options.bend)[0], 0.002, LEG)
    for kind, sizes in simple_cells.SIZES.items():
        for size in sizes:
            report(kind, simple_cells.meshed(kind, size), 1.0, (1.0, 4.0))
    return 0


if __name__ == "__main__":
    sys.exit(main())
