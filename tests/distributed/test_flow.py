"""A flow of which nodes hold parts, as the first process uses it, against the whole flow."""

from __future__ import annotations

import gc
import shutil
import weakref
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from foam_writer import decompose, header, write_case
from thread_mpi import on_nodes
from transient_case import scaled

from foamprb.cloud.block import Medium
from foamprb.cloud.measures import largest_slip
from foamprb.cloud.state import empty
from foamprb.distributed.flow import deepest, distributed_flow, require_divisible
from foamprb.distributed.fragment import IndivisibleMeshError
from foamprb.distributed.node import summary_of
from foamprb.distributed.partcase import PartCase
from foamprb.distributed.worker import Worker
from foamprb.errors import InputError
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.fluid import _NU, ViscosityField
from foamprb.flow.read.foamfile import FoamFile
from foamprb.flow.read.openfoam import flow_of, steady_flow
from foamprb.flow.read.source import FlowSource, FlowTimes


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    case = tmp_path_factory.mktemp("parts") / "case"
    mesh = write_case(case, "mixed")
    decompose(case, mesh, (2 * mesh.centres[:, 0]).astype(int), ("0", "1"))
    for file in case.glob("processor*/0/U"):
        file.write_text(scaled(file.read_text(), -0.5))
    return case


@pytest.fixture(scope="module")
def whole(case):
    return steady_flow(DecomposedCase(case), "1", FlowSource())


def distributed(case, times, source=FlowSource()):  # noqa: B008
    """The flow of two nodes, which execute calls together."""

    def read(team):
        part = flow_of(PartCase(case, "", team, 2), times, source)
        return part, summary_of(part)

    found = on_nodes(2, read)

    def call(function, *arguments):
        if function is Worker.load_part:

            def load(team):
                part = found[team.rank][0]
                until = part.load(*arguments)
                assert part.loaded_fields().columns == part.field_columns
                return until, part.rate

            return on_nodes(2, load)
        assert function is Worker.call_flow
        return on_nodes(2, lambda team: getattr(found[team.rank][0], arguments[0])(*arguments[1:]))

    return distributed_flow(call, lambda *_: [summary for _, summary in found], 0.0)


@pytest.fixture(scope="module")
def flow(case):
    return distributed(case, FlowTimes("1"))


def test_hosts_and_samples_are_those_of_the_whole(flow, whole, random):
    x = random.uniform(-0.1, 1.1, (200, 3))
    hosts = flow.locate(x)
    np.testing.assert_array_equal(hosts, whole.locate(x))
    x, hosts = x[hosts >= 0], hosts[hosts >= 0]
    for found, expected in zip(flow.sample(x, hosts, 0.0), whole.sample(x, hosts, 0.0), strict=True):
        np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(flow.cell_size(hosts), whole.cell_size(hosts))


def test_of_hosts_on_several_nodes_the_deepest_counts_then_the_first():
    """As at a point of two cells that share no point."""
    rows = np.arange(4)
    answers = [
        (rows, np.array([7, 8, 9, 5]), np.array([0.1, 0.0, 0.3, 0.0])),
        (rows[:3], np.array([3, 4, 20]), np.array([0.1, -1e-10, 0.4])),
        (rows[:1], np.array([6]), np.array([0.1])),
    ]
    assert deepest(5, answers).tolist() == [3, 8, 20, 5, -1]


def assert_alike(found, expected):
    """What tells flows apart is the same but for round-off."""
    assert found.keys() == expected.keys()
    for name, value in expected.items():
        value = np.asarray(value)
        if value.dtype.kind == "u":
            assert np.array_equal(found[name], value), name
        else:
            np.testing.assert_allclose(found[name], value, rtol=1e-12, atol=1e-13, err_msg=name)


def test_what_tells_a_flow_from_another_is_that_of_the_whole(flow, whole):
    assert_alike(flow.traits(), whole.traits())
    assert np.any(whole.traits()["fluxes"])


@pytest.mark.parametrize("few", [100, 8])
def test_values_for_the_log_are_those_of_the_whole(few, flow, whole, monkeypatch):
    monkeypatch.setattr("foamprb.flow.nodes._FEW", few)
    n = assert_nodes_alike(flow, whole)
    assert n == 39 if few == 100 else 8 <= n < 16


def assert_nodes_alike(flow, whole):
    """The chosen nodes have the same order and bits; return their number."""
    some, expected = flow.at_some_nodes(), whole.at_some_nodes()
    assert some.time == expected.time
    for found, values in zip(some[1:], expected[1:], strict=True):
        np.testing.assert_array_equal(found, values)

    def quantities(values):
        return *values.u.T, values.l[:, 1][values.l[:, 1] > 0.0], values.viscosity, *values.turbulence.T

    assert flow.ends_at_nodes(quantities) == whole.ends_at_nodes(quantities)
    assert len(flow.ends_at_nodes(quantities)) >= 5
    return len(some.u)


