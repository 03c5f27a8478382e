from __future__ import annotations

import json
import sys

import meshio
import numpy as np
import pytest
import pyvista
from mesh_shapes import block, box_patches, corners, grid, pipe
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFWriter
from vtkmodules.vtkIOParallel import vtkEnSightWriter

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Patch
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read import vtk_guard
from foamprb.flow.read.describe import describe_file
from foamprb.flow.read.meshfile import read_mesh_file, read_mesh_series
from foamprb.flow.read.source import Division
from foamprb.flow.reconstruct import Reconstruction
from foamprb.settings.patches import patch_interactions

GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])


def flowing(kind="hexahedra", factor=1.0):
    shape = block(4 if kind == "polyhedra" else 3, 0.2, kind)
    shape.cell_data["U"] = factor * build_mesh(shape).centres @ GRADIENT.T
    return shape


def write_series(folder, first=1.0):
    """Two times of a flow as foamToVTK leaves them."""
    for name, factor in (("case_1", first), ("case_2", 2.0)):
        shape = flowing(factor=factor)
        patches = {}
        for patch in box_patches(shape):
            moving = factor * patch.surface.cell_centers().points @ GRADIENT.T
            patch.surface.cell_data["U"] = moving * (patch.name != "sides")
            patches[patch.name] = patch.surface
        pyvista.MultiBlock({"internal": shape, "boundary": pyvista.MultiBlock(patches)}).save(
            folder / f"{name}.vtm"
        )
    path = folder / "case.vtm.series"
    times = [{"name": "case_1.vtm", "time": 0.5}, {"name": "case_2.vtm", "time": 10}]
    path.write_text(json.dumps({"file-series-version": "1.0", "files": times}))
    return path


def apart(shape, shift=0.0):
    """The same cells, each with points of its own."""
    cells = [shape.extract_cells([k]) for k in range(shape.n_cells)]
    for k, cell in enumerate(cells):
        cell.points = np.asarray(cell.points) + shift * k
    found = pyvista.merge(cells, merge_points=False)
    assert found.n_points > shape.n_points
    return found


@pytest.mark.parametrize("kind", ["hexahedra", "polyhedra"])
def test_cells_that_share_no_points_are_joined(kind, tmp_path):
    """As discontinuous methods write them."""
    shape = flowing(kind)
    for name, data in (("own", apart(shape)), ("shared", shape)):
        data.save(tmp_path / f"{name}.vtu")
    own, shared = (read_mesh_file(tmp_path / f"{name}.vtu") for name in ("own", "shared"))
    assert own.mesh.n_internal == shared.mesh.n_internal > 0
    assert own.mesh.n_points == shared.mesh.n_points
    assert any("points that coincide with others are merged" in note for note in own.notes)
    apart(shape, 1e-7).save(tmp_path / "near.vtu")
    with pytest.raises(
        InputError, match=r"\d+ boundary faces lie on each other, the first at .* share no point"
    ):
        read_mesh_file(tmp_path / "near.vtu")


def test_parts_of_a_mesh_are_joined(tmp_path):
    shape = flowing()
    left = np.asarray(shape.cell_centers().points)[:, 0] < 0.4
    parts = [shape.extract_cells(np.flatnonzero(some)) for some in (left, ~left)]
    pyvista.MultiBlock(parts).save(tmp_path / "flow.vtm")
    assert read_mesh_file(tmp_path / "flow.vtm").mesh.n_internal == build_mesh(shape).n_internal


@pytest.mark.parametrize("suffix", ["vti", "vtr", "vts", "vtk"])
@pytest.mark.parametrize("where", ["cell_data", "point_data"])
def test_structured_grids_are_read(suffix, where, tmp_path):
    shape = pyvista.ImageData(dimensions=(4, 5, 6), spacing=(0.25, 0.2, 0.2))
    places = shape.points if where == "point_data" else shape.cell_centers().points
    shape = {"vtr": shape.cast_to_rectilinear_grid, "vts": shape.cast_to_structured_grid}.get(
        suffix, shape.copy
    )()
    getattr(shape, where)["U"] = np.asarray(places) @ GRADIENT.T
    shape.save(tmp_path / f"flow.{suffix}")
    flow = read_mesh_file(tmp_path / f"flow.{suffix}")
    assert flow.mesh.volumes == pytest.approx(np.full(60, 0.01))
    x = np.array([[0.4, 0.5, 0.6]])
    np.testing.assert_allclose(flow.sample(x, flow.locate(x), 0.0)[0], x @ GRADIENT.T, rtol=1e-6)


