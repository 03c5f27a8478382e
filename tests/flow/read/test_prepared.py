"""Times of a flow that are kept on disk for later runs."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import namedtuple

import numpy as np
import pytest
from pipe_case import message
from transient_case import write_transient_case

from foamprb.errors import InputError
from foamprb.flow import balance, fluxes
from foamprb.flow.read import openfoam, prepared
from foamprb.flow.read.flows import read_flow, read_mesh, read_transient_flow
from foamprb.flow.read.source import FlowSource

Usage = namedtuple("Usage", "total used free")


@pytest.fixture
def case(tmp_path):
    return write_transient_case(tmp_path / "case")


@pytest.fixture
def source(tmp_path):
    return FlowSource(cache=tmp_path / "cache")


def fields(case, source):
    """u, ∇u and fluxes at all times."""
    flow = read_transient_flow(case, None, None, source)
    return [array for k in range(len(flow.times)) for array in flow._read(k)]


def kept(source):
    return sorted(source.cache.iterdir())


def forbid(monkeypatch):
    """Let nothing be reconstructed or balanced."""
    for name in ("Reconstruction", "Conservation"):
        monkeypatch.setattr(openfoam, name, None)


def assert_equal(some, others):
    assert len(some) == len(others)
    for array, other in zip(some, others, strict=True):
        np.testing.assert_array_equal(array, other)


def test_later_runs_read_what_the_first_one_has_made(case, source, monkeypatch):
    computed = fields(case, FlowSource())
    assert_equal(fields(case, source), computed)
    assert len(kept(source)) == 3
    steady = read_flow(case, 0.5)
    forbid(monkeypatch)
    assert_equal(fields(case, source), computed)
    assert_equal(read_flow(case, 0.5, source).at_nodes()[1:], steady.at_nodes()[1:])


@pytest.mark.parametrize("change", ["velocity", "patch", "density", "code"])
def test_a_flow_of_other_values_is_another(change, case, source, monkeypatch):
    fields(case, source)
    name = "constant/polyMesh/boundary" if change == "patch" else "0.5/U"
    file = case / name
    text = file.read_text()
    if change == "code":
        monkeypatch.setattr(prepared, "_code", lambda: "other code")
    elif change == "density":
        monkeypatch.setattr(openfoam, "mass_of", lambda *_: None)
    else:
        old, new = ("wall", "patch") if change == "patch" else ("0.02", "0.03")
        assert old in text
        file.write_text(text.replace(old, new))
    changed = fields(case, source)
    assert len(kept(source)) == (4 if change == "velocity" else 6)
    assert_equal(changed, fields(case, FlowSource()))


def test_a_damaged_file_is_made_again(case, source):
    computed = fields(case, source)
    for file in kept(source):
        os.truncate(file, file.stat().st_size // 2)
    assert_equal(fields(case, source), computed)
    assert_equal(fields(case, source), computed)


def test_the_folder_takes_no_more_than_it_leaves_free(case, source, monkeypatch):
    accepting = FlowSource(cache=source.cache, accept=("unbalanced",))
    read_flow(case, 0.5, accepting)
    (read_again,) = kept(source)
    fields(case, source)
    old, *young = sorted(kept(source), key=lambda file: file == read_again)
    size = old.stat().st_size
    os.utime(old, (0, 0))
    monkeypatch.setattr(prepared.shutil, "disk_usage", lambda _: Usage(0, 0, 4 * size))
    read_flow(case, 0.5, accepting)
    assert set(kept(source)) == {old, *young}
    monkeypatch.setattr(prepared, "_code", lambda: "other code")
    fields(case, source)
    assert old not in kept(source)
    assert set(young) < set(kept(source))
    assert len(kept(source)) == 3


def test_fluxes_without_balance_are_tried_again(case, source, monkeypatch, caplog):
    monkeypatch.setattr(balance, "MOST_ITERATIONS", 0)
    for module in (balance, fluxes):
        monkeypatch.setattr(module, "BALANCED", 0.0)
    accepting = FlowSource(cache=source.cache, accept=("unbalanced",))
    for _ in range(2):
        caplog.clear()
        fields(case, accepting)
        assert "cannot be balanced" in caplog.text
    assert len(read_flow(case, 0.5, accepting).arrays().phi) == 0


def test_a_full_disk_ends_no_run(case, source, monkeypatch, caplog):
    def save(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(prepared.np, "save", save)
    fields(case, source)
    assert caplog.text.count("no longer stored: No space left on device") == 1
    assert kept(source) == []


def test_no_folder_and_no_case_are_refused(case, source, capsys):
    source.cache.write_text("")
    assert f"-cache {source.cache}: this folder cannot be made" in message(
        case, capsys, "-cache", str(source.cache)
    )
    with pytest.raises(InputError, match="-cache keeps flows of cases only"):
        read_mesh(case, "latestTime", FlowSource(cache=source.cache, file=case / "a.vtu"))


def test_names_of_files_do_not_depend_on_the_process():
    """Though the order of a set of words does."""
    script = "from foamprb.flow.read.prepared import _hash; print(_hash((frozenset(map(str, range(20))),)))"
    names = {
        subprocess.run(
            [sys.executable, "-c", script], check=True, capture_output=True, text=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in "123"
    }  # fmt: skip
    assert len(names) == 1
