"""Files of a case or of its results that somebody else made: one message each, in finite time."""

from __future__ import annotations

import contextlib
import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from limits import ended_in_time
from pipe_case import edit

from foamprb import InputError, open_run
from foamprb.cli import main
from foamprb.results.checkpoint import Checkpoints
from foamprb.results.manifest import Manifest
from foamprb.run.restart import require_header
from foamprb.view.show import groups_of

Change = Callable[[Path], object]


def results_of(case: Path) -> Path:
    return case / "postProcessing/softCloud"


def put(name: str, data: str | bytes) -> Change:
    return lambda case: (results_of(case) / name).write_bytes(
        data if isinstance(data, bytes) else data.encode()
    )


def replaced(name: str, old: str, new: str) -> Change:
    def change(case: Path) -> None:
        file = results_of(case) / name
        text = file.read_text()
        assert old in text
        file.write_text(text.replace(old, new, 1))

    return change


def pipe(name: str) -> Change:
    def change(case: Path) -> None:
        file = results_of(case) / name
        file.unlink()
        os.mkfifo(file)

    return change


def device(name: str) -> Change:
    def change(case: Path) -> None:
        (results_of(case) / name).unlink()
        (results_of(case) / name).symlink_to("/dev/zero")

    return change


def in_pieces(piece: str) -> Change:
    def change(case: Path) -> None:
        replaced("softCloud.pvd", "softCloud_000001.vtp", "a.pvtp")(case)
        put("a.pvtp", f'<VTKFile type="PPolyData"><PPolyData>{piece}</PPolyData></VTKFile>')(case)

    return change


def with_header(file: Path, change: Callable[[Any], Any]) -> None:
    """Change the header of a checkpoint, whose checksums are right then."""
    with np.load(file) as stored:
        arrays = dict(stored)
    text = json.dumps(change(json.loads(arrays["header"].tobytes()))).encode()
    np.savez(file, **(arrays | {"header": np.frombuffer(text, dtype=np.uint8)}))


def header(**entries: Any) -> Change:
    """Entries of the headers of all checkpoints replaced, or removed if None."""

    def changed(document: dict[str, Any]) -> dict[str, Any]:
        return {key: value for key, value in {**document, **entries}.items() if value is not None}

    def change(case: Path) -> None:
        for file in (results_of(case) / "checkpoint").iterdir():
            with_header(file, changed)

    return change


def listing(*files: object) -> Change:
    return put("manifest.json", json.dumps({"format": 1, "files": files}))


def dictionary(pattern: str, text: str) -> Change:
    return lambda case: edit(case, pattern, text)


SIZES = r"type\s+fixedValue;\s+fixedValueDistribution\s*\{[^}]*\}"
GENERAL = "type general; generalDistribution { distribution ((1e-6 1e-323) (2e-6 1e-323)); }"
DEEP = "[" * 100_000

