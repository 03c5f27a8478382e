"""Default colours as the colour-blind see them, simulated after Machado, Oliveira and Fernandes (2009)."""

from __future__ import annotations

import re
from itertools import combinations

import numpy as np
import pytest
from matplotlib import colormaps
from matplotlib.font_manager import FontProperties
from paths import ROOT

from foamprb.view.colours import DARK, LIGHT, MAPS, colour_map, font_file, rgb
from foamprb.view.report import plots
from foamprb.view.report.plots import FATES

BLINDNESS = {
    "none": np.eye(3),
    "protan": [
        [0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]
    ],
    "deutan": [
        [0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]
    ],
    "tritan": [
        [1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]
    ],
}  # fmt: skip
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def lab(colours, kind):
    """CIELAB of colours (n, 3) of 0 to 255, as they are seen."""
    c = np.asarray(colours) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ np.transpose(BLINDNESS[kind]), 0.0, 1.0)
    t = seen @ TO_XYZ.T / TO_XYZ.sum(axis=1)
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16.0 / 116.0)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


@pytest.mark.parametrize("name", MAPS)
def test_maps_are_those_of_matplotlib(name):
    np.testing.assert_array_equal(colour_map(name), colormaps[name](np.arange(256), bytes=True)[:, :3])


def least_distance(colours, kind):
    """Smallest CIELAB distance of two of some colours."""
    return min(np.linalg.norm(a - b) for a, b in combinations(lab(colours, kind), 2))


@pytest.mark.parametrize("kind", BLINDNESS)
@pytest.mark.parametrize("name", MAPS)
def test_values_of_a_map_can_be_ordered(name, kind):
    """Lightness rises along a map; in the diverging one it falls to both ends, which differ."""
    colours = lab(np.asarray(colour_map(name))[:, :3], kind)
    L = colours[:, 0]
    if name == "coolwarm":
        assert L[[0, -1]].max() < L[128] - 25.0
        assert np.linalg.norm(colours[0] - colours[-1]) > 30.0
    else:
        assert np.diff(L[::8]).min() > 0.0
        assert L[-1] - L[0] > 50.0


@pytest.mark.parametrize("kind", BLINDNESS)
@pytest.mark.parametrize(
    "table", [*map(colour_map, MAPS), LIGHT.plane, DARK.plane], ids=[*MAPS, "light", "dark"]
)
def test_tenths_of_a_map_differ(table, kind):
    """Any two of eleven colours, by twice what can just be seen; a map from red to green has 1.3."""
    tenths = np.asarray(table)[np.linspace(0, 255, 11).round().astype(int), :3]
    assert least_distance(tenths, kind) > 2 * 2.3


@pytest.mark.parametrize("kind", BLINDNESS)
def test_colours_of_fates_differ(kind):
    """By seven times what can just be seen, a CIELAB distance of 2.3; hatches and markers differ, too."""
    assert least_distance([rgb(colour) for colour in FATES.values()], kind) > 7 * 2.3


def test_pages_pictures_and_plots_have_one_typeface():
    pages = (ROOT / "foamprb/view/page/page.css", ROOT / "foamprb/view/report/page.html")
    first = {re.search(r'--font: "([^"]+)"', page.read_text(encoding="utf-8"))[1] for page in pages}
    name = FontProperties(fname=font_file()).get_name()
    assert {*first, plots._STYLE["font.family"], name} == {name}
