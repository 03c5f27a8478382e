"""Table of the flow on the axis of the device, input of `tools/validate -case extensionDevice`.

Samples the flows of ``Allrun``, one folder per mesh, on the path of the beads.

    ./Allrun coarse; ./Allrun medium; ./Allrun fine
    python axis.py coarse medium fine > ../../tools/validation/extension_axis.csv
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import foamprb

START, END, SPACING = 1000, 1676, 2
"""x, µm: from the release of the beads to just before the outlet."""


def table(cases: list[Path]) -> str:
    """Return x, m, and on each mesh u, m/s, and ∂u/∂x, 1/s, as comma-separated values."""
    x = 1e-6 * np.arange(START, END + 1, SPACING)
    places = np.zeros((len(x), 3))
    places[:, 0] = x
    heads, columns = ["x"], [x]
    for case in cases:
        flow = foamprb.read_case(case)
        u, gradient = flow.sample(places, flow.locate(places), 0.0)
        heads += [f"u {case.name}", f"rate {case.name}"]
        columns += [u[:, 0], gradient[:, 0, 0]]
    rows = [",".join(f"{value:.6g}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([",".join(heads), *rows])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=Path, nargs="+", metavar="CASE", help="from coarse to fine")
    print(table(parser.parse_args().cases))


if __name__ == "__main__":
    main()
