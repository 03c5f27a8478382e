"""What a run looks like, however it is drawn: bodies, walls, camera, colours and words."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.constraints import Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.schema import read_entry
from foamprb.errors import InputError
from foamprb.results.vtk import Tracks
from foamprb.view.bodies import Bodies, Codes
from foamprb.view.colours import MAPS
from foamprb.view.geometry import Geometry, Slice, Surface

Floats = NDArray[np.float64]

BODY_SIZE = 1 / 16
"""Diameter at rest with which bodies are drawn if none is asked for, of the second longest side."""
WINDOW_LENGTH = 3.5
"""How much of a long geometry the camera looks at, of the second longest side."""
VIEW_ANGLE = 30.0
"""Vertical, degrees."""
MARGIN = 1.06
"""How much more is seen than must be."""
INSETS = (66.0, 88.0)
"""Pixels that words take above and below what is shown."""
TALL = 1.6
"""Something long is at least 1/1.6 of the picture high, its length cut, unless too little of that is left."""
PERCENTILES = (1.0, 99.0)
"""Of the values of an array that are ever shown: what lies beyond may be clamped."""
ALL = (0.0, 100.0)
"""The percentiles between which all values are."""
MOST_DEPOSITS = 3000
"""Of more deposits none is marked at first."""
_SLACK = 1e-5
"""How far beyond the limits, as a share of what is between them, a value is not noticed."""
_THIN = 0.35
"""A geometry whose shortest side is a smaller share of the second one is looked at along the shortest."""
_TILTED = 1.3
"""How many times larger than that along the principal axes the box along the axes must be to give way."""


class Camera(NamedTuple):
    """From where one looks at first; vectors (3,)."""

    focus: Floats
    """m."""
    towards: Floats
    """Unit vector from the focus to the eye."""
    up: Floats
    """Unit vector, vertical in the picture."""
    corners: Floats
    """What must be seen: points to the right of, above and before the focus, (k, 3), m."""
    least_width: float
    """Of what is to the right or left as much as must be seen even in a narrow picture, m."""

    def distance(self, aspect: float, free: float = 1.0) -> float:
        """Distance of the eye from the focus, m.

        Parameters
        ----------
        aspect
            How many times wider than high the picture is.
        free
            Share of its height that words leave free.
        """
        slope = math.tan(math.radians(VIEW_ANGLE / 2))
        x, y, z = np.abs(self.corners[:, 0]), np.abs(self.corners[:, 1]), self.corners[:, 2]
        x = np.minimum(x, max(self.least_width, TALL * float(y.max()) * aspect))
        return float((z + MARGIN * np.maximum(x / (slope * aspect), y / (slope * free))).max())


@dataclass(frozen=True)
class Scene:
    """All that is shown.

    Parameters
    ----------
    title, subtitle
        The case, and what it is about.
    bodies
        All bodies over their times.
    fate
        What became of each, (1, n).
    geometry
        The boundary, if the mesh could be read.
    slice
        A plane through the flow, if it is asked for.
    paths
        Paths finer than the bodies' times, if the run recorded them.
    camera
        From where one looks at first.
    enlargement
        How many times larger than they are the bodies are drawn.
    colour
        Name and component of the array by which they are coloured.
    range
        Its lowest and highest colour, if the user chose them.
    first
        Index of the time that is shown first.
    percentiles
        Between which of all values the colours range, where the user chose no range.
    """

    title: str
    subtitle: str
    bodies: Bodies
    fate: Codes
    geometry: Geometry | None
    slice: Slice | None
    paths: Tracks | None
    camera: Camera
    enlargement: float
    colour: tuple[str, str]
    range: tuple[float, float] | None
    first: int
    percentiles: tuple[float, float] = PERCENTILES

    @cached_property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest value of the chosen array that have colours of their own."""
        name, part = self.colour
        if self.range is not None:
            return self.range
        return limits_of(self.bodies, name, part, self.percentiles)

    @cached_property
    def beyond(self) -> tuple[bool, bool]:
        """Whether values of the chosen array that are ever shown lie below the limits, and above them."""
        low, high = self.limits
        least, most = extremes_of(self.bodies, *self.colour) or (low, high)
        slack = _SLACK * (high - low)
        return least < low - slack, most > high + slack

    def codes(self, name: str) -> Codes:
        """A property that has names, by its own."""
        return self.fate if name == self.fate.name else self.bodies.codes[name]

    @property
    def map_name(self) -> str:
        """The colour map of the chosen array."""
        low, high = self.limits
        return MAPS[-1] if low == -high else MAPS[0]

    def caption(self, shown: int) -> str:
        """Say how many bodies there are and how they are drawn."""
        return caption(shown, self.enlargement)


