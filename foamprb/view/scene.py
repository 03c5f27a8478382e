"""Scene of a run, independent of how it is drawn: bodies, walls, camera, colours and texts."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.results.vtk import Tracks
from foamprb.view.bodies import MAGNITUDE, Bodies, Codes
from foamprb.view.colours import MAPS, number, round_down, round_limits
from foamprb.view.flowfield import FlowField
from foamprb.view.geometry import Geometry, Surface

Floats = NDArray[np.float64]

BODY_SIZE = 1 / 16
"""Default diameter at which bodies at rest are drawn, as a share of the second longest side."""
WINDOW_LENGTH = 3.5
"""Visible length of a long geometry, as a multiple of the second longest side."""
LONG = 8.0
"""A geometry is visible as a whole unless it is longer than this multiple of the second longest side."""
VIEW_ANGLE = 30.0
"""Vertical, degrees."""
MARGIN = 1.06
"""Ratio of the visible size to the size that must be visible."""
INSETS = (66.0, 94.0)
"""Pixels that texts take above and below the scene."""
SCALE_BAR = 120.0
"""Largest length of the scale bar, pixels of the page."""
COHERENT = 0.3
"""Least ratio of the mean velocity's size to the mean speed at which the flow has a direction."""
TALL = 1.6
"""A long object takes at least 1/1.6 of the height of the picture. Its length is cut for that."""
PERCENTILES = (5.0, 95.0)
"""Percentiles of all shown values that limit the colours; values beyond may be clamped."""
ALL = (0.0, 100.0)
"""Percentiles that include all values."""
TRAIL = 0.3
"""Length of the fading trail of a body with the median speed, as a share of the visible length."""
MOST_TRAILS = 5000
"""Largest number of bodies that have trails by default."""
LARGE_DENSITY = 1e4
"""Density of deposits above which it is shown per mm², 1/m²."""
_THIN = 0.35
"""A geometry with a smaller ratio of the shortest side to the second one is viewed along the shortest."""
_TILTED = 1.3
"""Ratio of the volumes of the coordinate box and the principal box above which the latter is used."""


class Camera(NamedTuple):
    """First view; vectors (3,)."""

    focus: Floats
    """m."""
    towards: Floats
    """Unit vector from the focus to the eye."""
    up: Floats
    """Unit vector, vertical in the picture."""
    corners: Floats
    """Points that must be visible: right of, above and in front of the focus, (k, 3), m."""
    least_width: float
    """Half width that must be visible even in a narrow picture, m."""

    def distance(self, aspect: float, free: float = 1.0) -> float:
        """Return the distance of the eye from the focus, m.

        Parameters
        ----------
        aspect
            Ratio of the width of the picture to its height.
        free
            Share of its height without texts.
        """
        slope = math.tan(math.radians(VIEW_ANGLE / 2))
        x, y, z = np.abs(self.corners[:, 0]), np.abs(self.corners[:, 1]), self.corners[:, 2]
        x = np.minimum(x, max(self.least_width, TALL * float(y.max()) * aspect))
        return float((z + MARGIN * np.maximum(x / (slope * aspect), y / (slope * free))).max())


