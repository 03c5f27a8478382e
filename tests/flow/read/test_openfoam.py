from __future__ import annotations

import gzip
import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
import pyvista
from foam_writer import GRADIENT, Format, header, number_list, read_fields, write_case
from mesh_shapes import block, box_patches, pipe
from paths import PIPE

from foamprb.cloud.patches import Stick
from foamprb.errors import InputError
from foamprb.flow.base import Patch
from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.boundary import read_boundary
from foamprb.flow.read.case import available_times
from foamprb.flow.read.describe import describe
from foamprb.flow.read.meshfile import read_mesh_file
from foamprb.flow.read.openfoam import Case, read_case
from foamprb.settings.patches import KindRule, match_patches

POLY = "constant/polyMesh/"


@pytest.fixture
def case(tmp_path):
    write_case(tmp_path / "case")
    return tmp_path / "case"


def edit(path, pattern, replacement, count=1):
    text = path.read_text()
    changed = re.sub(pattern, replacement, text, count=count)
    assert changed != text
    path.write_text(changed)


@pytest.mark.parametrize("kind", ["hexahedra", "tetrahedra", "prisms", "pyramids", "polyhedra", "mixed"])
def test_a_case_is_read_as_it_was_written(kind, tmp_path):
    written = write_case(tmp_path, kind)
    mesh, cells, boundary, name = read_fields(tmp_path)
    assert name == "1e1"
    assert [patch[:2] for patch in mesh.patches] == [("floor", "wall"), ("lid", "patch"), ("sides", "wall")]
    assert np.array_equal(mesh.patch_start, written.patch_start)
    assert mesh.centres == pytest.approx(written.centres, abs=1e-6)
    assert mesh.boundary_centres == pytest.approx(written.boundary_centres, abs=1e-6)
    assert cells == pytest.approx(mesh.centres @ GRADIENT.T, abs=1e-5)
    assert boundary == pytest.approx(mesh.boundary_centres @ GRADIENT.T, abs=1e-5)


@pytest.mark.parametrize("lost", [b"internalField", b"boundaryField"])
def test_a_binary_list_that_has_lost_bytes_has_a_message(lost, tmp_path):
    write_case(tmp_path, "hexahedra", form=Format(binary=True, label=64, scalar=32))
    path = tmp_path / "1e1" / "U"
    data = path.read_bytes()
    at = data.index(b"(", data.index(lost)) + 5
    path.write_bytes(data[:at] + data[at + 7 :])
    with pytest.raises(InputError, match=r"U: line \d+: a list of \d+ entries in binary expected"):
        read_case(tmp_path)


def test_a_binary_field_without_a_brace_has_a_message(tmp_path):
    write_case(tmp_path, "hexahedra", form=Format(binary=True, label=64, scalar=32))
    path = tmp_path / "1e1" / "U"
    data = path.read_bytes()
    at = data.index(b"{", data.index(b"boundaryField"))
    path.write_bytes(data[:at] + data[at + 1 :])
    with pytest.raises(InputError, match=r"1e1/U, line \d+: 'boundaryField' has no closing ;"):
        read_case(tmp_path)


@pytest.mark.parametrize("label", [32, 64])
@pytest.mark.parametrize("scalar", [32, 64])
@pytest.mark.parametrize("kind", ["mixed", "polyhedra"])
@pytest.mark.parametrize("compressed", [False, True])
def test_binary_cases(label, scalar, kind, compressed, tmp_path):
    written = write_case(tmp_path, kind, form=Format(True, label, scalar, compressed))
    mesh, cells, boundary, _ = read_fields(tmp_path)
    assert mesh.centres == pytest.approx(written.centres, abs=1e-6)
    assert np.array_equal(mesh.patch_start, written.patch_start)
    assert cells == pytest.approx(mesh.centres @ GRADIENT.T, abs=1e-5)
    assert boundary == pytest.approx(mesh.boundary_centres @ GRADIENT.T, abs=1e-5)


def test_the_flow_of_a_case(case, random):
    flow = read_case(case, 0.5)
    points = random.random((200, 3))
    u, l = flow.sample(points, flow.locate(points), 0.0)
    assert u == pytest.approx(points @ GRADIENT.T, abs=2e-5)
    assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=2e-4)
    # The linear velocity goes across the walls.
    assert all("across its faces" in note for note in flow.notes)
    assert any("initial guess" in note for note in read_case(case, "0").notes)


