"""The floors of the house: the contracts of ``pyproject.toml`` on imports."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from paths import ROOT

CLIMBING = [
    ("body/drag.py", "from foamprb.cloud import state", "No import runs up"),
    ("body/traction.py", "def late():\n    from foamprb.compile import link", "No import runs up"),
    ("body/slip.py", "from foamprb.errors import InputError", "body imports only body"),
    ("flow/walk.py", "from foamprb.flow.series import SeriesFlow", "No import runs up within flow"),
    ("flow/mesh/faces.py", "from foamprb.flow.mesh.mesh import Mesh", "No import runs in a circle"),
    ("results/tables.py", "from foamprb.body import tensor", "results and dictionary know no physics"),
    ("cloud/state.py", "from foamprb.dictionary.positions import read_positions", "cloud reads no files"),
    ("flow/base.py", "import foamprb", "Only cli comes through the door"),
]
MODULES = ["foamprb." + module.removesuffix(".py").replace("/", ".") for module, _, _ in CLIMBING]


def check_imports(package_at: Path) -> tuple[int, str]:
    """Exit status and report of import-linter on the package in a folder."""
    program = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    result = subprocess.run(
        [sys.executable, "-c", program, "--no-cache", "--config", str(ROOT / "pyproject.toml")],
        cwd=package_at,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(package_at), *sys.path]), "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Contracts:" in result.stdout, result.stdout + result.stderr
    return result.returncode, result.stdout


def test_no_import_runs_up_and_none_in_a_circle():
    status, report = check_imports(ROOT)
    assert status == 0, report


def test_imports_that_climb_are_found(tmp_path):
    shutil.copytree(ROOT / "foamprb", tmp_path / "foamprb", ignore=shutil.ignore_patterns("__pycache__"))
    for module, line, _ in CLIMBING:
        with (tmp_path / "foamprb" / module).open("a") as file:
            file.write(f"\n\n{line}\n")
    status, report = check_imports(tmp_path)
    assert status != 0
    assert not [contract for _, _, contract in CLIMBING if f"{contract} BROKEN" not in report], report
    assert not [module for module in MODULES if module not in report], report
