"""State file of ParaView that shows the scene of a run: ``<cloud>.py``, for File > Load State."""

from __future__ import annotations

from inspect import getsource
from textwrap import fill

import numpy as np

from foamprb.body.quadratic import layers
from foamprb.cloud.state import Status
from foamprb.results.atomic import write_text
from foamprb.results.folder import ResultsFolder
from foamprb.results.shapes import DERIVED, SOURCES, derived
from foamprb.results.vtk import write_triangles
from foamprb.view.colours import LIGHT, colour_map, in_ascii, rgb
from foamprb.view.geometry import FLAT_TYPES
from foamprb.view.scene import VIEW_ANGLE, Scene, anchor
from foamprb.view.surfaces import MODE, bulges, unfolded

_ASPECT = 4 / 3
"""Ratio of width to height for which the camera shows the whole scene."""

_PALETTE = ("paper", "ink", "soft", "glass", "deposit")
_LINE = 60
"""Most letters of a line of the title."""
_TEXT = """\
# State of ParaView 5.11 or newer, by foamprb paraview: File > Load State, or paraview --script=THIS_FILE.
# Shows the scene of foamprb view: deformed bodies, enlarged, the walls, and the paths of particleTracks.
from pathlib import Path

from paraview import simple

CLOUD = {cloud!r}
TIME = {time!r}
ENLARGEMENT = {enlargement!r}
COLOURS = {colours!r}
# Position on the range of the colours, red, green and blue.
MAP = {map!r}
TITLE, CAPTION = {title!r}, {caption!r}
NAMES = {names!r}
PAPER, INK, SOFT, GLASS, DEPOSIT = {palette!r}
POSITION, FOCUS, UP = {position!r}, {focus!r}, {up!r}
# More bodies than this are drawn by the graphics card as copies of one sphere, from semiAxes and orientation.
# Fewer bodies are made one by one from glyph, so that a point of the surface keeps its place on the body.
# They have their quadratic mode, if the files contain it. 0: always as copies.
MANY = 20000
# Arrays that follow from the shape, where the files do not contain them.
SHAPES = {shapes!r}
# Surfaces of bodies with the quadratic mode, after ENLARGEMENT = … and STEPS = ….
SURFACES = {surfaces!r}
# ParaView may run this text without the name of its file.
FILE = globals().get("__file__", {file!r})
folder = Path(FILE).resolve().parent
if not folder.is_dir():
    raise FileNotFoundError(f"no folder {{folder}}: set FILE in this script to its present path")
view = simple.GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground, view.Background = 0, PAPER
# From the upper left behind the camera.
view.UseLight = 0
light = simple.CreateLight()
light.Coords, light.Position, light.FocalPoint = "Camera", [-0.35, 0.6, 0.72], [0, 0, 0]
view.AdditionalLights = light

series = simple.PVDReader(registrationName=CLOUD, FileName=str(folder / (CLOUD + ".pvd")))
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = view.ViewTime = TIME
shaped = simple.ProgrammableFilter(registrationName="shapes", Input=series, CopyArrays=1, Script=SHAPES)
# Bodies that have left the flow, or failed, are not shown.
cloud = simple.Threshold(registrationName="shown", Input=shaped)
cloud.Scalars = ["POINTS", "status"]
cloud.ThresholdMethod = "Between"
cloud.LowerThreshold, cloud.UpperThreshold = {shown!r}
cloud.UpdatePipeline(TIME)

count = cloud.GetDataInformation().GetNumberOfPoints()
if count <= MANY and {mode!r} in cloud.PointData.keys():
    bodies = simple.ProgrammableFilter(registrationName="bodies", Input=cloud)
    bodies.OutputDataSetType = "vtkPolyData"
    bodies.Script = f"ENLARGEMENT = {{ENLARGEMENT}}\\nSTEPS = {{8 if count > 5000 else 24}}\\n" + SURFACES
    shown, sphere = simple.Show(bodies, view), None
elif count > MANY:
    bodies = cloud
    shown = simple.Show(cloud, view)
    shown.SetRepresentationType("3D Glyphs")
    shown.GlyphType = "Sphere"
    shown.ScaleMode, shown.SelectScaleArray, shown.Scaling = "Vector Components", "semiAxes", 1
    shown.OrientationMode, shown.SelectOrientationVectors, shown.Orient = "Quaternion", "orientation", 1
    shown.ScaleFactor = ENLARGEMENT
    sphere = shown.GlyphType
else:
    bodies = simple.TensorGlyph(
        registrationName="bodies",
        Input=cloud,
        GlyphType="Sphere",
        Tensors=["POINTS", "glyph"],
        Scalars=["POINTS", "taylorDeformation"],
        ExtractEigenvalues=0,
        LimitScalingByEigenvalues=0,
    )
    sphere = bodies.GlyphType
if sphere:
    # Fewer facets for more bodies.
    sphere.Radius = 1.0
    sphere.ThetaResolution = sphere.PhiResolution = 8 if count > 5000 else 24
if sphere and bodies is not cloud:
    # ParaView changes the factor when it makes the filter, even a given factor of 1.
    bodies.UpdatePipeline(TIME)
    bodies.ScaleFactor = ENLARGEMENT
    shown = simple.Show(bodies, view)
    bodies.ScaleFactor = ENLARGEMENT
shown.Ambient, shown.Diffuse, shown.Specular, shown.SpecularPower = 0.36, 0.68, 0.25, 40.0
simple.ColorBy(shown, ("POINTS", "taylorDeformation"))
colours = simple.GetColorTransferFunction("taylorDeformation")
colours.ColorSpace = "RGB"
colours.RGBPoints = [number for row in MAP for number in row]
colours.RescaleTransferFunction(*COLOURS)
shown.SetScalarBarVisibility(view, True)
bar = simple.GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle, bar.Orientation = "Taylor deformation", "", "Vertical"
# Beside the scene, which leaves the right of a wide picture. Labels at round numbers only: those of the ends
# are 0.0e+00 and 6.0e-01.
bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.9, 0.3], 0.4
bar.AddRangeLabels = 0
bar.TitleColor = bar.LabelColor = INK
bar.TitleFontSize = bar.LabelFontSize = 14

# A cage of wire around each body that is stuck.
stuck = simple.Threshold(registrationName="stuck", Input=cloud)
stuck.Scalars, stuck.ThresholdMethod = ["POINTS", "status"], "Between"
stuck.LowerThreshold = stuck.UpperThreshold = {stuck!r}
deposits = simple.Glyph(registrationName="deposits", Input=stuck, GlyphType="Sphere", GlyphMode="All Points")
deposits.OrientationArray, deposits.ScaleArray = ["POINTS", "No orientation array"], ["POINTS", "d"]
deposits.ScaleFactor = 2 * ENLARGEMENT
halo = simple.Show(deposits, view)
halo.Representation, halo.LineWidth, halo.ColorArrayName = "Wireframe", 2.0, [None, ""]
halo.AmbientColor = halo.DiffuseColor = DEPOSIT

files = [("walls", folder / "walls.vtp"), ("near walls", folder / "walls.vtp")]
for name, file in [*files, *(("paths", file) for file in sorted(folder.glob("*/tracks.vtp")))]:
    reader = simple.XMLPolyDataReader(registrationName=name, FileName=[str(file)])
    drawn = simple.Show(reader, view)
    # ColorBy(drawn, None) fails where nothing was coloured before.
    drawn.ColorArrayName = [None, ""]
    if name == "paths":
        drawn.AmbientColor = drawn.DiffuseColor = INK
        drawn.Opacity = 0.3
        continue
    # The far side is opaque, the near side almost transparent.
    drawn.AmbientColor = drawn.DiffuseColor = GLASS
    drawn.Ambient, drawn.Diffuse = 0.8, 0.22
    drawn.BackfaceRepresentation = "Cull Frontface" if name == "walls" else "Cull Backface"
    drawn.Opacity = 1.0 if name == "walls" else 0.1

for name, place in NAMES:
    label = simple.Show(simple.Text(registrationName="name of " + name, Text=" " + name + " "), view)
    label.TextPropMode, label.BillboardPosition = "Billboard 3D Text", place
    label.Color, label.FontSize = SOFT, 12
for name, text, corner in (("title", TITLE, "Upper Left"), ("enlargement", CAPTION, "Upper Right")):
    note = simple.Show(simple.Text(registrationName=name, Text=text), view)
    note.WindowLocation, note.Color, note.FontSize = corner + " Corner", INK, 14
    note.Justification = corner.split()[1]
# ParaView moves the camera at the first rendering.
simple.Render(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = POSITION, FOCUS, UP
view.CameraViewAngle = {angle!r}
simple.Render(view)
"""

