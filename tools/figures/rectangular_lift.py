"""Tables of ``rectangularDuctLift``: lift on small neutral spheres in ducts of aspect ratios 1, 2 and 4.

Computes the coefficients at some places by :mod:`validation.references.rectangle`, adds their values at the
walls, −55π/96 times the square of the local shear rate across a wall and 0 along it, and fits the series of
:func:`foamprb.body.lift.rectangle_coefficient`. Writes ``foamprb/body/rectangle.txt`` and prints the
errors of the fit and where neutral spheres gather. Takes seven minutes.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from validation.case import Floats  # noqa: E402
from validation.references.rectangle import coefficients, profile, wall_rate  # noqa: E402

from foamprb.body.lift import LONG, SHORT, rectangle_coefficient  # noqa: E402

T = np.array([0.0, 0.15, 0.3, 0.45, 0.6, 0.7, 0.8, 0.9])
PLACES = {
    1: (T, (56, 56)),
    2: (np.array([0.0, 0.2, 0.4, 0.55, 0.7, 0.8, 0.875, 0.95]), (88, 48)),
    4: (np.array([0.0, 0.3, 0.5, 0.65, 0.75, 0.825, 0.875, 0.925, 0.96, 0.975]), (128, 40)),
}
"""Places along the longer sides over half of them, and orders of the polynomials, by aspect ratio."""
WALL = np.linspace(0.0, 1.0, 21)
_HEAD = """\
# c_mn of foamprb.body.lift.rectangle_coefficient, by tools/figures/rectangular_lift.py: aspect ratio,
# row by row the series along the longer sides, and the one along the shorter sides.
"""


def places(A: int) -> Floats:
    """Return y and z over half of the shorter side, (n, 2); of a square, those with y ≤ z."""
    s = PLACES[A][0]
    return np.array([(A * a, b) for a in s for b in T if A > 1 or a <= b])


def dense(A: int, points: Floats, C: Floats) -> tuple[Floats, Floats]:
    """Return points and C with more places along the longer sides, by splines: else the series oscillates."""
    s, more = PLACES[A][0], np.linspace(0.0, PLACES[A][0][-1], 27)
    values = C.reshape(len(s), len(T), 2)
    mirrored = np.concatenate([values[:0:-1] * np.array([-1.0, 1.0]), values])
    spline = CubicSpline(np.concatenate([-s[:0:-1], s]), mirrored)
    grid = np.array([(A * a, b) for a in more for b in T])
    return np.vstack([points, grid]), np.vstack([C, spline(more).reshape(-1, 2)])


def fit(A: int, points: Floats, C: Floats) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the coefficients of both series, from C (n, 2) at ``points`` (n, 2)."""
    if A == 1:
        points, C = np.vstack([points, points[:, ::-1]]), np.vstack([C, C[:, ::-1]])
    if A == 4:
        points, C = dense(A, points, C)
    y, z = points[:, 0] / A, points[:, 1]
    n, one = len(WALL), np.ones(1)
    slopes = profile(A * one, WALL, A)[1][0], profile(A * WALL, one, A)[2][:, 0]
    tables = []
    for component, (s, t, across) in enumerate(((y, z, SHORT), (z, y, LONG))):
        wall = -55.0 * np.pi / 96.0 * (slopes[component] / wall_rate(A)) ** 2
        at = np.concatenate([s, np.ones(n), WALL]), np.concatenate([t, WALL, np.ones(n)])
        values = np.concatenate([C[:, component], wall, np.zeros(n)])
        weights = np.repeat([1.0, 0.3, 0.1], [len(s), n, n])
        # Not more terms along the longer sides than places.
        used = np.arange(LONG * SHORT).reshape(-1, across)
        used = (used[: len(PLACES[A][0])] if across == SHORT else used[:, : len(PLACES[A][0])]).ravel()
        basis = np.array([rectangle_coefficient(*at, row, across) for row in np.eye(LONG * SHORT)[used]]).T
        ridge = 1e-4 * np.eye(len(used))
        answer, *_ = np.linalg.lstsq(
            np.vstack([weights[:, None] * basis, ridge]), np.append(weights * values, np.zeros(len(ridge)))
        )
        miss = np.abs(basis @ answer - values)
        print(f"  fit: {miss[: len(s)].max():.4f} at the places, {miss[len(s) :].max():.4f} at the walls")
        table = np.zeros(LONG * SHORT)
        table[used] = answer
        tables.append(tuple(float(c) for c in table.round(5)))
    return tables[0], tables[1]


def main() -> None:
    """Compute and write the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("-help", action="help", help="show this text and stop")
    parser.parse_args()
    text = _HEAD
    for A, (_, orders) in PLACES.items():
        print(f"aspect ratio {A}")
        points = places(A)
        tables = fit(A, points, coefficients(points, float(A), orders))

        def C(place: Floats, tables: tuple[tuple[float, ...], ...] = tables) -> list[float]:
            along, across = tables
            return [
                rectangle_coefficient(place[0], place[1], along, SHORT),
                rectangle_coefficient(place[1], place[0], across, LONG),
            ]

        for start in ((0.0, 0.65), (0.85, 0.0), (0.6, 0.6), (0.85, 0.6)):
            print("  no force at", fsolve(C, start).round(4), "from", start)
        text += "".join(" ".join(f"{c:g}" for c in (A, *table)) + "\n" for table in tables)
    (ROOT / "foamprb/body/rectangle.txt").write_text(text)


if __name__ == "__main__":
    main()
