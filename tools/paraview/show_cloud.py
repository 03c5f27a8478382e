"""Show the soft particles of a run in ParaView (5.11 or newer): their bodies, coloured by deformation.

From a terminal::

    pvpython show_cloud.py CASE [--cloud softCloud] [--time T] [--scale S] [--view DIRECTION] [--zoom Z]
                           [--screenshot out.png] [--size 1600x900]

In ParaView's window: open the cloud's ``.pvd``, then run this file from Macros or from the Python shell's
Run Script.
"""

from __future__ import annotations

import argparse
import gzip
import math
import re
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

try:
    from paraview import servermanager, simple  # type: ignore[import-not-found]
except ImportError:
    servermanager = simple = None

# Codes of the point array "status".
ACTIVE, STUCK = 1, 2

# Of the walls' second longest side: diameter at rest with which bodies are drawn where no scale is asked for.
BODY_SIZE = 1 / 16
# Of the walls' second longest side: how much of a long pipe the camera looks at.
WINDOW_LENGTH = 3.5

VIEW_ANGLE, YAW, PITCH = 30.0, 32.0, 6.0
# Of the picture's width and height: what the case fills; captions and legend have the rest.
FILLED = (0.94, 0.72)
# Of a coordinate box: how much smaller the box along the principal axes must be to be taken instead.
TILTED = 0.8
DIRECTIONS = {sign + axis: k for axis, k in zip("xyz", np.eye(3), strict=True) for sign in ("", "+")} | {
    "-" + axis: -k for axis, k in zip("xyz", np.eye(3), strict=True)
}
MANY_BODIES = 5000

INK = (0.13, 0.15, 0.18)
PAPER = (1.0, 1.0, 1.0)
GLASS = (0.86, 0.91, 0.95)
EDGE = (0.55, 0.6, 0.65)

Vector = NDArray[np.float64]
NO_POINTS = np.empty((0, 3))


class Scene(NamedTuple):
    """What is shown; a source is None where the run has nothing to show by it."""

    view: Any
    walls: Any
    cloud: Any
    bodies: Any
    scale: float


class Camera(NamedTuple):
    """Where the user wants to look from: a direction that points to the camera, if any; and how near."""

    direction: tuple[float, float, float] | None = None
    zoom: float = 1.0


def show(
    case: Path,
    name: str = "softCloud",
    time: float | None = None,
    scale: float | None = None,
    camera: Camera = Camera(),  # noqa: B008
    copies: bool = False,
) -> Scene:
    """Build the picture of a run in the active view.

    Parameters
    ----------
    case
        Folder of the OpenFOAM case.
    name
        The cloud.
    time
        Time, s: the nearest that was written is shown; the last one by default.
    scale
        How many times larger the bodies are drawn; by default such that they can be seen.
    camera
        From where to look; by default at the plane of a two-dimensional case, else at the longest side.
    copies
        Whether the graphics card draws the bodies as copies of one sphere, for many of them.
    """
    simple._DisableFirstRenderCameraReset()
    view = simple.GetActiveViewOrCreate("RenderView")
    walls = read_walls(case)
    cloud = read_cloud(case, name)
    if walls is None and cloud is None:
        raise SystemExit(f"{case}: neither an OpenFOAM mesh nor a cloud '{name}' here.")
    show_walls(walls, view)
    if cloud is None:
        annotate(f"No cloud '{name}' here: run foamprb first", view, "Upper Right Corner")
        look_at(case, walls, NO_POINTS, view, camera)
        return Scene(view, walls, None, None, 1.0)

    select_time(cloud, time)
    shown = simple.Threshold(
        registrationName="active or stuck",
        Input=cloud,
        Scalars=["POINTS", "status"],
        LowerThreshold=ACTIVE,
        UpperThreshold=STUCK,
    )
    shown.UpdatePipeline(view.ViewTime)
    points, deformation = positions(shown), point_array(shown, "taylorDeformation")
    if scale is None:
        scale = automatic_scale(point_array(cloud, "d"), outline(walls, positions(cloud)))
    # Tensor Glyph calls an empty input an error.
    bodies = None
    if len(points):
        bodies = shown if copies else draw_bodies(shown, scale, len(points))
        show_bodies(bodies, deformation.max(), view)
        if copies:
            show_as_copies(simple.GetDisplayProperties(bodies, view), scale, len(points))
        else:
            # ParaView chooses another factor when it shows a filter that was given 1.
            bodies.ScaleFactor = scale
    annotate_time(cloud, view)
    annotate(caption(scale, len(points)), view, "Upper Right Corner")
    look_at(case, walls, points, view, camera)
    return Scene(view, walls, cloud, bodies, scale)


