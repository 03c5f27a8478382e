"""How well a T-junction sorts stiff from soft beads, by drift in curved flow and by lift from walls.

Sends the same starts, random by flux, as stiff and as soft beads through the flow of a T-junction, with each
set of models. Prints shares of the side branch with 95 % intervals (Wilson's), the difference by softness
with that of pairs, and how many fates half the tolerance changes. The second flow has a long inlet and a
quarter of the flow in the side branch:

    cases/tJunction/Allrun coarse
    python tools/figures/t_junction_sorting.py cases/tJunction/coarse
    python tools/figures/t_junction_sorting.py -make FOLDER
    python tools/figures/t_junction_sorting.py FOLDER/coarse -upstream 2000e-6
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from t_junction import DIAMETER, DT, END, HALF_WIDTH, REFERENCE_RATE, RELEASE

import foamprb
from foamprb.body.quadratic import bullet_amplitude
from foamprb.results.intervals import share as share_of

Floats = NDArray[np.float64]

CAPILLARY = (0.001, 0.03, 0.1)
EARLY = 0.01
"""Time after which D and ε are taken, before the junction, s."""
BEADS = 1000
Z = 1.959964
"""Standard deviations of a 95 % interval."""
DEFAULT = foamprb.Models()
CASE = Path(__file__).resolve().parents[2] / "cases" / "tJunction"
LONG = {
    "system/blockMeshDict": (
        ("me      #eval{ -$e };", "me      -2150;"),
        ("hex (0 1 5 4 10 11 15 14) ($nLong", "hex (0 1 5 4 10 11 15 14) (150"),
    ),
    "0/U": (("share           0.5;", "share           0.25;"),),
}
"""Changes of the case for a long inlet, and a quarter of the flow to the side."""


def models(name: str, part: float) -> foamprb.Models:
    """Return the models of a set, with a part of the default tolerance."""
    tolerance, share = part * DEFAULT.tolerance, part * DEFAULT.roughness_share
    lift = (foamprb.WallLift(),) if "lift" in name else ()
    if "quadratic" in name:
        return foamprb.Models(
            touching="centre",
            integrator="stokes",
            surroundings=(foamprb.FaxenCorrection(), *lift),
            shape="quadratic",
            tolerance=tolerance,
            roughness_share=share,
        )
    return foamprb.Models(
        touching="centre", integrator="stokes", surroundings=lift, tolerance=tolerance, roughness_share=share
    )


SETS = ("affine", "quadratic", "affine and lift", "quadratic and lift")


def random_by_flux(job: foamprb.Job, release: float) -> Floats:
    """Return random starts where beads have room, with a density proportional to the speed, (n, 3), m."""
    rng = np.random.default_rng(0)
    half = HALF_WIDTH - 0.6 * DIAMETER
    x = np.column_stack([np.full(16 * BEADS, release), rng.uniform(-half, half, (16 * BEADS, 2))])
    u = job.cloud.flow.sample(x, job.cloud.flow.locate(x), 0.0)[0][:, 0]
    return x[rng.uniform(0.0, u.max(), len(u)) < u][:BEADS]


class Sorted(NamedTuple):
    """Fates of n beads."""

    patch: NDArray[np.str_]
    """Patch where a bead leaves or sticks; ``""`` if it is in the flow after :data:`END`, or ``failed``."""
    D: float
    """Median Taylor deformation after :data:`EARLY`."""
    epsilon: float
    """Median amplitude of the quadratic mode then."""


def send(job: foamprb.Job, x: Floats, Ca: float, chosen: foamprb.Models) -> Sorted:
    """Track beads from their starts, (n, 3), m, to the end."""
    flow, medium = job.cloud.flow, job.cloud.medium
    p = foamprb.spheres(x, d=DIAMETER, rho=medium.rho, mu=medium.mu * REFERENCE_RATE / Ca)
    walls = [foamprb.Stick() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    cloud = foamprb.Cloud(p, flow, medium, walls, DT, chosen)
    cloud.advance(round(EARLY / DT))
    D, epsilon = np.median(p.D), np.median(bullet_amplitude(tuple(p.B.T)))
    while cloud.time < END and (p.status <= foamprb.Status.ACTIVE).any():
        cloud.advance(1000)
    names = np.array([*(patch.name for patch in flow.patches), ""])
    patch = np.where(p.status == foamprb.Status.FAILED, "failed", names[p.patch])
    return Sorted(patch, float(D), float(epsilon))


def paired(more: int, fewer: int, n: int) -> tuple[float, float]:
    """Return the difference of two shares of the same n starts, and half its interval."""
    return (more - fewer) / n, Z * np.sqrt(more + fewer - (more - fewer) ** 2 / n) / n


def make(folder: Path) -> None:
    """Compute the flow with a long inlet, and a quarter of the flow to the side."""
    shutil.copytree(CASE, folder)
    for file, changes in LONG.items():
        text = (folder / file).read_text()
        for before, after in changes:
            if before not in text:
                raise SystemExit(f"{file}: no '{before}'")
            text = text.replace(before, after)
        (folder / file).write_text(text)
    subprocess.run([folder / "Allrun", "coarse"], check=True)


def main() -> None:
    """Compute and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-make", type=Path, metavar="FOLDER", help="compute the second flow, and stop")
    parser.add_argument(
        "-upstream",
        type=float,
        default=-RELEASE,
        metavar="X",
        help="distance of the starts from the side branch, m",
    )
    parser.add_argument("case", type=Path, nargs="?", help="a run of cases/tJunction")
    options = parser.parse_args()
    if options.make is not None:
        make(options.make)
        return
    job = foamprb.prepare(options.case)
    x = random_by_flux(job, -options.upstream)
    n = len(x)
    columns = (
        "models", "Ca", "to the side", "less the stiffest", "changed by half the tolerance",
        "wall, undecided, failed", "D", "ε",
    )  # fmt: skip
    print(f"| {' | '.join(columns)} |")
    print("|---" * len(columns) + "|")
    for name in SETS:
        stiffest = None
        for Ca in CAPILLARY:
            beads, finer = (send(job, x, Ca, models(name, part)) for part in (1.0, 0.5))
            side = beads.patch == "side"
            stiffest = side if stiffest is None else stiffest
            _, low, high = share_of(int(side.sum()), n)
            difference, error = paired(int((side & ~stiffest).sum()), int((~side & stiffest).sum()), n)
            changed = int((beads.patch != finer.patch).sum())
            others = ", ".join(str((beads.patch == word).sum()) for word in ("wall", "", "failed"))
            share = f"{side.mean():.3f} ({low:.3f} to {high:.3f})"
            numbers = f"{changed} | {others} | {beads.D:.3f} | {beads.epsilon:.3f}"
            print(f"| {name} | {Ca:g} | {share} | {difference:+.3f} ± {error:.3f} | {numbers} |", flush=True)


if __name__ == "__main__":
    main()
