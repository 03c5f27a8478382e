"""Files of other programs: read by VTK, or refused with a way to make a mesh of them."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import h5py
import meshio
import numpy as np
import pytest
import pyvista
from cgns_writer import cgns, write_cgns
from mesh_shapes import block, pipe

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.meshfile import read_mesh_file, read_mesh_series

ROOT = Path(__file__).parents[3]


def test_a_file_of_cgns_is_read(tmp_path, random, capfd):
    gradient = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
    shape = block(3, 0.2)
    write_cgns(tmp_path / "flow.cgns", shape, build_mesh(shape).centres @ gradient.T)
    flow = read_mesh_file(tmp_path / "flow.cgns", "Velocity")
    x = random.random((50, 3))
    u, l = flow.sample(x, flow.locate(x), 0.0)
    assert u == pytest.approx(x @ gradient.T, abs=1e-5)
    assert l == pytest.approx(np.broadcast_to(gradient, l.shape), abs=1e-4)
    (tmp_path / "none.cgns").write_bytes(b"nothing")
    with pytest.raises(InputError, match=r"none\.cgns: VTK says"):
        read_mesh_file(tmp_path / "none.cgns")
    assert capfd.readouterr() == ("", "")


def test_times_of_cgns_are_a_transient_flow(tmp_path):
    shape = block(3, 0.0)
    centres = build_mesh(shape).centres[:, [1, 2, 0]]
    write_cgns(tmp_path / "flow.cgns", shape, centres)
    with h5py.File(tmp_path / "flow.cgns", "r+", track_order=True) as file:
        base, zone = file["Base"], file["Base/Zone"]
        later = cgns(zone, "Later", "FlowSolution_t")
        cgns(later, "GridLocation", "GridLocation_t", "CellCenter")
        for k, axis in enumerate("XYZ"):
            cgns(later, f"Velocity{axis}", "DataArray_t", 3.0 * centres[:, k])
        times = cgns(base, "Times", "BaseIterativeData_t", np.array([2], np.int32))
        cgns(times, "TimeValues", "DataArray_t", np.array([0.0, 2.0]))
        names = np.frombuffer(b"Solution".ljust(32) + b"Later".ljust(32), np.int8).reshape(2, 32)
        of_times = cgns(zone, "ZoneTimes", "ZoneIterativeData_t")
        cgns(of_times, "FlowSolutionPointers", "DataArray_t", names)
    flow = read_mesh_series(tmp_path / "flow.cgns", velocity="Velocity")
    assert flow.times == (0.0, 2.0)
    x = np.array([[0.2, 0.4, 0.7]])
    for t in (0.0, 1.0, 2.0):
        assert flow.sample(x, flow.locate(x), t)[0] == pytest.approx((1.0 + t) * x[:, [1, 2, 0]])


@pytest.mark.parametrize("grid_first", [False, True])
def test_a_series_of_xdmf_is_a_transient_flow(grid_first, tmp_path, monkeypatch):
    """Its grid is there twice: by itself, and at each time."""
    monkeypatch.chdir(tmp_path)
    shape = block(3, 0.0)
    points, hexes = np.asarray(shape.points), shape.cells.reshape(-1, 9)[:, 1:]
    with meshio.xdmf.TimeSeriesWriter("flow.xdmf") as file:
        file.write_points_cells(points, [("hexahedron", hexes)])
        for time in (0.0, 0.5, 1.0):
            file.write_data(time, point_data={"U": time * points[:, [1, 2, 0]]})
    monkeypatch.chdir(tmp_path.parent)
    if grid_first:
        tree = ElementTree.parse(tmp_path / "flow.xdmf")
        domain = tree.getroot()[0]
        domain[:] = reversed(domain)
        tree.write(tmp_path / "flow.xdmf")
    flow = read_mesh_series(tmp_path / "flow.xdmf")
    assert flow.times == (0.0, 0.5, 1.0)
    assert flow.mesh.n_cells == 27
    x = np.array([[0.2, 0.4, 0.7]])
    for t in (0.25, 0.5, 0.75):
        assert flow.sample(x, flow.locate(x), t)[0] == pytest.approx(t * x[:, [1, 2, 0]])


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("case.foam", "", "stands for an OpenFOAM case. Allowed: -case DIR, without -flow"),
        ("flow.cas.h5", "", "files of Fluent are not read. Export CGNS or EnSight"),
        ("flow.msh", "$ParametricNodes", "ParametricNodes is not read. .* Mesh.SaveParametric 0"),
        ("flow.plt", "#!TDV112", "such files of Tecplot are not read. Export CGNS or EnSight"),
        ("part.STEP", "ISO-10303-21;", "a CAD geometry has neither cells nor velocities. .* as CGNS"),
        ("wall.stl", "solid wall", "a surface has neither cells with volume .* as CGNS"),
    ],
)
def test_files_that_are_not_read_say_what_to_do(name, content, message, tmp_path):
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError, match=message):
        read_mesh_file(tmp_path / name)


@pytest.mark.parametrize("where", ["point_data", "cell_data"])
def test_text_of_gmsh_with_data_says_what_to_do(where, tmp_path):
    """Of meshio its numbers are not readable; those of Gmsh are, and binary ones."""
    shape = block(1, 0.0)
    U = np.arange(8.0)[:, None] + [7.0, 8.0, 9.0] if where == "point_data" else [np.array([[1.0, 2.0, 3.0]])]
    mesh = meshio.Mesh(np.asarray(shape.points), [("hexahedron", shape.cells[None, 1:])], **{where: {"U": U}})
    meshio.write(tmp_path / "text.msh", mesh, file_format="gmsh22", binary=False)
    text = (tmp_path / "text.msh").read_text()
    if "np.float64(" in text:
        with pytest.raises(InputError, match=r"np\.float64.*by meshio\.write\(…, binary=True\)"):
            read_mesh_file(tmp_path / "text.msh")
    (tmp_path / "plain.msh").write_text(re.sub(r"np\.float64\((\S+)\)", r"\1", text))
    meshio.write(tmp_path / "binary.msh", mesh, file_format="gmsh22", binary=True)
    plain, binary = (read_mesh_file(tmp_path / f"{name}.msh").at_nodes()[1] for name in ("plain", "binary"))
    assert plain == pytest.approx(binary)
    assert plain[-1] == pytest.approx([10.5, 11.5, 12.5] if where == "point_data" else [1.0, 2.0, 3.0])


def test_files_of_surfaces_say_what_to_export(tmp_path):
    surface = block(1, 0.0).extract_surface(algorithm="dataset_surface")
    image = pyvista.ImageData(dimensions=(3, 3, 1))
    for data in (surface, surface.cast_to_unstructured_grid(), image):
        pyvista.MultiBlock({"internal": data}).save(tmp_path / "flow.vtm")
        with pytest.raises(InputError, match=r"no cells with volume\. Export the cells of the fluid"):
            read_mesh_file(tmp_path / "flow.vtm")


def test_a_time_that_is_there_twice_is_refused(tmp_path):
    """Two parts of one time are joined."""
    shape = block(2, 0.0)
    shape.cell_data["U"] = np.ones((8, 3))
    low = np.asarray(shape.cell_centers().points)[:, 0] < 0.5
    for name, cells in (("a", low), ("b", ~low)):
        shape.extract_cells(np.flatnonzero(cells)).save(tmp_path / f"{name}.vtu")
    head = '<?xml version="1.0"?><VTKFile type="Collection" version="0.1"><Collection>'
    for part in (0, 1):
        sets = (
            f'<DataSet timestep="1" part="0" file="a.vtu"/><DataSet timestep="1" part="{part}" file="b.vtu"/>'
        )
        (tmp_path / f"flow{part}.pvd").write_text(f"{head}{sets}</Collection></VTKFile>")
    with pytest.raises(InputError, match=r"the time 1 is there twice, as a\.vtu and b\.vtu"):
        read_mesh_file(tmp_path / "flow0.pvd")
    assert read_mesh_file(tmp_path / "flow1.pvd").mesh.n_cells == 8


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("table.csv", {"delimiter": ",", "header": "x,y,z,u,v,w", "comments": ""}),
        ("table.txt", {"header": "Model: duct.mph", "comments": "% "}),
    ],
)
def test_the_lines_for_a_table_make_a_mesh_of_it(name, options, tmp_path, monkeypatch):
    """A pipe, of which the points on its round wall have the convex hull."""
    points = np.asarray(pipe(6, axial=8, length=3.0).points)
    u = np.outer(1.0 - (points[:, 1:] ** 2).sum(axis=1), [1.0, 0.0, 0.0])
    np.savetxt(tmp_path / name, np.hstack([points, u]), **options)
    with pytest.raises(InputError, match="a table of points is no mesh") as error:
        read_mesh_file(tmp_path / name)
    lines = str(error.value).partition("\n\n")[2].rstrip()
    assert lines.count("\n") == 4
    monkeypatch.chdir(tmp_path)
    exec(lines, {})
    flow = read_mesh_file("flow.vtu")
    assert {patch.name: patch.type for patch in flow.patches} == {
        "opening0": "patch", "opening1": "patch", "wall": "wall"
    }  # fmt: skip
    hull = 3.0 * 0.5 * 24 * np.sin(2.0 * np.pi / 24)
    assert flow.mesh.volumes.sum() == pytest.approx(hull, rel=1e-6)
    x = np.array([[1.6, 0.3, 0.4]])
    assert flow.sample(x, flow.locate(x), 0.0)[0][0] == pytest.approx([0.75, 0.0, 0.0], abs=0.05)
    if name.endswith(".csv"):
        page = (ROOT / "docs/tables.md").read_text()
        on_page = re.search(r"```python\n(.*?)\n```", page, re.DOTALL)[1]
        assert on_page.replace("\n\n", "\n") == lines