@dataclass(frozen=True)
class Scene:
    """Everything that is drawn.

    Parameters
    ----------
    title, subtitle
        Names of the case and of the cloud.
    bodies
        Bodies over their times.
    fate
        Fate of each body, (1, n).
    geometry
        Boundary of the mesh, if it could be read.
    flowfield
        Streamlines and planes, if the flow was read.
    paths
        Paths that are finer than the bodies' times, if the run recorded them.
    camera
        First view.
    enlargement
        Ratio of the drawn size of the bodies to their size.
    colour
        Name and component of the array to colour by.
    range
        Limits of the colours, if the user chose them.
    first
        Index of the time that is shown first.
    flow
        Unit vector of the mean velocity; zero if the flow has no main direction.
    gravity
        Unit vector; zero without gravity.
    groups
        Dimensionless groups and the fluid, as text.
    known_extremes
        Least and largest value of the chosen array at all times, if the bodies have some times only.
    painted
        Whether a picture has the density of deposits on walls in place of bodies.
    """

    title: str
    subtitle: str
    bodies: Bodies
    fate: Codes
    geometry: Geometry | None
    flowfield: FlowField | None
    paths: Tracks | None
    camera: Camera
    enlargement: float
    colour: tuple[str, str]
    range: tuple[float, float] | None
    first: int
    flow: Floats = field(default_factory=lambda: np.zeros(3))
    gravity: Floats = field(default_factory=lambda: np.zeros(3))
    groups: str = ""
    known_extremes: tuple[float, float] | None = None
    painted: bool = False

    @cached_property
    def limits(self) -> tuple[float, float]:
        """Values of the chosen array at which its colours begin and end."""
        return self.range or limits_of(self.bodies, *self.colour, PERCENTILES)

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """Least and largest shown value of the chosen array."""
        return self.known_extremes or extremes_of(self.bodies, *self.colour) or self.limits

    @cached_property
    def densities(self) -> Floats:
        """Densities of deposits at the points of all walls that have them, 1/m²."""
        surfaces = self.geometry.surfaces if self.geometry is not None else ()
        return np.concatenate([np.zeros(0), *(s.density for s in surfaces if s.density is not None)])

    @cached_property
    def most_dense(self) -> float:
        """Density of deposits at which the colours end; some walls may have more, 1/m²."""
        return limits_of_values(self.densities, (0.0, PERCENTILES[1]))[1]

    @property
    def scale_of_deposits(self) -> dict[str, Any] | None:
        """Ends of the densities and of their colours, with their unit; None without deposits."""
        if not len(self.densities):
            return None
        per, unit = (1e-6, "1/mm²") if self.most_dense > LARGE_DENSITY else (1.0, "1/m²")
        ends = {"least": self.densities.min(), "most": self.densities.max(), "high": self.most_dense}
        return {"unit": unit, **{name: float(per * value) for name, value in ends.items()}}

    @cached_property
    def edges(self) -> Floats:
        """Edges of the geometry, or without it of a box around all bodies, (e, 2, 3), m."""
        if self.geometry is not None:
            return self.geometry.edges
        ends = np.array(box(None, self.bodies))
        corners = list(itertools.product((0, 1), repeat=3))
        pairs = [
            (a, b) for a, b in itertools.combinations(corners, 2) if np.abs(np.subtract(a, b)).sum() == 1
        ]
        return np.asarray(ends[np.array(pairs), range(3)])

    @cached_property
    def trail(self) -> float:
        """Time that a fading trail covers, s; zero if the speeds are not known."""
        bodies, field = self.bodies, self.bodies.fields.get("U")
        if field is None:
            return 0.0
        speeds = field.channel(MAGNITUDE)
        speed = speeds[min(self.first, len(speeds) - 1), bodies.shown[self.first]]
        return trail_time(speed, self.camera)

    @property
    def directions(self) -> dict[str, Floats]:
        """Unit vectors of the flow and of gravity, if they have one, by their labels."""
        both = {"flow": self.flow, "gravity": self.gravity}
        return {name: vector for name, vector in both.items() if vector.any()}

    def codes(self, name: str) -> Codes:
        """Return a property that has names."""
        return self.fate if name == self.fate.name else self.bodies.codes[name]

    @property
    def map_name(self) -> str:
        """Colour map of the chosen array."""
        low, high = self.limits
        return MAPS[-1] if low == -high else MAPS[0]

    def caption(self, shown: int) -> str:
        """Return a sentence with the number of shown bodies and their enlargement."""
        scale = f"{number(self.enlargement, 3)}× larger" if self.enlargement != 1.0 else "to scale"
        return f"{shown} {'body' if shown == 1 else 'bodies'}, drawn {scale}"


def trail_time(speeds: NDArray[Any], camera: Camera) -> float:
    """Return the time in which the median speed, m/s, covers :data:`TRAIL` of the visible length, s."""
    moving = speeds[np.isfinite(speeds) & (speeds > 0.0)]
    visible = 2.0 * min(float(np.abs(camera.corners[:, :2]).max()), camera.least_width)
    return TRAIL * visible / float(np.median(moving)) if len(moving) else 0.0


def limits_of(
    bodies: Bodies, name: str, part: str, percentiles: tuple[float, float] = ALL
) -> tuple[float, float]:
    """Return round limits of the shown values of an array; zero if it is near.

    Parameters
    ----------
    bodies, name, part
        The bodies, the array, and its component.
    percentiles
        Values beyond are left out, unless the values between them are all equal.
    """
    return limits_of_values(_values(bodies, name, part), percentiles)


