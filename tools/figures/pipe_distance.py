"""Landing distance in the paper's pipe against softness: the paper's Fig. 14 (a), and with wall lift.

Tracks the particle of Sect. 5.4 from (0, −1.65 mm, 0) until its centre meets the wall, for capillary numbers
from 0.0001 to 1, with both drag laws, in the exact Poiseuille flow and in OpenFOAM cases of the same pipe.
The solid has Poisson's ratio 0.499, and inertia. The change of the distances at ten times the tolerance is
printed beside them. Writes ``distance.csv`` and, with matplotlib, ``distance.png``. With ``-lift`` it prints
only the second table of docs/pipe.md: for each Ca the landing distance in diameters, or the height of the
centre over the wall, in radii, after 2 s; exact flow, without inertia of the solid, steps of 0.2 ms.

    python tools/figures/pipe_distance.py cases/pipe --output docs
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from validation.pipe import CAPILLARY, PRINTED_DISTANCE
from validation.report import pyplot
from validation.runs import DIAMETER, MEAN_VELOCITY, PIPE_RADIUS, pipe_cloud

import foamprb
from foamprb.body.drag import DRAGS
from foamprb.results.tables import write_table

RIGID_ANALYTIC, DT, TOLERANCE = 8989.0, 2e-5, 1e-6
SURROUNDINGS: dict[str, tuple[foamprb.WallLift, ...]] = {
    "without": (),
    "lift, `mobility no`": (foamprb.WallLift(mobility=False),),
    "with `mobility yes`": (foamprb.WallLift(mobility=True),),
}


def distances(flow, drag: str, tolerance: float) -> np.ndarray:
    """Return the landing distance over the particle's diameter, for each of CAPILLARY."""
    models = foamprb.Models(
        drag=drag, touching="centre", integrator="rosenbrock", tolerance=tolerance, roughness_share=0.0
    )
    cloud = pipe_cloud(CAPILLARY, DT, models, flow)
    cloud.advance(round(1.0 / DT))
    particles = cloud.particles
    if not (particles.status == foamprb.Status.STUCK).all():
        raise SystemExit(f"Not every particle landed: {particles.counts()}")
    return particles.x[:, 0] / DIAMETER


def print_lift(end: float = 2.0, dt: float = 2e-4) -> None:
    """Print the table with wall lift."""
    Ca = CAPILLARY[[0, 5, 10, 15, 20]]
    print("| Ca | " + " | ".join(f"{c:g}" for c in Ca) + " |")
    print("|---" * (len(Ca) + 1) + "|")
    for name, around in SURROUNDINGS.items():
        cloud = pipe_cloud(Ca, dt, foamprb.Models(integrator="stokes", surroundings=around))
        cloud.advance(round(end / dt))
        p = cloud.particles
        height = 2.0 * (PIPE_RADIUS - np.hypot(p.x[:, 1], p.x[:, 2])) / DIAMETER
        words = [
            f"{x:.0f}" if status == foamprb.Status.STUCK else f"{h:.2f} radii"
            for x, h, status in zip(p.x[:, 0] / DIAMETER, height, p.status, strict=True)
        ]
        print(f"| {name} | " + " | ".join(words) + " |")


def main() -> None:
    """Compute, write and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-lift", action="store_true", help="print the table with wall lift and stop")
    parser.add_argument("cases", type=Path, nargs="*", default=[Path("cases/pipe")], metavar="CASE")
    parser.add_argument("--output", type=Path, default=Path("docs"))
    options = parser.parse_args()
    if options.lift:
        print_lift()
        return
    flows = {"analytic": foamprb.analytic.pipe(PIPE_RADIUS, MEAN_VELOCITY)}
    for case in options.cases:
        flow = foamprb.read_case(case)
        flows[f"OpenFOAM, {flow.mesh.n_cells} cells"] = flow
    columns = {"Ca": CAPILLARY}
    for name, flow in flows.items():
        for drag in DRAGS:
            landings = columns[f"{drag}, {name}"] = distances(flow, drag, TOLERANCE)
            if name == "analytic":
                change = np.abs(landings - distances(flow, drag, 10 * TOLERANCE)).max()
                print(f"{drag}: {change:.2g} diameters from those of ten times the tolerance")
    options.output.mkdir(parents=True, exist_ok=True)
    write_table(options.output / "distance.csv", columns)
    for name, values in columns.items():
        print(f"{name:40s}", " ".join(f"{v:10.6f}" if name == "Ca" else f"{v:10.2f}" for v in values[::5]))
    plot(columns, options.output / "distance.png")


def plot(columns: dict[str, np.ndarray], file: Path) -> None:
    """Plot distance against Ca, one curve for each drag law and flow."""
    figure, axes = pyplot().subplots(figsize=(7, 4.5), layout="constrained")
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
    axes.axhline(PRINTED_DISTANCE, color="0.4", lw=0.8, ls=":", label="rigid sphere, the paper's print")
    axes.set(xlabel="Ca at the wall shear rate", ylabel="landing distance / particle diameter")
    axes.legend(frameon=False)
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    main()