def test_patches_and_zones_are_those_of_the_whole(flow, whole):
    assert (flow.patches, flow.width, flow.mesh[:2]) == (whole.patches, whole.width, (12, 27))
    np.testing.assert_array_equal(flow.bounds, whole.bounds)
    for found, expected in zip(flow.patch_faces("lid", 0.0), whole.patch_faces("lid", 0.0), strict=True):
        np.testing.assert_array_equal(found, expected)
    zone, expected = flow.cell_zone(None), whole.cell_zone(None)
    np.testing.assert_array_equal(zone.volumes, expected.volumes)
    np.testing.assert_array_equal(zone.vertices(zone.hosts), expected.vertices(expected.hosts))
    for found, expected in zip(flow.mesh_sizes(), whole.mesh_sizes(), strict=True):
        np.testing.assert_array_equal(found, expected)
    with pytest.raises(InputError, match=r"patch lit is not in the mesh\. Did you mean 'lid'"):
        flow.patch_faces("lit", 0.0)


@pytest.mark.parametrize("period", [None, 2.0])
def test_a_flow_in_time_is_that_of_the_whole(period, case, random):
    times = FlowTimes(None, True, period)
    whole, flow = flow_of(DecomposedCase(case), times, FlowSource()), distributed(case, times)
    assert (flow.span, flow.kernels, flow.notes) == (whole.span, whole.kernels, whole.notes)
    x = random.uniform(0.0, 1.0, (100, 3))
    hosts = flow.locate(x)
    for t in (0.0, 0.6, 1.0, 2.3)[: 4 if period else 3]:
        for found, expected in zip(flow.sample(x, hosts, t), whole.sample(x, hosts, t), strict=True):
            np.testing.assert_array_equal(found, expected)
    for found, expected in zip(flow.patch_faces("lid", 0.4), whole.patch_faces("lid", 0.4), strict=True):
        np.testing.assert_array_equal(found, expected)
    assert flow.load(0.2, 0.4) == 1.0
    assert_alike(flow.traits(), whole.traits())
    # The faster one of the loaded times counts.
    assert flow.rate == distributed(case, FlowTimes("1")).rate
    assert flow.times_within(-1.0, 9.0)[:2] == [0.0, 1.0]


def test_bodies_that_settle_pass_more_cells(flow):
    p = empty(2)
    p.R[:], p.rho[:], p.v[:] = (1e-4, 2e-4), 1900.0, ((0.0, 0.0, 0.0), (np.nan, 0.0, 0.0))
    slip = largest_slip(p, Medium(1e-3, 1000.0, (0.0, 0.0, -9.81)))
    assert slip == pytest.approx(2.0 * 2.0 / 9.0 * 900.0 * 9.81 * 4e-8 / 1e-3)
    before = flow.rate
    flow.expect(slip, 0.0)
    # Of cubes of half a metre and smaller cells.
    assert (flow.rate - before) / slip >= 2.0
    flow.expect(0.0, 0.0)


def put(case, name, unit, values, kind="volScalarField", boundary=1.0):
    """Write a field of the processors; ``values`` returns those of cells, by their numbers, at a time."""
    for folder in case.glob("processor*/[01]"):
        cells = FoamFile(folder.parent / "constant/polyMesh/cellProcAddressing").labels()
        found = values(cells, float(folder.name))
        (folder / name).write_text(
            f"{header(kind, name)} dimensions {unit};\n"
            f"internalField nonuniform List<scalar> {len(found)} ({' '.join(map(str, found))});\n"
            f'boundaryField {{ ".*" {{ type calculated; value uniform {boundary}; }} }}\n'
        )


def test_a_case_with_rotating_zones_is_read_as_a_whole(case, tmp_path):
    case = Path(shutil.copytree(case, tmp_path / "case"))
    (case / "constant/MRFProperties").write_text(
        header("dictionary", "MRFProperties")
        + "a { cellZone some; origin (0.1 0 0); axis (0 1 1); omega 30; }"
    )
    require_divisible(case, FlowSource(decomposed=True), 2)
    with pytest.raises(IndivisibleMeshError, match="the case has rotating zones"):
        require_divisible(case, FlowSource(decomposed=True, relative=True), 2)


GAS = "thermoType { equationOfState perfectGas; } mixture { specie { molWeight 28.9; } }"


