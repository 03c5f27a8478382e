"""Fresh coarse runs of the cases of the tree."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import foamprb
from foamprb.run.job import Job


@pytest.fixture(scope="module")
def live(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh coarse run of the case ``CASE`` of a module."""
    folder = tmp_path_factory.mktemp("live") / request.module.CASE.name
    subprocess.run([request.module.CASE / "Allrun", "coarse", folder], check=True)
    return folder


@pytest.fixture(scope="module")
def job(live: Path) -> Job:
    """The job of that case."""
    return foamprb.prepare(live)
