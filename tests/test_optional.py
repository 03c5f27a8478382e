"""What needs an extra of the package, and what does not."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from paths import ROOT
from pipe_case import copy_of_pipe

EXTRAS = ("matplotlib", "meshio", "PIL", "pyvista")

PROGRAM = f"""
import sys

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {EXTRAS}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Missing())
from foamprb.cli import main
sys.exit(main(sys.argv[1:]))
"""


def without_extras(*words):
    """What the command line does where only the dependencies of a run are installed."""
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *map(str, words)],
        env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True,
    )  # fmt: skip


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """A case that was run without the extras."""
    case = copy_of_pipe(tmp_path_factory.mktemp("extras"))
    done = without_extras("run", "-case", case)
    assert (done.returncode, done.stderr) == (0, "")
    return case


@pytest.mark.parametrize("words", [("info",), ("export", "openfoam"), ("run", "-dry-run", "-overwrite")])
def test_commands_without_pictures_need_no_extra(case, words):
    done = without_extras(*words, "-case", case)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    "words", [("view", "-noBrowser"), ("view", "-png", "a.png"), ("view", "-window"), ("report",)]
)
def test_pages_and_pictures_name_their_extra(case, words):
    done = without_extras(*words, "-case", case)
    assert done.returncode == 1
    assert "need pyvista: pip install 'foamprb[view]', or in a clone pip install '.[view]'" in done.stderr


@pytest.mark.parametrize(("name", "library"), [("flow.msh", "meshio"), ("flow.vtu", "pyvista")])
def test_mesh_files_name_their_extra(tmp_path, name, library):
    (tmp_path / name).write_text("")
    done = without_extras("info", "-flow", tmp_path / name)
    assert done.returncode == 1
    assert f"mesh files need {library}: pip install 'foamprb[meshes]', or in a clone" in done.stderr
