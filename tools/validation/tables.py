"""Second-order deformation of cells on the axis of a channel against dclab's table of finite elements.

``python tools/validation/tables.py`` prints the numbers of docs/models/quadratic.md.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import dclab
import numpy as np

from foamprb.body.quadratic import tube_deformation

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from validation.case import Floats

K, N, WIDTH, FLOW_RATE = 0.4057, 0.6039, 20e-6, 0.04e-9
"""Power law of the fluid, Pa sⁿ; width of the channel, m; m³/s."""
RADIUS = 0.547 * WIDTH
"""Of the tube that acts as the channel, m."""


def deformations(area: Floats, modulus: Floats) -> tuple[Floats, Floats]:
    """Return 1 − 2√(πA)/P of cells with outlines of an area, m², and Young's moduli, Pa, and their a/R."""
    gradient = 2.0 / RADIUS * K * ((3.0 * N + 1.0) / N * FLOW_RATE / (np.pi * RADIUS**3)) ** N
    a = np.sqrt(area / np.pi)
    for _ in range(60):
        eps = 7.0 / 32.0 * gradient * a / (modulus / 3.0)
        a = np.sqrt(area / (np.pi * np.maximum(1.0 - 0.75 * eps * eps, 0.3)))
    b = a / RADIUS
    return 25.0 / 32.0 * (eps * tube_deformation(np.minimum(b, 0.7))) ** 2, b


def main() -> None:
    """Print how far the deformations are from HE-3D-FEM-22, for a/R from 0.3 to 0.6."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    file = Path(dclab.__file__).parent / "features/emodulus/lut_HE-3D-FEM-22.txt"
    area, deformation, modulus = np.loadtxt(file).T
    ours, b = deformations(1e-12 * area, 1e3 * modulus)
    for low, high in ((0.005, 0.02), (0.02, 0.03), (0.03, 0.04), (0.04, 0.05), (0.05, 0.1)):
        rows = (b > 0.3) & (b < 0.6) & (deformation >= low) & (deformation < high)
        off = 100.0 * (ours[rows] / deformation[rows] - 1.0)
        median, *ends = np.percentile(off, (50.0, 5.0, 95.0))
        print(
            f"deformation {low} to {high}: {rows.sum()} rows, median {median:+.1f} %, 5 to 95 % "
            f"{ends[0]:+.1f} to {ends[1]:+.1f} %, within 15 %: {100.0 * np.mean(np.abs(off) <= 15.0):.0f} %"
        )


if __name__ == "__main__":
    main()