def read_walls(case: Path) -> Any:
    """Return boundary faces of the case's walls (of all patches without walls), or None without a mesh."""
    patches = patch_types(mesh_folder(case))
    if not (case / "system" / "controlDict").is_file() or not patches:
        say(f"{case}: no system/controlDict or no mesh; the walls are not shown.")
        return None
    names = [name for name, kind in patches.items() if kind == "wall"] or list(patches)
    walls = read_patches(case, names, "walls")
    # The flow's times would make ParaView's clock run to the last iteration of a steady solver.
    simple.GetTimeKeeper().SuppressedTimeSources = [walls]
    return walls


def read_patches(case: Path, names: list[str], title: str) -> Any:
    """Return the boundary faces of some patches of the case's mesh."""
    # The reader takes controlDict for the case, so that no .foam file has to be left there.
    patches = simple.OpenFOAMReader(registrationName=title, FileName=str(case / "system" / "controlDict"))
    patches.CaseType = "Decomposed Case" if is_decomposed(case) else "Reconstructed Case"
    patches.MeshRegions = [f"patch/{name}" for name in names]
    patches.CellArrays = []
    patches.UpdatePipeline()
    return patches


def is_decomposed(case: Path) -> bool:
    """Return whether the mesh is in processor folders only."""
    return not (case / "constant" / "polyMesh").is_dir()


def mesh_folder(case: Path) -> Path:
    """Return the folder of the mesh, or of the first processor's part of it."""
    return case / ("processor0" if is_decomposed(case) else "") / "constant" / "polyMesh"


def plane_normal(case: Path) -> Vector | None:
    """Return the normal of a two-dimensional case by its ``empty`` or ``wedge`` patches, else None."""
    names = [name for name, kind in patch_types(mesh_folder(case)).items() if kind in ("empty", "wedge")]
    if not names or not (case / "system" / "controlDict").is_file():
        return None
    patches = read_patches(case, names, "planes")
    merged = simple.MergeBlocks(Input=patches)
    merged.UpdatePipeline()
    data = servermanager.Fetch(merged)
    normal = None
    if data.GetNumberOfCells():
        face = vtk_to_numpy(data.GetCell(0).GetPoints().GetData()).astype(float)
        vector = sum(np.cross(face[i] - face[0], face[i + 1] - face[0]) for i in range(1, len(face) - 1))
        normal = vector / np.linalg.norm(vector)
    simple.Delete(merged)
    simple.Delete(patches)
    return normal


def patch_types(mesh: Path) -> dict[str, str]:
    """Return the type of each patch by name, by ``polyMesh/boundary``; {} without that file."""
    for file, opener in ((mesh / "boundary", open), (mesh / "boundary.gz", gzip.open)):
        if file.is_file():
            with opener(file, "rt", encoding="utf-8", errors="replace") as stream:
                text = re.sub(r"//[^\n]*|/\*.*?\*/", "", stream.read(), flags=re.DOTALL)
            entries = re.findall(r"([^\s{}();]+)\s*\{([^{}]*)\}", text)
            kinds = {
                name: re.search(r"\btype\s+(\w+)\s*;", body) for name, body in entries if name != "FoamFile"
            }
            return {name: kind[1] for name, kind in kinds.items() if kind and kind[1] != "processor"}
    return {}


def read_cloud(case: Path, name: str) -> Any:
    """Return the time series of a cloud, or None without results."""
    folder = case / "postProcessing" / name
    pvd = folder / f"{name}.pvd"
    if not pvd.is_file():
        others = sorted(path.stem for path in case.glob("postProcessing/*/*.pvd"))
        hint = f"There is: {', '.join(others)} (--cloud)." if others else "Run foamprb first."
        say(f"{pvd}: no such file, so no particles are shown. {hint}")
        return None
    cloud = simple.PVDReader(registrationName=name, FileName=str(pvd))
    cloud.UpdatePipelineInformation()
    return cloud