def test_an_ensight_case_is_read(tmp_path):
    shape = flowing()
    shape.cell_data["BlockId"] = np.ones(shape.n_cells, dtype=np.int32)
    writer = vtkEnSightWriter()
    writer.SetFileName(str(tmp_path / "flow"))
    writer.SetPath(str(tmp_path))
    writer.SetBaseName("flow")
    writer.SetInputData(shape)
    writer.Write()
    writer.WriteCaseFile(1)
    flow = read_mesh_file(next(tmp_path.glob("*.case")), "U_c")
    assert flow.mesh.volumes.sum() == pytest.approx(1.0, rel=1e-6)


@pytest.mark.parametrize("where", ["cell_data", "point_data"])
def test_a_velocity_may_be_three_scalars(where, tmp_path):
    shape = flowing()
    shape.point_data["U"] = np.asarray(shape.points) @ GRADIENT.T
    shape.save(tmp_path / "vector.vtu")
    u = getattr(shape, where)["U"]
    shape.clear_data()
    for k, name in enumerate("xyz"):
        getattr(shape, where)[f"u_{name}"] = u[:, k]
    shape.save(tmp_path / "flow.vtu")
    x = np.array([[0.4, 0.5, 0.6]])
    flow = read_mesh_file(tmp_path / "flow.vtu", "(u_x u_y u_z)")
    np.testing.assert_allclose(flow.sample(x, flow.locate(x), 0.0)[0], x @ GRADIENT.T, atol=1e-5)
    with pytest.raises(
        InputError, match=r"no array U\. Allowed: .*\. Three scalars are read by -velocity .\(Ux Uy Uz\)"
    ):
        read_mesh_file(tmp_path / "flow.vtu")


def test_a_missing_package_of_a_format_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    (tmp_path / "flow.h5m").write_bytes(b"x")
    with pytest.raises(
        InputError, match=r"meshio needs h5py for this format: pip install 'foamprb\[meshes\]'"
    ):
        read_mesh_file(tmp_path / "flow.h5m")


def test_a_series_of_foam_to_vtk(tmp_path):
    path = write_series(tmp_path)
    assert read_mesh_file(path).patches == (
        Patch("floor", "patch"), Patch("lid", "patch"), Patch("sides", "wall")
    )  # fmt: skip
    x = np.array([[0.4, 0.5, 0.6]])
    flow = read_mesh_file(tmp_path / "case_1.vtm")
    first, _ = flow.sample(x, flow.locate(x), 0.0)
    for time, factor in (("latestTime", 2.0), (0.5, 1.0), ("10", 2.0)):
        flow = read_mesh_file(path, time=time)
        u, _ = flow.sample(x, flow.locate(x), 0.0)
        # The sides are at rest, which the middle feels.
        assert u == pytest.approx(factor * first, rel=1e-6)
    with pytest.raises(InputError, match=r"no time 3; the times are 0\.5, 10"):
        read_mesh_file(path, time=3)


@pytest.mark.parametrize("names", [("floor", "lid", "sides"), ("lid",), ("floor", "sides"), ()])
def test_velocities_on_the_patches_that_have_some_count_and_others_are_continued(names, tmp_path):
    shape, patches = flowing(), {}
    for patch in box_patches(shape):
        patch.surface.clear_data()
        if patch.name in names:
            # Other than what the cells would be continued to.
            patch.surface.cell_data["U"] = -2.0 * patch.surface.cell_centers().points @ GRADIENT.T
        patches[patch.name] = patch.surface
    path = tmp_path / "case.vtm"
    pyvista.MultiBlock({"internal": shape, "boundary": pyvista.MultiBlock(patches)}).save(path)
    flow = read_mesh_file(path)
    mesh = flow.mesh
    given = np.repeat([patch.name in names for patch in flow.patches], np.diff(mesh.patch_start))
    expected, slopes = Reconstruction(mesh, given)(
        mesh.centres @ GRADIENT.T, -2.0 * mesh.boundary_centres @ GRADIENT.T
    )
    _, u, l = flow.at_nodes()
    assert u == pytest.approx(expected, abs=1e-5)
    assert l == pytest.approx(slopes.reshape(-1, 9), abs=1e-4)
    assert any("The file has velocities of cells alone" in note for note in flow.notes) == (not names)


