"""Picture of the pseudo-rigid body for docs/models/index.md: F = V R, the traction, and what affine means."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
TURN = np.deg2rad(35.0)
BODY, LINE, FLOW, FORCE = "#bcd7ea", "#0b4f7d", "#7a7a7a", "#c0392b"
EDGE = np.stack([np.cos(s := np.linspace(0.0, 2.0 * np.pi, 241)), np.sin(s)])


def draw(axes: Any, place: tuple[float, float], shape: NDArray[np.float64], title: str, note: str) -> None:
    """Draw a body with the lines on its material, and the point that the text follows."""
    at = np.array(place)[:, None]
    axes.fill(*(shape @ EDGE + at), facecolor=BODY, edgecolor=LINE, linewidth=1.5)
    for line in (np.array([[-1.0, 1.0], [0.0, 0.0]]), np.array([[0.0, 0.0], [-1.0, 1.0]])):
        axes.plot(*(shape @ line + at), color=LINE, linewidth=0.8)
    axes.plot(*(shape @ np.array([[0.7], [0.7]]) + at), "o", color=LINE, markersize=6)
    axes.text(place[0], 1.75, title, ha="center", fontsize=12)
    axes.text(place[0], -1.85, note, ha="center", va="top", fontsize=10)


def arrow(axes: Any, start: tuple[float, float], end: tuple[float, float], text: str) -> None:
    """Draw an arrow with a name above it."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1.4})
    axes.text(0.5 * (start[0] + end[0]), start[1] + 0.13, text, ha="center", fontsize=13)


def stretch(long: float, short: float, angle: float) -> NDArray[np.float64]:
    """Return the symmetric V with two stretches and the angle of the long axis."""
    turn = rotation(angle)
    return np.asarray(turn @ np.diag([long, short]) @ turn.T)


def rotation(angle: float) -> NDArray[np.float64]:
    """Return the rotation by an angle."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def traction(axes: Any, x0: float, V: NDArray[np.float64]) -> None:
    """Draw a body in shear, with the traction of a uniform stress on its surface."""
    draw(axes, (x0, 0.0), V, "traction", "t̃ = σ̃·n on the surface,\nwith a uniform stress σ̃")
    stress = 0.55 * np.array([[0.0, 1.0], [1.0, 0.0]])
    points = V @ EDGE[:, :-1:12]
    normals = np.linalg.inv(V).T @ EDGE[:, :-1:12]
    normals /= np.linalg.norm(normals, axis=0)
    pulls = stress @ normals
    # Arrows of a push end on the surface.
    tails = points - np.where((pulls * normals).sum(axis=0) < 0.0, pulls, 0.0)
    axes.quiver(
        tails[0] + x0, tails[1], *pulls, color=FORCE, angles="xy", scale_units="xy", scale=1, width=0.002
    )
    for y in (-1.25, -0.75, 0.75, 1.25):
        start = x0 + np.sign(y) * 1.75
        axes.annotate("", (start + 0.7 * y, y), (start, y),
                      arrowprops={"arrowstyle": "->", "color": FLOW, "lw": 1.0})  # fmt: skip


def not_affine(axes: Any, x0: float) -> None:
    """Draw two shapes that no F makes of a sphere."""
    axes.text(x0, 1.75, "not affine", ha="center", fontsize=12)
    angle = np.linspace(0.0, 2.0 * np.pi, 241)
    bent = np.stack([1.1 * EDGE[0], 0.32 * EDGE[1] + 0.45 * EDGE[0] ** 2 + 0.5])
    wavy = (0.62 + 0.06 * np.sin(9 * angle)) * EDGE - np.array([[0.0], [0.85]])
    for outline in (bent, wavy):
        axes.fill(
            outline[0] + x0, outline[1], facecolor="#e8e8e8", edgecolor=FLOW, linewidth=1.2, linestyle="--"
        )
    axes.text(x0, -1.85, "bending and wrinkling\nare left out", ha="center", va="top", fontsize=10)


def main() -> None:
    """Write the picture."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("--output", type=Path, default=ROOT / "docs/models/body.png", metavar="FILE")
    options = parser.parse_args()
    R, V = rotation(-TURN), stretch(1.5, 0.667, TURN)
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 5.6))
    draw(above, (0.0, 0.0), np.eye(2), "at rest", "a sphere;\na point of it: Ξ")
    arrow(above, (1.25, 0.0), (2.35, 0.0), "R")
    draw(above, (3.6, 0.0), R, "turned", "R turns the material,\nnot the outline")
    arrow(above, (4.85, 0.0), (5.85, 0.0), "V")
    draw(above, (7.5, 0.0), V @ R, "deformed", "V stretches along three axes:\n$x = x_c + F·Ξ$,  $F = V·R$")
    traction(below, 1.2, V @ R)
    not_affine(below, 6.6)
    for axes in (above, below):
        axes.set(xlim=(-1.6, 9.6), ylim=(-2.75, 2.05), aspect="equal")
        axes.axis("off")
    figure.subplots_adjust(0, 0, 1, 1)
    figure.savefig(options.output, dpi=140)


if __name__ == "__main__":
    main()