def caption(shown: int, enlargement: float) -> str:
    """Say how many bodies there are and how they are drawn."""
    number = f"{shown} {'body' if shown == 1 else 'bodies'}"
    return f"{number}, drawn {enlargement:g}× larger" if enlargement != 1.0 else f"{number}, drawn to scale"


def limits_of(
    bodies: Bodies, name: str, part: str, percentiles: tuple[float, float] = ALL
) -> tuple[float, float]:
    """Round numbers around the values of an array that are ever shown; from zero where that is near.

    Parameters
    ----------
    bodies, name, part
        The bodies, the array, and its component.
    percentiles
        Which of the values count; of up to a hundred values, and where those that count are all alike, all.
    """
    values = _values(bodies, name, part)
    if not values.size:
        return 0.0, 1.0
    shares = np.array(percentiles) / 100.0
    low = float(np.quantile(values, shares[0], method="lower"))
    high = float(np.quantile(values, shares[1], method="higher"))
    if low == high:
        low, high = float(values.min()), float(values.max())
    return round_limits(low, high)


def extremes_of(bodies: Bodies, name: str, part: str) -> tuple[float, float] | None:
    """Least and largest of the values of an array that are ever shown; None if there is none."""
    values = _values(bodies, name, part)
    return (float(values.min()), float(values.max())) if values.size else None


def _values(bodies: Bodies, name: str, part: str) -> Floats:
    values = np.broadcast_to(bodies.fields[name].channel(part), bodies.present.shape)[bodies.shown]
    return np.asarray(values[np.isfinite(values)])


def round_limits(low: float, high: float) -> tuple[float, float]:
    """Round numbers, the first not above ``low``, the second not below ``high``.

    A range that lies on one side of zero and reaches near it begins there, and one on both sides of zero is
    symmetric.
    """
    if low < 0.0 < high:
        most = _round_up(max(-low, high))
        return -most, most
    if high <= 0.0 and low < 0.0:
        a, b = round_limits(-high, -low)
        return -b, -a
    if high == 0.0:
        return 0.0, 1.0
    if low <= 0.3 * high:
        return 0.0, _round_up(high)
    if high - low <= 1e-6 * high:
        return 0.0, _round_up(high)
    step = _round_up(high - low) / 10.0
    return math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step


def _round_up(value: float) -> float:
    """The least multiple of a power of ten, of one digit, that is not below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return float(f"{math.ceil(value / power * (1 - 1e-6)) * power:.12g}")


def round_down(value: float) -> float:
    """The largest of 1, 2, 3, 4, 5, 6, 8 times a power of ten that is not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    digit = max(digit for digit in (1, 2, 3, 4, 5, 6, 8) if digit * power <= value * (1 + 1e-12))
    return float(f"{digit * power:.12g}")


