"""What VTK reads without a word, and what is made of what it reads."""

from __future__ import annotations

import json
import os
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
import pyvista
from mesh_shapes import block

from foamprb.errors import InputError
from foamprb.flow.read import vtkfile
from foamprb.flow.read.vtkfile import grid_and_surfaces, read_file, solid_cells, times_of_file

HEAD = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
WHOLE = "POINTS 2 double\n0 0 0 1 1 1\nCELLS 2 2\nOFFSETS vtktypeint64\n0 2\nCONNECTIVITY vtktypeint64\n0 1\n"
DATA = "CELL_TYPES 1\n3\nPOINT_DATA 2\n"


@pytest.mark.parametrize(
    ("text", "name", "found", "expected"),
    [
        ("POINTS 3 double\n0 0 0 1 1 1 2 2\n", "POINTS", 8, 9),
        (WHOLE + "CELL_TYPES 4\n3 3 3\n", "CELL_TYPES", 3, 4),
        ("POINTS 1 float\n0 0 0\nCELLS 2 6\n2 0 0 2 0\n", "CELLS", 5, 6),
        ("CELLS 3 4\nOFFSETS vtktypeint64\n0 2\n", "OFFSETS", 2, 3),
        ("CELLS 3 4\nOFFSETS vtktypeint64\n0 2 4\nCONNECTIVITY vtktypeint64\n0 1 1\n", "CONNECTIVITY", 3, 4),
        (WHOLE + DATA + "VECTORS U double\n1 2 3 4 5\n", "VECTORS", 5, 6),
        (WHOLE + DATA + "NORMALS n double\n1 2 3 4 5\n", "NORMALS", 5, 6),
        (WHOLE + DATA + "TENSORS T double\n" + 17 * "1 " + "\n", "TENSORS", 17, 18),
        (WHOLE + DATA + "SCALARS s double\nLOOKUP_TABLE default\n1\n", "LOOKUP_TABLE", 1, 2),
        (WHOLE + DATA + "SCALARS s double 3\nLOOKUP_TABLE default\n1 2 3 4 5\n", "LOOKUP_TABLE", 5, 6),
        (WHOLE + DATA + "SCALARS s double 2\n1 2 3\n", "SCALARS", 3, 4),
        (WHOLE + DATA + "FIELD FieldData 1\nU 3 2 double\n1 2 3 4 5\n", "U", 5, 6),
        (WHOLE + "CELL_DATA 1\nVECTORS U double\n1 2\n", "VECTORS", 2, 3),
        # The data of the later of two.
        (WHOLE + "CELL_DATA 1\nVECTORS U double\n1 2 3\nPOINT_DATA 2\nVECTORS V double\n1 2 3 nan inf\n",
         "VECTORS", 5, 6),
    ],
)  # fmt: skip
def test_a_legacy_file_in_text_that_ends_early_is_refused(text, name, found, expected, tmp_path):
    path = tmp_path / "flow.vtk"
    path.write_text(HEAD + text)
    with pytest.raises(InputError, match=f"flow.vtk: {name} has {found} values, not {expected}; the file is"):
        vtkfile._require_whole(path)
    # With one number more it is whole.
    path.write_text(HEAD + text.rstrip() + " 1\n")
    vtkfile._require_whole(path)


@pytest.mark.parametrize(
    "text",
    ["", "1 2 3\n", "METADATA\n", "VECTORS U double\n", "OFFSETS vtktypeint64\n", "POINTS many double\n1\n",
     "U 3 x double\n1\n"],
)  # fmt: skip
def test_what_says_no_number_is_left_to_vtk(text, tmp_path):
    path = tmp_path / "flow.vtk"
    path.write_text(HEAD + text)
    vtkfile._require_whole(path)
    path.write_text(HEAD + text + "POINTS 1 double\n0 0\n")
    with pytest.raises(InputError, match="POINTS has 2 values, not 3"):
        vtkfile._require_whole(path)


