"""Processor folders put together again, against the case that they were cut from."""

from __future__ import annotations

import gzip
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from foam_writer import Format, decompose, header, write_case

from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.flow.read.boundary import read_boundary
from foamprb.flow.read.case import is_only_decomposed
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.field import VELOCITY_FIELD, read_field
from foamprb.flow.read.flows import read_flow
from foamprb.flow.read.foamfile import FoamFile
from foamprb.flow.read.openfoam import read_case, read_series, steady_flow, transient_flow
from foamprb.flow.read.source import FlowSource

MESH = Path("constant/polyMesh")
TIMES = ("0", "0.5", "1e1")


def read_parts(case, time="latestTime", region=""):
    return steady_flow(DecomposedCase(case, region), time, FlowSource())


def series_of_parts(case, region=""):
    return transient_flow(DecomposedCase(case, region), None, None, FlowSource())


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    case = tmp_path_factory.mktemp("decomposed") / "case"
    mesh = write_case(case, "mixed")
    decompose(case, mesh, np.random.default_rng(5).integers(0, 3, mesh.n_cells), TIMES)
    return case


@pytest.fixture
def case(written, tmp_path):
    shutil.copytree(written, tmp_path / "case")
    return tmp_path / "case"


def alone(case):
    """Leave nothing but the processor folders."""
    shutil.rmtree(case / "constant")
    for time in TIMES:
        shutil.rmtree(case / time)
    return case


def test_the_flow_is_that_of_the_whole_to_the_last_bit(written):
    whole, parts = read_case(written, 0.5), read_parts(written, 0.5)
    assert parts.patches == whole.patches
    for name, a, b in zip(whole.arrays()._fields, whole.arrays(0.1), parts.arrays(0.1), strict=True):
        np.testing.assert_array_equal(a, b, err_msg=name)
    assert parts.notes == ("The flow was put together from 3 processor folders.", *whole.notes)


def test_meshes_without_addressing_are_joined_over_their_processor_patches(case, random):
    for path in case.glob("processor*/constant/polyMesh/*Addressing"):
        path.unlink()
    whole, parts = read_case(case, 0.5), read_parts(case, 0.5)
    assert any("joined over their processor patches" in note for note in parts.notes)
    assert parts.patches == whole.patches
    assert len(parts.mesh.points) == len(whole.mesh.points)
    assert np.diff(parts.mesh.patch_start).tolist() == np.diff(whole.mesh.patch_start).tolist()
    assert parts.mesh.volumes.sum() == pytest.approx(whole.mesh.volumes.sum(), rel=1e-8)
    x = random.random((50, 3))
    for found, expected in zip(*(f.sample(x, f.locate(x), 0.0) for f in (parts, whole)), strict=True):
        np.testing.assert_allclose(found, expected, atol=1e-5)


def test_collated_files_are_read(written, tmp_path):
    """Of which the first part alone has a header."""
    for name, of in (("processors3", (0, 1, 2)), ("processors3_0-1", (0, 1)), ("processors3_2-2", (2,))):
        case = tmp_path / ("one" if name == "processors3" else "two")
        for path in (written / "processor0").rglob("*"):
            inner = path.relative_to(written / "processor0")
            if path.is_file():
                parts = [(written / f"processor{k}" / inner).read_bytes() for k in of]
                parts[1:] = [part[part.index(b"}") + 1 :] for part in parts[1:]]
                to = case / name / inner
                to.parent.mkdir(parents=True, exist_ok=True)
                text = header("decomposedBlockData", path.name, form=Format(binary=True)).encode()
                for number, part in enumerate(parts):
                    text += b"\n// Processor%d\n\n%d\n(%b)\n" % (number, len(part), part)
                to.write_bytes(text)
    whole = read_case(written, 0.5)
    for case in (tmp_path / "one", tmp_path / "two"):
        assert is_only_decomposed(case)
        np.testing.assert_array_equal(read_parts(case, 0.5).arrays().nodes, whole.arrays().nodes)
        assert main(["info", "-case", str(case)]) == 0
        files = DecomposedCase(case).processors.files(MESH / "owner")
        for k, file in enumerate(files):
            path = written / f"processor{k}" / MESH / "owner"
            np.testing.assert_array_equal(file.labels(), FoamFile(path).labels())
        assert len(files) == 3
    cut = tmp_path / "one/processors3/constant/polyMesh/owner"
    cut.write_bytes(cut.read_bytes()[:-40])
    with pytest.raises(InputError, match=r"owner: byte .* the file of processor 2"):
        read_parts(tmp_path / "one")
    shutil.rmtree(tmp_path / "two/processors3_0-1")
    with pytest.raises(InputError, match="processors3_2-2: there is no folder for processor 0"):
        read_parts(tmp_path / "two")