def select_time(cloud: Any, time: float | None) -> None:
    """Set ParaView's clock to the written time that is nearest, or to the last."""
    times = list(cloud.TimestepValues)
    nearest = times[-1] if time is None else min(times, key=lambda t: abs(t - time))
    if time is not None and not math.isclose(nearest, time, rel_tol=1e-9, abs_tol=1e-15):
        say(f"Time {time:g} s was not written; the nearest is {nearest:g} s.")
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = nearest
    cloud.UpdatePipeline(nearest)


def positions(cloud: Any) -> Vector:
    """Return positions of the particles of a source, shape (n, 3), m."""
    points = servermanager.Fetch(cloud).GetPoints()
    return vtk_to_numpy(points.GetData()) if points and points.GetNumberOfPoints() else NO_POINTS


def point_array(cloud: Any, name: str) -> Vector:
    """Return a point array of the particles of a source, shape (n,)."""
    array = servermanager.Fetch(cloud).GetPointData().GetArray(name)
    return vtk_to_numpy(array) if array and array.GetNumberOfTuples() else np.empty(0)


def automatic_scale(diameters: Vector, corners: Vector) -> float:
    """Return a round magnification: bodies at rest are visible and mostly do not overlap."""
    sides = np.sort(np.linalg.norm(corners[[4, 2, 1]] - corners[0], axis=1))
    if len(diameters) == 0 or not sides[0] > 0:
        return 1.0
    spacing = (sides.prod() / len(diameters)) ** (1 / 3)
    return max(1.0, round_down(min(BODY_SIZE * sides[1], spacing / 2) / np.median(diameters)))


def round_down(value: float) -> float:
    """Return the largest of 1, 2, 3, 4, 5, 6, 8 times a power of ten not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(digit for digit in (1, 2, 3, 4, 5, 6, 8) if digit * power <= value * (1 + 1e-12)) * power


def round_up(value: float) -> float:
    """Return the least one-digit multiple of a power of ten not below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return math.ceil(value / power * (1 - 1e-12)) * power


def draw_bodies(cloud: Any, scale: float, count: int) -> Any:
    """Return the deformed, enlarged bodies: the unit sphere under R F, whose columns ``glyph`` holds."""
    bodies = simple.TensorGlyph(
        registrationName="bodies",
        Input=cloud,
        GlyphType="Sphere",
        Tensors=["POINTS", "glyph"],
        Scalars=["POINTS", "taylorDeformation"],
        ExtractEigenvalues=0,
        LimitScalingByEigenvalues=0,
        ScaleFactor=scale,
    )
    bodies.GlyphType.Radius = 1.0
    bodies.GlyphType.ThetaResolution, bodies.GlyphType.PhiResolution = resolution(count)
    return bodies


def show_as_copies(display: Any, scale: float, count: int) -> None:
    """Draw a sphere at each point, with its semi-axes and orientation, by the graphics card."""
    display.SetRepresentationType("3D Glyphs")
    display.GlyphType = "Sphere"
    display.GlyphType.Radius = 1.0
    display.GlyphType.ThetaResolution, display.GlyphType.PhiResolution = resolution(count)
    display.ScaleMode, display.SelectScaleArray, display.Scaling = "Vector Components", "semiAxes", 1
    display.OrientationMode, display.SelectOrientationVectors = "Quaternion", "orientation"
    display.Orient = 1
    display.ScaleFactor = scale


def resolution(count: int) -> tuple[int, int]:
    """Return facets of a body around and along its axis, fewer for many bodies."""
    return (16, 9) if count > MANY_BODIES else (48, 25)