def test_only_a_file_in_text_is_counted(tmp_path):
    path = tmp_path / "flow.vtk"
    for kind, counted in (("ASCII", True), ("BINARY", False)):
        path.write_text(HEAD.replace("ASCII", kind) + "POINTS 3 double\n0 0 0\n")
        with pytest.raises(InputError, match="3 values, not 9") if counted else nullcontext():
            vtkfile._require_whole(path)


def test_the_times_of_a_series_rise(tmp_path):
    path = tmp_path / "flow.vtu.series"
    entries = [("c", 10), ("a", 0.5), ("b", 2)]
    path.write_text(json.dumps({"files": [{"name": n, "time": t} for n, t in entries]}))
    assert times_of_file(path) == ["0.5", "2", "10"]
    assert vtkfile._series(path) == {"0.5": "a", "2": "b", "10": "c"}
    (tmp_path / "b").touch()
    assert vtkfile._of_series(path, 2.0) == tmp_path / "b"
    for time in ("latestTime", 0.5):
        with pytest.raises(InputError, match=r"the file .* does not exist"):
            vtkfile._of_series(path, time)
    path.write_text(json.dumps({"files": [{"name": "flow.vtu.series", "time": 1}]}))
    with pytest.raises(InputError, match="does not exist"):
        vtkfile._of_series(path, 1)
    path.write_text('{"files": []}')
    with pytest.raises(InputError, match="the list of files is empty"):
        times_of_file(path)


@pytest.mark.parametrize("name", ["flow.vtu", "flow.msh", "flow.vtu.series"])
def test_a_file_that_is_not_there(name, tmp_path):
    for read in (times_of_file, lambda path: read_file(path, "latestTime")):
        with pytest.raises(InputError, match=f"{name}: no such file"):
            read(tmp_path / name)


def test_a_format_of_meshio_has_no_times(tmp_path):
    (tmp_path / "flow.msh").touch()
    assert times_of_file(tmp_path / "flow.msh") == []


@pytest.mark.parametrize("ghosts", [[0, 1, 0, 2], None])
def test_cells_that_a_piece_has_for_its_neighbours_are_left_out(ghosts, tmp_path):
    piece = block(1, 0.0)
    for k in range(4):
        part = piece.copy()
        part.points = np.array(part.points) + np.array([float(k), 0.0, 0.0])
        if ghosts is not None:
            part.cell_data["vtkGhostType"] = np.array([ghosts[k]], dtype=np.uint8)
        part.cell_data["number"] = np.array([float(k)])
        part.save(tmp_path / f"flow_{k}.vtu")
    array = '<PDataArray type="{}" Name="{}"/>'
    arrays = array.format("Float64", "number")
    arrays += "" if ghosts is None else array.format("UInt8", "vtkGhostType")
    pieces = "".join(f'<Piece Source="flow_{k}.vtu"/>' for k in range(4))
    (tmp_path / "flow.pvtu").write_text(
        '<?xml version="1.0"?><VTKFile type="PUnstructuredGrid" version="1.0" header_type="UInt32">'
        f'<PUnstructuredGrid GhostLevel="0"><PCellData>{arrays}</PCellData><PPoints>'
        f'<PDataArray type="Float64" NumberOfComponents="3"/></PPoints>{pieces}</PUnstructuredGrid></VTKFile>'
    )
    found = read_file(tmp_path / "flow.pvtu", "latestTime")
    kept = [0, 2] if ghosts is not None else [0, 1, 2, 3]
    assert sorted(np.asarray(found.cell_data["number"]).tolist()) == kept
    assert solid_cells(found, tmp_path)[0].n_points == (16 if ghosts is not None else 20)


