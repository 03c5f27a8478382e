"""Scene drawn by VTK: a picture or a film, without a display."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor2D, vtkCoordinate, vtkLight, vtkPolyDataMapper2D

from foamprb import optional
from foamprb.errors import InputError
from foamprb.flow.patches import PatchKind, kind_of_type
from foamprb.flow.read.vtk_messages import vtk_messages
from foamprb.optional import load
from foamprb.results.atomic import atomic_write
from foamprb.view.bodies import UNNAMED, Codes
from foamprb.view.colours import (
    OF_DEPOSITS,
    Style,
    Table,
    colour_map,
    colour_of_name,
    font_file,
    number,
    readable,
    rgb,
    round_down,
    written,
)
from foamprb.view.flowfield import PLANE, QUANTITIES, STREAM_OPACITY, FlowField
from foamprb.view.geometry import FLAT_TYPES, Geometry
from foamprb.view.scene import (
    INSETS,
    MOST_TRAILS,
    SCALE_BAR,
    VIEW_ANGLE,
    Scene,
    anchor,
)
from foamprb.view.surfaces import bulges

if TYPE_CHECKING:
    from pyvista import Plotter

pyvista = load("pyvista")

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

PAGE_HEIGHT = 900.0
"""Height of a picture in which texts are as large as on the page."""
# Largest number of bodies, and steps around and from pole to pole of their spheres.
_SPHERES = ((300, 48, 24), (1_000, 24, 12), (5_000, 16, 9), (20_000, 12, 7), (math.inf, 6, 4))
_MOST_MARKED = 500
_MARK_WIDTH, _SPOT_WIDTH, _MARK_STEPS = 0.04, 0.3, 72
_BAR = 280.0
_FONT_FILE = 4
"""VTK's number of a font family that is a file."""
_UNKNOWN = 153
_TRAIL_OPACITY = 0.85
_HAZE, _HAZE_LENGTH = 0.3, 0.6
"""Largest share of the paper in colours, and how far behind the focus it is reached, in its distances."""
_NEAR_DEPOSITS = 0.35
"""Opacity of the near side of a wall that is coloured by its deposits."""
_LATER: dict[str, Any] = {"render": False, "reset_camera": False}
"""Options of the plotter: the picture is rendered once, by the camera of the scene."""


class Triangles(NamedTuple):
    """Triangulated part of the unit sphere."""

    points: Floats
    """(v, 3)."""
    triangles: Ints
    """(t, 3)."""