_IMPORTS = "from __future__ import annotations\n\nimport numpy as np\n\n"
_SHAPES = """\
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
arrays, scope = output.VTKObject.GetPointData(), {{}}
exec({function!r}, scope)
names = [name for name in {names!r} if not arrays.HasArray(name)]
sources = [vtk_to_numpy(arrays.GetArray(name)) for name in {sources!r}]
for name, values in scope["derived"](*sources, names).items():
    added = numpy_to_vtk(values.copy(), deep=1)
    added.SetName(name)
    arrays.AddArray(added)
"""

_SURFACES = """\
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
scope = {{}}
exec({functions!r}, scope)
import numpy as np
cloud = inputs[0].VTKObject
arrays, n = cloud.GetPointData(), cloud.GetNumberOfPoints()
source = vtkSphereSource()
source.SetRadius(1.0)
source.SetThetaResolution(STEPS)
source.SetPhiResolution(STEPS)
source.Update()
X = vtk_to_numpy(source.GetOutput().GetPoints().GetData()).astype(float)
triangles = vtk_to_numpy(source.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
glyph, d, B = (vtk_to_numpy(arrays.GetArray(name)) if n else np.zeros((0, size))
               for name, size in (("glyph", 9), ("d", 1), ({mode!r}, 7)))
radius = 0.5 * d.astype(float).reshape(-1, 1, 1)
F = glyph.reshape(-1, 3, 3).astype(float).swapaxes(1, 2) / radius
offsets = X @ F.swapaxes(1, 2)
finite = np.isfinite(F).all(axis=(1, 2))
K = scope["bulges"](F[finite], scope["unfolded"](F[finite], B[finite]))
offsets[finite] += np.einsum("nijk,vj,vk->nvi", K, X, X, optimize=True)
centres = vtk_to_numpy(cloud.GetPoints().GetData()).astype(float) if n else np.zeros((0, 3))
surface, points, cells = output.VTKObject, vtkPoints(), vtkCellArray()
places = centres[:, None] + ENLARGEMENT * radius * offsets
points.SetData(numpy_to_vtk(np.ascontiguousarray(places.reshape(-1, 3)), deep=1))
corners = (triangles[None] + len(X) * np.arange(n)[:, None, None]).reshape(-1)
cells.SetData(numpy_to_vtkIdTypeArray(3 * np.arange(len(corners) // 3 + 1), deep=1),
              numpy_to_vtkIdTypeArray(corners, deep=1))
surface.SetPoints(points)
surface.SetPolys(cells)
for k in range(arrays.GetNumberOfArrays()):
    values = arrays.GetArray(k)
    repeated = numpy_to_vtk(np.repeat(vtk_to_numpy(values), len(X), axis=0), deep=1)
    repeated.SetName(values.GetName())
    surface.GetPointData().AddArray(repeated)
"""


