"""Deposits on walls: their density, and how far along the flow they come."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from view_run import motion, write_run

from foamprb.view.colours import LIGHT, OF_DEPOSITS, colour_map
from foamprb.view.deposits import FEW, ways, with_density
from foamprb.view.geometry import Geometry, Surface
from foamprb.view.page import Page
from foamprb.view.picture import picture
from foamprb.view.report import plots
from foamprb.view.results import open_run
from foamprb.view.show import Request, make_scene


def tube(n: int = 48, length: float = 4.0, radius: float = 0.5) -> Surface:
    """A tube along x, of n times ten rectangles."""
    angle, x = np.linspace(0.0, 2.0 * np.pi, n + 1), np.linspace(0.0, length, 11)
    grid = np.array([[(a, radius * np.cos(t), radius * np.sin(t)) for t in angle] for a in x])
    corner = np.arange(11 * (n + 1)).reshape(11, n + 1)
    a, b, c, d = (
        part.ravel() for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:])
    )
    return Surface(
        "tube", "wall", grid.reshape(-1, 3), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    )


def floor(*rectangles: tuple[float, float, float, float]) -> Surface:
    """A floor of rectangles (x0, x1, y0, y1), two triangles each."""
    points = [
        [x, y, 0.0] for x0, x1, y0, y1 in rectangles for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
    ]
    corners = np.arange(len(points)).reshape(-1, 4)
    halves = corners[:, [0, 2, 1]], corners[:, [0, 3, 2]]
    return Surface("floor", "wall", np.array(points), np.concatenate(halves))


def on_tube(n: int, offset: float = 0.0) -> np.ndarray:
    random = np.random.default_rng(0)
    t, x = random.uniform(0.0, 2.0 * np.pi, n), random.uniform(0.0, 4.0, n)
    return np.stack([x, (0.5 - offset) * np.cos(t), (0.5 - offset) * np.sin(t)], axis=1)


def number_of(wall: Surface) -> float:
    """The integral of the density over the wall."""
    return float(wall.density[wall.triangles].mean(axis=1) @ np.linalg.norm(wall.areas, axis=1))


@pytest.mark.parametrize("n", [100, 20_000])
def test_the_density_of_an_even_deposit_is_the_mean(n):
    """The centres of the particles are off the wall."""
    wall = with_density(tube(), on_tube(n, offset=0.05))
    assert np.linalg.norm(wall.areas, axis=1).sum() == pytest.approx(4.0 * np.pi, rel=2e-3)
    assert number_of(wall) == pytest.approx(n, rel=0.03)
    assert np.median(wall.density) == pytest.approx(n / (4.0 * np.pi), rel=0.2)


def test_a_density_is_where_the_particles_are_and_needs_some():
    """A wall of two triangles is divided."""
    coarse, x = floor((0.0, 2.0, 0.0, 1.0)), np.tile([1.9, 0.9, 0.0], (FEW, 1))
    assert with_density(coarse, x[1:]) is coarse
    wall = with_density(coarse, x)
    dense = np.linalg.norm(wall.points - [1.9, 0.9, 0.0], axis=1)[wall.density > 0.0]
    # The radius of a circle that holds four particles on average.
    assert dense.max() < np.sqrt(4.0 * 2.0 / (np.pi * FEW)) + 0.02
    assert len(dense) > 10


def test_a_way_follows_the_walls():
    """Along a tube it is x, and in an angle it goes around the inner corner."""
    x = on_tube(500)
    start = tube().points[:49]
    lengths, longest = ways(Geometry((tube(),), np.zeros((0, 2, 3)), None), start, x)
    assert longest == pytest.approx(4.0, rel=0.03)
    np.testing.assert_allclose(lengths, x[:, 0], atol=0.1, rtol=0.03)
    angle = floor((0.0, 4.0, 0.0, 1.0), (3.0, 4.0, 1.0, 5.0))
    geometry = Geometry((angle,), np.zeros((0, 2, 3)), None)
    end = np.array([[3.0, 5.0, 0.0]])
    lengths, _ = ways(geometry, np.array([[0.0, 1.0, 0.0]]), end)
    assert lengths[0] == pytest.approx(3.0 + 4.0, rel=0.03)


def test_particles_per_length_sum_to_their_number(monkeypatch):
    drawn = []

    class Axes:
        def stairs(self, values, edges, **_options):
            drawn.append(values @ np.diff(edges))

        def __getattr__(self, _name):
            return lambda *_arguments, **_options: None

    monkeypatch.setattr(plots, "_plot", lambda draw: draw(None, Axes()))
    plots.per_length({"floor": np.linspace(0.0, 1.0, 40), "lid": np.full(3, 0.5)}, 2.0)
    np.testing.assert_allclose(drawn, [40.0, 3.0])


def test_walls_have_the_colours_of_their_density(tmp_path):
    case = tmp_path / "cube"
    write_run(case, motion(3, 2), fates=True)
    scene = make_scene(Request(case), open_run(case), [1], drawn=True)
    assert Page(scene, "1")._header["deposits"] is None
    walls = tuple(s._replace(density=np.full(len(s.points), 50.0)) for s in scene.geometry.surfaces)
    painted = replace(scene, geometry=scene.geometry._replace(surfaces=walls), painted=True)
    assert painted.scale_of_deposits == {"unit": "1/m²", "least": 50.0, "most": 50.0, "high": 50.0}
    header = Page(painted, "1")._header
    assert header["deposits"]["high"] == 50.0
    assert all(surface["density"]["shape"] for surface in header["surfaces"])
    wanted, shares = colour_map(OF_DEPOSITS)[255].astype(float), []
    for k, one in enumerate((scene, painted)):
        picture(one, tmp_path / f"{k}.png", (300, 200), LIGHT, texts=False)
        pixels = np.array(Image.open(tmp_path / f"{k}.png")).reshape(-1, 3).astype(float)
        hue = pixels / pixels.max(axis=1, keepdims=True)
        # That of the largest density, in any light.
        shares.append((np.abs(hue - wanted / wanted.max()).max(axis=1) < 0.06).mean())
    assert shares[0] < 0.02
    assert shares[1] > 0.1
