"""Complete times of a case whose solver is running: folders written in steps, as OpenFOAM writes them."""

from __future__ import annotations

import math
import os
import time as clock
from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.flow.read import follow
from foamprb.flow.read.follow import FollowedCase

CONTROL = {
    "stopAt": "endTime", "endTime": "0.4", "deltaT": "0.01", "purgeWrite": "0",
    "writeControl": "timeStep", "writeInterval": "10",
}  # fmt: skip


@pytest.fixture(autouse=True)
def _at_once(monkeypatch):
    monkeypatch.setattr(follow, "_QUIET", 0.0)


def control(case, **entries):
    file = case / "system/controlDict"
    file.parent.mkdir(exist_ok=True)
    text = " ".join(f"{key} {value};" for key, value in (CONTROL | entries).items())
    file.write_text(f"FoamFile {{ version 2.0; format ascii; class dictionary; }} {text}")
    return file


def write(folder: Path, *fields: str, end: str = "// *** //\n") -> None:
    """A time as the solver writes it: ``uniform/time`` first, then the fields."""
    (folder / "uniform").mkdir(parents=True, exist_ok=True)
    index = round(float(folder.name) / 0.01)
    (folder / "uniform/time").write_text(
        f"FoamFile {{ version 2.0; format ascii; class dictionary; }} index {index};"
    )
    for name in fields:
        (folder / name).write_text(f"values of {name}\n{end}")


@pytest.fixture
def case(tmp_path):
    case = tmp_path / "case"
    (case / "constant/polyMesh").mkdir(parents=True)
    (case / "constant/polyMesh/faces").touch()
    control(case)
    (case / "0").mkdir()
    (case / "0/U").touch()
    return case


def followed(case, selection=None, **options):
    found = FollowedCase(case, selection, **options)
    found.look()
    return found


def test_a_time_is_complete_when_the_next_one_exists(case):
    flow = followed(case)
    assert flow.times == []
    write(case / "0.1", "U", "p")
    flow.look()
    assert flow.times == ["0"]
    (case / "0.2").mkdir()
    flow.look()
    assert flow.times == ["0", "0.1"]
    assert not flow.ended


def test_the_last_time_is_not_taken_while_its_files_are_new(case, monkeypatch):
    """The solver may be writing a field of which it has flushed a whole line."""
    monkeypatch.setattr(follow, "_QUIET", 5.0)
    for time in ("0.1", "0.2", "0.3", "0.4"):
        write(case / time, "U")
    flow = followed(case)
    assert (flow.times[-1], flow.ended) == ("0.3", False)
    before = clock.time() - 10.0
    for path in (case / "0.4/U", case / "0.4/uniform"):
        os.utime(path, (before, before))
    flow.look()
    assert (flow.times[-1], flow.ended) == ("0.4", True)


def test_a_range_ends_with_a_time_beyond_it(case):
    write(case / "0.1", "U")
    write(case / "0.2", "U")
    flow = followed(case, "0.1:0.2")
    assert (flow.times, flow.ended) == (["0.1"], False)
    write(case / "0.3", "U")
    flow.look()
    assert (flow.times, flow.ended) == (["0.1", "0.2"], True)
    assert followed(case, "0.12:0.18").ended


@pytest.mark.parametrize(
    ("entries", "ended"),
    [
        ({}, False),
        ({"endTime": "0.2"}, True),
        ({"endTime": "0.25"}, True),
        ({"endTime": "0.3"}, False),
        ({"endTime": "0.29", "adjustTimeStep": "yes"}, False),
        ({"writeControl": "adjustableRunTime", "writeInterval": "0.1", "endTime": "0.29"}, True),
        ({"writeControl": "clockTime", "endTime": "0.29"}, False),
        # An interval that was changed: the next time may be a multiple, as 0.3 and 0.32.
        ({"writeInterval": "15", "endTime": "0.3"}, False),
        ({"writeInterval": "16", "endTime": "0.31"}, True),
        ({"stopAt": "noWriteNow"}, True),
        ({"stopAt": "writeNow"}, False),
    ],
)
def test_the_end_of_the_solver_follows_from_its_dictionary(entries, ended, case):
    write(case / "0.1", "U")
    write(case / "0.2", "U")
    control(case, **entries)
    flow = followed(case)
    flow.look()
    assert flow.ended is ended
    assert flow.times[-1] == ("0.2" if ended else "0.1")


