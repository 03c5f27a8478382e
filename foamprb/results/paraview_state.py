"""State file of ParaView beside the results of a run: ``<cloud>.py``, for File > Load State."""

from __future__ import annotations

from pathlib import Path

from foamprb.results.atomic import write_text

__all__ = ["write_state"]

_TEXT = """\
# State of ParaView 5.11 or newer, by foamprb: File > Load State, or paraview --script=THIS_FILE.
# Shows the deformed bodies of the cloud, enlarged, and the paths of particleTracks.
from pathlib import Path

from paraview import simple

CLOUD = {name!r}
# More bodies than this are drawn by the graphics card as copies of one sphere, from semiAxes and orientation.
# Fewer bodies are made one by one from glyph, so that a point of the surface keeps its place on the body.
# 0: always as copies.
MANY = 20000
folder = Path(__file__).resolve().parent
view = simple.GetActiveViewOrCreate("RenderView")

cloud = simple.PVDReader(registrationName=CLOUD, FileName=str(folder / (CLOUD + ".pvd")))
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
cloud.UpdatePipeline(scene.AnimationTime)

# The largest body is drawn with a fiftieth of the size of the cloud.
low, high = cloud.PointData["d"].GetRange(0)
bounds = cloud.GetDataInformation().GetBounds()
size = max(bounds[2 * k + 1] - bounds[2 * k] for k in range(3))
enlargement = max(1.0, 0.02 * size / high) if size > 0.0 else 1.0

count = cloud.GetDataInformation().GetNumberOfPoints()
if count > MANY:
    bodies = cloud
    shown = simple.Show(cloud, view)
    shown.SetRepresentationType("3D Glyphs")
    shown.GlyphType = "Sphere"
    shown.ScaleMode, shown.SelectScaleArray, shown.Scaling = "Vector Components", "semiAxes", 1
    shown.OrientationMode, shown.SelectOrientationVectors, shown.Orient = "Quaternion", "orientation", 1
    shown.ScaleFactor = enlargement
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
    bodies.UpdatePipeline(scene.AnimationTime)
    bodies.ScaleFactor = enlargement
    shown = simple.Show(bodies, view)
    bodies.ScaleFactor = enlargement
simple.ColorBy(shown, ("POINTS", "taylorDeformation"))
shown.SetScalarBarVisibility(view, True)

for file in sorted(folder.glob("*/tracks.vtp")):
    paths = simple.XMLPolyDataReader(registrationName="paths", FileName=[str(file)])
    lines = simple.Show(paths, view)
    simple.ColorBy(lines, None)
    lines.Opacity = 0.3

note = simple.Text(registrationName="enlargement", Text="bodies drawn %.3g times larger" % enlargement)
simple.Show(note, view).WindowLocation = "Lower Left Corner"
view.ResetCamera()
simple.Render(view)
"""


def write_state(path: Path, name: str) -> None:
    """Write the state file for the cloud with a name, in one step.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    write_text(path, _TEXT.format(name=name))