def test_of_several_parts_one_is_a_grid_and_the_others_surfaces(tmp_path):
    path = tmp_path / "flow.vtm"
    sphere, cube = pyvista.Sphere(theta_resolution=4, phi_resolution=4), block(1, 0.0)
    inner = pyvista.MultiBlock({"wall": sphere, "nothing": None, "line": pyvista.Line()})
    data = pyvista.MultiBlock({"mesh": cube, "empty": pyvista.UnstructuredGrid(), "patches": inner})
    grid, surfaces = grid_and_surfaces(data, path)
    assert grid.n_cells == 1
    assert [name for name, _ in surfaces] == ["wall"]
    assert grid_and_surfaces(cube, path)[1] == []
    with pytest.raises(InputError, match="no cells with volume"):
        grid_and_surfaces(inner, path)
    with pytest.raises(InputError, match="no grid with cells"):
        grid_and_surfaces(pyvista.MultiBlock({"nothing": None}), path)
    assert grid_and_surfaces(pyvista.MultiBlock([cube, block(2, 0.0)]), path)[0].n_cells == 9
    twice = pyvista.MultiBlock({"mesh": cube, "a": pyvista.MultiBlock({"w": sphere}),
                                "b": pyvista.MultiBlock({"w": sphere})})  # fmt: skip
    with pytest.raises(InputError, match=r"two surfaces have the same name; their names are w, w\."):
        grid_and_surfaces(twice, path)


def test_points_lines_and_surfaces_of_a_grid_are_left_out(tmp_path):
    path = tmp_path / "flow.vtu"
    points = np.asarray(block(1, 0.0).points)
    cells = [8, 0, 1, 3, 2, 4, 5, 7, 6, 4, 0, 1, 3, 2, 2, 0, 1, 1, 4, 4, 0, 1, 3, 4]
    grid = pyvista.UnstructuredGrid(cells, [12, 9, 3, 1, 10], points)
    found, notes = solid_cells(grid, path)
    assert notes == ["3 points, lines and surfaces among the cells are left out."]
    assert sorted(found.celltypes) == [10, 12]
    whole = block(1, 0.0)
    assert solid_cells(whole, path) == (whole, [])
    with pytest.raises(InputError, match=r"no cells with volume\. Export .*; 2-D data as one layer of cells"):
        solid_cells(pyvista.UnstructuredGrid([4, 0, 1, 3, 2], [9], points), path)
    hull = pyvista.UnstructuredGrid([8, *range(8)], [pyvista.CellType.CONVEX_POINT_SET], points)
    with pytest.raises(
        InputError, match="no cells of the allowed kinds tetrahedron, voxel, hexahedron, prism"
    ):
        solid_cells(hull, path)


@pytest.mark.parametrize(
    ("kind", "size"), [(10, 4), (12, 8), (13, 6), (14, 5), (9, 4), (5, 3), (3, 2), (8, 4)]
)
def test_each_kind_of_cell_has_its_number_of_points(kind, size, tmp_path):
    points = np.random.default_rng(0).random((9, 3))
    for n, sound in ((size, True), (size - 1, False), (size + 1, False)):
        grid = pyvista.UnstructuredGrid([n, *range(n)], [kind], points)
        if sound:
            vtkfile._require_lists(grid, tmp_path)
        else:
            with pytest.raises(InputError, match=f"does not have {size} points; the file is broken"):
                vtkfile._require_lists(grid, tmp_path)


@pytest.mark.parametrize("fails", [False, True])
@pytest.mark.parametrize(("name", "silent"), [("flow.vtkhdf", True), ("flow.vtu", False)])
def test_only_while_an_hdf5_file_is_read_the_standard_error_is_silent(name, silent, fails, capfd):
    """Beneath Python, where the library writes."""
    os.write(2, b"before ")
    try:
        with vtkfile._quiet(Path(name)):
            os.write(2, b"within ")
            if fails:
                raise InputError("broken")
    except InputError:
        assert fails
    os.write(2, b"after")
    assert capfd.readouterr().err == ("before after" if silent else "before within after")