def show_bodies(bodies: Any, largest: float, view: Any) -> None:
    """Colour the bodies from 0 to a round number above the largest deformation, with a colour bar."""
    display = simple.Show(bodies, view)
    simple.ColorBy(display, ("POINTS", "taylorDeformation"))
    display.Specular = 0.35
    display.SpecularPower = 40
    display.Ambient = 0.12
    colours = simple.GetColorTransferFunction("taylorDeformation")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    top = round_up(largest) if largest > 0 else 1.0
    colours.RescaleTransferFunction(0.0, top)
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.Title = "Taylor deformation (a − c)/(a + c)"
    bar.ComponentTitle = ""
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Any Location"
    bar.Position = [0.62, 0.045]
    bar.ScalarBarLength = 0.33
    bar.ScalarBarThickness = 14
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize = bar.LabelFontSize = 18
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.2g"
    bar.UseCustomLabels, bar.CustomLabels = 1, ticks(top)
    bar.AddRangeLabels = 0


def ticks(top: float) -> list[float]:
    """Round numbers from 0 to ``top``, of one digit, so few that their texts do not overlap."""
    power = 10.0 ** math.floor(math.log10(top * (1 + 1e-12)))
    digit = round(top / power)
    step = 0.5 if digit <= 2 else 1.0 if digit <= 5 else 2.0
    return [k * step * power for k in range(math.floor(digit / step) + 1)]


