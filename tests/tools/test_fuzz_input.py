"""Some damaged inputs, as tools/hardening/fuzz_input tries them by the thousand."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import sys

import pytest
from paths import ROOT

TOOL = ROOT / "tools/hardening/fuzz_input"


@pytest.fixture(scope="module")
def tool():
    loader = importlib.machinery.SourceFileLoader("fuzz_input", str(TOOL))
    path = list(sys.path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("fuzz_input", loader))
    sys.modules["fuzz_input"] = module
    loader.exec_module(module)
    yield module
    sys.path[:] = path
    del sys.modules["fuzz_input"]


def test_damaged_input_ends_in_a_message_or_a_correct_run(tool, tmp_path):
    failures: list[str] = []
    outcomes = tool.fuzz(60, 1, tmp_path, failures.append)
    assert not failures, "\n".join(failures)
    assert sum(outcomes.values()) == 60
    seen = {kind for _, kind in outcomes}
    assert seen == {"message", "run", "other"}


def test_a_damaged_cache_ends_in_the_same_run(tool, tmp_path):
    failures: list[str] = []
    outcomes = tool.fuzz_caches(2, 1, tmp_path, failures.append)
    assert not failures, "\n".join(failures)
    assert outcomes == {("the cache", "run"): 2}


def test_every_damage_of_a_cache_changes_it(tool, tmp_path):
    for number, (name, change) in enumerate(tool.CACHE_DAMAGES.items()):
        cache = tmp_path / str(number)
        for folder in "ab":
            (cache / folder).mkdir(parents=True)
            (cache / folder / "x.code").write_bytes(folder.encode() * 1000)
        path = cache / "a/x.code"
        change(path, tool.random.Random(3))
        whole = path.is_file() and path.read_bytes() == b"a" * 1000
        closed = (
            not (path.exists() and path.stat().st_mode & 0o022) and not path.parent.stat().st_mode & 0o022
        )
        assert not (whole and closed), name


def test_a_failure_is_seen(tool, tmp_path):
    """The sound inputs with other sizes than they have: every one must be told."""
    inputs = tool.sound_inputs(tmp_path)
    answer = tool.attempt(tmp_path / inputs[0].name, inputs[0].flow, (8, 27, 23))
    assert answer["outcome"] == "silent"
    assert "the input had (8, 27, 23)" in answer["text"]
    assert tool.attempt(tmp_path / "none", "", (8, 27, 24))["outcome"] == "message"


def test_another_result_without_a_warning_is_seen_where_the_files_show_the_damage(tool):
    sound = {"outcome": "run", "result": "abc 1", "notes": ["a"]}
    other = {"outcome": "run", "result": "abd 1", "notes": ["a"]}
    assert tool.compared(sound, sound, True) == sound
    assert tool.compared(other, sound, True)["outcome"] == "silent"
    assert tool.compared(other, sound, False)["outcome"] == "other"
    assert tool.compared({**other, "notes": ["a", "b"]}, sound, True)["outcome"] == "other"
    assert tool.compared({"outcome": "message"}, sound, True) == {"outcome": "message"}