TIMES = (0.5, 1.0, 10.0)


def at(time):
    return flowing(factor=time)


def write_vtkhdf(path, shapes):
    """Several times in one file."""
    key = vtkStreamingDemandDrivenPipeline

    class Source(VTKPythonAlgorithmBase):
        def __init__(self):
            super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")

        def RequestInformation(self, _request, _inputs, outputs):
            for time in TIMES:
                outputs.GetInformationObject(0).Append(key.TIME_STEPS(), time)
            for time in (TIMES[0], TIMES[-1]):
                outputs.GetInformationObject(0).Append(key.TIME_RANGE(), time)
            return 1

        def RequestData(self, _request, _inputs, outputs):
            about = outputs.GetInformationObject(0)
            time = about.Get(key.UPDATE_TIME_STEP()) if about.Has(key.UPDATE_TIME_STEP()) else TIMES[0]
            about.Get(vtkDataObject.DATA_OBJECT()).ShallowCopy(shapes[TIMES.index(time)])
            return 1

    writer, source = vtkHDFWriter(), Source()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetWriteAllTimeSteps(True)
    writer.Write()


def write_times(folder, suffix, shapes):
    """A file of several times."""
    path = folder / f"flow{suffix}"
    if suffix == ".vtkhdf":
        write_vtkhdf(path, shapes)
        return path
    for k, shape in enumerate(shapes):
        shape.save(folder / f"flow{k}.vtu")
    names = [(f"flow{k}.vtu", time) for k, time in enumerate(TIMES)]
    if suffix == ".pvd":
        entries = "".join(f'<DataSet timestep="{time}" file="{name}"/>' for name, time in names)
        path.write_text(
            '<?xml version="1.0"?><VTKFile type="Collection" version="0.1">'
            f"<Collection>{entries}</Collection></VTKFile>"
        )
    else:
        path.write_text(json.dumps({"files": [{"name": name, "time": time} for name, time in names]}))
    return path


@pytest.mark.parametrize("where", ["cell_data", "point_data"])
@pytest.mark.parametrize("suffix", [".vtu.series", ".pvd", ".vtkhdf"])
def test_a_file_of_several_times_is_a_transient_flow(suffix, where, tmp_path, random):
    shapes = [at(time) for time in TIMES]
    if where == "point_data":
        for time, shape in zip(TIMES, shapes, strict=True):
            shape.clear_data()
            shape.point_data["U"] = time * shape.points @ GRADIENT.T
    path = write_times(tmp_path, suffix, shapes)
    flow = read_mesh_series(path)
    assert flow.times == TIMES
    x = random.random((50, 3))
    for t in (0.5, 0.6, 1.0, 7.0, 10.0):
        u, l = flow.sample(x, flow.locate(x), t)
        # Points and velocities are in single precision.
        assert u == pytest.approx(t * x @ GRADIENT.T, abs=2e-6 * t)
        assert l == pytest.approx(np.broadcast_to(t * GRADIENT, l.shape), abs=1e-5 * t)
    chosen = read_mesh_series(path, "1:")
    assert chosen.times == (1.0, 10.0)
    assert read_mesh_series(path, "1:", 10.0).period == 10.0
    single = read_mesh_series(path, "1")
    assert isinstance(single, MeshFlow)
    for steady, t in ((single, 1.0), (read_mesh_file(path), 10.0), (read_mesh_file(path, time=0.5), 0.5)):
        assert steady.sample(x, steady.locate(x), 0.0)[0] == pytest.approx(t * x @ GRADIENT.T, abs=2e-6 * t)
    with pytest.raises(InputError, match=r"no time in 2:9; the times go from 0\.5 to 10"):
        read_mesh_series(path, "2:9")
    assert "    0.5, 1, 10" in describe_file(path)


def test_a_patch_that_moves_later_is_no_wall(tmp_path):
    path = write_series(tmp_path, first=0.0)
    assert read_mesh_file(path, time=0.5).patches[1] == Patch("lid", "wall")
    flow = read_mesh_series(path)
    assert [patch.type for patch in flow.patches] == ["patch", "patch", "wall"]
    x = np.array([[0.4, 0.5, 0.6]])
    whole = read_mesh_file(path)
    last, _ = whole.sample(x, whole.locate(x), 0.0)
    for t, share in ((0.5, 0.0), (5.25, 0.5), (10.0, 1.0)):
        assert flow.sample(x, flow.locate(x), t)[0] == pytest.approx(share * last, abs=1e-12)


