"""Errors of the flow's second derivatives in Faxén's correction, on three meshes of a pipe.

Usage: python tools/figures/faxen.py prints the table of docs/models/faxen.md. The meshes are those of
tools/benchmark, with exact values at the cell centres and on the boundary, of two fields: Poiseuille's, and
rotating cells across the pipe with a flow along it, of wave number 2/radius. ∇²u, whose ⅙ R² acts on a
sphere, is compared at random places in the core (r < 0.8 radii) and near the wall. Errors are root mean
squares over that of ∇²u.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks import pipe

import foamprb
from foamprb.compile.link import link
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.walk import curvature

Floats = NDArray[np.float64]
MESHES = ("5k", "40k", "300k")
WAVE = 2.0 / pipe.RADIUS


def cells_across(x: Floats) -> Floats:
    """Return rotating cells with a flow along them, 1 m/s."""
    y, z = WAVE * x[:, 1], WAVE * x[:, 2]
    return np.stack([np.cos(y) * np.cos(z), np.sin(y) * np.cos(z), -np.cos(y) * np.sin(z)], axis=1)


def laplacian_of_cells(x: Floats) -> Floats:
    """Return ∇²u of the rotating cells, 1/(m s)."""
    return -2.0 * WAVE * WAVE * cells_across(x)


def laplacian_of_poiseuille(x: Floats) -> Floats:
    """Return ∇²u of Poiseuille's flow, 8 U/a² against the flow, 1/(m s)."""
    laplacian = np.zeros_like(x)
    laplacian[:, 0] = -8.0 * pipe.MEAN / pipe.RADIUS**2
    return laplacian


FIELDS: dict[str, tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]]] = {
    "Poiseuille": (pipe.poiseuille, laplacian_of_poiseuille),
    "cells": (cells_across, laplacian_of_cells),
}


def laplacians(flow: Any, hosts: NDArray[np.int32], values: Floats) -> None:
    """Return ∇²u in the tetrahedra, (n, 3), 1/(m s)."""
    for i in range(len(hosts)):
        xx, yy, zz, _, _, _ = curvature(flow, hosts[i], (0.0, 0.0, 0.0), 0.0)
        for k in range(3):
            values[i, k] = xx[k] + yy[k] + zz[k]


def places(n: int) -> Floats:
    """Return random places between a third and two thirds of the pipe, to 0.98 radii, (n, 3)."""
    random = np.random.default_rng(0)
    r, angle = 0.98 * pipe.RADIUS * np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    x = pipe.LENGTH / 3.0 * (1.0 + random.random(n))
    return np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    rows: list[tuple[str, int, float, float, float]] = []
    with tempfile.TemporaryDirectory() as folder:
        os.environ["FOAMPRB_BENCHMARK_DIR"] = folder
        for name in MESHES:
            mesh = foamprb.read_case(pipe.case(name)).mesh
            width = float(np.cbrt(np.median(mesh.volumes))) / pipe.RADIUS
            reconstruct = Reconstruction(mesh)
            for field, (u, laplacian) in FIELDS.items():
                flow = MeshFlow(mesh, *reconstruct(u(mesh.centres), u(mesh.boundary_centres)))
                x = places(20_000)
                hosts = flow.locate(x)
                x, hosts = x[hosts >= 0], hosts[hosts >= 0]
                values = np.empty_like(x)
                link(laplacians)(flow.arrays(), hosts, values)
                exact = laplacian(x)
                square = ((values - exact) ** 2).sum(axis=1) / (exact**2).sum(axis=1).mean()
                core = np.hypot(x[:, 1], x[:, 2]) < 0.8 * pipe.RADIUS
                errors = float(np.sqrt(square[core].mean())), float(np.sqrt(square[~core].mean()))
                rows.append((field, mesh.n_cells, width, *errors))
    print("| field | cells | width of a cell, radii | core | wall |\n|---|---|---|---|---|")
    for field, cells, width, core_error, wall_error in sorted(rows):
        print(f"| {field} | {cells} | {width:.2f} | {core_error:.2%} | {wall_error:.2%} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
