"""Cases in processor folders that nodes read in parts, against the whole flow."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import decompose, header, write_case
from thread_mpi import on_nodes

from foamprb.distributed.fragment import IndivisibleMeshError
from foamprb.distributed.partcase import PartCase
from foamprb.errors import InputError
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.field import VELOCITY_FIELD
from foamprb.flow.read.openfoam import steady_flow
from foamprb.flow.read.source import FlowSource


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A case of four processors: slabs, between two of which a few cells are dealt at random.

    The floor is on the first processor alone.
    """
    case = tmp_path_factory.mktemp("parts") / "case"
    mesh = write_case(case, "mixed")
    x, _, z = mesh.centres.T
    part_of = np.clip((4 * x).astype(int), 0, 3)
    some = (x > 0.4) & (x < 0.6)
    part_of[some] = np.random.default_rng(3).integers(1, 3, np.count_nonzero(some))
    part_of[z < 0.3] = 0
    decompose(case, mesh, part_of, ("0", "1"))
    return case


def read(case, n, depth=1):
    return on_nodes(n, lambda team: steady_flow(PartCase(case, "", team, depth), "1", FlowSource()))


def test_nodes_read_the_flow_of_the_whole(written, random):
    case = written
    flow = steady_flow(DecomposedCase(case), "1", FlowSource())
    points = random.uniform(0.0, 1.0, (500, 3))
    hosts = flow.locate(points)
    u, l = flow.sample(points, hosts, 0.0)
    located = 0
    for part in read(case, 2):
        assert part.notes == flow.notes
        assert part.counts == (flow.mesh.n_cells, flow.mesh.n_points, len(flow.mesh.tets))
        assert (part.width, [p.name for p in part.patches[:-1]]) == (
            flow.width,
            [p.name for p in flow.patches],
        )
        rows, numbers, _ = part.locate_own(points)
        np.testing.assert_array_equal(numbers, hosts[rows])
        for own, whole in zip(
            part.sample(points[rows], part.own_hosts(numbers)[1], 0.0), (u, l), strict=True
        ):
            np.testing.assert_array_equal(own, whole[rows])
        located += len(rows)
    assert located == len(points)


def test_a_flow_rate_is_that_through_the_whole_patch(written, tmp_path, random):
    """Without values in the file."""
    case = tmp_path / "case"
    shutil.copytree(written, case)
    for file in case.glob("processor*/1/U"):
        rate = "lid { type flowRateInletVelocity; volumetricFlowRate 0.7;\n}"
        file.write_text(re.sub(r"lid \{.*?\n\}", rate, file.read_text(), flags=re.DOTALL))
    whole = steady_flow(DecomposedCase(case), "1", FlowSource()).patch_faces("lid", 0.0)
    parts = [part.own_patch_faces("lid", 0.0) for part in read(case, 3)]
    order = np.argsort(np.concatenate([faces for faces, _ in parts]), kind="stable")
    found = np.concatenate([own.velocity for _, own in parts])[order]
    np.testing.assert_array_equal(found, whole.velocity)
    assert whole.velocity[:, :, 2].min() < -0.5


def test_nodes_take_folders_by_their_cells(written, tmp_path):
    case = tmp_path / "case"
    shutil.copytree(written, case)
    for k, n in enumerate((1, 1, 1, 9)):
        path = case / f"processor{k}/constant/polyMesh/cellProcAddressing"
        path.write_text(f"{header('labelList', path.name)}{n}\n(\n")
    selected = on_nodes(2, lambda team: PartCase(case, "", team, 1).processors.selected)
    assert selected == [range(3), range(3, 4)]


def without(name):
    """Remove addressing files of all processors."""
    return lambda case: [path.unlink() for path in case.glob(f"processor*/constant/polyMesh/{name}")]


def of_type(kind):
    """Give a patch another type."""

    def change(case):
        for file in case.glob("processor*/constant/polyMesh/boundary"):
            file.write_text(re.sub(r"(sides\s*\{\s*type\s+)wall", rf"\1{kind}", file.read_text()))

    return change


INDIVISIBLE = {
    "all": (without("*Addressing"), r"the processor folders have no files \*ProcAddressing"),
    "some": (without("pointProcAddressing"), r"the processor folders have no files \*ProcAddressing"),
    **{
        kind: (of_type(kind), f"the mesh has patches of type {kind}")
        for kind in ("cyclic", "cyclicAMI", "nonConformalCyclic", "wedge")
    },
}


@pytest.mark.parametrize("name", INDIVISIBLE)
def test_all_nodes_refuse_cases_that_they_cannot_share(name, written, tmp_path):
    change, message = INDIVISIBLE[name]
    case = shutil.copytree(written, tmp_path / "case")
    change(case)

    def work(team):
        with pytest.raises(IndivisibleMeshError, match=message):
            PartCase(case, "", team, 1).mesh("1")
        return True

    assert on_nodes(2, work) == [True, True]


FAULTS = {
    "missing": (lambda _: None, r"processor3/1/U: no such file\."),
    "cut": (lambda text: text[:700], r"processor3/1/U, line \d+: 'a' has no closing"),
    "not finite": (
        lambda text: re.sub(r"\n\(\S+ ", "\n(nan ", text, count=1),
        r"processor3/1/U: 1 of \d+ values are not finite .* at cell 0",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_of_one_field_is_reported_by_all_nodes(fault, written, tmp_path):
    damage, message = FAULTS[fault]
    case = tmp_path / "case"
    shutil.copytree(written, case)
    file = case / "processor3/1/U"
    text = damage(file.read_text())
    file.unlink() if text is None else file.write_text(text)

    def work(team):
        opened = PartCase(case, "", team, 1)
        with pytest.raises(InputError, match=message):
            opened.field("1", "U", VELOCITY_FIELD)
        return True

    assert on_nodes(2, work) == [True, True]