def test_old_lists_of_neighbours_and_owners_are_read(case):
    """With −1 for each boundary face, and the type of the list before its length."""
    before = read_fields(case)
    path = case / POLY / "neighbour"
    edit(path, r"\n12\n\(([^)]*)\)", lambda match: f"\n36\n({match[1]}{24 * '-1 '})")
    edit(case / POLY / "owner", r"\n36\n\(", "\nList<label> 36 ( // owners\n")
    mesh = read_fields(case)[0]
    assert np.array_equal(mesh.neighbour, before[0].neighbour)
    assert np.array_equal(mesh.owner, before[0].owner)


def test_a_mesh_may_lie_in_a_time_folder(case):
    (case / "0.5/polyMesh").parent.mkdir(exist_ok=True)
    (case / POLY).rename(case / "0.5/polyMesh")
    assert read_case(case).mesh.n_cells == 8
    assert len(describe(Case(case)).patches) == 3
    with pytest.raises(InputError, match="boundary: no such file"):
        read_case(case, "0")


@pytest.mark.parametrize("far", [(1000.0, 0.0, 0.0), (581749.0, 4785670.0, 0.0)])
def test_a_mesh_far_from_the_origin_keeps_its_cells(far, tmp_path):
    """Of a millimetre: single precision has steps of half a metre there."""
    near = write_case(tmp_path)
    points = 1e-3 * near.points + far
    (tmp_path / POLY / "points").write_bytes(
        header("vectorField", "points", form=Format(binary=True)).encode()
        + number_list(points, Format(binary=True))
    )
    mesh = read_case(tmp_path).mesh
    assert np.array_equal(mesh.points, points)
    round_off = 4.0 * np.spacing(np.abs(points).max()) / 1e-3
    np.testing.assert_allclose(mesh.volumes, 1e-9 * near.volumes, rtol=20.0 * round_off)


def compressed_beside(path, text):
    """Put a compressed file of another text beside a file."""
    with gzip.open(f"{path}.gz", "wt") as file:
        file.write(text)


def test_a_plain_file_counts_before_a_compressed_one(case):
    """As in OpenFOAM; mesh files and fields alike."""
    plain = read_case(case)
    points, velocity = case / POLY / "points", case / "1e1" / "U"
    compressed_beside(points, re.sub(r"\((\S+) (\S+) (\S+)\)", r"(1\1 \2 \3)", points.read_text()))
    compressed_beside(velocity, re.sub(r"\((\S+) (\S+) (\S+)\)", "(1 2 3)", velocity.read_text()))
    compressed_beside(case / POLY / "boundary", "nonsense")
    both = read_case(case)
    for name, a, b in zip(plain.arrays()._fields, plain.arrays(), both.arrays(), strict=True):
        np.testing.assert_array_equal(a, b, err_msg=name)
    velocity.unlink()
    centres = plain.mesh.centres
    only = read_case(case)
    assert only.sample(centres, only.locate(centres), 0.0)[0] == pytest.approx(
        np.tile([1.0, 2.0, 3.0], (8, 1))
    )


def test_a_time_without_permission_is_not_passed_over(case, monkeypatch):
    access = os.access
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path).name != "1e1" and access(path, mode))
    with pytest.raises(InputError, match="1e1: this folder cannot be read: no permission"):
        read_case(case)


def test_description(case):
    info = describe(Case(case))
    assert [time.name for time in info.times] == ["0", "0.5", "1e1"]
    assert info.times[0].fields == {"U": "volVectorField", "p": "volScalarField"}
    assert [p[:3] for p in info.patches] == [("floor", "wall", 4), ("lid", "patch", 4), ("sides", "wall", 16)]
    assert [p.start - info.patches[0].start for p in info.patches] == [0, 4, 8]
    assert (info.points, info.cells) == (27, {"hexahedron": 8})
    assert np.array_equal(info.bounds, [[0.0] * 3, [1.0] * 3])