def other_points(shape):
    shape.points[13] += 0.01


def other_array(shape):
    shape.clear_data()


def short(shape):
    shape.cell_data["U"] = np.ones(27)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (other_points, r"the mesh of time 10 is not that of time 0\.5; only meshes at rest"),
        (other_array, "no array U at one of its times"),
        (short, r"array U has shape \(27,\)"),
    ],
)
def test_a_time_that_does_not_fit_is_refused_when_it_is_read(change, message, tmp_path):
    shapes = [at(time) for time in TIMES]
    change(shapes[2])
    flow = read_mesh_series(write_times(tmp_path, ".pvd", shapes))
    flow.load(0.5, 0.6)
    with pytest.raises(InputError, match=message):
        flow.load(1.5, 1.6)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is damaged: Expecting property name"),
        ("[]", "is damaged: it is .., not an object"),
        ('{"files": []}', "the list of files is empty"),
        ('{"files": [{"name": "none.vtu", "time": 1}]}', "none.vtu does not exist"),
        ('{"files": [{"name": "case.vtm.series", "time": 1}]}', "series does not exist"),
        ('{"files": [{"time": 1}]}', "is damaged: files has no name"),
        (
            '{"files": [{"name": "a.vtu", "time": 1}, {"name": "b.vtu", "time": 1}]}',
            "2 files have 1 different times",
        ),
    ],
)
def test_broken_series(text, message, tmp_path):
    (tmp_path / "case.vtm.series").write_text(text)
    with pytest.raises(InputError, match=message):
        read_mesh_file(tmp_path / "case.vtm.series")


def test_physical_groups_of_gmsh_name_the_patches(tmp_path):
    points, hexes = corners(1, 0.0)
    mesh = meshio.Mesh(
        points,
        [("hexahedron", hexes), ("quad", np.concatenate([hexes[:, :4], hexes[:, 4:]]))],
        point_data={"U": np.ones((8, 3))},
        cell_data={
            name: [np.array([9]), np.array([1, 2])] for name in ("gmsh:physical", "gmsh:geometrical")
        },
        field_data={"air": np.array([9, 3]), "inlet": np.array([1, 2]), "outlet": np.array([2, 2])},
    )  # fmt: skip
    mesh.write(tmp_path / "flow.msh", file_format="gmsh22")
    flow = read_mesh_file(tmp_path / "flow.msh", division=Division(array="gmsh:physical"))
    assert {patch.name for patch in flow.patches} == {"boundary", "inlet", "outlet"}


def test_the_fluid_is_at_rest_on_the_walls_that_cells_show(tmp_path):
    """Poiseuille flow; a fluid that slides along its walls is continued to them."""
    shape = pipe(6)
    centres = build_mesh(shape).centres
    for least, at_wall, tolerance in ((0.0, 0.0, 1e-12), (4.0, 4.0, 0.2)):
        shape.cell_data["U"] = np.outer(least + 1.0 - (centres[:, 1:] ** 2).sum(axis=1), [1.0, 0.0, 0.0])
        shape.save(tmp_path / "flow.vtu")
        flow = read_mesh_file(tmp_path / "flow.vtu")
        (wall,) = (k for k, patch in enumerate(flow.patches) if patch.type == "wall")
        nodes = np.unique(flow.mesh.triangles[flow.mesh.triangle_patch == wall])
        inside = nodes[np.abs(flow.mesh.nodes[nodes, 0] - 0.5) < 0.4]
        assert flow.at_nodes()[1][inside, 0] == pytest.approx(at_wall, abs=tolerance)
        assert any("at rest on walls" in note for note in flow.notes) == (least == 0.0)


def test_lengths_are_scaled_and_velocities_are_not(tmp_path, random):
    shape = flowing("prisms")
    shape.points *= 1e6
    shape.save(tmp_path / "flow.vtu")
    x = random.random((20, 3))
    flow = read_mesh_file(tmp_path / "flow.vtu", scale=1e-6)
    u, l = flow.sample(x, flow.locate(x), 0.0)
    assert u == pytest.approx(x @ GRADIENT.T, abs=1e-5)
    assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=1e-4)
    assert not any("-scale" in note for note in flow.notes)
    notes = read_mesh_file(tmp_path / "flow.vtu").notes
    assert sum(isinstance(note, Caveat) and "the mesh is 1.73e+06 m across" in note for note in notes) == 1


