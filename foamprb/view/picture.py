"""Scene drawn by VTK: a picture or a film, without a display."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkSphereSource

from foamprb import optional
from foamprb.errors import InputError
from foamprb.flow.patches import PatchKind, kind_of_type
from foamprb.flow.read.vtk_messages import vtk_messages
from foamprb.optional import load
from foamprb.results.atomic import atomic_write
from foamprb.view.bodies import UNNAMED, Codes
from foamprb.view.canvas import Canvas, dots, segments, surface
from foamprb.view.colours import (
    OF_DEPOSITS,
    Style,
    Table,
    colour_map,
    colour_of_name,
    number,
    readable,
    rgb,
    round_down,
    written,
)
from foamprb.view.flowfield import PLANE, QUANTITIES, STREAM_OPACITY, FlowField
from foamprb.view.geometry import FLAT_TYPES, Geometry, filtered, triangles_of
from foamprb.view.scene import (
    INSETS,
    MOST_TRAILS,
    SCALE_BAR,
    VIEW_ANGLE,
    Scene,
    anchor,
)
from foamprb.view.surfaces import bulges

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

PAGE_HEIGHT = 900.0
"""Height of a picture in which texts are as large as on the page."""
# Largest number of bodies, and steps around and from pole to pole of their spheres.
_SPHERES = ((300, 48, 24), (1_000, 24, 12), (5_000, 16, 9), (20_000, 12, 7), (math.inf, 6, 4))
_MOST_MARKED = 500
_MARK_WIDTH, _SPOT_WIDTH, _MARK_STEPS = 0.04, 0.3, 72
_BAR = 280.0
_UNKNOWN = 153
_TRAIL_OPACITY = 0.85
_HAZE, _HAZE_LENGTH = 0.3, 0.6
"""Largest share of the paper in colours, and how far behind the focus it is reached, in its distances."""
_WIDER, _MOST_STRETCHED = 1.2, 4.0
"""Bodies are drawn a little beyond the picture, too; half lengths of bodies in radii, at most."""
_NEAR_DEPOSITS = 0.35
"""Opacity of the near side of a wall that is coloured by its deposits."""
_AXES = {"X": "#ff6347", "Y": "#2e8b57", "Z": "#3a6df0"}
_AXIS, _TIP = 46.0, 11.0
"""Lengths of an axis and of its arrow head, pixels of the page."""


class Triangles(NamedTuple):
    """Triangulated part of the unit sphere."""

    points: Floats
    """(v, 3)."""
    triangles: Ints
    """(t, 3)."""


@dataclass
class Drawing:
    """Scene on a canvas, with the parts that change from time to time."""

    canvas: Canvas
    scene: Scene
    texts: bool
    style: Style
    scale: float
    """Pixels of the picture per pixel of the page."""

    def show(self, frame: int) -> None:
        """Draw the bodies and the texts of a time."""
        scene, bodies = self.scene, self.scene.bodies
        if scene.painted:
            return
        shown = np.flatnonzero(bodies.shown[frame])
        for old in ("bodies", "mark", "trails"):
            self.canvas.remove(old)
        self._draw_trails(frame)
        visible = shown[self._visible(bodies.x[frame, shown], scene.enlargement * bodies.radius[shown])]
        if len(visible):
            colours = self._hazed(body_colours(scene, frame, visible), bodies.x[frame, visible])
            F = bodies.F[frame, visible].astype(np.float64)
            K = bulges(F, bodies.B[frame, visible]) if bodies.B is not None else None
            place, size = bodies.x[frame, visible], bodies.radius[visible] * scene.enlargement
            self._add("bodies", draw(sphere_for(len(shown)), place, F, size, colours, K), "back")
            if len(shown) <= _MOST_MARKED:
                self._add("mark", draw(mark(), place, F, 1.002 * size, marked(colours), K))
        self._show_deposits(frame)
        if self.texts:
            times = bodies.times
            self._write("clock", f"t = {written(times[frame], 's', times[-1])}", 17, "right", 30, bold=True)
            self._write("caption", scene.caption(len(shown)), 14, "right", 53)

    def _draw_trails(self, frame: int) -> None:
        """Draw the fading trails of the bodies."""
        points, colours = trails(self.scene, frame)
        if len(points):
            colours[..., :3] = self._hazed(colours[..., :3], points)
            self.canvas.mesh("trails", segments(points, colours), width=2.2 * self.scale)

    def _visible(self, places: Floats, size: Floats) -> NDArray[np.bool_]:
        """Return whether bodies at places (n, 3), of a size at rest, (n,), m, are in the picture, (n,)."""
        eye, (width, height) = self.canvas.camera, self.canvas.size
        ahead, up = np.subtract(eye.GetFocalPoint(), eye.GetPosition()), np.array(eye.GetViewUp())
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, up) / np.linalg.norm(np.cross(ahead, up))
        axes = np.array([right, np.cross(right, ahead), ahead])
        x, y, z = axes @ (places - eye.GetPosition()).T
        slope = _WIDER * math.tan(math.radians(0.5 * eye.GetViewAngle()))
        room = _MOST_STRETCHED * size
        return np.asarray((np.abs(y) < slope * z + room) & (np.abs(x) < slope * width / height * z + room))

    def _hazed(self, colours: Table, places: Floats) -> Table:
        """Return colours (…, 3) faded towards the paper at places (…, 3) beyond the focus."""
        eye = self.canvas.camera
        towards = np.subtract(eye.GetFocalPoint(), eye.GetPosition())
        ahead = (places - eye.GetPosition()) @ towards / (towards @ towards)
        share = _HAZE * np.clip((ahead - 1.0) / _HAZE_LENGTH, 0.0, 1.0)[..., None]
        hazed: Table = np.rint(colours + share * (np.array(rgb(self.style.paper)) - colours)).astype(np.uint8)
        return hazed

    def _add(self, name: str, mesh: Any, culling: str = "") -> None:
        """Draw a mesh with its own colours, in the light of the bodies."""
        self.canvas.mesh(name, mesh, culling=culling, light=(0.36, 0.68, 0.25))

    def label(self) -> None:
        """Write the texts that do not change: title, legends and names of patches."""
        scene = self.scene
        self._write("title", scene.title, 17, "left", 30, bold=True)
        self._write("subtitle", "  ·  ".join(filter(None, (scene.subtitle, scene.groups))), 14, "left", 53)
        left = 22.0
        if scene.flowfield is not None and scene.flowfield.slice is not None:
            scale = scene.flowfield.scales[PLANE]
            left = self._bar(*QUANTITIES[PLANE], scale.limits, self.style.plane, left, scale.extremes)
        name, part = scene.colour
        if scene.painted and (density := scene.scale_of_deposits):
            limits, ends = (0.0, density["high"]), (density["least"], density["most"])
            self._bar("deposits per area", density["unit"], limits, colour_map(OF_DEPOSITS), left, ends)
        elif name in scene.bodies.fields:
            field = scene.bodies.fields[name]
            label = f"{field.label}, {part}" if part else field.label
            self._bar(label, field.unit, scene.limits, colour_map(scene.map_name), left, scene.extremes)
        else:
            self._names(scene.codes(name))
        for patch in scene.geometry.surfaces if scene.geometry is not None else ():
            if patch.type not in FLAT_TYPES:
                self._name(patch.name, anchor(patch, scene.camera))

    def _name(self, text: str, place: Floats) -> None:
        """Write the name of a patch on a pill above a place of the scene."""
        actor = self.canvas.text(f"patch {text}", f" {text} ", 12 * self.scale, self.style.soft)
        actor.GetPositionCoordinate().SetCoordinateSystemToWorld()
        actor.GetPositionCoordinate().SetValue(*place)
        letters = actor.GetTextProperty()
        letters.SetJustificationToCentered()
        letters.SetBackgroundColor(*(c / 255.0 for c in rgb(self.style.paper)))
        letters.SetBackgroundOpacity(0.82)

    def compass(self) -> None:
        """Draw axes and a scale bar in the lower right corner."""
        eye = self.canvas.camera
        width, height = (length / self.scale for length in self.canvas.size)
        towards = np.subtract(eye.GetPosition(), eye.GetFocalPoint())
        distance = float(np.linalg.norm(towards))
        pixel = 2.0 * distance * math.tan(math.radians(0.5 * eye.GetViewAngle())) / height
        length = round_down(SCALE_BAR * pixel, (1, 2, 5))
        right, left = width - 20.0, width - 20.0 - length / pixel
        bar = np.array([[left, 30.0], [left, 26.0], [right, 26.0], [right, 30.0]])
        self._write("scale", written(length, "m", length), 12, "center", height - 12.0, 0.5 * (left + right))
        bar = self._flat("scale bar", np.stack([bar[:-1], bar[1:]], axis=1), self.style.ink)
        bar.GetProperty().SetLineWidth(1.5 * self.scale)
        towards, up = towards / distance, np.array(eye.GetViewUp())
        across = np.cross(up, towards) / np.linalg.norm(np.cross(up, towards))
        screen = np.array([across, np.cross(towards, across)])
        middle = np.array([0.94 * width, 0.19 * height])
        # The axis that points to the viewer is in front of the others.
        for k in np.argsort(towards).tolist():
            name, tip = "XYZ"[k], middle + _AXIS * screen[:, k]
            shown = float(np.linalg.norm(screen[:, k]))
            along = screen[:, k] / max(shown, 1e-9)
            back, side = tip - min(_TIP, _AXIS * shown) * along, np.array([-along[1], along[0]])
            shaft = self._flat(f"axis {name}", np.array([[middle, back]]), _AXES[name])
            shaft.GetProperty().SetLineWidth(2.0 * self.scale)
            head = np.array([tip, back + 0.4 * _TIP * side, back - 0.4 * _TIP * side])
            self._flat(f"head {name}", head, _AXES[name])
            x, y = tip + 8.0 * along
            self._write(f"name {name}", name, 14, "center", height - y + 5.0, x)

    def _write(
        self, name: str, text: str, size: float, side: str, top: float, left: float = 22.0, bold: bool = False
    ) -> None:
        """Write a line; ``top`` and ``left`` are pixels of the page from the upper and the ``side`` edge."""
        (width, height), s = self.canvas.size, self.scale
        actor = self.canvas.text(name, text, size * s, self.style.ink if bold else self.style.soft, bold)
        actor.SetPosition(width - left * s if side == "right" else left * s, height - top * s)
        letters = actor.GetTextProperty()
        letters.SetJustification(("left", "center", "right").index(side))

    def _bar(
        self, label: str, unit: str, limits: tuple[float, float], table: Table, left: float,
        extremes: tuple[float, float],
    ) -> float:  # fmt: skip
        """Draw a colour bar ``left`` pixels of the page from the left; return the position of the next one.

        Values beyond the limits are named by their extremes.
        """
        width, height = (length / self.scale for length in self.canvas.size)
        factor, shown_unit = readable(unit, max(map(abs, limits)))
        low, high = (value / factor for value in limits)
        title = label[:1].upper() + label[1:] + (f"  ({shown_unit})" if shown_unit else "")
        ends = [f"min {number(extremes[0] / factor, 2)}"] * (extremes[0] < limits[0])
        ends += [f"max {number(extremes[1] / factor, 2)}"] * (extremes[1] > limits[1])
        self._write(f"{label} title", "  ".join([title, *ends]), 13, "left", height - 62.0, left, bold=True)
        for k, side in enumerate(("left", "center", "center", "center", "right")):
            value, at = low + 0.25 * k * (high - low), left + 0.25 * k * _BAR
            at = width - at if side == "right" else at
            self._write(f"{label} {k}", number(value, 3), 12, side, height - 12.0, at)
        x = left + _BAR * np.linspace(0.0, 1.0, len(table))
        corners = np.stack([np.repeat(x, 2), np.tile([30.0, 53.0], len(x))], axis=1)
        first = np.arange(0, len(corners) - 2, 2)[:, None]
        bands = np.concatenate([first + np.array([0, 2, 1]), first + np.array([1, 2, 3])])
        self._flat(f"{label} bar", corners, None, bands, np.repeat(table, 2, axis=0))
        return left + _BAR + 40.0

    def _names(self, codes: Codes) -> None:
        """Draw the colours of the names that occur."""
        present = [
            k for k in np.unique(codes.codes).tolist() if k < len(codes.meanings) and codes.meanings[k]
        ]
        height = self.canvas.size[1] / self.scale
        for row, k in enumerate(reversed(present)):
            low, high = 24.0 + 24.0 * row, 38.0 + 24.0 * row
            square = np.array([[22.0, low], [36.0, low], [36.0, high], [22.0, high]])
            self._flat(f"square {k}", square, colour_of_name(k), np.array([[0, 1, 2], [0, 2, 3]]))
            self._write(f"name {k}", codes.meanings[k], 13, "left", height - low - 2.0, 44.0)

    def _flat(
        self, name: str, points: Floats, colour: str | None, triangles: Ints | None = None,
        colours: Table | None = None,
    ) -> Any:  # fmt: skip
        """Draw lines (s, 2, 2) or triangles of points (n, 2), pixels of the page, in front of the scene."""
        flat = np.concatenate([self.scale * points, np.zeros((*points.shape[:-1], 1))], axis=-1)
        triangles = np.array([[0, 1, 2]]) if triangles is None else triangles
        data = segments(flat) if flat.ndim == 3 else surface(flat, triangles, colours)
        return self.canvas.flat(name, data, colour)

    def _show_deposits(self, frame: int) -> None:
        """Mark the deposits in front of everything."""
        bodies = self.scene.bodies
        stuck = [k for k, word in enumerate(bodies.status.meanings) if word == "stuck"]
        codes = bodies.status.codes
        rows = np.flatnonzero(bodies.present[frame] & np.isin(codes[min(frame, len(codes) - 1)], stuck))
        self.canvas.remove("deposits")
        if len(rows) == 0:
            return
        actor = self.canvas.flat("deposits", dots(bodies.x[frame, rows]), self.style.deposit, world=True)
        actor.GetProperty().SetPointSize(6.0 * self.scale)


def picture(scene: Scene, path: Path, size: tuple[int, int], style: Style, texts: bool = True) -> None:
    """Write a picture of the scene's first time, ``.png``, in one step.

    Raises
    ------
    InputError
        If the name of the file has another ending.
    """
    if path.suffix.lower() != ".png":
        raise InputError(f"-png {path}: the name must end in .png.")
    (image,) = images(scene, size, (style,), texts)
    with atomic_write(path) as temporary:
        temporary.write_bytes(png_of(image))


def png_of(image: NDArray[np.uint8]) -> bytes:
    """Return a picture, (height, width, 3), as a PNG file."""
    file = io.BytesIO()
    # Higher levels take two and more times as long, for a tenth of the size.
    load("PIL.Image").fromarray(image).save(file, format="png", compress_level=3)
    return file.getvalue()


def images(
    scene: Scene, size: tuple[int, int], styles: Sequence[Style], texts: bool = True
) -> Iterator[NDArray[np.uint8]]:
    """Yield pictures of the scene's first time in several styles, (height, width, 3), on one canvas."""
    with vtk_messages():
        canvas = Canvas(size)
        for style in styles:
            _drawing(canvas, scene, style, texts).show(scene.first)
            yield canvas.image()
        canvas.close()