@dataclass
class Drawing:
    """Scene on a plotter, with the parts that change from time to time."""

    plotter: Plotter
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
            self.plotter.remove_actor(old, render=False)
        self._draw_trails(frame)
        if len(shown):
            colours = self._hazed(body_colours(scene, frame, shown), bodies.x[frame, shown])
            F = bodies.F[frame, shown].astype(np.float64)
            K = bulges(F, bodies.B[frame, shown]) if bodies.B is not None else None
            place, size = bodies.x[frame, shown], bodies.radius[shown] * scene.enlargement
            self._add("bodies", draw(sphere_for(len(shown)), place, F, size, colours, K))
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
            lines = pyvista.line_segments_from_points(points.reshape(-1, 3))
            colours[..., :3] = self._hazed(colours[..., :3], points)
            lines.point_data["colour"] = colours.reshape(-1, 4)
            self.plotter.add_mesh(
                lines, scalars="colour", rgb=True, lighting=False, line_width=2.2 * self.scale, name="trails",
                show_scalar_bar=False, **_LATER,
            )  # fmt: skip

    def _hazed(self, colours: Table, places: Floats) -> Table:
        """Return colours (…, 3) faded towards the paper at places (…, 3) beyond the focus."""
        eye = self.plotter.camera
        towards = np.subtract(eye.focal_point, eye.position)
        ahead = (places - eye.position) @ towards / (towards @ towards)
        share = _HAZE * np.clip((ahead - 1.0) / _HAZE_LENGTH, 0.0, 1.0)[..., None]
        hazed: Table = np.rint(colours + share * (np.array(rgb(self.style.paper)) - colours)).astype(np.uint8)
        return hazed

    def _add(self, name: str, mesh: Any) -> None:
        """Draw a mesh with its own colours, in the light of the bodies."""
        self.plotter.add_mesh(
            mesh, scalars="colour", rgb=True, smooth_shading=True, name=name, show_scalar_bar=False,
            ambient=0.36, diffuse=0.68, specular=0.25, specular_power=40.0, **_LATER,
        )  # fmt: skip

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
        for surface in scene.geometry.surfaces if scene.geometry is not None else ():
            if surface.type not in FLAT_TYPES:
                self._name(surface.name, anchor(surface, scene.camera))

    def _name(self, text: str, place: Floats) -> None:
        """Write the name of a patch on a pill above a place of the scene."""
        actor = pyvista.Text(f" {text} ")
        typeset(actor.prop)
        actor.GetPositionCoordinate().SetCoordinateSystemToWorld()
        actor.GetPositionCoordinate().SetValue(*place)
        actor.prop.font_size = max(6, round(12 * self.scale))
        actor.prop.justification_horizontal, actor.prop.justification_vertical = "center", "bottom"
        actor.prop.color, actor.prop.background_color = self.style.soft, self.style.paper
        actor.prop.background_opacity = 0.82
        self.plotter.add_actor(actor, name=f"patch {text}", **_LATER)

    def compass(self) -> None:
        """Draw axes and a scale bar in the lower right corner."""
        axes = self.plotter.add_axes(
            interactive=False, color=self.style.soft, line_width=2, viewport=(0.88, 0.08, 1.0, 0.3)
        )
        for name in "XYZ":
            typeset(getattr(axes, f"Get{name}AxisCaptionActor2D")().GetCaptionTextProperty())
        eye = self.plotter.camera
        width, height = (length / self.scale for length in self.plotter.window_size)
        distance = float(np.linalg.norm(np.subtract(eye.position, eye.focal_point)))
        pixel = 2.0 * distance * math.tan(math.radians(0.5 * eye.view_angle)) / height
        length = round_down(SCALE_BAR * pixel, (1, 2, 5))
        right, left = width - 20.0, width - 20.0 - length / pixel
        points = np.array([[left, 30.0, 0.0], [left, 26.0, 0.0], [right, 26.0, 0.0], [right, 30.0, 0.0]])
        self._write("scale", written(length, "m", length), 12, "center", height - 12.0, 0.5 * (left + right))
        actor = self._add_flat("scale bar", pyvista.lines_from_points(points * self.scale))
        actor.GetProperty().SetColor(*(c / 255.0 for c in rgb(self.style.ink)))
        actor.GetProperty().SetLineWidth(1.5 * self.scale)

    def _write(
        self, name: str, text: str, size: float, side: str, top: float, left: float = 22.0, bold: bool = False
    ) -> None:
        """Write a line; ``top`` and ``left`` are pixels of the page from the upper and the ``side`` edge."""
        width, height = self.plotter.window_size
        s = self.scale
        actor = pyvista.Text(
            text, position=(width - left * s if side == "right" else left * s, height - top * s)
        )
        typeset(actor.prop, bold)
        actor.prop.font_size = max(6, round(size * s))
        actor.prop.justification_horizontal = side
        actor.prop.color = self.style.ink if bold else self.style.soft
        self.plotter.add_actor(actor, name=name, **_LATER)

    def _bar(
        self, label: str, unit: str, limits: tuple[float, float], table: Table, left: float,
        extremes: tuple[float, float],
    ) -> float:  # fmt: skip
        """Draw a colour bar ``left`` pixels of the page from the left; return the position of the next one.

        Values beyond the limits are named by their extremes.
        """
        width, height = (length / self.scale for length in self.plotter.window_size)
        factor, shown_unit = readable(unit, max(map(abs, limits)))
        low, high = (value / factor for value in limits)
        title = label[:1].upper() + label[1:] + (f"  ({shown_unit})" if shown_unit else "")
        ends = [f"min {number(extremes[0] / factor, 2)}"] * (extremes[0] < limits[0])
        ends += [f"max {number(extremes[1] / factor, 2)}"] * (extremes[1] > limits[1])
        colours = np.column_stack([table, np.full(len(table), 255)]).astype(np.uint8)
        mapper = pyvista.DataSetMapper()
        mapper.lookup_table = pyvista.LookupTable(values=colours, scalar_range=(low, high))
        mapper.scalar_range = low, high
        self._write(f"{label} title", "  ".join([title, *ends]), 13, "left", height - 62.0, left, bold=True)
        for k, side in enumerate(("left", "center", "center", "center", "right")):
            value, at = low + 0.25 * k * (high - low), left + 0.25 * k * _BAR
            at = width - at if side == "right" else at
            self._write(f"{label} {k}", number(value, 3), 12, side, height - 12.0, at)
        # The title of the bar, blanks, is the name of its actor.
        self.plotter.add_scalar_bar(
            round(left) * " ", mapper=mapper, vertical=False, n_labels=0, position_x=left / width,
            position_y=30.0 / height, width=_BAR / width, height=62.0 / height, render=False,
        )  # fmt: skip
        return left + _BAR + 40.0

    def _names(self, codes: Codes) -> None:
        """Draw the colours of the names that occur."""
        present = [
            k for k in np.unique(codes.codes).tolist() if k < len(codes.meanings) and codes.meanings[k]
        ]
        names = [[codes.meanings[k], colour_of_name(k)] for k in present]
        legend = self.plotter.add_legend(
            names, bcolor=self.style.paper, background_opacity=0.82, face="rectangle", loc="lower left",
            size=(0.2, 0.035 * len(names)),
        )  # fmt: skip
        typeset(legend.GetEntryTextProperty())

    def _add_flat(self, name: str, data: Any) -> Any:
        """Draw a mesh in front of the scene, in pixels of the picture; return its actor."""
        actor = vtkActor2D()
        actor.SetMapper(vtkPolyDataMapper2D())
        actor.GetMapper().SetInputData(data)
        self.plotter.add_actor(actor, name=name, **_LATER)
        return actor

    def _show_deposits(self, frame: int) -> None:
        """Mark the deposits in front of everything."""
        bodies = self.scene.bodies
        stuck = [k for k, word in enumerate(bodies.status.meanings) if word == "stuck"]
        codes = bodies.status.codes
        rows = np.flatnonzero(bodies.present[frame] & np.isin(codes[min(frame, len(codes) - 1)], stuck))
        self.plotter.remove_actor("deposits", render=False)
        if len(rows) == 0:
            return
        actor = self._add_flat("deposits", pyvista.PolyData(bodies.x[frame, rows]))
        world = vtkCoordinate()
        world.SetCoordinateSystemToWorld()
        actor.GetMapper().SetTransformCoordinate(world)
        actor.GetProperty().SetColor(*(c / 255.0 for c in rgb(self.style.deposit)))
        actor.GetProperty().SetPointSize(6.0 * self.scale)