def test_times_that_some_processors_alone_have_are_noted(case):
    shutil.rmtree(case / "processor2/1e1")
    shutil.copytree(case / "processor1/0.5", case / "processor1/0.7")
    flow = read_parts(case)
    assert "Some processor folders alone have the times 0.7, 1e1; all have 0, 0.5." in flow.notes
    np.testing.assert_array_equal(flow.arrays().nodes, read_case(case, 0.5).arrays().nodes)
    with pytest.raises(InputError, match=r"no time 0.7; the times are 0, 0.5"):
        read_parts(case, 0.7)
    for time in ("0", "0.5"):
        shutil.rmtree(case / "processor2" / time)
    with pytest.raises(InputError, match=r"no time is in all processor folders; in some: 0, 0.5"):
        read_parts(case)


def test_later_times_of_processor_folders_are_noted(case):
    assert not any("later" in note for note in read_flow(case).notes)
    for path in case.glob("processor*"):
        shutil.copytree(path / "1e1", path / "11")
    [note] = (note for note in read_flow(case).notes if "later" in note)
    assert note.startswith("The processor folders have the later time 11, which is not read")


def test_a_mesh_in_a_time_folder_of_each_processor(case):
    """As snappyHexMesh leaves it."""
    for path in case.glob("processor*"):
        shutil.move(path / "constant/polyMesh", path / "0/polyMesh")
    alone(case)
    (case / "constant").mkdir()
    assert is_only_decomposed(case)
    assert read_parts(case, 0.5).mesh.n_cells == 12


