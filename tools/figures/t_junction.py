"""Branch and deformation of soft beads in a T-junction, by softness and start.

Sends beads through the flow that ``cases/tJunction/Allrun`` computed: from a grid across the channel, from
the edges of what goes straight on and of what turns off, found to a tenth of a nanometre, and from random
places, as many as liquid flows there. Writes ``tJunction.csv``, ``tJunctionEdges.csv`` and, with matplotlib,
``tJunction.png``; prints the numbers of ``tJunction.md``.

    cases/tJunction/Allrun coarse
    python tools/figures/t_junction.py cases/tJunction/coarse --output docs
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from validation.report import pyplot

import foamprb
from foamprb.results.tables import write_table

Floats = NDArray[np.float64]

HALF_WIDTH, RELEASE = 50e-6, -200e-6
"""Half width of the channels; x at the start, from the intersection of their axes; m."""
DIAMETER, REFERENCE_RATE = 20e-6, 100.0
"""Diameter of the beads, m; shear rate of Ca, the mean velocity over the width, 1/s."""
CAPILLARY = np.array([0.001, 0.01, 0.03, 0.1])
EXCESS = 1000.0
"""Density of a heavy bead less that of the liquid, kg/m³."""
DT, END = 1e-4, 2.0
"""Tracking step, s; time after which a bead counts as undecided, s."""
LOOK, LATE, LATE_LOOK = 5, 0.2, 100
"""Steps between two samples of the shapes, and their number after a time, s, for creeping beads."""
CUTS, ROUNDS = 16, 5
"""Number of parts and of repetitions in the search for an edge: from 76 µm to 0.07 nm."""
BODY_ROUNDS = 3
"""Repetitions with contact of ellipsoids: to 19 nm, as each is larger than cells and tests many walls."""


class Fates(NamedTuple):
    """Fates of n beads."""

    patch: NDArray[np.str_]
    """Patch of its escape or deposition; ``""`` if still in the flow, ``failed`` if it failed."""
    D: Floats
    """Largest Taylor deformation with the centre in the crossing of the channels; 0 if it was never there."""


def flow_rates(case: Path) -> dict[str, float]:
    """Return the flow rate out of each patch by the solver's own fluxes, m³/s."""
    rates = {}
    for patch in ("inlet", "straight", "side"):
        (table,) = (case / "postProcessing" / patch).glob("*/surfaceFieldValue.dat")
        rates[patch] = float(table.read_text().split()[-1])
    return rates


