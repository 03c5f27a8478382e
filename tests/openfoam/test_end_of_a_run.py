"""foamprb, started by a solver at its end as the tutorial says."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from foam_tutorials import tutorial
from paths import ROOT

from foamprb import open_run
from foamprb.cli import main

pytestmark = pytest.mark.openfoam

NOBODY = 65534
ORDINARY: dict[str, Any] = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
"""OpenFOAM makes no system calls for root."""


@pytest.fixture
def case() -> Iterator[Path]:
    """The cavity, where an ordinary user can come."""
    with tempfile.TemporaryDirectory() as folder:
        case = tutorial("incompressible/icoFoam/cavity/cavity", Path(folder) / "cavity")
        if ORDINARY:
            for path in (Path(folder), case, *case.rglob("*")):
                os.chown(path, NOBODY, NOBODY)
        yield case


def test_the_solver_starts_foamprb_at_its_end(case: Path) -> None:
    """What the solver calls says where and with which words; the same is then done here."""
    page = (ROOT / "docs/tutorials/openfoam.md").read_text(encoding="utf-8")
    block = re.search(r"<!-- controlDict -->\n```\n(.*?)```", page, re.DOTALL)
    assert block
    with (case / "system/controlDict").open("a") as file:
        file.write(block[1])
    called = case / "called"
    program = case.parent / "bin" / "foamprb"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\n{{ pwd; ls; echo "$@"; }} > "{called}"\n')
    program.chmod(0o755)
    program.parent.chmod(0o755)
    environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}"}
    for command in ("blockMesh", "icoFoam"):
        done = subprocess.run(command, cwd=case, env=environment, capture_output=True, text=True, **ORDINARY)
        assert done.returncode == 0, done.stdout + done.stderr
        assert called.exists() == (command == "icoFoam")
    where, *files, words = called.read_text().splitlines()
    assert Path(where) == case.resolve()
    # The last time, that of endTime, is there already.
    assert "0.5" in files
    assert main(["init", "-case", where]) == 0
    assert main([*words.split(), "-case", where]) == 0
    assert len(open_run(case).times) > 1