def limits_of_values(values: NDArray[Any], percentiles: tuple[float, float] = ALL) -> tuple[float, float]:
    """Return round limits of finite values; see :func:`limits_of`."""
    if not values.size:
        return 0.0, 1.0
    shares = np.array(percentiles) / 100.0
    low = float(np.quantile(values, shares[0], method="lower"))
    high = float(np.quantile(values, shares[1], method="higher"))
    if low == high:
        low, high = float(values.min()), float(values.max())
    return round_limits(low, high)


def extremes_of(bodies: Bodies, name: str, part: str) -> tuple[float, float] | None:
    """Return the least and the largest shown value of an array; None without values."""
    values = _values(bodies, name, part)
    return (float(values.min()), float(values.max())) if values.size else None


def _values(bodies: Bodies, name: str, part: str) -> Floats:
    values = np.broadcast_to(bodies.fields[name].channel(part), bodies.present.shape)[bodies.shown]
    return np.asarray(values[np.isfinite(values)])


def main_direction(mean: Sequence[float] | None) -> Floats:
    """Return the unit vector of a mean velocity that is relative to the mean speed, or zero."""
    v = np.array(mean or (), dtype=np.float64)
    size = float(np.linalg.norm(v)) if v.shape == (3,) else 0.0
    return v / size if COHERENT <= size < math.inf else np.zeros(3)


def automatic_enlargement(bodies: Bodies, sides: Floats) -> float:
    """Return a round number ≥ 1 at which bodies at rest are visible and mostly do not overlap.

    Parameters
    ----------
    bodies
        The bodies.
    sides
        Sides of the box around them, (3,), m.
    """
    sides = np.sort(sides)
    positive = bodies.radius[bodies.radius > 0.0]
    if len(positive) == 0 or not sides[1] > 0.0:
        return 1.0
    most = max(1, int(bodies.shown.sum(axis=1).max(initial=0)))
    spacing = (sides[2] * sides[1] * max(sides[0], sides[1] * BODY_SIZE) / most) ** (1 / 3)
    wanted = min(BODY_SIZE * sides[1], 0.5 * spacing) / float(2.0 * np.median(positive))
    return round_down(wanted) if wanted > 1.0 else 1.0


def opening(shown: NDArray[np.integer[Any]], stuck: int) -> int:
    """Return the index of the time that is shown first.

    It is the last time if at least half as many bodies are on walls then as are ever shown at once.
    Otherwise it is the time with most bodies in the flow or on a wall; of several, the last.

    Parameters
    ----------
    shown
        Number of bodies in the flow or on a wall at each time.
    stuck
        Number of bodies on walls at the last time.
    """
    if 2 * stuck >= max(1, shown.max(initial=0)):
        return len(shown) - 1
    return int(len(shown) - 1 - np.argmax(shown[::-1]))


def box(geometry: Geometry | None, bodies: Bodies) -> tuple[Floats, Floats]:
    """Return the lowest and the highest corner of the geometry, or without it of all bodies, m."""
    points = geometry.points if geometry is not None else bodies.x[bodies.present]
    if len(points) == 0:
        return np.full(3, -0.5), np.full(3, 0.5)
    low, high = points.min(axis=0), points.max(axis=0)
    if geometry is None:
        room = max(4.0 * float(bodies.radius.max(initial=0.0)), 0.05 * float((high - low).max()))
        low, high = low - room, high + room
    return low, high