VIEWED: dict[str, tuple[Change, str]] = {
    "list of clouds with a time that is no number": (
        replaced("softCloud.pvd", 'timestep="0.001"', 'timestep="nan"'),
        "the time of softCloud_000001.vtp is nan",
    ),
    "pipe for the list of clouds": (pipe("softCloud.pvd"), "no results here|not a regular file"),
    "pipe for a cloud": (pipe("softCloud_000001.vtp"), "not a regular file"),
    "device for a cloud": (device("softCloud_000001.vtp"), "not a regular file"),
    "piece without a file": (in_pieces("<Piece/>"), "a.pvtp is damaged: KeyError"),
    "piece that is itself": (in_pieces('<Piece Source="a.pvtp"/>'), "names the piece 'a.pvtp'"),
    "piece elsewhere": (in_pieces('<Piece Source="../x.vtp"/>'), "names the piece '../x.vtp'"),
    "piece that is a device": (in_pieces('<Piece Source="/dev/zero"/>'), "names the piece '/dev/zero'"),
}
COMPARED: dict[str, tuple[Change, str]] = {
    "record that is a list": (put("run.json", "[]"), "run.json is damaged: it is \\[\\]"),
    "record without an end": (put("run.json", DEEP), "run.json is damaged: RecursionError"),
    "settings that are a list": (
        replaced("run.json", '"settings": {', '"settings": [], "x": {'),
        "settings is \\[\\], not an object",
    ),
    "overrides that are a list": (
        replaced("run.json", '"settings": {', '"settings": {"overrides": [1], '),
        "settings/overrides is \\[1\\], not an object",
    ),
    "pipe for the record": (pipe("run.json"), "run.json is damaged: it is not a regular file"),
    "table with an integer that is too large": (
        replaced("fates.csv", "\n0,", f"\n{'9' * 400},"),
        "fates.csv is not the table|fates.csv is no table",
    ),
    "table with one name twice": (replaced("fates.csv", "id,d,", "id,id,"), "different names of columns"),
    "table without a line": (put("fates.csv", ""), "fates.csv is no table"),
    "pipe for the table": (pipe("fates.csv"), "not a regular file"),
}
RESUMED: dict[str, tuple[Change, str]] = {
    "list of files with a null character": (listing("a\0b"), "Warning : .*manifest.json is damaged"),
    "list of files that is no text": (listing("\ud800"), "Warning : .*manifest.json is damaged"),
    "list of numbers": (listing(3), "files is 3, not a text"),
    "list that is null": (put("manifest.json", "null"), "it is None, not an object"),
    "pipe for the list of files": (pipe("manifest.json"), "it is not a regular file"),
    "pipe for the list of clouds": (pipe("softCloud.pvd"), "it is not a regular file"),
    "header without rows": (header(rows=None), "its header has no rows"),
    "header without a step": (header(step=None), "its header has no step"),
    "header with a text for a step": (header(step="x"), "its header/step is 'x', not an integer"),
    "header with too large a step": (header(step=10**30), "its header/step is 1000"),
    "header with a negative step": (header(step=-5), "its step is -5"),
    "header with a list for the fingerprint": (
        header(fingerprint=[]),
        "fingerprint is \\[\\], not an object",
    ),
    "header with other arrays": (header(arrays=[1]), "its header/arrays is 1, not a text"),
    "header with parts elsewhere": (header(parts=[["../../x", "0"]]), "its header/parts is"),
    "header with clouds that are numbers": (header(series=[[0.0, 1]]), "its header/series is 1, not a text"),
}
SETTINGS: dict[str, tuple[Change, str]] = {
    "density that is hardly a number": (
        dictionary(SIZES, GENERAL),
        "whose size is not from 1e-30",
    ),
    "pattern that takes years": (
        dictionary(r'"\(inlet\|outlet\)"', '"(inlet|outlet)" { type escape; } "(.?.?){60}!"'),
        r"the pattern '\(\.\?\.\?\)\{60\}!' takes more than 1 s to match",
    ),
    "viscosity of the solid beyond its range": (
        dictionary(r"Ca\s+0\.5;", "Ca 0.5; viscosity 1e308;"),
        "solid/viscosity is '1e308', whose size is not from 1e-30 to 1e30",
    ),
}
STUDIES: dict[str, tuple[str, str]] = {
    "number beyond any": (f"[entries]\na = {{ from = 1{400 * '0'}, to = 2, number = 2 }}", "is no study"),
    "lists without an end": (f"[entries]\na = {'[' * 3000}{']' * 3000}", "is no study: RecursionError"),
}