def automatic_enlargement(bodies: Bodies, sides: Floats) -> float:
    """A round number ≥ 1: bodies at rest are seen, and mostly not in each other.

    Parameters
    ----------
    bodies
        The bodies.
    sides
        Of the box that they are in, (3,), m.
    """
    sides = np.sort(sides)
    known = bodies.radius[bodies.radius > 0.0]
    if len(known) == 0 or not sides[1] > 0.0:
        return 1.0
    most = max(1, int(bodies.shown.sum(axis=1).max(initial=0)))
    spacing = (sides[2] * sides[1] * max(sides[0], sides[1] * BODY_SIZE) / most) ** (1 / 3)
    wanted = min(BODY_SIZE * sides[1], 0.5 * spacing) / float(2.0 * np.median(known))
    return round_down(wanted) if wanted > 1.0 else 1.0


def busiest(bodies: Bodies) -> int:
    """Index of the last of those times at which most bodies are in the flow or on a wall."""
    number = bodies.shown.sum(axis=1)
    return int(len(number) - 1 - np.argmax(number[::-1]))


def box(geometry: Geometry | None, bodies: Bodies) -> tuple[Floats, Floats]:
    """Lowest and highest corner of the geometry, or of where the bodies ever are, m."""
    points = geometry.points if geometry is not None else bodies.x[bodies.present]
    if len(points) == 0:
        return np.full(3, -0.5), np.full(3, 0.5)
    low, high = points.min(axis=0), points.max(axis=0)
    if geometry is None:
        room = max(4.0 * float(bodies.radius.max(initial=0.0)), 0.05 * float((high - low).max()))
        low, high = low - room, high + room
    return low, high


def camera_for(geometry: Geometry | None, bodies: Bodies, first: int, g: Floats) -> Camera:
    """Look at what there is.

    A long geometry lies across the picture and is seen from the side, a little from above and from one end;
    of one much longer than wide only the part where most bodies are. A thin one is seen along its shortest
    side, one with ``empty`` patches or wedges straight along their normal. Gravity points down.

    Parameters
    ----------
    geometry, bodies
        What there is.
    first
        Index of the time that is shown first.
    g
        Gravity, m/s²; zero where there is none.
    """
    low, high = box(geometry, bodies)
    points = geometry.points if geometry is not None else np.array([low, high])
    axes = principal_axes(points, low, high) if geometry is not None else np.eye(3)
    along = points @ axes
    low, high = along.min(axis=0), along.max(axis=0)
    sides, middle = high - low, axes @ (0.5 * (low + high))
    flat = geometry.flat if geometry is not None else None
    right, up, depth, (yaw, pitch) = _directions(axes, sides, flat, g)
    towards = math.cos(pitch) * (math.cos(yaw) * depth - math.sin(yaw) * right) + math.sin(pitch) * up
    across = np.cross(up, towards) / np.linalg.norm(np.cross(up, towards))
    frame = np.array([across, np.cross(towards, across), towards])
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    extent, second = float(np.abs(right @ axes) @ sides), float(np.sort(sides)[1])
    window = WINDOW_LENGTH * second
    if not 0.0 < window < extent:
        return Camera(middle, towards, up, 0.5 * signs * sides @ axes.T @ frame.T, math.inf)
    places = bodies.x[first][bodies.shown[first]] @ right
    ends = middle @ right + 0.5 * extent * np.array([-1.0, 1.0])
    focus = middle + right * (densest(places, window, ends) - middle @ right)
    # Of what is long, the parts that are nearer than the focus, and farther, are cut.
    wide = 0.5 * window * math.cos(yaw)
    tall = 0.5 * float(np.abs(frame[1] @ axes) @ np.where(np.abs(right @ axes) > 0.5, 0.0, sides))
    return Camera(focus, towards, up, signs * np.array([wide, tall, 0.0]), min(wide, 1.2 * tall))