def test_a_part_may_be_empty(tmp_path):
    """As those of regions that do not reach to every processor."""
    mesh = write_case(tmp_path / "case", "polyhedra", times=("0",))
    parts = np.zeros(mesh.n_cells, dtype=int)
    parts[mesh.n_cells // 2 :] = 2
    decompose(tmp_path / "case", mesh, parts, ("0",))
    assert len(FoamFile(tmp_path / "case/processor1/constant/polyMesh/owner").labels()) == 0
    a, b = read_case(tmp_path / "case"), read_parts(tmp_path / "case")
    np.testing.assert_array_equal(a.arrays().nodes, b.arrays().nodes)


def test_a_series_of_times_too(written, random):
    whole, parts = read_series(written), series_of_parts(written)
    x = random.random((20, 3))
    for t in (0.0, 0.2, 0.5, 7.0):
        for a, b in zip(*(flow.sample(x, flow.locate(x), t) for flow in (whole, parts)), strict=True):
            np.testing.assert_array_equal(a, b)


def into_region(case):
    """Make the mesh of a case and its parts that of a region."""
    for folder in (case, *case.glob("processor*")):
        for part in (folder / "constant", *(folder / time for time in TIMES)):
            (part / "air").mkdir()
            for path in [p for p in part.iterdir() if p.name != "air"]:
                path.rename(part / "air" / path.name)
    return case


def test_regions_are_put_together_too(case, random):
    into_region(case)
    a, b = (read(case, 0.5, region="air") for read in (read_case, read_parts))
    np.testing.assert_array_equal(a.arrays().nodes, b.arrays().nodes)
    whole, parts = (read(case, region="air") for read in (read_series, series_of_parts))
    x = random.random((20, 3))
    for t in (0.0, 0.2, 7.0):
        found, expected = (flow.sample(x, flow.locate(x), t) for flow in (parts, whole))
        np.testing.assert_array_equal(found[0], expected[0])
        np.testing.assert_array_equal(found[1], expected[1])
    assert np.abs(expected[1]).max() > 0.1


def test_regions_of_parts_alone(case, capsys):
    alone(into_region(case))
    assert is_only_decomposed(case, "air")
    with pytest.raises(InputError, match=r"divided into regions; choose one with -region\. Allowed: air"):
        read_parts(case)
    with pytest.raises(InputError, match=r"no region aire\. Did you mean 'air'"):
        read_parts(case, region="aire")
    assert main(["info", "-case", str(case), "-region", "air"]) == 0
    out = capsys.readouterr().out
    assert re.search(r"^Region +air$", out, re.MULTILINE)
    assert re.search(r"^ +0.5 +U \(volVectorField\)$", out, re.MULTILINE)


def test_compressed_files_are_read_alike(case):
    for path in [*case.glob("processor*/*/U"), *case.glob("processor*/constant/polyMesh/*")]:
        with gzip.open(f"{path}.gz", "wb") as file:
            file.write(path.read_bytes())
        path.unlink()
    a, b = read_case(case), read_parts(case)
    np.testing.assert_array_equal(a.arrays().nodes, b.arrays().nodes)


def test_a_mesh_beside_parts_that_alone_have_times_after_0(case):
    """As decomposePar leaves it, before the run and after it."""
    for time in TIMES[1:]:
        shutil.rmtree(case / time)
    assert is_only_decomposed(case)
    (case / "0").rename(case / "0.0")
    assert is_only_decomposed(case)
    for folder in case.glob("processor*"):
        for time in TIMES[1:]:
            shutil.rmtree(folder / time)
    assert not is_only_decomposed(case)


def test_parts_alone_are_found_and_described(case, capsys):
    assert not is_only_decomposed(case)
    alone(case)
    assert is_only_decomposed(case)
    assert main(["info", "-case", str(case)]) == 0
    out = capsys.readouterr().out
    assert re.search(rf"^Case +{case}$", out, re.MULTILINE)
    assert re.search(r"^ +lid +\d+ faces +patch$", out, re.MULTILINE)
    assert re.search(r"^ +0.5 +U \(volVectorField\)$", out, re.MULTILINE)


def test_zones_of_cells_are_put_together(case):
    for part in range(3):
        n = len(FoamFile(case / f"processor{part}/constant/polyMesh/cellProcAddressing").labels())
        zone = f"first {{ type cellZone; cellLabels List<label> 2 (0 {n - 1}); }}"
        none = "none { type cellZone; cellLabels List<label> 0 (); }"
        (case / f"processor{part}/constant/polyMesh/cellZones").write_text(
            header("regIOobject", "cellZones") + f"2 ( {zone} {none} )"
        )
    flow = read_parts(case)
    found = np.unique(flow.cell_of(flow.cell_zone("first").hosts))
    expected = [FoamFile(case / f"processor{part}/constant/polyMesh/cellProcAddressing").labels()[[0, -1]]
                for part in range(3)]  # fmt: skip
    np.testing.assert_array_equal(found, np.unique(expected))
    assert len(flow.cell_zone("none").hosts) == 0


def lose(path):
    return lambda case: (case / path).unlink()


def replace(path, pattern, text):
    def change(case):
        file = case / path
        old = file.read_text()
        new = re.sub(pattern, text, old, count=1)
        assert new != old
        file.write_text(new)

    return change


POLY = "processor1/constant/polyMesh"
FIELD = "processor1/1e1/U"


MISTAKES = {
    "a processor is missing": (
        lambda case: shutil.rmtree(case / "processor1"),
        r"processor1: no such folder, but there is processor2",
    ),
    "no addressing": (
        lose(f"{POLY}/cellProcAddressing"), r"processor1/constant/polyMesh/cellProcAddressing: no such file",
    ),
    "no velocity": (lose(FIELD), r"processor1/1e1/U: no such file"),
    "no points": (lose(f"{POLY}/points"), r"processor1/constant/polyMesh/points: no such file"),
    "cut short": (
        replace(FIELD, r"(?s)\)\s*;\s*// of the part.*", ""),
        r"processor1/1e1/U, line \d+: 'internalField' has no closing ;",
    ),
    "half of the field": (
        replace(FIELD, r"(?s)boundaryField.*", ""), r"no internalField of vectors and boundaryField",
    ),
    "no whole number": (
        replace(f"{POLY}/owner", r"\n0\n", "\n0.5\n"), r"owner: line \d+: a list of whole numbers",
    ),
    "an index too large": (
        replace(f"{POLY}/owner", r"\n0\n", "\n999\n"), r"owner: an index outside 0 to \d+",
    ),
    "parts of another case": (
        replace(f"{POLY}/cellProcAddressing", r"\(\n\d+", "(\n999"), r"do not make a whole mesh",
    ),
    "a cell twice": (
        replace(f"{POLY}/cellProcAddressing", r"\(\n\d+\n(\d+)", r"(\n\1\n\1"), r"do not make a whole mesh",
    ),
    "a point of another's": (
        replace(f"{POLY}/pointProcAddressing", r"\(\n\d+\n(\d+)", r"(\n\1\n\1"),
        r"do not make a whole mesh",
    ),
    "a point that differs": (
        replace(f"{POLY}/points", r"\(\n\(\S+", "(\n(0.125"), r"do not make a whole mesh",
    ),
    "a face twice": (
        replace(f"{POLY}/faceProcAddressing", r"\(\n\d+\n(\d+)", r"(\n\1\n\1"), r"do not make a whole mesh",
    ),
    "an address beyond all": (
        replace(f"{POLY}/pointProcAddressing", r"\(\n\d+", "(\n2147483647"), r"do not make a whole mesh",
    ),
    "the wrong field": (
        replace(FIELD, "volVectorField", "volScalarField"), r"the class is volScalarField",
    ),
    "a patch without values": (
        replace(FIELD, r"lid \{", "lidd {"), r"processor1/1e1/U: no boundaryField for the patch lid",
    ),
}  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_named(mistake, case):
    break_it, message = MISTAKES[mistake]
    break_it(case)
    with pytest.raises(InputError, match=message):
        read_parts(case)


def test_messages_of_the_reader_name_the_case(case):
    with pytest.raises(InputError, match=re.escape(f"{case}: no time 7; the times are 0, 0.5, 1e1.")):
        read_parts(case, 7)


def test_a_field_is_read_whatever_stands_beside_the_values(tmp_path):
    file = tmp_path / "U"
    vectors = np.arange(6.0).reshape(2, 3)
    list_of_two = b"nonuniform List<vector> 2\n(" + vectors.tobytes() + b")"
    file.write_bytes(
        b'FoamFile { version 2.0; format binary; class volVectorField; arch "LSB;label=32;scalar=64"; }\n'
        b"dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (1 2 3);\nboundaryField\n{\n"
        b"inlet { type flowRateInletVelocity; flowRate table ((0 1) (1 2)); value " + list_of_two + b"; }\n"
        b"outlet { type inletOutlet; inletValue uniform (0 0 0); phi phi; value uniform (7 8 9); }\n"
        b"mixed { type mixed; refGradient " + list_of_two + b"; valueFraction nonuniform List<scalar> 1\n("
        + np.ones(1).tobytes() + b"); value nonuniform List<vector> 0; }\n"
        b'"(a|b)" { type noSlip; }\nfront { type empty; value nonuniform List<vector> 0; }\n}\n'
    )  # fmt: skip
    field = read_field(file, VELOCITY_FIELD, tmp_path)
    assert field.cells.tolist() == [[1, 2, 3]]
    assert {name: entry.type for name, entry in field.patches.items()} == {
        "inlet": "flowRateInletVelocity", "outlet": "inletOutlet", "mixed": "mixed", "(a|b)": "noSlip",
        "front": "empty",
    }  # fmt: skip
    assert field.patches["inlet"].fields["value"].tolist() == vectors.tolist()
    assert field.patches["outlet"].fields["value"].tolist() == [[7, 8, 9]]
    assert len(field.patches["mixed"].fields["value"]) == 0
    # As decomposePar writes the patch of a flux.
    assert field.patches["front"].fields == {}
    assert field.patches["mixed"].fields["valueFraction"].tolist() == [[1.0]]
    assert field.patches["(a|b)"].fields == {}
    assert [entry.pattern for entry in field.patches.values()] == [False, False, False, True, False]


def test_patches_keep_all_their_entries(written):
    patch = read_boundary(written / "processor0/constant/polyMesh/boundary", written)[0]
    assert patch.entries["inGroups"].split() == ["1", "(", "some", ")"]
