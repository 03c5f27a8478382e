"""Landing distance in the paper's pipe against softness: the paper's Fig. 14 (a).

Tracks the particle of Sect. 5.4 from (0, −1.65 mm, 0) until its centre meets the wall, for capillary numbers
from 0.0001 to 1, with both drag laws, in the exact Poiseuille flow and in OpenFOAM cases of the same pipe.
The solid has Poisson's ratio 0.499, and inertia. The change of the distances at ten times the tolerance is
printed beside them. Writes ``distance.csv`` and, with matplotlib, ``distance.png``.

    python tools/figures/pipe_distance.py cases/pipe --output docs
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import foamprb
from foamprb.body.drag import DRAGS
from foamprb.results.tables import write_table

NU, RHO = 1.491e-5, 1.208
WALL_SHEAR_RATE, RADIUS, DIAMETER = 923.8, 2.1e-3, 5e-6
CAPILLARY = np.array([1e-4, *np.arange(0.05, 1.001, 0.05)])
RIGID_ANALYTIC, RIGID_PRINTED = 8989.0, 9165.0


INTEGRATOR, POISSONS_RATIO = "rosenbrock", 0.499


def distances(flow, drag: str, dt: float, tolerance: float) -> np.ndarray:
    """Return the landing distance over the particle's diameter, for each of CAPILLARY."""
    medium = foamprb.Medium(RHO * NU, RHO, (0.0, -9.81, 0.0))
    start = np.tile([0.0, -1.65e-3, 0.0], (len(CAPILLARY), 1))
    mu = medium.mu * WALL_SHEAR_RATE / CAPILLARY
    particles = foamprb.spheres(start, d=DIAMETER, rho=2560.0, mu=mu, poissons_ratio=POISSONS_RATIO)
    interactions = [foamprb.Stick() if p.type == "wall" else foamprb.Escape() for p in flow.patches]
    models = foamprb.Models(drag=drag, touching="centre", integrator=INTEGRATOR, tolerance=tolerance)
    cloud = foamprb.Cloud(particles, flow, medium, interactions, dt, models)
    cloud.advance(round(1.0 / dt))
    if not (particles.status == foamprb.Status.STUCK).all():
        raise SystemExit(f"Not every particle landed: {cloud.particles.counts()}")
    return particles.x[:, 0] / DIAMETER


def main() -> None:
    """Compute, write and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("cases", type=Path, nargs="*", default=[Path("cases/pipe")], metavar="CASE")
    parser.add_argument("--output", type=Path, default=Path("docs"))
    parser.add_argument("--dt", type=float, default=2e-5, help="tracking step, s [2e-5]")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="of a step [1e-6]")
    options = parser.parse_args()
    flows = {
        "analytic": foamprb.analytic.pipe(RADIUS, WALL_SHEAR_RATE * RADIUS / 4),
    }
    for case in options.cases:
        flow = foamprb.read_case(case)
        flows[f"OpenFOAM, {flow.mesh.n_cells} cells"] = flow
    columns = {"Ca": CAPILLARY}
    for name, flow in flows.items():
        for drag in DRAGS:
            found = columns[f"{drag}, {name}"] = distances(flow, drag, options.dt, options.tolerance)
            if name == "analytic":
                change = np.abs(found - distances(flow, drag, options.dt, 10 * options.tolerance)).max()
                print(f"{drag}: {change:.2g} diameters from those of ten times the tolerance")
    options.output.mkdir(parents=True, exist_ok=True)
    write_table(options.output / "distance.csv", columns)
    for name, values in columns.items():
        print(f"{name:40s}", " ".join(f"{v:10.6f}" if name == "Ca" else f"{v:10.2f}" for v in values[::5]))
    plot(columns, options.output / "distance.png")


def plot(columns: dict[str, np.ndarray], file: Path) -> None:
    """Plot distance against Ca, one curve for each drag law and flow."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    colours = dict(zip(DRAGS, ("tab:blue", "tab:orange"), strict=True))
    markers = {drag: iter("osv^") for drag in DRAGS}
    for name, values in columns.items():
        if name == "Ca":
            continue
        drag, flow = name.split(", ", 1)
        style = (
            {"ls": "-"}
            if flow == "analytic"
            else {"ls": "", "marker": next(markers[drag]), "ms": 4, "mfc": "none"}
        )
        axes.plot(CAPILLARY, values, color=colours[drag], label=name, **style)
    axes.axhline(RIGID_ANALYTIC, color="0.4", lw=0.8, label="rigid sphere, closed form")
    axes.axhline(RIGID_PRINTED, color="0.4", lw=0.8, ls=":", label="rigid sphere, the paper's print")
    axes.set(xlabel="Ca at the wall shear rate", ylabel="landing distance / particle diameter")
    axes.legend(frameon=False)
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    main()