def send(
    job: foamprb.Job,
    starts: Floats,
    Ca: float | Floats,
    *,
    excess: float = 0.0,
    touching: Literal["ellipsoid", "centre"] = "centre",
    dt: float = DT,
) -> Fates:
    """Track spheres from ``starts``, (n, 2), y and z in m, until they leave, stick, or exceed the time."""
    flow, medium = job.cloud.flow, job.cloud.medium
    x = np.column_stack([np.full(len(starts), RELEASE), starts])
    stiffness = medium.mu * REFERENCE_RATE / np.broadcast_to(Ca, len(starts))
    p = foamprb.spheres(x, d=DIAMETER, rho=medium.rho + excess, mu=stiffness)
    walls = [foamprb.Stick() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    cloud = foamprb.Cloud(p, flow, medium, walls, dt, foamprb.Models(touching=touching, integrator="stokes"))
    D = np.zeros(p.size)
    while cloud.time < END and (p.status <= foamprb.Status.ACTIVE).any():
        cloud.advance(round((LOOK if cloud.time < LATE else LATE_LOOK) * DT / dt))
        rows = np.flatnonzero(
            (p.status == foamprb.Status.ACTIVE) & (np.abs(p.x[:, :2]) < HALF_WIDTH).all(axis=1)
        )
        if len(rows):
            c = foamprb.context(p.take(rows), flow, medium.mu, cloud.time)
            D[rows] = np.maximum(D[rows], foamprb.measure(c)["taylorDeformation"])
    names = np.array([*(patch.name for patch in flow.patches), ""])
    return Fates(np.where(p.status == foamprb.Status.FAILED, "failed", names[p.patch]), D)


def speeds(job: foamprb.Job, starts: Floats) -> Floats:
    """Return the speed of the liquid along x at the starts, m/s."""
    x = np.column_stack([np.full(len(starts), RELEASE), starts])
    u, _ = job.cloud.flow.sample(x, job.cloud.flow.locate(x), 0.0)
    return u[:, 0]


def grid(half: float, n_y: int, n_z: int) -> Floats:
    """Return centres of n_y × n_z equal parts of a square section up to ±half, (n_y n_z, 2), m."""
    y, z = (half * ((2.0 * np.arange(n) + 1.0) / n - 1.0) for n in (n_y, n_z))
    return np.stack(np.meshgrid(y, z, indexing="ij"), axis=-1).reshape(-1, 2)


def random_by_flux(job: foamprb.Job, n: int, seed: int = 0) -> Floats:
    """Return n random starts in the whole section, with a density proportional to the speed, (n, 2), m."""
    rng = np.random.default_rng(seed)
    candidates = rng.uniform(-HALF_WIDTH, HALF_WIDTH, (8 * n, 2))
    u = speeds(job, candidates)
    return candidates[rng.uniform(0.0, u.max(), len(u)) < u][:n]


def edges(
    job: foamprb.Job,
    Ca: Floats,
    *,
    excess: float = 0.0,
    touching: Literal["ellipsoid", "centre"] = "centre",
    dt: float = DT,
    rounds: int = ROUNDS,
) -> Floats:
    """Return the edges of both branches in the plane z = 0 for each Ca, (n, 2), m.

    Below the first y a bead goes straight on, above the second it turns off; between them it ends on the wall
    or exceeds the time.
    """
    middles = []
    for straight in (True, False):
        low, high = (np.full(len(Ca), sign * (HALF_WIDTH - 0.6 * DIAMETER)) for sign in (-1.0, 1.0))
        for _ in range(rounds):
            y = np.linspace(low, high, CUTS + 1, axis=1)
            starts = np.column_stack([y.ravel(), np.zeros(y.size)])
            patch = send(job, starts, np.repeat(Ca, CUTS + 1), excess=excess, touching=touching, dt=dt).patch
            below = ((patch == "straight") if straight else (patch != "side")).reshape(y.shape)
            last = np.argmin(below, axis=1) - 1
            if below.all() or (last < 0).any():
                raise SystemExit(f"{job.settings.case}: every bead of a line takes the same way")
            low, high = (y[np.arange(len(Ca)), i] for i in (last, last + 1))
        middles.append((low + high) / 2.0)
    return np.stack(middles, axis=1)


def by_start(job: foamprb.Job, n_y: int, n_z: int) -> dict[str, Floats]:
    """Return the columns of the main table: Ca, y, share of the flux at y to each branch, and D.

    The shares are over all z with room for a bead, each bead weighted by the liquid's speed at its start.
    """
    starts = grid(HALF_WIDTH - 0.6 * DIAMETER, n_y, n_z)
    weights = speeds(job, starts).reshape(n_y, n_z)
    weights /= weights.sum(axis=1, keepdims=True)
    middle = np.abs(starts[:, 1]).reshape(n_y, n_z) == np.abs(starts[:, 1]).min()
    columns: dict[str, list[Floats]] = {}
    for Ca in CAPILLARY:
        fates = send(job, starts, Ca)
        patch, D = fates.patch.reshape(n_y, n_z), fates.D.reshape(n_y, n_z)
        parts = {"Ca": np.full(n_y, Ca), "y": starts[::n_z, 0]}
        parts |= {name: ((patch == name) * weights).sum(axis=1) for name in ("straight", "side", "wall")}
        parts |= {"undecided": ((patch == "") * weights).sum(axis=1), "D": D[middle]}
        for name, values in parts.items():
            columns.setdefault(name, []).append(values)
    return {name: np.concatenate(values) for name, values in columns.items()}


def main() -> None:
    """Compute, write, print and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("case", type=Path, help="a run of cases/tJunction")
    parser.add_argument("--output", type=Path, default=Path("docs"))
    options = parser.parse_args()
    job = foamprb.prepare(options.case)
    options.output.mkdir(parents=True, exist_ok=True)

    rates = flow_rates(options.case)
    share = rates["side"] / -rates["inlet"]
    print(f"flow rates, m3/s: {rates}; sum over inlet {sum(rates.values()) / rates['inlet']:.1e}")
    print("\n| Ca | beads | to the side | expected | standard error | on the wall | undecided | failed |")
    print("|---" * 8 + "|")
    starts = random_by_flux(job, 4000)
    for Ca in CAPILLARY[[0, -1]]:
        patch = send(job, starts, Ca).patch
        side, wall, under_way, failed = (np.mean(patch == name) for name in ("side", "wall", "", "failed"))
        error = np.sqrt(share * (1.0 - share) / len(patch))
        print(
            f"| {Ca:g} | {len(patch)} | {side:.4f} | {share:.4f} | {error:.4f} "
            f"| {wall:.4f} | {under_way:.4f} | {failed:.4f} |"
        )
    even = grid(HALF_WIDTH, 60, 60)
    patch, weights = send(job, even, CAPILLARY[0]).patch, speeds(job, even)
    shares = {name or "undecided": weights @ (patch == name) / weights.sum() for name in np.unique(patch)}
    print(
        f"\nby flux on an even grid of {len(even)}:",
        ", ".join(f"{v:.4f} {name}" for name, v in shares.items()),
    )

    columns = by_start(job, 39, 19)
    write_table(options.output / "tJunction.csv", columns)

    point, heavy = edges(job, CAPILLARY), edges(job, CAPILLARY, excess=EXCESS)
    print(f"edges of points, um:\n{1e6 * point}\nof heavy ones less those, nm:\n{1e9 * (heavy - point)}")
    extremes = CAPILLARY[[0, -1]]
    change = edges(job, extremes, dt=DT / 2) - point[[0, -1]]
    print(f"edges at half the time step, less those at {DT:g} s, nm:\n{1e9 * change}")
    body = edges(job, CAPILLARY, touching="ellipsoid", rounds=BODY_ROUNDS)
    D = columns["D"].reshape(len(CAPILLARY), -1)
    y = columns["y"].reshape(D.shape)[0]
    table: dict[str, Floats] = {"Ca": CAPILLARY}
    for name, edges_of in (("point", point), ("heavy", heavy), ("body", body)):
        table[f"{name}, straight below"], table[f"{name}, side above"] = edges_of.T
    table["D from y = 0"] = np.array([np.interp(0.0, y, d) for d in D])
    table["largest D"] = D.max(axis=1)
    write_table(options.output / "tJunctionEdges.csv", table)
    print("\n| " + " | ".join(table) + " |")
    print("|---" * len(table) + "|")
    for row in zip(*table.values(), strict=True):
        print(f"| {row[0]:g} | " + " | ".join(f"{1e6 * v:.4f}" for v in row[1:-2]), end="")
        print(f" | {row[-2]:.4f} | {row[-1]:.4f} |")
    plot(columns, table, options.output / "tJunction.png")


def plot(columns: dict[str, Floats], table: dict[str, Floats], file: Path) -> None:
    """Plot share to the side branch and deformation against the start, and the edges against Ca."""
    figure, (share, D, edge) = pyplot().subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for k, Ca in enumerate(CAPILLARY):
        rows = columns["Ca"] == Ca
        y, style = 1e6 * columns["y"][rows], {"color": f"C{k}", "label": f"Ca = {Ca:g}"}
        share.plot(y, columns["side"][rows], marker="osv^"[k], ms=9 - 2 * k, mfc="none", ls="", **style)
        D.semilogy(y, columns["D"][rows], **style)
    share.set(xlabel="start y, µm", ylabel="share to the side branch")
    D.set(xlabel="start y, µm (z = 0)", ylabel="largest D in the junction")
    D.set_ylim(top=5.0)
    D.legend(frameon=False, fontsize="small", ncols=2, loc="upper center")
    for name, label, colour in (
        ("point", "centre on the wall", "0.5"),
        ("body", "ellipsoid on the wall", "tab:red"),
    ):
        below, above = (1e6 * table[f"{name}, {way}"] for way in ("straight below", "side above"))
        edge.fill_between(CAPILLARY, below, above, color=colour, alpha=0.4, lw=0)
        edge.plot(CAPILLARY, below, color=colour, label=label)
        edge.plot(CAPILLARY, above, color=colour)
    edge.set(xscale="log", xlabel="Ca", ylabel="edges of the branches, y at z = 0, µm")
    edge.set_ylim(bottom=-2.5)
    edge.legend(frameon=False, fontsize="small", loc="lower left")
    figure.savefig(file, dpi=130)


if __name__ == "__main__":
    main()