@pytest.mark.parametrize("times", [FlowTimes("1"), FlowTimes(None, True)])
@pytest.mark.parametrize("known", ["rho", "p and T", "T on one node"])
def test_a_flow_of_varying_density_is_that_of_the_whole(known, times, case, random, tmp_path):
    """On each node alone the density is constant; where it is not known, cells keep what they make."""
    plain = flow_of(DecomposedCase(case), times, FlowSource())
    case = Path(shutil.copytree(case, tmp_path / "case"))
    half = FoamFile(case / "processor0/constant/polyMesh/cellProcAddressing").labels()
    # The fluxes between cells, which are fewer than cells here, are not used.
    put(case, "phi", "[1 0 -1 0 0 0 0]", lambda *_: [7.0], "surfaceScalarField")
    if known == "rho":
        put(case, "rho", "[1 -3 0 0 0 0 0]", lambda cells, t: (1.0 + t) * (1.0 + 2.0 * np.isin(cells, half)))
    else:
        (case / "constant/thermophysicalProperties").write_text(
            header("dictionary", "thermophysicalProperties") + GAS
        )
        put(case, "p", "[1 -1 -2 0 0 0 0]", lambda cells, t: 1e5 * (1.0 + t + 0.01 * cells), boundary=1e5)
        other = 310.0 if known == "p and T" else -1.0
        put(
            case,
            "T",
            "[0 0 0 1 0 0 0]",
            lambda cells, _: np.where(np.isin(cells, half), 300.0, other),
            boundary=300,
        )
    whole, flow = flow_of(DecomposedCase(case), times, FlowSource()), distributed(case, times)
    assert flow.notes == whole.notes
    assert any("density is from" in note for note in flow.notes) == (known == "rho")
    x = random.uniform(0.0, 1.0, (100, 3))
    hosts = flow.locate(x)
    u = whole.sample(x, hosts, 0.6)[0]
    np.testing.assert_array_equal(flow.sample(x, hosts, 0.6)[0], u)
    # Linear as it is, the interpolated velocity keeps volume.
    assert np.array_equal(u, plain.sample(x, hosts, 0.6)[0]) == (known == "T on one node")


@pytest.mark.parametrize("times", [FlowTimes("1"), FlowTimes(None, True)])
def test_further_fields_are_those_of_the_whole(times, case, random):
    for name, unit in (
        ("k", "[0 2 -2 0 0 0 0]"),
        ("epsilon", "[0 2 -3 0 0 0 0]"),
        ("nu", "[0 2 -1 0 0 0 0]"),
    ):
        put(case, name, unit, lambda cells, _: 1.0 + cells)
    source = FlowSource(turbulent=True, viscosity=ViscosityField("nu", _NU, 1.0), sampled=("k", "U"))
    whole, flow = flow_of(DecomposedCase(case), times, source), distributed(case, times, source)
    x = random.uniform(0.0, 1.0, (100, 3))
    hosts = flow.locate(x)
    np.testing.assert_array_equal(flow.viscosity(x, hosts, 0.5), whole.viscosity(x, hosts, 0.5))
    assert_nodes_alike(flow, whole)
    assert flow.at_some_nodes().turbulence.shape[1] == 8
    found, expected = (own.fields(0.4, 0.5).at(x, hosts, 0.5) for own in (flow, whole))
    assert list(found) == ["k", "U"]
    for name, field in expected.items():
        np.testing.assert_array_equal(found[name].values, field.values)
    assert_alike(flow.traits(), whole.traits())
    # Eddies make bodies faster.
    assert flow.rate > distributed(case, times).rate


def test_an_error_on_one_node_is_raised_on_all():
    def read(team):
        with team.united():
            if team.rank == 1:
                raise InputError("a file of node 1")
            team.exchange([0, 0])

    def work(team):
        with pytest.raises(InputError, match="a file of node 1"):
            read(team)
        return team.exchange([team.rank, team.rank])

    assert on_nodes(2, work) == [[0, 1], [0, 1]]


def test_an_error_that_is_caught_holds_no_arrays_of_its_callers():
    def read(team):
        array = np.zeros(9)
        with suppress(InputError), team.united():
            raise InputError("a field that may be missing")
        return weakref.ref(array)

    def work(team):
        gc.disable()
        found = read(team)
        team.exchange([None])
        gc.enable()
        return found() is None

    assert on_nodes(1, work) == [True]


@pytest.mark.parametrize(
    ("changes", "nodes", "reason"),
    [
        ({}, 2, "the flow is read from the case itself; -decomposed reads its processor folders"),
        ({"file": Path("mesh.vtu")}, 2, "a mesh file is read"),
        ({"decomposed": True}, 3, "the case has 2 processor folders for 3 nodes"),
    ],
)
def test_the_reason_for_a_whole_mesh_is_given(changes, nodes, reason, case):
    require_divisible(case, FlowSource(decomposed=True), 2)
    with pytest.raises(IndivisibleMeshError, match=reason):
        require_divisible(case, FlowSource(**changes), nodes)


def test_a_case_without_processor_folders_is_not_decomposed(case, tmp_path):
    whole = shutil.copytree(case, tmp_path / "case", ignore=shutil.ignore_patterns("processor*"))
    with pytest.raises(IndivisibleMeshError, match="it is not decomposed"):
        require_divisible(whole, FlowSource(), 2)