def _directions(
    axes: Floats, sides: Floats, flat: Floats | None, g: Floats
) -> tuple[Floats, Floats, Floats, tuple[float, float]]:
    """Directions to the right, upwards and to the viewer, and how far the eye is turned from there, rad."""
    order = np.argsort(-sides, kind="stable")
    if flat is not None:
        up = _up(g, flat)
        return np.cross(up, flat), up, flat, (0.0, 0.0)
    if sides[order[2]] < _THIN * sides[order[1]]:
        depth = axes[:, order[2]] * np.sign(axes[:, order[2]].sum() or 1.0)
        up = _up(g, depth)
        return np.cross(up, depth), up, depth, (math.radians(16.0), math.radians(22.0))
    up = _up(g, np.zeros(3))
    right = axes[:, order[0]] if abs(axes[:, order[0]] @ up) < 0.9 else axes[:, order[1]]
    right = right - (right @ up) * up
    right = right / np.linalg.norm(right) * np.sign(right[np.argmax(np.abs(right))])
    is_long = sides[order[0]] > 2.0 * sides[order[1]]
    yaw, pitch = (32.0, 6.0) if is_long else (28.0, 20.0)
    return right, up, np.cross(right, up), (math.radians(yaw), math.radians(pitch))


def _up(g: Floats, depth: Floats) -> Floats:
    """Unit vector against gravity, upright on a direction; y or z where gravity does not say."""
    y_or_z = np.eye(3)[1] if abs(depth[2]) > 0.5 or not depth.any() else np.eye(3)[2]
    size = float(np.linalg.norm(g))
    up = -g / size if size > 0.0 else y_or_z
    if abs(up @ depth) > 0.7:
        up = y_or_z if abs(y_or_z @ depth) < 0.7 else np.eye(3)[0]
    up = up - (up @ depth) * depth
    return np.asarray(up / np.linalg.norm(up))


def anchor(surface: Surface, camera: Camera) -> NDArray[np.float64]:
    """Where the name of a patch stands: in the middle of a flat one, at the top of one that surrounds."""
    areas = surface.areas
    size = np.linalg.norm(areas, axis=1)
    middle = (surface.centres * size[:, None]).sum(axis=0) / max(float(size.sum()), 1e-300)
    if np.linalg.norm(areas.sum(axis=0)) > 0.5 * size.sum():
        chosen = np.linalg.norm(surface.centres - middle, axis=1).argmin()
    else:
        right = np.cross(camera.up, camera.towards)
        right /= max(float(np.linalg.norm(right)), 1e-300)
        off = np.abs((surface.centres - camera.focus) @ right)
        near = off <= max(0.3 * float(np.abs(camera.corners[:, 0]).max()), float(off.min()) * 1.01)
        height = surface.centres @ camera.up
        chosen = np.where(near, height, -np.inf).argmax()
    return np.asarray(surface.centres[chosen])


def principal_axes(points: Floats, low: Floats, high: Floats) -> Floats:
    """Columns: the coordinate axes, unless the box along the principal axes of inertia is much smaller."""
    spread = points - points.mean(axis=0)
    axes = np.linalg.eigh(spread.T @ spread)[1][:, ::-1]
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    own, tilted = high - low, np.ptp(points @ axes, axis=0)
    floor = 1e-3 * own.max()
    if np.maximum(own, floor).prod() <= _TILTED * np.maximum(tilted, floor).prod():
        return np.eye(3)
    return np.asarray(axes)


def densest(places: Floats, window: float, ends: Floats) -> float:
    """Middle of the stretch of length ``window`` between the ends that holds most of the places."""
    low, high = ends.min() + window / 2, ends.max() - window / 2
    if len(places) == 0 or high <= low:
        return float(ends.mean())
    places = np.sort(places)
    held = np.searchsorted(places, places + window, side="right") - np.arange(len(places))
    return float(np.clip(places[held.argmax()] + window / 2, low, high))


def gravity(case: Path, region: str = "") -> Floats:
    """Gravity of ``constant/g``, m/s²; zero where the case has none."""
    path = case / "constant" / region / "g"
    try:
        value: tuple[float, float, float] = read_entry(read_dictionary(path, case), "value", Vector3)
    except InputError:
        return np.zeros(3)
    return np.array(value)