def test_many_times_with_the_same_fields_have_one_line(case):
    for k in range(100):
        shutil.copytree(case / "0.5", case / f"{20 + k}")
    (case / "50/T").write_text((case / "0.5/p").read_text().replace("object p", "object T"))
    lines = describe(Case(case)).lines()
    times = [line[4:24].strip() for line in lines[lines.index("Times and fields") + 1 :]]
    assert times == ["0 to 49 (33 times)", "50", "51 to 119 (69 times)"]


def test_a_mesh_that_moves_is_described_as_it_is_at_the_last_time(case):
    """Of a box in the unit cube, one corner moves from 0 to −1."""
    for time, x in (("0.5", -7), ("1e1", -1)):
        (case / time / "polyMesh").mkdir()
        text = (case / "constant/polyMesh/points").read_text()
        assert text.count("(0 0 0)") == 1
        (case / time / "polyMesh/points").write_text(text.replace("(0 0 0)", f"({x} 0 0)"))
    assert np.array_equal(describe(Case(case)).bounds, [[-1.0, 0.0, 0.0], [1.0, 1.0, 1.0]])


def test_regions(case):
    whole = read_fields(case)
    with pytest.raises(InputError, match="no region air; the case is not divided into regions"):
        read_case(case, region="air")
    folders = [case / "constant", *(case / time for time in available_times(case))]
    for folder in folders:
        (folder / "air").mkdir()
        for path in [p for p in folder.iterdir() if p.name != "air"]:
            path.rename(folder / "air" / path.name)
    shutil.copytree(case / "constant" / "air", case / "constant" / "iron")
    mesh, cells, boundary, name = read_fields(case, region="air")
    assert name == "1e1"
    assert np.array_equal(mesh.tets, whole[0].tets)
    assert np.array_equal(cells, whole[1])
    assert np.array_equal(boundary, whole[2])
    info = describe(Case(case, "air"))
    assert (info.region, info.regions, info.points) == ("air", ("air", "iron"), 27)
    assert info.times[0].fields == {"U": "volVectorField", "p": "volScalarField"}
    assert "Region  air" in info.lines()
    with pytest.raises(
        InputError, match=r"divided into regions; choose one with -region\. Allowed: air, iron"
    ):
        read_case(case)
    with pytest.raises(InputError, match=r"no region aire\. Did you mean 'air'"):
        read_case(case, region="aire")
    with pytest.raises(InputError, match=r"iron: no field U; the fields are \(none\)"):
        read_case(case, region="iron")


def test_cyclic_patches_of_a_case(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    edit(tmp_path / POLY / "boundary", "type wall; inGroups", "type cyclic; neighbourPatch lid; inGroups")
    edit(tmp_path / POLY / "boundary", "type patch; inGroups", "type cyclic; neighbourPatch floor; inGroups")
    edit(tmp_path / "1e1" / "U", "floor { type fixedValue", "floor { type cyclic")
    edit(tmp_path / "1e1" / "U", "lid { type fixedValue", "lid { type cyclic")
    flow = read_case(tmp_path)
    assert [patch[:3] for patch in flow.patches[:2]] == [
        ("floor", "cyclic", "lid"),
        ("lid", "cyclic", "floor"),
    ]
    assert flow.mesh.couplings[0].shift == pytest.approx([0.0, 0.0, 1.0])
    assert np.array_equal(flow.mesh.couplings[0].turn, np.eye(3))


def test_how_an_interface_lies_to_its_neighbour_is_what_the_file_says(tmp_path):
    """The angle in degrees."""
    write_case(tmp_path)
    path = tmp_path / POLY / "boundary"
    around = "rotationAxis (1 2 3); rotationCentre (4 5 6); rotationAngle -30;"
    edit(path, "type wall;", f"type cyclicAMI; neighbourPatch lid; transform rotational; {around}")
    edit(path, "type patch;", "type cyclicAMI; transform translational; separationVector (7 8 9);")
    floor, lid, sides = (patch.transform for patch in read_boundary(path, tmp_path))
    assert floor == ("rotational", None, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), pytest.approx(-np.pi / 6.0))
    assert lid == ("translational", (7.0, 8.0, 9.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), None)
    assert sides == Transform()


