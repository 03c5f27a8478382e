"""Dictionaries of which words are lost, doubled or changed: settings or a message, never anything else."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from cloud_dictionary import CLOUD
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from foamprb.dictionary.mistakes import ReportedError
from foamprb.errors import InputError
from foamprb.settings.settings import read_settings

WORDS = re.findall(r"\s+|[{}();]|[^\s{}();]+", CLOUD)
NAMES = sorted({word for word in WORDS if re.fullmatch(r"[A-Za-z]\w*", word)})
OTHERS = ["", "{", "}", ";", "(", ")", "0", "-1", "1e-320", "1e300", "nan", "none", "no", "$inlet", "#calc",
          "{ }", "; x", "Ca 0.1; Ca", "libs", "cloudFunctions { a { type particleTracks; } }"]  # fmt: skip
change = st.tuples(st.integers(0, len(WORDS) - 1), st.sampled_from([*OTHERS, *NAMES]))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    case = tmp_path_factory.mktemp("damage")
    (case / "constant").mkdir()
    (case / "constant/transportProperties").write_text("nu 1.5e-5;")
    return case


@settings(max_examples=600, suppress_health_check=list(HealthCheck))
@given(st.lists(change, min_size=1, max_size=3))
def test_any_damage_ends_in_settings_or_a_message(folder: Path, changes: list[tuple[int, str]]) -> None:
    words = list(WORDS)
    for at, word in changes:
        words[at] = word
    (folder / "constant/softCloudProperties").write_text("".join(words))
    can_be_read(folder)


def can_be_read(folder: Path) -> bool:
    """Return whether the settings can be read; the message of a refusal names a file of the case."""
    try:
        read_settings(folder)
    except ReportedError as error:
        raise AssertionError(f"{error}, which nothing has reported") from error
    except InputError as error:
        assert "constant/" in str(error)  # noqa: PT017
        return False
    return True


def test_any_line_may_be_lost(folder: Path) -> None:
    """A brace, the fluid or an injection is missed; a line with a default is not."""
    lines = CLOUD.splitlines()
    outcomes = []
    for at in range(len(lines)):
        (folder / "constant/softCloudProperties").write_text("\n".join(lines[:at] + lines[at + 1 :]))
        outcomes.append(can_be_read(folder))
    assert True in outcomes
    assert False in outcomes
