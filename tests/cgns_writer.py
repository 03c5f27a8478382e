"""Writer of files of CGNS, by the nodes of its format in HDF5."""

from __future__ import annotations

import h5py
import numpy as np


def cgns(parent, name, label, data=None):
    """Add a node of CGNS to a file of HDF5."""
    group = parent if name == "HDF5 MotherNode" else parent.create_group(name, track_order=True)
    if isinstance(data, str):
        data = np.frombuffer(data.encode(), np.int8)
    kind = "MT" if data is None else {"i1": "C1", "i4": "I4", "f4": "R4", "f8": "R8"}[data.dtype.str[1:]]
    if data is not None:
        group.create_dataset(" data", data=data)
    for key, size, text in (("name", 33, name), ("label", 33, label), ("type", 3, kind)):
        group.attrs.create(key, np.array(text.encode(), dtype=f"S{size}"))
    group.attrs.create("flags", np.array([1], np.int32))
    return group


def write_cgns(path, shape, u):
    """Write hexahedra, prisms or tetrahedra with velocities at cells, or at points if u has as many."""
    (vtk_type, cells), at_cells = *shape.cells_dict.items(), len(u) == shape.n_cells
    cells = cells.astype(np.int32) + 1
    counts = np.array([[shape.n_points], [shape.n_cells], [0]], np.int32)
    with h5py.File(path, "w", libver="earliest", track_order=True) as file:
        cgns(file, "HDF5 MotherNode", "Root Node of HDF5 File")
        for name, text in (
            (" format", b"IEEE_LITTLE_32\0"),
            (" hdf5version", b"HDF5 Version 1.8.17".ljust(33, b"\0")),
        ):
            file.create_dataset(name, data=np.frombuffer(text, np.int8))
        cgns(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([3.2], np.float32))
        base = cgns(file, "Base", "CGNSBase_t", np.array([3, 3], np.int32))
        zone = cgns(base, "Zone", "Zone_t", counts)
        cgns(zone, "ZoneType", "ZoneType_t", "Unstructured")
        places = cgns(zone, "GridCoordinates", "GridCoordinates_t")
        elements = cgns(
            zone, "Cells", "Elements_t", np.array([{12: 17, 10: 10, 13: 14}[vtk_type], 0], np.int32)
        )
        cgns(elements, "ElementRange", "IndexRange_t", np.array([1, shape.n_cells], np.int32))
        cgns(elements, "ElementConnectivity", "DataArray_t", cells.ravel())
        solution = cgns(zone, "Solution", "FlowSolution_t")
        cgns(solution, "GridLocation", "GridLocation_t", "CellCenter" if at_cells else "Vertex")
        for k, axis in enumerate("XYZ"):
            cgns(
                places, f"Coordinate{axis}", "DataArray_t", np.asarray(shape.points, dtype=float)[:, k].copy()
            )
            cgns(solution, f"Velocity{axis}", "DataArray_t", u[:, k].copy())