@pytest.mark.parametrize(
    ("pattern", "replacement", "message"),
    [
        ("neighbourPatch lid", "neighbourPatch lib", r"lib of the cyclic patch floor is not there\. Did you"),
        ("neighbourPatch lid", "neighbourPatch floor", "floor names floor as its neighbour"),
        ("type cyclic; neighbourPatch lid", "type wall", "lid names floor .* floor is of type wall"),
    ],
)
def test_cyclic_patches_that_do_not_fit(pattern, replacement, message, tmp_path):
    write_case(tmp_path, perturbation=0.0)
    edit(tmp_path / POLY / "boundary", "type wall; inGroups", "type cyclic; neighbourPatch lid; inGroups")
    edit(tmp_path / POLY / "boundary", "type patch; inGroups", "type cyclic; neighbourPatch floor; inGroups")
    edit(tmp_path / POLY / "boundary", pattern, replacement)
    with pytest.raises(InputError, match=message):
        read_case(tmp_path)


def cut(name, share=0.5):
    def breakage(case):
        path = case / name
        path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])

    return breakage


def cut_compressed(case):
    path = case / "1e1" / "U"
    packed = gzip.compress(path.read_bytes())
    (case / "1e1" / "U.gz").write_bytes(packed[: len(packed) // 2])
    path.unlink()


def rewrite(name, pattern, replacement):
    return lambda case: edit(case / name, pattern, replacement)


def remove(name):
    def breakage(case):
        path = case / name
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()

    return breakage


BREAKAGES = {
    "no mesh": (remove(POLY[:-1]), r"polyMesh: no mesh here\. Make it and the flow first"),
    "no U": (remove("1e1/U"), r"1e1: no field U; the fields are p\."),
    "U cut short": (cut("1e1/U"), "1e1/U"),
    "U cut in the boundary": (cut("1e1/U", 0.9), "1e1/U"),
    "U.gz cut short": (cut_compressed, "1e1/U.gz"),
    "U empty": (cut("1e1/U", 0.0), r"1e1/U: the class is \(none\)"),
    "U of another mesh": (rewrite("1e1/U", r"<vector> 8\n\(\n\(", "<vector> 9\n(\n(0 0 0)\n("), "U"),
    "U not finite": (
        rewrite("1e1/U", r"<vector> 8\n\(\n\(\S+", "<vector> 8\n(\n(nan"),
        r"1e1/U: 1 of 8 values are not finite .*; the first is \(nan \S+ \S+\) at cell 0\.",
    ),
    "U a scalar": (rewrite("1e1/U", "volVectorField", "volScalarField"), "the class is volScalarField"),
    "U without a patch": (
        rewrite("1e1/U", "lid", "lit"),
        "for patch lid. Did you mean 'lit'",
    ),
    "owner out of range": (
        rewrite(POLY + "owner", r"\n7\n", "\n9999\n"),
        "owner: face 19 belongs to cell 9999, but there are 36 cells",
    ),
    "owner cut short": (cut(POLY + "owner"), "owner"),
    "neighbour out of range": (
        rewrite(POLY + "neighbour", r"\n7\n", "\n77\n"),
        "belongs to cell 77, but there are 8",
    ),
    "a cell on both sides": (
        rewrite(POLY + "neighbour", r"\n\(\n1\n", "\n(\n0\n"),
        "neighbour: face 0 has cell 0 on both sides",
    ),
    "a face of some billion points": (
        rewrite(POLY + "faces", r"\n4\(", "\n2147483647("),
        "faces: line 5: a list of 36 faces expected",
    ),
    "some billion points": (
        rewrite(POLY + "points", r"\n27\n", "\n2147483646\n"),
        r"points: line 7: a list of 2147483646 entries, not 27, expected",
    ),
    "no points": (remove(POLY + "points"), "points"),
    "no owner": (remove(POLY + "owner"), "owner: no such file"),
    "boundary cut short": (cut(POLY + "boundary", 0.7), "boundary"),
    "no boundary": (remove(POLY + "boundary"), "boundary: no such file"),
    "boundary lacks a patch": (
        rewrite(POLY + "boundary", r"3\n\(\n\s*floor.*\n.*\n", "2\n(\n"),
        "the patches have the faces from 16 to 36, but the faces of one cell are those from 12 to 36",
    ),
    "patch of wrong size": (
        rewrite(POLY + "boundary", "nFaces 16", "nFaces 15"),
        "the patches have the faces from 12 to 35, but the faces of one cell are those from 12 to 36",
    ),
    "a cell without faces": (
        rewrite(POLY + "owner", r"\n7\n(\)|$)", r"\n8\n\1"),
        "owner: cell 8 has 1 faces. Allowed: at least 4",
    ),
    "point out of range": (
        rewrite(POLY + "faces", r"\n4\(\d+", "\n4(27"),
        "faces: face 0 has point 27, but there are 27 points",
    ),
    "patch of a type misspelt": (
        rewrite(POLY + "boundary", "type wall", "type wal"),
        r"boundary, line 8: boundary/floor/type is 'wal'\. Did you mean 'wall'\?",
    ),
    "a curved symmetry plane": (
        lambda case: (
            edit(
                case / POLY / "boundary", r"sides // a patch\n    \{ type wall", "sides { type symmetryPlane"
            ),
            edit(case / "1e1/U", r"sides \{[^}]*\}", "sides { type symmetryPlane; }"),
        ),
        "patch sides is of type symmetryPlane, but not planar: its faces turn by up to 180",
    ),
    "gap between patches": (rewrite(POLY + "boundary", "nFaces 4", "nFaces 3"), "lid starts at face"),
    "patch twice": (rewrite(POLY + "boundary", "lid", "floor"), "line 9: boundary/floor occurs twice"),
    "patch without type": (rewrite(POLY + "boundary", "type patch;", ""), "lid/type is missing"),
    "patch size no number": (
        rewrite(POLY + "boundary", "nFaces 16", "nFaces x"),
        "sides/nFaces is 'x'",
    ),
    "too few patches": (rewrite(POLY + "boundary", r"\n3\n", "\n4\n"), "'4' is not the number of entries"),
    "boundary is no list": (rewrite(POLY + "boundary", r"\n3\n", "\nthree\n"), "where a number and a list"),
    "words behind the boundary": (rewrite(POLY + "boundary", r"\)\n$", ")\nmore\n"), "behind the list"),
}


@pytest.mark.parametrize("name", BREAKAGES)
def test_a_broken_case_gives_its_one_message(name, case, capfd):
    breakage, message = BREAKAGES[name]
    breakage(case)
    with pytest.raises(InputError, match=message) as caught:
        read_case(case)
    assert str(case) in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_a_type_of_somebodys_library_is_a_plain_patch(case):
    """OpenFOAM makes a generic patch of it."""
    edit(case / POLY / "boundary", "type patch", "type turbineInlet")
    flow = read_case(case)
    note = "Patch lid is of type turbineInlet, which is taken for a plain patch, as by OpenFOAM."
    assert note in flow.notes
    assert flow.patches[1][:2] == ("lid", "turbineInlet")


def test_a_damaged_owner_is_found(tmp_path):
    write_case(tmp_path)
    edit(tmp_path / "constant" / "polyMesh" / "owner", r"\n7\n", "\n999\n")
    with pytest.raises(InputError, match="owner: face 19 belongs to cell 999, but there are 36"):
        read_case(tmp_path)


@pytest.mark.parametrize("label", [32, 64])
def test_lengths_of_faces_that_do_not_fit_are_refused(label, tmp_path):
    write_case(tmp_path, form=Format(True, label))
    path = tmp_path / POLY / "faces"
    data = path.read_bytes()
    at = data.index(b"(", data.index(b"}")) + 1 + 10 * label // 8
    path.write_bytes(data[: at + 2] + b"\x40" + data[at + 3 :])
    with pytest.raises(InputError, match="faces: the lengths of the faces do not fit their points"):
        read_case(tmp_path)


@pytest.mark.parametrize("label", [32, 64])
@pytest.mark.parametrize("name", ["owner", "neighbour"])
def test_a_label_of_some_billions_costs_no_memory(name, label, tmp_path):
    write_case(tmp_path, form=Format(True, label), note=False)
    path = tmp_path / POLY / name
    data = path.read_bytes()
    at = data.index(b"(", data.index(b"}")) + 1
    path.write_bytes(data[: at + 3] + b"\x70" + data[at + 4 :])
    with pytest.raises(InputError, match=f"{name}: face 0 belongs to cell 1879048"):
        read_case(tmp_path)


@pytest.mark.parametrize("value", ["1e35", "1e300"])
def test_numbers_beyond_any_length_are_refused(value, case):
    edit(case / POLY / "points", r"\n\(0 0 0\)", f"\n({value} 0 0)")
    with pytest.raises(InputError, match="1 of 27 points are not finite numbers below 1e"):
        read_case(case)


def test_the_pipe(random):
    flow = read_case(PIPE)
    radius, mean = 2.1e-3, 0.484995
    assert {patch.type for patch in flow.patches if patch.name == "wall"} == {"wall"}
    r, angle = radius * np.sqrt(random.random(5000)), 2.0 * np.pi * random.random(5000)
    x = random.uniform(0.02, 0.09, 5000)
    points = np.column_stack([x, r * np.cos(angle), r * np.sin(angle)])
    hosts = flow.locate(points)
    inside = hosts >= 0
    assert np.count_nonzero(~inside) < 100
    u, l = flow.sample(points[inside], hosts[inside], 0.0)
    off = np.abs(u[:, 0] - 2.0 * mean * (1.0 - (r[inside] / radius) ** 2))
    assert np.sqrt(np.mean(off**2)) < 0.005 * mean
    shear = np.hypot(l[:, 0, 1], l[:, 0, 2]) - 4.0 * mean * r[inside] / radius**2
    assert np.sqrt(np.mean(shear**2)) < 0.01 * 4.0 * mean / radius


@pytest.mark.parametrize("suffix", [".vtu", ".vtk", ".vtm", ".msh", ".pvd"])
@pytest.mark.parametrize("where", ["cell_data", "point_data"])
def test_mesh_files(suffix, where, tmp_path, random):
    shape = block(3, 0.2, "tetrahedra")
    places = shape.points if where == "point_data" else build_mesh(shape).centres
    getattr(shape, where)["U"] = places @ GRADIENT.T
    path = tmp_path / f"flow{suffix}"
    if suffix == ".vtm":
        patches = {}
        for patch in box_patches(shape):
            places = patch.surface.points if where == "point_data" else patch.surface.cell_centers().points
            getattr(patch.surface, where)["U"] = places @ GRADIENT.T
            patches[patch.name] = patch.surface
        pyvista.MultiBlock({"internal": shape, "boundary": pyvista.MultiBlock(patches)}).save(path)
    elif suffix == ".pvd":
        shape.save(tmp_path / "flow_1.vtu")
        path.write_text(
            '<?xml version="1.0"?><VTKFile type="Collection" version="0.1"><Collection>'
            '<DataSet timestep="1" file="flow_1.vtu"/></Collection></VTKFile>'
        )
    elif suffix == ".msh":
        pyvista.save_meshio(path, shape, file_format="gmsh")
    else:
        shape.save(path)
    flow = read_mesh_file(path)
    names = [patch.name for patch in box_patches(shape)]
    several = tuple(Patch(name, "patch") for name in names)
    assert flow.patches == several if suffix == ".vtm" else flow.patches[0] == Patch("opening0", "patch")
    points = random.random((100, 3))
    u, l = flow.sample(points, flow.locate(points), 0.0)
    assert u == pytest.approx(points @ GRADIENT.T, abs=1e-5)
    assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=1e-4)


def test_other_names_of_the_velocity(tmp_path):
    shape = block(2)
    shape.cell_data["velocity"] = np.ones((8, 3))
    shape.cell_data["p"] = np.ones(8)
    path = tmp_path / "flow.vtu"
    shape.save(path)
    assert read_mesh_file(path, "velocity").mesh.n_cells == 8
    with pytest.raises(InputError, match=r"no array U\. Another one is read by -velocity NAME: velocity\."):
        read_mesh_file(path)
    with pytest.raises(InputError, match=r"array p has shape \(8,\)"):
        read_mesh_file(path, "p")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("none.vtu", None, "no such file"),
        ("bad.vtu", b"<VTKFile", "VTK"),
        ("bad.vtk", b"nonsense", "VTK|unstructured"),
        ("bad.msh", b"nonsense", "meshio cannot read it"),
        ("bad.xyz", b"nonsense", "meshio cannot read it"),
    ],
)
def test_unreadable_mesh_files(name, content, message, tmp_path, capfd):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=message):
        read_mesh_file(tmp_path / name)
    assert capfd.readouterr() == ("", "")


