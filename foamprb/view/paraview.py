"""State file of ParaView that shows the scene of a run: ``<cloud>.py``, for File > Load State."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.state import Status
from foamprb.results.atomic import write_text
from foamprb.results.folder import ResultsFolder
from foamprb.results.vtk import write_triangles
from foamprb.view.geometry import FLAT_TYPES
from foamprb.view.scene import VIEW_ANGLE, Scene

__all__ = ["write_state"]

_ASPECT = 4 / 3
"""Ratio of width to height for which the camera shows the whole scene."""

_TEXT = """\
# State of ParaView 5.11 or newer, by foamprb paraview: File > Load State, or paraview --script=THIS_FILE.
# Shows the deformed bodies of the cloud, enlarged, the walls, and the paths of particleTracks.
from pathlib import Path

from paraview import simple

CLOUD = {cloud!r}
TIME = {time!r}
ENLARGEMENT = {enlargement!r}
COLOURS = {colours!r}
POSITION, FOCUS, UP = {position!r}, {focus!r}, {up!r}
# More bodies than this are drawn by the graphics card as copies of one sphere, from semiAxes and orientation.
# Fewer bodies are made one by one from glyph, so that a point of the surface keeps its place on the body.
# 0: always as copies.
MANY = 20000
# ParaView runs this text without the name of its file.
folder = Path(globals().get("__file__", {file!r})).resolve().parent
view = simple.GetActiveViewOrCreate("RenderView")

series = simple.PVDReader(registrationName=CLOUD, FileName=str(folder / (CLOUD + ".pvd")))
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = view.ViewTime = TIME
# Bodies that have left the flow, or failed, are not shown.
cloud = simple.Threshold(registrationName="shown", Input=series)
cloud.Scalars = ["POINTS", "status"]
cloud.ThresholdMethod = "Between"
cloud.LowerThreshold, cloud.UpperThreshold = {shown!r}
cloud.UpdatePipeline(TIME)

count = cloud.GetDataInformation().GetNumberOfPoints()
if count > MANY:
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
# Fewer facets for more bodies.
sphere.Radius = 1.0
sphere.ThetaResolution = sphere.PhiResolution = 8 if count > 5000 else 24
if bodies is not cloud:
    # ParaView changes the factor when it makes the filter, even a given factor of 1.
    bodies.UpdatePipeline(TIME)
    bodies.ScaleFactor = ENLARGEMENT
    shown = simple.Show(bodies, view)
    bodies.ScaleFactor = ENLARGEMENT
simple.ColorBy(shown, ("POINTS", "taylorDeformation"))
simple.GetColorTransferFunction("taylorDeformation").RescaleTransferFunction(*COLOURS)
shown.SetScalarBarVisibility(view, True)

for file in [folder / "walls.vtp", *sorted(folder.glob("*/tracks.vtp"))]:
    name = "walls" if file.parent == folder else "paths"
    reader = simple.XMLPolyDataReader(registrationName=name, FileName=[str(file)])
    drawn = simple.Show(reader, view)
    # ColorBy(drawn, None) fails where nothing was coloured before.
    drawn.ColorArrayName = [None, ""]
    drawn.Opacity = 0.15 if name == "walls" else 0.3

text = "bodies drawn %.3g times larger" % ENLARGEMENT
note = simple.Text(registrationName="enlargement", Text=text)
simple.Show(note, view).WindowLocation = "Lower Left Corner"
# ParaView moves the camera at the first rendering.
simple.Render(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = POSITION, FOCUS, UP
view.CameraViewAngle = {angle!r}
simple.Render(view)
"""


def write_state(folder: ResultsFolder, scene: Scene) -> None:
    """Write the state file of a scene and the walls that it reads, each in one step.

    Raises
    ------
    OSError
        If a file cannot be written.
    """
    camera = scene.camera
    surfaces = scene.geometry.surfaces if scene.geometry is not None else ()
    corners = [s.points[s.triangles] for s in surfaces if s.type not in FLAT_TYPES]
    write_triangles(folder.walls, np.concatenate([np.empty((0, 3, 3)), *corners]))
    values = {
        "cloud": folder.cloud,
        "time": float(scene.bodies.times[scene.first]),
        "enlargement": float(scene.enlargement),
        "colours": tuple(map(float, scene.limits)),
        "position": (camera.focus + camera.distance(_ASPECT) * camera.towards).tolist(),
        "focus": camera.focus.tolist(),
        "up": camera.up.tolist(),
        "angle": VIEW_ANGLE,
        "shown": (int(Status.ACTIVE), int(Status.STUCK)),
        "file": str(folder.state.resolve()),
    }
    write_text(folder.state, _TEXT.format(**values))