def camera_for(geometry: Geometry | None, bodies: Bodies, first: int, g: Floats) -> Camera:
    """Return the first view of a geometry and bodies.

    A long geometry lies across the picture, viewed from the side, a little from above and from one end. If it
    is longer than :data:`LONG` widths, only the part with most bodies is visible. A thin geometry is viewed
    along its shortest side, or from above if gravity acts along that side. One with ``empty`` patches or
    wedges is viewed along their normal. Gravity points down.

    Parameters
    ----------
    geometry, bodies
        The boundary of the mesh, if it could be read, and the bodies.
    first
        Index of the time that is shown first.
    g
        Gravity, m/s²; zero without it.
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
    if not 0.0 < LONG * second < extent:
        return Camera(middle, towards, up, 0.5 * signs * sides @ axes.T @ frame.T, math.inf)
    places = bodies.x[first][bodies.shown[first]] @ right
    ends = middle @ right + 0.5 * extent * np.array([-1.0, 1.0])
    focus = middle + right * (densest(places, window, ends) - middle @ right)
    # The ends of a long geometry, nearer and farther than the focus, are cut.
    wide = 0.5 * window * math.cos(yaw)
    tall = 0.5 * float(np.abs(frame[1] @ axes) @ np.where(np.abs(right @ axes) > 0.5, 0.0, sides))
    return Camera(focus, towards, up, signs * np.array([wide, tall, 0.0]), min(wide, 1.2 * tall))


def _directions(
    axes: Floats, sides: Floats, flat: Floats | None, g: Floats
) -> tuple[Floats, Floats, Floats, tuple[float, float]]:
    """Return the directions right, up and to the viewer, and yaw and pitch of the eye from there, rad."""
    order = np.argsort(-sides, kind="stable")
    if flat is not None:
        up = _up(g, flat)
        return np.cross(up, flat), up, flat, (0.0, 0.0)
    depth = axes[:, order[2]] * np.sign(axes[:, order[2]].sum() or 1.0)
    thin = sides[order[2]] < _THIN * sides[order[1]]
    lies = thin and abs(g @ depth) > 0.7 * np.linalg.norm(g)
    if thin and not lies:
        up = _up(g, depth)
        return np.cross(up, depth), up, depth, (math.radians(16.0), math.radians(22.0))
    up = _up(g, np.zeros(3))
    right = axes[:, order[0]] if abs(axes[:, order[0]] @ up) < 0.9 else axes[:, order[1]]
    right = right - (right @ up) * up
    right = right / np.linalg.norm(right) * np.sign(right[np.argmax(np.abs(right))])
    is_long = sides[order[0]] > 2.0 * sides[order[1]]
    yaw, pitch = (32.0, 6.0) if is_long else (28.0, 20.0)
    # A flat room that lies on the floor is seen from above.
    pitch = 55.0 if lies else pitch
    return right, up, np.cross(right, up), (math.radians(yaw), math.radians(pitch))


def _up(g: Floats, depth: Floats) -> Floats:
    """Return a unit vector normal to ``depth`` against gravity; along y or z if gravity does not decide."""
    y_or_z = np.eye(3)[1] if abs(depth[2]) > 0.5 or not depth.any() else np.eye(3)[2]
    size = float(np.linalg.norm(g))
    up = -g / size if size > 0.0 else y_or_z
    if abs(up @ depth) > 0.7:
        up = y_or_z if abs(y_or_z @ depth) < 0.7 else np.eye(3)[0]
    up = up - (up @ depth) * depth
    return np.asarray(up / np.linalg.norm(up))


def anchor(surface: Surface, camera: Camera) -> NDArray[np.float64]:
    """Return the position of the name of a patch: the middle of a flat patch, the top of a closed one."""
    areas = surface.areas
    size = np.linalg.norm(areas, axis=1)
    middle = (surface.centres * size[:, None]).sum(axis=0) / max(float(size.sum()), 1e-300)
    if np.linalg.norm(areas.sum(axis=0)) > 0.5 * size.sum():
        nearest = np.linalg.norm(surface.centres - middle, axis=1).argmin()
    else:
        right = np.cross(camera.up, camera.towards)
        right /= max(float(np.linalg.norm(right)), 1e-300)
        off = np.abs((surface.centres - camera.focus) @ right)
        near = off <= max(0.3 * float(np.abs(camera.corners[:, 0]).max()), float(off.min()) * 1.01)
        height = surface.centres @ camera.up
        nearest = np.where(near, height, -np.inf).argmax()
    return np.asarray(surface.centres[nearest])


def principal_axes(points: Floats, low: Floats, high: Floats) -> Floats:
    """Return the axes as columns: principal axes of inertia if their box is much smaller, else x, y, z."""
    spread = points - points.mean(axis=0)
    axes = np.linalg.eigh(spread.T @ spread)[1][:, ::-1]
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    extents, tilted = high - low, np.ptp(points @ axes, axis=0)
    floor = 1e-3 * extents.max()
    if np.maximum(extents, floor).prod() <= _TILTED * np.maximum(tilted, floor).prod():
        return np.eye(3)
    return np.asarray(axes)


def densest(places: Floats, window: float, ends: Floats) -> float:
    """Return the middle of the interval of length ``window`` between the ends that holds most places."""
    low, high = ends.min() + window / 2, ends.max() - window / 2
    if len(places) == 0 or high <= low:
        return float(ends.mean())
    places = np.sort(places)
    held = np.searchsorted(places, places + window, side="right") - np.arange(len(places))
    return float(np.clip(places[held.argmax()] + window / 2, low, high))