def show_walls(walls: Any, view: Any) -> None:
    """Draw the walls as glass, their far side too, with their edges: a plane shows nothing else of them."""
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = PAPER
    view.OrientationAxesVisibility = 0
    if walls is None:
        return
    # Two copies, as a source has one display: an opaque far half behind the bodies, a hint of the near one.
    far = smooth(walls)
    near = simple.ExtractSurface(registrationName="near side", Input=far)
    for side, culled, opacity in ((far, "Cull Frontface", 1.0), (near, "Cull Backface", 0.1)):
        display = simple.Show(side, view)
        display.ColorArrayName = ["POINTS", ""]
        display.SetRepresentationType("Surface")
        display.AmbientColor = display.DiffuseColor = GLASS
        display.BackfaceRepresentation = culled
        display.Opacity = opacity
        display.Ambient, display.Diffuse, display.Specular = 0.45, 0.55, 0.2
        display.Pickable = 0
    edges = simple.FeatureEdges(registrationName="edges", Input=near)
    display = simple.Show(edges, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = EDGE
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.LineWidth = 1.5
    display.Pickable = 0


def smooth(walls: Any) -> Any:
    """Return the walls with normals for smooth shading, by the filter's name in this ParaView."""
    normals = getattr(simple, "SurfaceNormals", None) or simple.GenerateSurfaceNormals
    return normals(registrationName="far side", Input=walls)


def annotate(text: str, view: Any, where: str) -> None:
    """Write a line in a corner of the view."""
    source = simple.Text(registrationName="caption", Text=text)
    style_text(simple.Show(source, view), where)


def annotate_time(cloud: Any, view: Any) -> None:
    """Write the time in the upper left corner; it follows ParaView's clock."""
    source = simple.AnnotateTimeFilter(registrationName="time", Input=cloud, Format="t = {time:.4g} s")
    style_text(simple.Show(source, view), "Upper Left Corner")


def style_text(display: Any, where: str) -> None:
    """Place and colour a text."""
    display.WindowLocation = where
    display.Color = INK
    display.FontSize = 20


def caption(scale: float, count: int) -> str:
    """Return the number of bodies and the scale of the drawing as text."""
    bodies = f"{count} {'body' if count == 1 else 'bodies'}"
    return f"{bodies}, drawn {scale:g} times larger" if scale != 1.0 else f"{bodies}, drawn to scale"


def look_at(case: Path, walls: Any, points: Vector, view: Any, camera: Camera) -> None:
    """Point the camera so that the case fills the picture.

    A two-dimensional case is seen along the normal of its plane, without perspective. Of any other the long
    axis is seen from the side, a little from above and from one end, gravity down; of a long one the stretch
    that holds most of the points.
    """
    corners = outline(walls, points)
    up = -gravity(case) / np.linalg.norm(gravity(case))
    normal = plane_normal(case) if walls is not None else None
    flat = normal is not None and camera.direction is None
    focus = corners.mean(axis=0)
    if camera.direction is not None:
        towards = np.array(camera.direction) / np.linalg.norm(camera.direction)
    elif normal is not None:
        # The side from which the first two of the remaining axes make a right-handed picture.
        towards = normal * np.sign(normal[np.argmax(abs(normal))])
        towards = -towards if np.argmax(abs(normal)) == 1 else towards
    else:
        axis, up, side = camera_frame(corners, up)
        length = float(np.ptp(corners @ axis))
        width = np.sort(np.ptp(corners @ np.array([axis, up, side]).T, axis=0))[1]
        window = min(length, WINDOW_LENGTH * width)
        middle = densest(points @ axis, window, corners @ axis)
        corners = corners + np.outer(np.clip(corners @ axis, middle - window / 2, middle + window / 2), axis)
        corners = corners - np.outer(outline(walls, points) @ axis, axis)
        focus = corners.mean(axis=0)
        yaw, pitch = np.radians((YAW, PITCH))
        towards = math.cos(pitch) * (math.cos(yaw) * side - math.sin(yaw) * axis) + math.sin(pitch) * up
    up = upright(up, towards)
    right = np.cross(up, towards)
    width, height = view.ViewSize
    # Half of the picture's height that the corners want, and how far they are before the focus.
    offsets = corners - focus
    half = (
        np.maximum(abs(offsets @ right) / FILLED[0] * height / width, abs(offsets @ up) / FILLED[1])
        / camera.zoom
    )
    tangent = math.tan(math.radians(VIEW_ANGLE / 2))
    distance = float((offsets @ towards + half / tangent).max())
    if flat:
        distance = float(half.max() / tangent + np.ptp(offsets @ towards))
    view.CameraParallelProjection = int(flat)
    view.CameraParallelScale = float(half.max())
    view.CameraViewAngle = VIEW_ANGLE
    view.CameraFocalPoint = focus
    view.CameraPosition = focus + distance * towards
    view.CameraViewUp = up
    view.CenterOfRotation = focus


def outline(walls: Any, points: Vector) -> Vector:
    """Return the eight corners of a box around the walls, or else the points; shape (8, 3), m.

    Its sides are parallel to the coordinate axes, unless the walls fit much better into another box.
    """
    if walls is not None:
        low, high = np.reshape(walls.GetDataInformation().GetBounds(), (3, 2)).T
        merged = simple.MergeBlocks(Input=walls)
        merged.UpdatePipeline()
        found = positions(merged).astype(float)
        simple.Delete(merged)
    elif len(points) < 2:
        low, high = np.array([[-0.5], [0.5]]) + (points[0] if len(points) else np.zeros(3))
        found = NO_POINTS
    else:
        low, high, found = points.min(axis=0), points.max(axis=0), NO_POINTS
    signs = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    box = low + signs * (high - low)
    if len(found) < 4:
        return box
    axes = np.linalg.svd(found - found.mean(axis=0), full_matrices=False)[2]
    places = found @ axes.T
    sides = np.ptp(places, axis=0)
    if sides.prod() > TILTED * (high - low).prod():
        return box
    return (places.min(axis=0) + signs * sides) @ axes


def camera_frame(corners: Vector, up: Vector) -> tuple[Vector, Vector, Vector]:
    """Return unit vectors to the right, up and towards the camera: long side horizontal if possible.

    Parameters
    ----------
    corners
        The eight of :func:`outline`.
    up
        Unit vector against gravity.
    """
    edges = corners[[4, 2, 1]] - corners[0]
    lengths = np.linalg.norm(edges, axis=1)
    axes = [edges[k] / max(lengths[k], 1e-300) for k in np.argsort(lengths)[::-1]]
    axis = axes[0] if abs(axes[0] @ up) <= 0.9 else axes[1]
    axis = axis * (np.sign(axis[np.argmax(abs(axis))]) or 1.0)
    axis = axis - (axis @ up) * up
    axis = axis / np.linalg.norm(axis)
    return axis, up, np.cross(axis, up)


def upright(up: Vector, towards: Vector) -> Vector:
    """Return the unit vector upwards in the picture: ``up``, or y, or z when looking along it."""
    for choice in (up, np.eye(3)[1], np.eye(3)[2]):
        across = choice - (choice @ towards) * towards
        if np.linalg.norm(across) > 0.3:
            break
    return across / np.linalg.norm(across)


def gravity(case: Path) -> Vector:
    """Return gravity from ``constant/g``, m/s2; along −z without the file."""
    file = case / "constant" / "g"
    text = file.read_text(encoding="utf-8", errors="replace") if file.is_file() else ""
    found = re.search(r"\bvalue\s*\(\s*(\S+)\s+(\S+)\s+([^\s)]+)\s*\)", text)
    try:
        g = np.array([float(number) for number in found.groups()]) if found else np.zeros(3)
    except ValueError:
        g = np.zeros(3)
    return g if g.any() else np.array([0.0, 0.0, -9.81])


def densest(places: Vector, window: float, ends: Vector) -> float:
    """Return the centre of the interval of length ``window`` that contains most of the places."""
    low, high = ends.min() + window / 2, ends.max() - window / 2
    if len(places) == 0 or high <= low:
        return float(ends.mean())
    places = np.sort(places)
    held = np.searchsorted(places, places + window, side="right") - np.arange(len(places))
    return float(np.clip(places[held.argmax()] + window / 2, low, high))


def say(message: str) -> None:
    """Print a message at once, also where ParaView's window shows it."""
    print(message, flush=True)


def case_of_active_source() -> Path:
    """Return the case of the active source of ParaView's window; else the working folder."""
    source = simple.GetActiveSource()
    file = getattr(source, "FileName", None) if source else None
    for folder in Path(str(file)).resolve().parents if file else ():
        if (folder / "system" / "controlDict").is_file():
            return folder
    return Path.cwd()


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("case", type=Path, metavar="CASE", help="folder of the OpenFOAM case")
    parser.add_argument("--cloud", default="softCloud", help="name of the cloud (default: softCloud)")
    parser.add_argument("--time", type=float, help="time to show, s (default: the last)")
    parser.add_argument(
        "--scale", type=float, help="draw the bodies this many times larger (default: automatic)"
    )
    parser.add_argument(
        "--view",
        type=direction,
        metavar="DIRECTION",
        help="look from there: x, -x, y, -y, z, -z or a vector like 1,0.5,2 (default: by the geometry)",
    )
    parser.add_argument(
        "--zoom", type=magnification, default=1.0, help="come nearer by this factor (default: 1)"
    )
    parser.add_argument(
        "--copies",
        action="store_true",
        help="let the graphics card draw copies of a sphere, for many bodies",
    )
    parser.add_argument("--screenshot", type=Path, help="write this picture and stop")
    parser.add_argument("--size", type=picture_size, default=(1600, 900), help="of the picture, as 1600x900")
    return parser.parse_args(arguments)


def picture_size(text: str) -> tuple[int, int]:
    """Read a size like 1600x900."""
    found = re.fullmatch(r"([1-9]\d*)x([1-9]\d*)", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"'{text}' is not a size like 1600x900")
    return int(found[1]), int(found[2])


def direction(text: str) -> tuple[float, float, float]:
    """Read a direction like -y or 1,0.5,2."""
    if text in DIRECTIONS:
        x, y, z = DIRECTIONS[text]
        return float(x), float(y), float(z)
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        x = y = z = 0.0
    if not 0.0 < math.hypot(x, y, z) < math.inf:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not one of x, -x, y, -y, z, -z or a vector like 1,0.5,2"
        )
    return x, y, z


def magnification(text: str) -> float:
    """Read a number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number > 0")
    return value


def main(arguments: list[str]) -> None:
    """Show a run in a window of its own, or write its picture."""
    options = parse(arguments)
    if simple is None:
        raise SystemExit("show_cloud.py needs ParaView: pvpython show_cloud.py CASE")
    if not options.case.is_dir():
        raise SystemExit(f"{options.case}: no such folder.")
    view = simple.CreateView("RenderView")
    view.ViewSize = options.size
    camera = Camera(options.view, options.zoom)
    show(options.case.resolve(), options.cloud, options.time, options.scale, camera, options.copies)
    if options.screenshot:
        simple.SaveScreenshot(str(options.screenshot), view, ImageResolution=options.size)
    else:
        simple.Interact(view)


if __name__ == "__main__":
    # Only pvpython puts the script's own name first.
    if sys.argv and sys.argv[0].endswith(".py"):
        main(sys.argv[1:])
    else:
        show(case_of_active_source())
        simple.Render()
