"""Canvas of VTK, without a display: meshes, lines, texts, and the camera."""

from __future__ import annotations

from typing import Any

import numpy as np

# Factories: VTK draws by OpenGL, and texts by FreeType.
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkCoordinate,
    vtkLight,
    vtkPolyDataMapper,
    vtkPolyDataMapper2D,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

from foamprb.results.vtk import triangles_data
from foamprb.view.colours import font_file, rgb

_ = vtkmodules.vtkRenderingFreeType, vtkmodules.vtkRenderingOpenGL2
_FONT_FILE = 4
"""VTK's number of a font family that is a file."""
_SAMPLES = 8
"""Samples per pixel, if the graphics have as many."""


class Canvas:
    """Window without a display; what is added under a name replaces what had it.

    Parameters
    ----------
    size
        Width and height, pixels.
    """

    def __init__(self, size: tuple[int, int]) -> None:
        self.size, self.actors = size, dict[str, Any]()
        self.renderer, self._window = vtkRenderer(), vtkRenderWindow()
        self._window.SetOffScreenRendering(True)
        self._window.SetSize(*size)
        self._window.SetMultiSamples(_SAMPLES)
        self._window.AddRenderer(self.renderer)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(-0.35, 0.6, 0.72)
        # Faces behind each other are few, and blended in the order in which they are added.
        self.renderer.SetUseOIT(False)
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(light)

    @property
    def camera(self) -> Any:
        """Camera of VTK."""
        return self.renderer.GetActiveCamera()

    def clear(self, paper: str) -> None:
        """Remove everything, and take another colour of the background."""
        self.renderer.RemoveAllViewProps()
        self.actors.clear()
        self.renderer.SetBackground(*_share(paper))

    def remove(self, name: str) -> None:
        """Remove what was added under a name, if there is any."""
        self.renderer.RemoveViewProp(self.actors.pop(name, None))

    def add(self, name: str, actor: Any) -> Any:
        """Draw a prop of VTK; return it."""
        self.remove(name)
        self.actors[name] = actor
        self.renderer.AddViewProp(actor)
        return actor

    def mesh(
        self,
        name: str,
        data: Any,
        colour: str = "#000000",
        opacity: float = 1.0,
        width: float = 1.0,
        culling: str = "",
        light: tuple[float, float, float] | None = None,
    ) -> None:
        """Draw PolyData.

        Parameters
        ----------
        name, data
            Its name; the mesh, with normals if it has light.
        colour
            ``#rrggbb`` of a mesh that has no colours of its own.
        opacity, width
            Opacity, and width of lines in pixels.
        culling
            Side of faces that is not drawn: ``front``, ``back``, or neither.
        light
            Ambient, diffuse and specular share of the light; None for plain colours.
        """
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputData(data)
        mapper.SetScalarVisibility(data.GetPointData().GetScalars() is not None)
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*_share(colour))
        look.SetOpacity(opacity)
        look.SetLineWidth(width)
        look.SetBackfaceCulling(culling == "back")
        look.SetFrontfaceCulling(culling == "front")
        look.SetLighting(light is not None)
        look.SetInterpolationToPhong()
        ambient, diffuse, specular = light or (1.0, 0.0, 0.0)
        look.SetAmbient(ambient)
        look.SetDiffuse(diffuse)
        look.SetSpecular(specular)
        look.SetSpecularPower(40.0)
        self.add(name, actor)

    def flat(self, name: str, data: Any, colour: str | None = None, world: bool = False) -> Any:
        """Draw PolyData in front of everything, in pixels or at places in the scene; return its actor."""
        mapper, actor = vtkPolyDataMapper2D(), vtkActor2D()
        mapper.SetInputData(data)
        mapper.SetScalarVisibility(colour is None)
        if world:
            places = vtkCoordinate()
            places.SetCoordinateSystemToWorld()
            mapper.SetTransformCoordinate(places)
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*_share(colour or "#000000"))
        return self.add(name, actor)

    def text(self, name: str, text: str, size: float, colour: str, bold: bool = False) -> Any:
        """Add a line of text of a size in pixels; return its actor."""
        actor = vtkTextActor()
        actor.SetInput(text)
        letters = actor.GetTextProperty()
        letters.SetFontFamily(_FONT_FILE)
        letters.SetFontFile(font_file(bold))
        letters.SetFontSize(max(6, round(size)))
        letters.SetColor(*_share(colour))
        return self.add(name, actor)

    def image(self) -> NDArray[np.uint8]:
        """Render; return the picture, (height, width, 3)."""
        self.renderer.ResetCameraClippingRange()
        self._window.Render()
        picture = vtkWindowToImageFilter()
        picture.SetInput(self._window)
        picture.ReadFrontBufferOff()
        picture.ShouldRerenderOff()
        picture.Update()
        values = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars())
        return np.ascontiguousarray(values.reshape(self.size[1], self.size[0], 3)[::-1], dtype=np.uint8)

    def close(self) -> None:
        """Free the window."""
        self._window.Finalize()


def surface(points: NDArray[Any], triangles: NDArray[Any], colours: NDArray[np.uint8] | None = None) -> Any:
    """Return triangles (t, 3) of points (n, 3), with the colours of the points, (n, 3 or 4)."""
    return coloured(triangles_data(points, triangles), colours)


def segments(ends: NDArray[Any], colours: NDArray[np.uint8] | None = None) -> Any:
    """Return lines between pairs of points (s, 2, 3), with the colours of their ends, (s, 2, 3 or 4)."""
    data, cells = triangles_data(ends.reshape(-1, 3), np.zeros(0, dtype=np.int64)), vtkCellArray()
    cells.SetData(2, numpy_to_vtk(np.arange(2 * len(ends))))
    data.SetLines(cells)
    return coloured(data, None if colours is None else colours.reshape(2 * len(ends), -1))


def dots(points: NDArray[Any]) -> Any:
    """Return points, (n, 3), as vertices."""
    data, cells = triangles_data(points, np.zeros(0, dtype=np.int64)), vtkCellArray()
    cells.SetData(1, numpy_to_vtk(np.arange(len(points))))
    data.SetVerts(cells)
    return data


def coloured(data: Any, colours: NDArray[np.uint8] | None) -> Any:
    """Return PolyData with colours of its points, (n, 3 or 4)."""
    if colours is not None:
        data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colours)))
    return data


def _share(colour: str) -> tuple[float, float, float]:
    r, g, b = rgb(colour)
    return r / 255.0, g / 255.0, b / 255.0