def test_a_surface_is_no_mesh(tmp_path):
    pipe(2).extract_surface(algorithm="dataset_surface").cast_to_unstructured_grid().save(
        tmp_path / "surface.vtu"
    )
    with pytest.raises(InputError, match="no cells with volume"):
        read_mesh_file(tmp_path / "surface.vtu")


def test_patch_names_may_have_brackets(case):
    for path in (case / POLY / "boundary", case / "1e1/U"):
        edit(path, r"\bfloor\b", "floor(2)")
    assert read_case(case).patches[0][:2] == ("floor(2)", "wall")


def cyclic(case, floor, lid):
    """Couple floor and lid of a case without displaced points."""
    edit(case / POLY / "boundary", "type wall; inGroups", f"{floor}; inGroups")
    edit(case / POLY / "boundary", "type patch; inGroups", f"{lid}; inGroups")


@pytest.mark.parametrize("groups", ["1(some)", "2(cyclic pair)"])
def test_a_group_names_the_neighbour_of_a_cyclic_patch(groups, tmp_path):
    write_case(tmp_path, perturbation=0.0)
    cyclic(tmp_path, *2 * ["type cyclic; coupleGroup pair"])
    edit(tmp_path / POLY / "boundary", r"1\(some\)", groups + " ", 2)
    for name in ("floor", "lid"):
        edit(tmp_path / "1e1" / "U", f"{name} {{ type fixedValue", f"{name} {{ type cyclic")
    assert [patch.neighbour for patch in read_case(tmp_path).patches] == ["lid", "floor", ""]


