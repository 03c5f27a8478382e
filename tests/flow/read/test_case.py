"""The folders of a case: which mesh holds at which time, and what is said where something is missing."""

from __future__ import annotations

import pytest
from foam_writer import header, write_case

from foamprb.errors import InputError
from foamprb.flow.read.case import (
    available_times,
    cell_zones,
    fields_of,
    mesh_files,
    mesh_folder,
    processor_folders,
    regions,
    require_case,
    select_time,
    select_times,
)


def touch(*paths):
    for path in paths:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()


@pytest.mark.parametrize("region", ["", "fluid"])
def test_a_mesh_holds_from_its_time_on(region, tmp_path):
    """Faces and points may change at different times; in the numbers' order, not in that of their names."""
    for name in ("0", "0.5", "2", "10", "1e2"):
        (tmp_path / name).mkdir()
    touch(
        tmp_path / "constant" / region / "polyMesh/faces",
        tmp_path / "0.5" / region / "polyMesh/faces",
        tmp_path / "2" / region / "polyMesh/points.gz",
        tmp_path / "10" / region / "polyMesh/faces.gz",
    )

    def at(time, part="faces"):
        return mesh_folder(tmp_path, time, region, part).relative_to(tmp_path).parts[0]

    assert [at(t) for t in (None, "0", "0.5", "2", "10", "1e2")] == [
        "constant", "constant", "0.5", "0.5", "10", "10",
    ]  # fmt: skip
    assert [at(t, "points") for t in (None, "0", "0.5", "2", "10")] == [
        "constant", "constant", "constant", "2", "2",
    ]  # fmt: skip
    files = mesh_files(tmp_path, "2", region)
    assert [path.name for path in files] == ["points", "faces", "owner", "neighbour", "boundary"]
    assert [path.relative_to(tmp_path).parts[0] for path in files] == ["2", *["0.5"] * 4]


def test_times_are_folders_named_like_numbers(tmp_path):
    for name in ("0", "0.5", "10", "2", "1e-3", "5.", "constant", "1x", "-1", ".5", "0.orig", "1e"):
        (tmp_path / name).mkdir()
    (tmp_path / "3").touch()
    assert available_times(tmp_path) == ("-1", "0", "1e-3", "0.5", "2", "5.", "10")


def test_regions_have_a_mesh_or_are_listed(tmp_path):
    constant = tmp_path / "constant"
    constant.mkdir()
    assert regions(tmp_path) == ()
    text = header("dictionary", "regionProperties") + 'regions ( fluid (air "water") solid (heater) );\n'
    (constant / "regionProperties").write_text(text)
    assert regions(tmp_path) == ("air", "heater", "water")
    touch(constant / "b/polyMesh/faces", constant / "a/polyMesh/faces.gz")
    assert regions(tmp_path) == ("a", "b")


def test_a_case_has_a_mesh(tmp_path):
    with pytest.raises(InputError, match="nothing: no such folder"):
        require_case(tmp_path / "nothing", "")
    with pytest.raises(InputError, match=r"constant/polyMesh: no mesh here; is .* an OpenFOAM case"):
        require_case(tmp_path, "")
    touch(tmp_path / "system/controlDict")
    with pytest.raises(InputError, match=r"constant/polyMesh: no mesh here\. Make it and the flow first"):
        require_case(tmp_path, "")
    touch(tmp_path / "constant/air/polyMesh/faces")
    require_case(tmp_path, "air")
    with pytest.raises(InputError, match="the mesh is divided into regions; choose one"):
        require_case(tmp_path, "")
    touch(tmp_path / "constant/polyMesh/faces.gz")
    require_case(tmp_path, "")


@pytest.mark.parametrize("name", ["processor0", "processors4"])
def test_a_mesh_in_parts_alone_is_said_to_be_so(name, tmp_path):
    assert not processor_folders(tmp_path)
    (tmp_path / name / "constant").mkdir(parents=True)
    assert processor_folders(tmp_path) == [tmp_path / name]
    with pytest.raises(InputError, match="only the processor folders hold a mesh; run reconstructParMesh"):
        require_case(tmp_path, "")


def test_a_case_without_times_says_so(tmp_path):
    touch(tmp_path / "constant/polyMesh/faces")
    with pytest.raises(InputError, match=r"no time directories; has the solver been run\?$"):
        select_time(tmp_path)
    (tmp_path / "processor0/constant").mkdir(parents=True)
    with pytest.raises(InputError, match="Only decomposed times are there: run reconstructPar"):
        select_times(tmp_path)


def test_the_latest_time_and_others(tmp_path):
    write_case(tmp_path)
    (tmp_path / "5").touch()
    assert select_time(tmp_path) == "1e1"
    (tmp_path / "20").touch()
    assert select_time(tmp_path, 0.5) == "0.5"
    with pytest.raises(
        InputError, match=r"20: named like a time, but not a readable folder.* time is 1e1: -time 1e1\."
    ):
        select_time(tmp_path)


def test_fields_are_files_of_a_class_of_fields(tmp_path):
    folder = tmp_path / "1"
    folder.mkdir()
    for name, kind in (("U", "volVectorField"), ("p", "volScalarField"), ("points", "regIOobject")):
        (folder / name).write_text(header(kind, name))
    (folder / "uniform").mkdir()
    (folder / "note").write_text("no header")
    assert fields_of(folder) == {"U": "volVectorField", "p": "volScalarField"}
    assert fields_of(tmp_path / "2") == {}


def test_a_mesh_without_zones_has_none(tmp_path):
    assert cell_zones(tmp_path) == {}