@pytest.mark.parametrize("suffix", [".vtkhdf", ".vtu"])
@pytest.mark.parametrize("kind", ["hexahedra", "polyhedra", "mixed"])
def test_kinds_of_cells_in_vtk_files(suffix, kind, tmp_path, random):
    if suffix == ".vtkhdf" and kind == "polyhedra":
        pytest.skip("VTK does not write polyhedra to this format")
    flowing(kind).save(tmp_path / f"flow{suffix}")
    flow = read_mesh_file(tmp_path / f"flow{suffix}")
    x = random.random((100, 3))
    u, l = flow.sample(x, flow.locate(x), 0.0)
    assert u == pytest.approx(x @ GRADIENT.T, abs=1e-5)
    assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=1e-4)


def test_a_cell_that_names_a_wrong_point_is_told_by_the_boundary(tmp_path):
    points, hexes = corners(2, 0.2)
    for wrong in (False, True):
        if wrong:
            hexes[3, 1] = 1
        shape = grid(points, [(12, hexes)])
        shape.cell_data["U"] = np.ones((8, 3))
        shape.save(tmp_path / "flow.vtu")
        for division in (None, Division(feature_angle=30.0)):
            flow = read_mesh_file(tmp_path / "flow.vtu", division=division)
            assert flow.mesh.inverted == 0
            assert any("more than two boundary faces meet" in note for note in flow.notes) == wrong


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9, 0.97])
@pytest.mark.parametrize("binary", [True, False])
def test_a_legacy_file_cut_short_is_refused(share, binary, tmp_path, capfd):
    points, hexes = corners(3, 0.1)
    shape = grid(points, [(12, hexes)])
    shape.cell_data["U"] = np.random.default_rng(0).random((27, 3))
    path = tmp_path / "flow.vtk"
    shape.save(path, binary=binary)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(InputError, match=r"flow\.vtk"):
        read_mesh_file(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("kind", "name"), [(9, "cell of VTK type 9"), (10, "tetrahedron")])
def test_a_cell_of_another_type_than_its_points_is_refused(kind, name, tmp_path):
    points, hexes = corners(2, 0.2)
    shape = grid(points, [(12, hexes)])
    shape.cell_data["U"] = np.ones((8, 3))
    path = tmp_path / "flow.vtk"
    shape.save(path, binary=False)
    text = path.read_text()
    path.write_text(text.replace("CELL_TYPES 8\n12", f"CELL_TYPES 8\n{kind}"))
    with pytest.raises(InputError, match=f"a {name} does not have 4 points"):
        read_mesh_file(path)


@pytest.mark.parametrize("start", [1 << 40, 14336, 5])
def test_starts_of_cells_that_do_not_fit_are_refused(start, tmp_path):
    """The second offset in a legacy file, of 64 bits."""
    points, hexes = corners(2, 0.2)
    shape = grid(points, [(12, hexes)])
    shape.cell_data["U"] = np.ones((8, 3))
    path = tmp_path / "flow.vtk"
    shape.save(path, binary=True)
    data = path.read_bytes()
    at = data.index(b"\n", data.index(b"OFFSETS")) + 1 + 8
    assert int.from_bytes(data[at : at + 8], "big") == 8
    path.write_bytes(data[:at] + start.to_bytes(8, "big") + data[at + 8 :])
    with pytest.raises(InputError, match=r"flow\.vtk"):
        read_mesh_file(path)


def test_a_file_that_vtk_does_not_survive_is_refused(tmp_path):
    """The points are said to lie in no compressed block instead of one."""
    points, hexes = corners(2, 0.2)
    shape = grid(points, [(12, hexes)])
    shape.cell_data["U"] = np.ones((8, 3))
    path = tmp_path / "flow.vtu"
    shape.save(path)
    text = path.read_text()
    assert "AQAAAACAAACIAgAA" in text
    path.write_text(text.replace("AQAAAACAAACIAgAA", "AAAAAACAAACIAgAA"))
    with pytest.raises(InputError, match=r"flow\.vtu: VTK"):
        read_mesh_file(path)


def test_a_file_that_vtk_never_ends_with_is_refused(tmp_path, monkeypatch):
    """It counts up to a number of components that is none."""
    monkeypatch.setattr(vtk_guard, "_LEAST_TIME", 1)
    path = tmp_path / "flow.vtu"
    flowing().save(path)
    text = path.read_text()
    assert 'Name="U" NumberOfComponents="3"' in text
    path.write_text(
        text.replace('Name="U" NumberOfComponents="3"', f'Name="U" NumberOfComponents="{20 * "9"}"')
    )
    with pytest.raises(InputError, match="VTK has not finished within 1 s of processor time"):
        read_mesh_file(path)


