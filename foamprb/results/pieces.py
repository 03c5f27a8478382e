"""PyVista readers of clouds; entry points of the package register them."""

from __future__ import annotations

from typing import Any

from pyvista.core.utilities.reader import BaseReader, PointCellDataSelection
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

from foamprb.results.shapes import DERIVED, SOURCES, derived


class XMLPolyDataReader(BaseReader, PointCellDataSelection):  # type: ignore[misc]
    """Reader of ``.vtp`` files that adds the arrays that follow from the shapes of bodies."""

    _vtk_class = vtkXMLPolyDataReader

    def read(self, **options: Any) -> Any:
        """Return the contents of the file; to a cloud, add the :data:`~foamprb.results.shapes.DERIVED`."""
        mesh = super().read(**options)
        # Other programs write files without units.
        if mesh.n_points and "units" in mesh.field_data and all(name in mesh.point_data for name in SOURCES):
            names = [name for name in DERIVED if name not in mesh.point_data]
            glyph, d, status = (mesh.point_data[name] for name in SOURCES)
            for name, array in derived(glyph, d, status, names).items():
                mesh.point_data[name] = array
        return mesh


class XMLPPolyDataReader(XMLPolyDataReader):
    """The same of ``.pvtp`` files, which several processes wrote."""

    _vtk_class = vtkXMLPPolyDataReader