def film(scene: Scene, path: Path, size: tuple[int, int], style: Style) -> None:
    """Write a film of all times, ``.mp4`` or ``.gif``, of about eight seconds."""
    suffix = path.suffix.lower()
    if suffix not in (".mp4", ".gif"):
        raise InputError(f"-film {path}: the name must end in .mp4 or .gif.")
    get_writer = optional.load("imageio.v2", "film", "-film needs").get_writer
    m = len(scene.bodies.times)
    rate = float(np.clip(round(m / 8.0), 4, 30))
    # Video codecs need even sides.
    even = (size[0] // 2 * 2, size[1] // 2 * 2)
    options: dict[str, Any] = {"duration": 1e3 / rate, "loop": 0}
    if suffix == ".mp4":
        options = {"fps": rate, "quality": 8, "macro_block_size": 1}
    # The encoder is chosen by the ending of the name.
    temporary = path.with_name(f".{path.stem}.unfinished{suffix}")
    writer: Any
    try:
        with vtk_messages(), get_writer(temporary, **options) as writer:
            drawing = _drawing(Canvas(even), scene, style, texts=True)
            for frame in range(m):
                drawing.show(frame)
                writer.append_data(drawing.canvas.image())
            drawing.canvas.close()
        temporary.replace(path)
    except (ImportError, ValueError) as error:
        # Without its encoder imageio does not support the format.
        raise InputError(
            f"-film {path}: {' '.join(str(error).split())}. Is 'foamprb[film]' installed?"
        ) from error
    finally:
        temporary.unlink(missing_ok=True)


def _drawing(canvas: Canvas, scene: Scene, style: Style, texts: bool) -> Drawing:
    """Return the scene without its bodies, alone on a canvas."""
    canvas.clear(style.paper)
    scale = canvas.size[1] / PAGE_HEIGHT
    drawing = Drawing(canvas, scene, texts, style, scale)
    if len(scene.edges):
        canvas.mesh("edges", segments(scene.edges), style.edge)
    if scene.flowfield is not None:
        draw_flow(canvas, scene.flowfield, style)
    if scene.geometry is not None:
        draw_geometry(canvas, scene.geometry, style, scene.most_dense if scene.painted else 0.0)
    if texts:
        drawing.label()
    _place_camera(canvas, scene, [inset * scale for inset in INSETS] if texts else [0.0, 0.0])
    if texts:
        drawing.compass()
    return drawing


def _place_camera(canvas: Canvas, scene: Scene, insets: list[float]) -> None:
    camera, eye = scene.camera, canvas.camera
    width, height = canvas.size
    above, below = insets
    free = max(0.3, 1.0 - (above + below) / height)
    distance = camera.distance(width / height, free)
    eye.SetViewAngle(VIEW_ANGLE)
    eye.SetFocalPoint(*camera.focus)
    eye.SetPosition(*(camera.focus + distance * camera.towards))
    eye.SetViewUp(*camera.up)
    # The scene is centred between the texts above and below.
    eye.SetWindowCenter(0.0, (above - below) / height)


def draw_geometry(canvas: Canvas, geometry: Geometry, style: Style, most_dense: float = 0.0) -> None:
    """Draw the far side of walls, and the near side and other patches almost transparent.

    Up to the density ``most_dense``, 1/m², if it is given, colours of walls tell that of their deposits.
    """
    for k, patch in enumerate(geometry.surfaces):
        if patch.type in FLAT_TYPES:
            continue
        if kind_of_type(patch.type) is not PatchKind.WALL:
            mesh = surface(patch.points, patch.triangles)
            canvas.mesh(f"patch {k}", mesh, style.accent, opacity=0.07)
            continue
        colour, colours, opacity = style.glass, None, 0.1
        if most_dense > 0.0 and patch.density is not None:
            shares = np.clip(255.0 * patch.density / most_dense, 0, 255).astype(np.uint8)
            colours, opacity = colour_map(OF_DEPOSITS)[shares], _NEAR_DEPOSITS
        normals = vtkPolyDataNormals()
        normals.SplittingOff()
        mesh = filtered(normals, surface(patch.points, patch.triangles, colours))
        canvas.mesh(f"near {k}", mesh, colour, opacity, culling="back", light=(0.6, 0.4, 0.0))
        canvas.mesh(f"far {k}", mesh, colour, culling="front", light=(0.8, 0.22, 0.0))


def draw_flow(canvas: Canvas, field: FlowField, style: Style) -> None:
    """Draw streamlines, faintly, and the plane through the flow, coloured by the speed."""
    if len(field.lines.points):
        canvas.mesh("streamlines", segments(field.lines.segments), style.soft, STREAM_OPACITY)
    if field.slice is not None:
        low, high = field.scales[PLANE].limits
        share = (field.slice.values[PLANE] - low) / ((high - low) or 1.0)
        colours = style.plane[np.clip(255.0 * share, 0, 255).astype(np.uint8)]
        canvas.mesh("plane", surface(field.slice.points, field.slice.triangles, colours))


def trails(scene: Scene, frame: int) -> tuple[Floats, Table]:
    """Return segments of the fading trails at a time, (k, 2, 3), m, and their colours, (k, 2, 4)."""
    bodies, times, span = scene.bodies, scene.bodies.times, scene.trail
    points, colours = [np.zeros((0, 2, 3))], [np.zeros((0, 2, 4), dtype=np.uint8)]
    if span > 0.0 and len(bodies.ids) <= MOST_TRAILS:
        tail = times[frame] - span
        for t in range(max(1, int(np.searchsorted(times, tail, side="right"))), frame + 1):
            rows = np.flatnonzero(bodies.present[t - 1] & bodies.present[t] & ~bodies.jumped(t))
            cut = max(0.0, (tail - times[t - 1]) / (times[t] - times[t - 1]))
            ends = bodies.x[t - 1 : t + 1, rows]
            ends[0] += cut * (ends[1] - ends[0])
            share = (np.maximum(times[t - 1 : t + 1], tail) - tail) / span
            alpha = np.broadcast_to(255.0 * _TRAIL_OPACITY * share[:, None] ** 1.5, ends.shape[:2])
            rgb = np.stack([body_colours(scene, k, rows) for k in (t - 1, t)])
            points.append(ends.swapaxes(0, 1))
            colours.append(np.concatenate([rgb, alpha[..., None].astype(np.uint8)], axis=2).swapaxes(0, 1))
    return np.concatenate(points), np.concatenate(colours)


def body_colours(scene: Scene, frame: int, shown: Ints) -> Table:
    """Return the colours of the shown bodies at a time, (s, 3)."""
    name, part = scene.colour
    if name in scene.bodies.fields:
        values = scene.bodies.fields[name].channel(part)
        low, high = scene.limits
        numbers = values[min(frame, len(values) - 1), shown].astype(np.float64)
        share = (np.nan_to_num(numbers) - low) / ((high - low) or 1.0)
        at = np.clip(255.0 * share + 0.5, 0, 255).astype(np.uint8)
        colours: Table = np.where(np.isfinite(numbers)[:, None], colour_map(scene.map_name)[at], _UNKNOWN)
        return colours.astype(np.uint8)
    codes = scene.codes(name)
    table = np.full((UNNAMED + 1, 3), _UNKNOWN, dtype=np.uint8)
    for k in range(len(codes.meanings)):
        table[k] = rgb(colour_of_name(k))
    own_codes = codes.codes[min(frame, len(codes.codes) - 1), shown]
    return np.asarray(table[own_codes], dtype=np.uint8)


def marked(colours: Table) -> Table:
    """Return the colours of the marks on bodies: darker on light colours, lighter on dark ones."""
    plain = colours.astype(np.float64)
    light = plain @ np.array([0.3, 0.59, 0.11]) > 0.45 * 255.0
    mark = np.where(light[:, None], 0.42 * plain, 0.38 * plain + 0.62 * 255.0)
    return np.asarray(np.rint(0.2 * plain + 0.8 * mark), dtype=np.uint8)


def sphere_for(count: int) -> Triangles:
    """Return the unit sphere, coarser for more bodies."""
    around, down = next((around, down) for most, around, down in _SPHERES if count <= most)
    ball = vtkSphereSource()
    ball.SetRadius(1.0)
    ball.SetThetaResolution(around)
    ball.SetPhiResolution(down)
    ball.Update()
    points, triangles = triangles_of(ball.GetOutput())
    return Triangles(points / np.linalg.norm(points, axis=1, keepdims=True), triangles)


def mark() -> Triangles:
    """Return the mark that moves with the material: three great circles, and a spot around the first axis."""
    n = _MARK_STEPS
    angle = 2.0 * np.pi * np.arange(n) / n
    circle = np.stack([np.zeros(n), np.cos(angle), np.sin(angle)], axis=1)

    def ring(axis: int, height: float) -> Floats:
        around_x = math.sqrt(1.0 - height**2) * circle + [height, 0.0, 0.0]
        return np.roll(around_x, axis, axis=1)

    # The rim of the spot is a chord of this length away from its middle.
    turn = 2.0 * math.asin(0.5 * _SPOT_WIDTH)
    heights = [(axis, -_MARK_WIDTH, _MARK_WIDTH) for axis in range(3)]
    heights += [(0, math.cos(turn), math.cos(0.5 * turn)), (0, math.cos(0.5 * turn), 1.0)]
    k, after = np.arange(n), (np.arange(n) + 1) % n
    band = np.concatenate([np.stack([k, after, n + k], axis=1), np.stack([after, n + after, n + k], axis=1)])
    points = [ring(axis, height) for axis, low, high in heights for height in (low, high)]
    triangles = [2 * n * index + band for index in range(len(heights))]
    return Triangles(np.concatenate(points), np.concatenate(triangles))


def draw(
    shape: Triangles, place: Floats, F: Floats, size: Floats, colours: Table, K: Floats | None = None
) -> Any:
    """Return one mesh of a shape on each of n bodies, with its normals.

    Parameters
    ----------
    shape
        Part of the unit sphere.
    place, F, size
        (n, 3), (n, 3, 3) and (n,): a point X of the sphere moves to ``place + size * F X``.
    colours
        (n, 3).
    K
        Quadratic modes, (n, 3, 3, 3): F X becomes F X + K XX, see :func:`foamprb.view.surfaces.bulges`.
    """
    n, v = len(place), len(shape.points)
    # Graphics have single precision; places may lie far from the origin.
    sphere = shape.points.astype(np.float32)
    points = place[:, None, :] + sphere @ (size[:, None, None] * F).astype(np.float32).transpose(0, 2, 1)
    if K is None:
        normals = sphere @ np.linalg.inv(F).astype(np.float32)
    else:
        half = np.einsum("nijk,vk->nvji", K.astype(np.float32), sphere)
        points += size[:, None, None] * np.einsum("vj,nvji->nvi", sphere, half)
        # Rows: derivatives by the three components of X. The normals are X under their cofactors.
        a, b, c = np.moveaxis(F.astype(np.float32).transpose(0, 2, 1)[:, None] + 2.0 * half, 2, 0)
        cofactors = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=2)
        normals = np.einsum("vj,nvji->nvi", sphere, cofactors)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    faces = shape.triangles.astype(np.int64)[None] + (v * np.arange(n))[:, None, None]
    mesh = surface(points.reshape(-1, 3), faces, np.repeat(colours, v, axis=0))
    mesh.GetPointData().SetNormals(numpy_to_vtk(normals.reshape(-1, 3)))
    return mesh
