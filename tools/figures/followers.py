"""Tracers in flows of OpenFOAM: their distribution in closed flows, and their deposition in open ones.

Usage: python tools/figures/followers.py CASE [CASE …], with solved cases. Tracers of 10 nm with the density
of the fluid stick to walls. They start evenly in a closed flow, 20 per cell, and are followed for
``-turnovers`` times its size over its mean speed; in an open one, 1000 start at the inflow. Steps are a fifth
of a cell at the largest speed. Each flow is taken as it is read, and without the correction that keeps
volume. Prints the table of docs/flow.md.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb import Cloud, Medium, Stick, read_case, spheres
from foamprb.cloud.patches import Escape, Interaction, Mirror
from foamprb.cloud.state import Status
from foamprb.flow.meshflow import MeshFlow

DIAMETER, NUMBER = 1e-8, 1000
"""Of the tracers, m, and their number."""
OPEN, WALL = "patch", "wall"


def seed(flow: MeshFlow, number: int, inlet: bool) -> NDArray[np.float64]:
    """Return places: evenly in the flow, or over the inflow in proportion to the flux."""
    random = np.random.default_rng(1)
    if not inlet:
        zone = flow.cell_zone(None)
        rows = random.choice(len(zone.volumes), number, p=np.abs(zone.volumes) / np.abs(zone.volumes).sum())
        corners = zone.vertices(zone.hosts[rows])
        return np.einsum("nk,nki->ni", random.dirichlet(np.ones(4), number), corners)
    faces = [flow.patch_faces(patch.name, 0.0) for patch in flow.patches if patch.type == OPEN]
    vertices, normals = (
        np.concatenate([getattr(f, name) for f in faces]) for name in ("vertices", "normals")
    )
    areas = np.concatenate([f.areas for f in faces])
    speeds = np.concatenate([f.velocity.mean(axis=1) for f in faces])
    flux = np.maximum(areas * np.einsum("ni,ni->n", speeds, normals), 0.0)
    rows = random.choice(len(flux), number, p=flux / flux.sum())
    places = np.einsum("nk,nki->ni", random.dirichlet(np.ones(3), number), vertices[rows])
    return places + 1e-6 * np.sqrt(areas[rows])[:, None] * normals[rows]


def interactions(flow: MeshFlow) -> list[Interaction]:
    """Let tracers stick to walls and leave through open patches."""
    by_type: dict[str, Interaction] = {WALL: Stick(), OPEN: Escape()}
    return [by_type.get(patch.type, Mirror()) for patch in flow.patches]


def follow(flow: MeshFlow, turnovers: float) -> tuple[int, int, float]:
    """Return how many tracers stuck and are still on their way, and χ² over the number of cells (closed)."""
    closed = all(patch.type != OPEN for patch in flow.patches)
    _, u, _ = flow.at_nodes()
    speed = float(np.linalg.norm(u[flow.mesh.n_points :], axis=1).mean())
    size = float(np.max(flow.bounds[1] - flow.bounds[0]))
    cell = float(np.cbrt(np.median(flow.mesh.volumes)))
    dt = 0.2 * cell / float(np.linalg.norm(u, axis=1).max())
    steps = int((turnovers if closed else 20.0) * size / speed / dt)
    number = 20 * flow.mesh.n_cells if closed else NUMBER
    x = seed(flow, min(number, 20_000), not closed)
    bodies = spheres(x, d=DIAMETER, rho=1.0, mu=1.0)
    cloud = Cloud(bodies, flow, Medium(1e-5, 1.0, (0.0, 0.0, 0.0)), interactions(flow), dt)
    cloud.advance(steps)
    p = cloud.particles
    active = p.status == Status.ACTIVE
    count = np.bincount(flow.cell_of(p.host[active]), minlength=flow.mesh.n_cells)
    expected = len(x) * flow.mesh.volumes / flow.mesh.volumes.sum()
    chi = float(np.mean((count - expected) ** 2 / expected)) if closed else np.nan
    return int(np.count_nonzero(p.status == Status.STUCK)), int(np.count_nonzero(active)), chi


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE")
    parser.add_argument("-turnovers", type=float, default=50.0, help="default: %(default)s")
    options = parser.parse_args()
    print(
        "| case | cells | u | tracers | stuck | on their way | χ² per cell |\n|---|---|---|---|---|---|---|"
    )
    for case in options.cases:
        flow = read_case(case)
        _, u, l = flow.at_nodes()
        plain = MeshFlow(flow.mesh, u, l.reshape(-1, 3, 3))
        for name, one in (("interpolated", plain), ("keeps volume", flow)):
            stuck, active, chi = follow(one, options.turnovers)
            tracers = min(20 * flow.mesh.n_cells, 20_000) if np.isfinite(chi) else NUMBER
            shown = f"{chi:.2f}" if np.isfinite(chi) else ""
            print(
                f"| {case.name} | {flow.mesh.n_cells} | {name} | {tracers} | {stuck} | {active} | {shown} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
