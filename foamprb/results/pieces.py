"""What PyVista lacks to read a cloud that several processes wrote; it finds it among its entry points."""

from __future__ import annotations

from pyvista.core.utilities.reader import BaseReader, PointCellDataSelection
from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader


class XMLPPolyDataReader(BaseReader, PointCellDataSelection):  # type: ignore[misc]
    """Reads ``.pvtp`` files by VTK's reader of that name."""

    _vtk_class = vtkXMLPPolyDataReader
