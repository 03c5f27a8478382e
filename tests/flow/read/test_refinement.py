"""Flows on meshes whose faces change in time, as by refinement."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import GRADIENT, header, put_linear, put_scalar, put_zones, write_case
from mesh_shapes import octants

from foamprb import Cloud, Escape, Medium, Status, Stick, spheres
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import assemble
from foamprb.flow.read.openfoam import read_series
from foamprb.flow.read.refinement import finest
from foamprb.flow.series import SeriesFlow

TIMES = ("0", "0.05", "0.1")


def refined(*fine):
    return assemble(octants(*fine), "mesh")


def remeshed(folder, *meshes):
    """A linear velocity at three times, each on its own mesh."""
    write_case(folder, times=TIMES, mesh=meshes[0])
    for time, mesh in zip(TIMES[1:], meshes[1:], strict=True):
        other = folder.parent / f"{folder.name}{time}"
        write_case(other, times=TIMES, mesh=mesh)
        shutil.copytree(other / "constant/polyMesh", folder / time / "polyMesh")
        shutil.copy(other / time / "U", folder / time / "U")
    return folder


@pytest.mark.parametrize(("a", "b"), [((0,), (7,)), ((0,), (1,)), ((0, 3), (1, 3)), ((), (2,))])
def test_the_finest_cells_of_two_meshes_make_one(a, b):
    """Its faces are shared by the finer cells; points hang in the edges of the others."""
    mesh, expected = finest(refined(*a), refined(*b), octants(*b), "b"), refined(*{*a, *b})
    assert mesh.n_cells == expected.n_cells
    assert len(mesh.owner) == len(expected.owner)
    assert np.sort(np.diff(mesh.face_start)) == pytest.approx(np.sort(np.diff(expected.face_start)))
    assert np.unique(mesh.points, axis=0) == pytest.approx(np.unique(expected.points, axis=0))
    assert np.sort(mesh.volumes) == pytest.approx(np.sort(expected.volumes))
    assert np.array_equal(
        mesh.patch_start - mesh.patch_start[0], expected.patch_start - expected.patch_start[0]
    )


def test_a_linear_flow_is_the_same_on_every_mesh(tmp_path):
    case = remeshed(tmp_path / "case", refined(0), refined(1), refined(7))
    put_zones(case, last=[14])
    flow = read_series(case)
    assert any("nodes of a mesh of 29 cells, the finest of all times" in note for note in flow.notes)
    assert flow.cell_zone("last").volumes.sum() == pytest.approx(0.125)
    x = np.random.default_rng(2).uniform(0.01, 0.99, (50, 3))
    for time in (0.0, 0.03, 0.05, 0.08, 0.1):
        flow.load(time, time)
        u, l = flow.sample(x, flow.locate(x), time)
        assert u == pytest.approx(x @ GRADIENT.T, abs=1e-6)
        assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=1e-5)


def test_paths_in_a_linear_flow_are_those_on_one_mesh(tmp_path):
    """All bodies go on where the mesh changes, and meet the same walls."""
    x = np.random.default_rng(1).uniform(0.02, 0.6, (50, 3))
    ends = []
    for name, meshes in {"one": [refined()] * 3, "case": [refined(0), refined(), refined(1, 7)]}.items():
        bodies = spheres(x, d=1e-6, rho=1000.0, mu=1e3)
        flow = read_series(remeshed(tmp_path / name, *meshes))
        Cloud(bodies, flow, Medium(1e-3, 1000.0), [Stick(), Escape(), Stick()], 0.002, threads=1).advance(50)
        ends.append(bodies)
    one, other = ends
    assert 5 < (one.status == Status.ACTIVE).sum() < 45
    assert np.array_equal(one.status, other.status)
    assert other.x == pytest.approx(one.x, abs=1e-5)


def test_gas_that_is_compressed_keeps_its_mass_as_on_one_mesh(tmp_path):
    """The velocity is −x, and the density grows with e³ᵗ."""
    ends = []
    for name, meshes in {
        "one": [refined(0, 1, 7)] * 3,
        "case": [refined(0), refined(), refined(1, 7)],
    }.items():
        case = remeshed(tmp_path / name, *meshes)
        for time, mesh in zip(TIMES, meshes, strict=True):
            put_linear(case / time, mesh, "U", -np.eye(3), 0.0, "[0 1 -1 0 0 0 0]")
            put_scalar(case / time, "rho", "1 -3 0", np.exp(3.0 * float(time)))
        text = header("dictionary", "thermophysicalProperties") + "thermoType { type hePsiThermo; }"
        (case / "constant/thermophysicalProperties").write_text(text)
        x = np.random.default_rng(1).uniform(0.02, 0.9, (50, 3))
        bodies = spheres(x, d=1e-6, rho=1000.0, mu=1e3)
        Cloud(bodies, read_series(case), Medium(1e-3, 1000.0), [Escape()] * 3, 0.002, threads=1).advance(50)
        ends.append(bodies.x)
    assert ends[0] == pytest.approx(x * np.exp(-0.1), abs=0.01)
    assert ends[1] == pytest.approx(ends[0], abs=1e-3)


def test_faces_that_are_written_again_and_stay_the_same_change_nothing(tmp_path):
    flow = read_series(remeshed(tmp_path / "case", *[refined(0)] * 3))
    assert type(flow) is SeriesFlow
    assert not any("faces change" in note for note in flow.notes)


@pytest.mark.parametrize("factor", [(1.1, 1.0, 1.0), (1.1, 1.0 / 1.1, 1.0)])
def test_other_cells_within_a_boundary_that_is_stretched_are_reported(tmp_path, factor):
    case = remeshed(tmp_path / "case", refined(), refined(), refined(0))
    points = case / "0.1/polyMesh/points"

    def moved(m):
        x = (float(x) * f for x, f in zip(m.groups(), factor, strict=True))
        return "({:.17g} {:.17g} {:.17g})".format(*x)

    points.write_text(re.sub(r"\((\S+) (\S+) (\S+)\)", moved, points.read_text()))
    message = (
        r"case, mesh at 0(\.05)? s: the cells are no parts of those of other times, and those do not fit "
        r"into this mesh: .* Allowed: cells that are divided .* boundary is at rest; layers of cells"
    )
    with pytest.raises(InputError, match=message):
        read_series(case)