def typeset(text: Any, bold: bool = False) -> None:
    """Set the typeface of a text of VTK."""
    text.SetFontFamily(_FONT_FILE)
    text.SetFontFile(font_file(bold))


def picture(scene: Scene, path: Path, size: tuple[int, int], style: Style, texts: bool = True) -> None:
    """Write a picture of the scene's first time, ``.png``, in one step.

    Raises
    ------
    InputError
        If the name of the file has another ending.
    """
    if path.suffix.lower() != ".png":
        raise InputError(f"-png {path}: the name must end in .png.")
    with vtk_messages():
        drawing = _drawing(scene, size, style, texts)
        drawing.show(scene.first)
        image = drawing.plotter.screenshot(return_img=True)
        drawing.plotter.close()
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        load("PIL.Image").fromarray(image).save(file, format="png")


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
            drawing = _drawing(scene, even, style, texts=True)
            for frame in range(m):
                drawing.show(frame)
                drawing.plotter.render()
                writer.append_data(drawing.plotter.screenshot(return_img=True))
            drawing.plotter.close()
        temporary.replace(path)
    except (ImportError, ValueError) as error:
        # Without its encoder imageio does not support the format.
        raise InputError(
            f"-film {path}: {' '.join(str(error).split())}. Is 'foamprb[film]' installed?"
        ) from error
    finally:
        temporary.unlink(missing_ok=True)


def _drawing(scene: Scene, size: tuple[int, int], style: Style, texts: bool) -> Drawing:
    """Return the scene without its bodies."""
    plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting=None)
    plotter.set_background(style.paper)
    plotter.enable_anti_aliasing("msaa", multi_samples=8)
    light = vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetPosition(-0.35, 0.6, 0.72)
    plotter.renderer.AddLight(light)
    scale = size[1] / PAGE_HEIGHT
    drawing = Drawing(plotter, scene, texts, style, scale)
    if scene.geometry is not None:
        draw_geometry(plotter, scene.geometry, style, scene.most_dense if scene.painted else 0.0)
    if len(scene.edges):
        lines = pyvista.line_segments_from_points(scene.edges.reshape(-1, 3))
        plotter.add_mesh(lines, color=style.edge, line_width=1.0, lighting=False, **_LATER)
    if scene.flowfield is not None:
        draw_flow(plotter, scene.flowfield, style)
    if texts:
        drawing.label()
    _place_camera(plotter, scene, size, [inset * scale for inset in INSETS] if texts else [0.0, 0.0])
    if texts:
        drawing.compass()
    return drawing


