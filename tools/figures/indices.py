"""Errors and intervals of the indices of Sobol designs, for Ishigami's function of three entries.

Usage: python tools/figures/indices.py; prints the table of docs/studies.md, from 100 designs of each size.
Its rows are, over the six indices: the largest of the errors that 95 % of the designs stay below; the share
of intervals that hold the exact index; the mean width of the intervals over that of 95 % of the estimates.
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from foamprb.view.sensitivity import sobol_indices

Floats = NDArray[np.float64]

SIZES = (16, 64, 256, 1024)
DESIGNS = 100


def ishigami(x: Floats) -> Floats:
    """Return sin x + 7 sin² y + 0.1 z⁴ sin x, for entries in (…, 3)."""
    return np.asarray(np.sin(x[..., 0]) * (1.0 + 0.1 * x[..., 2] ** 4) + 7.0 * np.sin(x[..., 1]) ** 2)


def exact() -> Floats:
    """Return the indices of first order and the total ones, (2, 3)."""
    alone, both = 0.5 * (1.0 + np.pi**4 / 50.0) ** 2, 0.01 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    y = 49.0 / 8.0
    return np.array([(alone, y, 0.0), (alone + both, y, both)]) / (alone + y + both)


def estimates(n: int, seed: int) -> Floats:
    """Return the indices of a design of n rows, and the ends of their intervals, (3, 2, 3)."""
    a, b = np.split(np.pi * (2.0 * qmc.Sobol(6, rng=np.random.default_rng(seed)).random(n) - 1.0), 2, axis=1)
    mixed = np.where(np.eye(3, dtype=bool), b[:, None], a[:, None])
    indices = sobol_indices(ishigami(np.concatenate([a[:, None], mixed, b[:, None]], axis=1)))
    return np.array([[indices[f"{kind}{end}"] for kind in ("first", "total")] for end in ("", "Low", "High")])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    columns = []
    for n in SIZES:
        indices, low, high = np.array([estimates(n, seed) for seed in range(DESIGNS)]).transpose(1, 0, 2, 3)
        error = np.quantile(np.abs(indices - exact()), 0.95, axis=0).max()
        covered = np.mean((low <= exact()) & (exact() <= high))
        widths = (
            np.mean(high - low, axis=0) / np.diff(np.quantile(indices, (0.025, 0.975), axis=0), axis=0)[0]
        )
        columns.append(
            (f"{n}", f"{error:.2g}", f"{100.0 * covered:.0f} %", f"{widths.min():.1f} to {widths.max():.1f}")
        )
    titles = (
        "`number`",
        "error of an index, in 95 % of the designs",
        "intervals with the exact index",
        "width of an interval, over the one that 95 % of the estimates need",
    )
    for k, row in enumerate(zip(titles, *columns, strict=True)):
        print(f"| {' | '.join(row)} |")
        if k == 0:
            print("|---" * len(row) + "|")


if __name__ == "__main__":
    main()
