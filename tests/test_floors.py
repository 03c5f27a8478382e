"""The floors of the house: the contracts of ``pyproject.toml`` on who may import whom."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def broken(package_at: Path) -> set[str]:
    """Names of the contracts that the package in a folder breaks."""
    command = [
        sys.executable,
        "-c",
        "from importlinter.cli import lint_imports_command; lint_imports_command()",
    ]
    options = ["--no-cache", "--config", str(ROOT / "pyproject.toml")]
    path = os.pathsep.join([str(package_at), os.environ.get("PYTHONPATH", "")])
    result = subprocess.run(
        [*command, *options],
        cwd=package_at,
        env={**os.environ, "PYTHONPATH": path, "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Contracts:" in result.stdout, result.stdout + result.stderr
    names = {line.split(" BROKEN")[0] for line in result.stdout.splitlines() if " BROKEN" in line}
    assert (result.returncode == 0) == (not names)
    return names


def test_no_import_runs_up_and_none_in_a_circle():
    assert broken(ROOT) == set()


@pytest.mark.parametrize(
    ("module", "line", "contract"),
    [
        ("body/drag.py", "from foamprb.cloud import state", "No import runs up"),
        ("body/drag.py", "def late():\n    from foamprb.compile import link", "No import runs up"),
        (
            "body/drag.py",
            "from foamprb.errors import InputError",
            "body imports only body",
        ),
        ("flow/walk.py", "from foamprb.flow.series import SeriesFlow", "No import runs up within flow"),
        ("flow/mesh/faces.py", "from foamprb.flow.mesh.mesh import Mesh", "No import runs in a circle"),
        ("results/tables.py", "from foamprb.body import tensor", "results and dictionary know no physics"),
        ("cloud/state.py", "from foamprb.dictionary.positions import read_positions", "cloud reads no files"),
        ("flow/base.py", "import foamprb", "Only cli comes through the door"),
    ],
)
def test_an_import_that_climbs_is_found(tmp_path, module, line, contract):
    shutil.copytree(ROOT / "foamprb", tmp_path / "foamprb", ignore=shutil.ignore_patterns("__pycache__"))
    with (tmp_path / "foamprb" / module).open("a") as file:
        file.write(f"\n\n{line}\n")
    assert contract in broken(tmp_path)