def couple_without_faces(case, shift="(0 0 1)"):
    """Add patches of no faces that couple floor and lid, as OpenFOAM.org has them from version 11 on."""
    path = case / POLY / "boundary"
    text = path.read_text().replace("\n3\n(", "\n5\n(").rstrip()[:-1]
    end = 12 + 24
    for own, other, sign in (("floor", "lid", ""), ("lid", "floor", "-")):
        text += (
            f"on_{own} {{ type nonConformalCyclic; nFaces 0; startFace {end}; neighbourPatch on_{other}; "
            f"originalPatch {own}; transformType translational; "
            f"separation {shift.replace('1', sign + '1')}; }}\n"
        )
    path.write_text(text + ")\n")


def test_a_couple_without_faces_couples_the_patches_that_have_them(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    couple_without_faces(tmp_path)
    flow = read_case(tmp_path)
    assert [patch[1:3] for patch in flow.patches[:2]] == [("cyclicAMI", "lid"), ("cyclicAMI", "floor")]
    assert all(patch.groups == {"some"} for patch in flow.patches[:2])
    assert flow.mesh.couplings[0].shift == pytest.approx([0.0, 0.0, 1.0])
    assert "Patch on_floor couples patch floor, which needs no interaction." in flow.notes
    kinds = [PatchKind.PASSABLE] * 2 + [PatchKind.WALL] + [PatchKind.FACELESS] * 2
    assert [patch.kind for patch in flow.patches] == kinds


def test_a_couple_without_faces_that_does_not_fit_is_left_to_the_settings(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    couple_without_faces(tmp_path, "(1 1 0)")
    patches = read_case(tmp_path).patches
    assert [patch[:3] for patch in patches[:2]] == [("floor", "cyclicAMI", ""), ("lid", "cyclicAMI", "")]
    with pytest.raises(InputError, match="particles cannot pass through 'floor'"):
        match_patches([KindRule("wall", Stick())], patches, "file")


@pytest.mark.parametrize("name", ["../../../../pwn", "a/b", "..", '"a b"'])
def test_the_name_of_a_patch_is_a_word(name, case):
    edit(case / "constant/polyMesh/boundary", "floor", name)
    with pytest.raises(InputError, match=r"boundary, line 7: .* is no name for a patch"):
        read_case(case)
