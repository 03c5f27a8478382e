"""PyVista reader of clouds that several processes wrote; an entry point of the package registers it."""

from __future__ import annotations

from pyvista.core.utilities.reader import BaseReader, PointCellDataSelection
from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader


class XMLPPolyDataReader(BaseReader, PointCellDataSelection):  # type: ignore[misc]
    """Reader of ``.pvtp`` files, with VTK's reader of the same name."""

    _vtk_class = vtkXMLPPolyDataReader