def test_a_solver_that_is_stopped_ends_with_the_time_it_writes_then(case):
    write(case / "0.1", "U")
    control(case, stopAt="writeNow")
    flow = followed(case)
    write(case / "0.13", "U")
    flow.look()
    flow.look()
    assert (flow.times, flow.ended) == (["0", "0.1", "0.13"], True)


def test_solver_that_goes_back_is_an_error_unless_it_writes_later_times_only(case):
    control(case, endTime="1")
    flow = followed(case)
    for time in ("0.1", "0.2", "0.3"):
        write(case / time, "U")
        flow.look()
    # Restarted from 0.2, as it had not ended 0.3.
    for time in ("0.3", "0.4"):
        write(case / time, "U")
        flow.look()
    assert flow.times == ["0", "0.1", "0.2", "0.3"]
    flow.require_unchanged(flow.times)
    write(case / "0.2", "U")
    flow.look()
    with pytest.raises(InputError, match=r"the time 0\.2 was written again\. The solver has gone back"):
        flow.require_unchanged(flow.times)
    write(case / "0.3", "U")
    with pytest.raises(InputError, match=r"the time 0\.3 was written again\."):
        flow.look()


def test_checksums_tell_times_without_the_file_that_is_written_first(case):
    """A copy of the same files, or a further one, is no change."""
    control(case, endTime="1")
    flow = followed(case)
    for time in ("0.1", "0.2", "0.3"):
        write(case / time, "U")
        (case / time / "uniform/time").unlink()
        flow.look()
    assert flow.times == ["0", "0.1", "0.2"]
    (case / "0.1/U").write_bytes((case / "0.1/U").read_bytes())
    (case / "0.1/vorticity").touch()
    flow.require_unchanged(flow.times)
    (case / "0.1/U").write_text("values of V\n// *** //\n")
    with pytest.raises(InputError, match=r"the time 0\.1 was written again\."):
        flow.require_unchanged(flow.times)


def test_new_time_before_earlier_ones_is_an_error(case):
    flow = followed(case)
    write(case / "0.1", "U")
    write(case / "0.2", "U")
    flow.look()
    # Restarted from 0.1 with another interval: 0.2 is of the run before.
    write(case / "0.15", "U")
    with pytest.raises(InputError, match=r"the time 0\.15 was written after 0\.2\."):
        flow.look()


def test_times_of_processors_are_those_of_all(case):
    for k in (0, 1):
        (case / f"processor{k}/constant").mkdir(parents=True)
        write(case / f"processor{k}/0", "U")
        write(case / f"processor{k}/0.1", "U")
    write(case / "processor0/0.2", "U")
    flow = followed(case)
    assert (flow.decomposed, flow.times) == (True, ["0"])
    write(case / "processor1/0.2", "U")
    flow.look()
    assert flow.times == ["0", "0.1"]


def test_case_may_be_decomposed_while_a_run_waits(case):
    flow = followed(case)
    assert flow.times == []
    for time in ("0", "0.1", "0.2"):
        write(case / "processor0" / time, "U")
    (case / "processor0/constant").mkdir()
    flow.look()
    assert (flow.decomposed, flow.times) == (True, ["0", "0.1"])


def test_collated_files_may_be_written_after_the_folder_of_the_next_time(case, monkeypatch):
    monkeypatch.setattr(follow, "_QUIET", math.inf)
    (case / "processors2/constant").mkdir(parents=True)
    for time in ("0", "0.1", "0.3"):
        write(case / "processors2" / time, "U", "p")
    flow = followed(case)
    assert flow.times == []
    monkeypatch.setattr(follow, "_QUIET", 0.0)
    flow.look()
    assert flow.times == ["0", "0.1"]


def test_last_time_needs_the_region(case):
    write(case / "0.3", "U")
    write(case / "0.4", "U")
    flow = followed(case, region="water")
    assert (flow.times, flow.ended) == (["0", "0.3"], False)
    (case / "0.4/water").mkdir()
    (case / "0.4/water/U").write_text("U //")
    flow.look()
    flow.look()
    assert (flow.times, flow.ended) == (["0", "0.3", "0.4"], True)


def test_what_cannot_be_followed_is_refused(case):
    control(case, purgeWrite="2")
    with pytest.raises(InputError, match=r"purgeWrite lets the solver remove times .* with -follow: 0"):
        followed(case)
    control(case)
    with pytest.raises(InputError, match="'latestTime' is no range of times"):
        followed(case, "latestTime")
    (case / "system/controlDict").unlink()
    with pytest.raises(InputError, match="controlDict: -follow needs this file"):
        followed(case)
