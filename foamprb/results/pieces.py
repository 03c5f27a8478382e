"""PyVista reader for clouds of several processes, registered as an entry point."""

from __future__ import annotations

from pyvista.core.utilities.reader import BaseReader, PointCellDataSelection
from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader


class XMLPPolyDataReader(BaseReader, PointCellDataSelection):  # type: ignore[misc]
    """Reader of ``.pvtp`` files by VTK's reader."""

    _vtk_class = vtkXMLPPolyDataReader