def _place_camera(plotter: Plotter, scene: Scene, size: tuple[int, int], insets: list[float]) -> None:
    camera, eye = scene.camera, plotter.camera
    width, height = size
    above, below = insets
    free = max(0.3, 1.0 - (above + below) / height)
    distance = camera.distance(width / height, free)
    eye.view_angle = VIEW_ANGLE
    eye.focal_point = camera.focus
    eye.position = camera.focus + distance * camera.towards
    eye.up = camera.up
    # The scene is centred between the texts above and below.
    eye.SetWindowCenter(0.0, (above - below) / height)
    plotter.renderer.ResetCameraClippingRange()
    plotter.camera_set = True


def draw_geometry(plotter: Plotter, geometry: Geometry, style: Style, most_dense: float = 0.0) -> None:
    """Draw the far side of walls, and the near side and other patches almost transparent.

    Up to the density ``most_dense``, 1/m², if it is given, colours of walls tell that of their deposits.
    """
    for surface in geometry.surfaces:
        if surface.type in FLAT_TYPES:
            continue
        mesh = pyvista.PolyData.from_regular_faces(surface.points, surface.triangles)
        more = {"smooth_shading": True} | _LATER
        if kind_of_type(surface.type) is PatchKind.WALL:
            more["color"], opacity = style.glass, 0.1
            if most_dense > 0.0 and surface.density is not None:
                shares = np.clip(255.0 * surface.density / most_dense, 0, 255).astype(np.uint8)
                mesh.point_data["colour"] = colour_map(OF_DEPOSITS)[shares]
                more |= {"color": None, "scalars": "colour", "rgb": True, "show_scalar_bar": False}
                opacity = _NEAR_DEPOSITS
            plotter.add_mesh(mesh, culling="back", opacity=opacity, ambient=0.6, diffuse=0.4, **more)
            plotter.add_mesh(mesh, culling="front", ambient=0.8, diffuse=0.22, specular=0.0, **more)
        else:
            plotter.add_mesh(mesh, color=style.accent, opacity=0.07, ambient=1.0, diffuse=0.0, **more)


def draw_flow(plotter: Plotter, field: FlowField, style: Style) -> None:
    """Draw streamlines, faintly, and the plane through the flow, coloured by the speed."""
    if len(field.lines.points):
        lines = pyvista.line_segments_from_points(field.lines.segments.reshape(-1, 3))
        plotter.add_mesh(lines, color=style.soft, opacity=STREAM_OPACITY, lighting=False, **_LATER)
    if field.slice is not None:
        low, high = field.scales[PLANE].limits
        mesh = pyvista.PolyData.from_regular_faces(field.slice.points, field.slice.triangles)
        share = (field.slice.values[PLANE] - low) / ((high - low) or 1.0)
        mesh.point_data["colour"] = style.plane[np.clip(255.0 * share, 0, 255).astype(np.uint8)]
        plotter.add_mesh(mesh, scalars="colour", rgb=True, lighting=False, show_scalar_bar=False, **_LATER)


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
    ball = pyvista.Sphere(radius=1.0, theta_resolution=around, phi_resolution=down)
    points = np.asarray(ball.points, dtype=np.float64)
    return Triangles(
        points / np.linalg.norm(points, axis=1, keepdims=True), np.array(ball.regular_faces, dtype=np.int64)
    )


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
    faces = shape.triangles.astype(np.int32)[None] + (v * np.arange(n, dtype=np.int32))[:, None, None]
    mesh = pyvista.PolyData.from_regular_faces(points.reshape(-1, 3), faces.reshape(-1, 3))
    mesh.point_data["Normals"] = normals.reshape(-1, 3)
    mesh.point_data.active_normals_name = "Normals"
    mesh.point_data["colour"] = np.repeat(colours, v, axis=0)
    return mesh