def _script_of_surfaces() -> str:
    """Return the script of a filter that makes the surfaces of bodies with a quadratic mode."""
    functions = "\n\n".join(getsource(function) for function in (layers, unfolded, bulges))
    return _SURFACES.format(functions=f"{_IMPORTS}{functions}", mode=MODE)


def _script_of_shapes() -> str:
    """Return the script of a filter that adds the arrays that follow from the shape."""
    function = f"{_IMPORTS}{getsource(derived)}"
    return _SHAPES.format(function=function, names=tuple(DERIVED), sources=SOURCES)


def _colours(scene: Scene) -> list[tuple[float, ...]]:
    """Return the colours of the page: places from 0 to 1, and red, green and blue."""
    table = colour_map(scene.map_name) / 255.0
    return [(k / 255.0, *map(float, np.round(table[k], 4))) for k in range(0, 256, 15)]


def write_state(folder: ResultsFolder, scene: Scene) -> None:
    """Write the state file of a scene and the walls that it reads, each in one step."""
    camera = scene.camera
    surfaces = scene.geometry.surfaces if scene.geometry is not None else ()
    drawn = [s for s in surfaces if s.type not in FLAT_TYPES]
    corners = [s.points[s.triangles] for s in drawn]
    position = camera.focus + camera.distance(_ASPECT) * camera.towards
    write_triangles(folder.walls, np.concatenate([np.empty((0, 3, 3)), *corners]))
    values = {
        "cloud": folder.cloud,
        "time": float(scene.bodies.times[scene.first]),
        "enlargement": float(scene.enlargement),
        "colours": tuple(map(float, scene.limits)),
        "map": _colours(scene),
        "title": "\n".join(fill(line, _LINE) for line in (scene.title, in_ascii(scene.groups)) if line),
        "caption": f"bodies drawn {scene.enlargement:.3g}x larger"
        if scene.enlargement != 1.0
        else "to scale",
        # In front of the surfaces, which would hide them.
        "names": [(s.name, (0.9 * anchor(s, camera) + 0.1 * position).tolist()) for s in drawn],
        "palette": tuple([c / 255 for c in rgb(getattr(LIGHT, name))] for name in _PALETTE),
        "position": position.tolist(),
        "focus": camera.focus.tolist(),
        "up": camera.up.tolist(),
        "angle": VIEW_ANGLE,
        "shapes": _script_of_shapes(),
        "surfaces": _script_of_surfaces(),
        "mode": MODE,
        "stuck": int(Status.STUCK),
        "shown": (int(Status.ACTIVE), int(Status.STUCK)),
        "file": str(folder.state.resolve()),
    }
    write_text(folder.state, _TEXT.format(**values))