def said(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Output and errors of a command, which must end; an error is one message."""
    with ended_in_time():
        status = main([*words])
    out, err = capsys.readouterr()
    assert status == (1 if err else 0)
    assert "Traceback" not in err
    return out + err


def expect(pattern: str, text: str) -> None:
    assert re.search(pattern, text), text[-2000:]


@pytest.mark.parametrize("name", VIEWED)
def test_results_that_are_exported(name, finished, tmp_path, capsys):
    change, pattern = VIEWED[name]
    change(finished)
    expect(
        pattern, said(capsys, "export", "openfoam", "-case", str(finished), "-output", str(tmp_path / "x"))
    )


@pytest.mark.parametrize("name", COMPARED)
def test_results_that_are_compared(name, finished, tmp_path, capsys):
    change, pattern = COMPARED[name]
    change(finished)
    expect(pattern, said(capsys, "compare", str(finished), "-output", str(tmp_path / "x.html"), "-noBrowser"))


@pytest.mark.parametrize("name", RESUMED)
def test_results_that_a_run_continues(name, stopped, capsys):
    change, pattern = RESUMED[name]
    change(stopped)
    expect(pattern, said(capsys, "run", "-case", str(stopped), "-resume", "-threads", "1"))


@pytest.mark.parametrize("name", SETTINGS)
def test_settings(name, case, capsys):
    change, pattern = SETTINGS[name]
    change(case)
    expect(f"(?s)Error : .*{pattern}", said(capsys, "run", "-case", str(case), "-threads", "1"))


@pytest.mark.parametrize("name", STUDIES)
def test_studies(name, tmp_path, capsys):
    text, pattern = STUDIES[name]
    (tmp_path / "study.toml").write_text(text)
    expect(pattern, said(capsys, "sweep", str(tmp_path / "study.toml"), "-list"))


def test_pipes_and_devices_are_no_studies(tmp_path, capsys):
    os.mkfifo(tmp_path / "study.toml")
    for file in (tmp_path / "study.toml", Path("/dev/zero")):
        expect("is no study: it is not a regular file", said(capsys, "sweep", str(file), "-list"))


N_EXAMPLES = 100_000 if os.environ.get("HYPOTHESIS_PROFILE") == "nightly" else 100
VALUES: list[Any] = [None, True, -1, 0, 10**18, 10**400, 1e308, "", "x", "../x", "/dev/zero"]
VALUES += [[], {}, [[]], [None], {"a": []}]
TEXTS = [b"", b"nan", b"-1", b"9" * 400, b"1e999", b"<a>", b"&b;", b"\0", b"\xff", b'"', b",", b"../x"]
TEXTS += [b"[" * 2000]


def places(value: Any) -> list[tuple[Any, Any]]:
    """Containers and keys of all values in a document."""
    if isinstance(value, dict):
        return [place for key in value for place in [(value, key), *places(value[key])]]
    if isinstance(value, list):
        return [place for k in range(len(value)) for place in [(value, k), *places(value[k])]]
    return []


def changed_value(draw: Any, document: Any) -> Any:
    container, key = draw(st.sampled_from(places(document)))
    container[key] = draw(st.sampled_from(VALUES))
    return document


def changed_bytes(draw: Any, data: bytes) -> bytes:
    at = draw(st.integers(0, len(data)))
    length = draw(st.sampled_from([0, 1, 2, 8, len(data)]))
    return data[:at] + draw(st.sampled_from(TEXTS) | st.binary(max_size=4)) + data[at + length :]


def read_all(case: Path) -> None:
    """Read what commands read of a run."""
    run = open_run(case)
    groups_of(run.record)
    for index in range(len(run.times)):
        run.cloud(index)
    run.fates()
    Manifest.read(results_of(case))
    checkpoints = Checkpoints(results_of(case) / "checkpoint")
    latest = checkpoints.latest(lambda stored: require_header(stored) is None)
    if latest is not None:
        latest.read_all()


@settings(max_examples=N_EXAMPLES)
@given(data=st.data())
def test_changed_results_are_read_or_refused(data, ended):
    """A value in a document, with right checksums, or some bytes of a file."""
    files = [file for file in sorted(results_of(ended).rglob("*")) if file.suffix]
    file = data.draw(st.sampled_from(files))
    before = file.read_bytes()
    try:
        if file.suffix == ".json" and data.draw(st.booleans()):
            file.write_text(json.dumps(changed_value(data.draw, json.loads(before))))
        elif file.suffix == ".npz" and data.draw(st.booleans()):
            with_header(file, lambda document: changed_value(data.draw, document))
        else:
            file.write_bytes(changed_bytes(data.draw, before))
        with contextlib.suppress(InputError), ended_in_time():
            read_all(ended)
    finally:
        file.write_bytes(before)
