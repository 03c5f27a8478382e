"""What needs an extra of the package, and what does not."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from paths import ROOT
from pipe_case import copy_of_pipe

EXTRAS = ("matplotlib", "meshio", "PIL", "pyvista")

PROGRAM = f"""
import json, sys

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {EXTRAS}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Missing())
from foamprb.cli import main
sys.exit(sum(map(main, json.loads(sys.argv[1]))))
"""


def without_extras(*commands):
    """Commands where only the dependencies of a run are installed; the status is the sum of theirs."""
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(commands, default=str)],
        env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True,
    )  # fmt: skip


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """A case that was run without the extras."""
    case = copy_of_pipe(tmp_path_factory.mktemp("extras"))
    done = without_extras(["run", "-case", case])
    assert (done.returncode, done.stderr) == (0, "")
    return case


def test_commands_without_pictures_need_no_extra(case):
    commands = ["info"], ["export", "openfoam"], ["view", "-noBrowser"], ["run", "-dry-run", "-overwrite"]
    done = without_extras(*([*words, "-case", case] for words in commands))
    assert (done.returncode, done.stderr) == (0, "")


def test_pictures_and_reports_name_their_extra(case):
    commands = ["view", "-png", "a.png"], ["report"]
    done = without_extras(*([*words, "-case", case] for words in commands))
    assert done.returncode == len(commands)
    expected = "need matplotlib: pip install 'foamprb[view]', or in a clone pip install '.[view]'"
    assert done.stderr.count(expected) == len(commands)


def test_mesh_files_name_their_extra(tmp_path):
    libraries = {"flow.msh": "meshio", "flow.vtu": "pyvista"}
    for name in libraries:
        (tmp_path / name).write_text("")
    done = without_extras(*(["info", "-flow", tmp_path / name] for name in libraries))
    assert done.returncode == 2
    for library in libraries.values():
        assert f"mesh files need {library}: pip install 'foamprb[meshes]', or in a clone" in done.stderr
