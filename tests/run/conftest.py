"""Runs of the short pipe case that several modules begin with."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from pipe_case import EARLIER, results, short_case, stop_after

from foamprb.cli import main


@pytest.fixture(scope="session")
def ended(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A case whose run was never interrupted; tests leave it as it is."""
    case = short_case(tmp_path_factory.mktemp("ended"))
    assert main(["run", "-case", str(case), "-threads", "2"]) == 0
    return case


@pytest.fixture
def finished(ended: Path, tmp_path: Path) -> Path:
    return shutil.copytree(ended, tmp_path / "pipe")


@pytest.fixture(scope="session")
def truth(ended: Path) -> dict[str, bytes]:
    """Results of that run."""
    found = results(ended)
    assert len(found) == 12
    assert b",stuck,wall," in found["fates.csv"]
    return found


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return short_case(tmp_path)


@pytest.fixture(scope="session")
def _stopped(tmp_path_factory: pytest.TempPathFactory) -> Path:
    case = short_case(tmp_path_factory.mktemp("stopped"))
    stop_after(case, EARLIER)
    return case


@pytest.fixture
def stopped(_stopped: Path, tmp_path: Path) -> Path:
    """A case whose run was stopped at 3 ms, with particles pending."""
    return shutil.copytree(_stopped, tmp_path / "pipe")