def test_inside_out_cells_are_refused(tmp_path):
    points, hexes = corners(1, 0.0)
    points[:, 2] *= -0.0
    shape = grid(points, [(12, hexes)])
    shape.cell_data["U"] = np.ones((1, 3))
    shape.save(tmp_path / "flow.vtu")
    with pytest.raises(InputError, match="1 of 1 cells have no positive volume; the first is cell 0"):
        read_mesh_file(tmp_path / "flow.vtu")


@pytest.mark.parametrize("time", ["inf", "nan"])
def test_a_time_that_is_none_is_refused(tmp_path, time):
    flowing("tetrahedra").save(tmp_path / "flow_0.vtu")
    flowing("tetrahedra").save(tmp_path / "flow_1.vtu")
    sets = (f'<DataSet timestep="{t}" file="flow_{k}.vtu"/>' for k, t in enumerate(("0", time)))
    head = '<?xml version="1.0"?><VTKFile type="Collection" version="0.1"><Collection>'
    (tmp_path / "flow.pvd").write_text(f"{head}{''.join(sets)}</Collection></VTKFile>")
    with pytest.raises(InputError, match=rf"flow.pvd: the time {time} is not finite"):
        read_mesh_file(tmp_path / "flow.pvd")


@pytest.mark.parametrize(
    ("where", "message"),
    [
        ("cell_data", r"the first is \(1 nan 0\) at cell 5\."),
        ("point_data", r"the first is \(1 nan 0\) at point 5\."),
    ],
)
def test_a_velocity_that_is_no_number_is_named_with_its_place(where, message, tmp_path):
    shape = block(2)
    values = np.tile([1.0, 0.0, 0.0], (shape.n_cells if where == "cell_data" else shape.n_points, 1))
    values[5, 1] = np.nan
    getattr(shape, where)["U"] = values
    shape.save(tmp_path / "flow.vtu")
    with pytest.raises(InputError, match=message):
        read_mesh_file(tmp_path / "flow.vtu")


def driven(x):
    """The curl of (0, 0, s(x) g(y) s(z)) with s = sin² πx and g = y² (y − 1): a lid at y = 1 slides."""
    s, ds = np.sin(np.pi * x) ** 2, np.pi * np.sin(2.0 * np.pi * x)
    u, y = np.zeros_like(x), x[:, 1]
    u[:, 0], u[:, 1] = s[:, 0] * y * (3.0 * y - 2.0) * s[:, 2], -ds[:, 0] * y**2 * (y - 1.0) * s[:, 2]
    return u


@pytest.mark.parametrize(
    ("kind", "suffix", "where"),
    [
        ("tetrahedra", "vtu", "cell_data"), ("tetrahedra", "vtu", "point_data"),
        ("prisms", "vtu", "cell_data"), ("prisms", "vtk", "point_data"),
        ("hexahedra", "xdmf", "cell_data"), ("hexahedra", "msh", "point_data"),
    ],
)  # fmt: skip
def test_hardly_anything_sticks_in_a_closed_box_with_a_lid_that_slides(kind, suffix, where, tmp_path):
    shape = block(6, 0.3, kind)
    places = build_mesh(shape).centres if where == "cell_data" else np.asarray(shape.points)
    getattr(shape, where)["U"] = driven(places)
    path = tmp_path / f"flow.{suffix}"
    if suffix.startswith("vt"):
        shape.save(path)
    else:
        pyvista.to_meshio(shape).write(path, **({"file_format": "gmsh"} if suffix == "msh" else {}))
    flow = read_mesh_file(path)
    assert {patch.type for patch in flow.patches} == {"wall"}
    bodies = spheres(np.random.default_rng(7).uniform(0.02, 0.98, (300, 3)), d=1e-9, rho=1.0, mu=1e3)
    still = Medium(1e-3, 1.0, (0.0, 0.0, 0.0))
    cloud = Cloud(bodies, flow, still, patch_interactions(flow, Stick()), 0.1, Models("roscoe"))
    cloud.advance(300)
    assert np.count_nonzero(cloud.particles.status != Status.ACTIVE) <= 1
