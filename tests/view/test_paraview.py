"""Command ``foamprb paraview``."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from view_run import motion, write_run

from foamprb.cli import main


@pytest.fixture
def case(tmp_path):
    write_run(tmp_path, motion(3, 2)._replace(radius=np.full(3, 1e-3)), mesh=False)
    return tmp_path


def test_missing_program_is_reported(case, capsys, monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert main(["paraview", "-case", str(case)]) == 1
    assert "no paraview on PATH" in capsys.readouterr().err


def test_paraview_is_started_with_the_state(case, monkeypatch):
    state = case / "postProcessing/softCloud/softCloud.py"
    state.write_text("print('another script of the case')")
    program = case / "paraview"
    program.write_text(f'#!/bin/sh\necho "$1" > {case}/called\nexit 3\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(case), prepend=":")
    monkeypatch.setattr("foamprb.view.show.has_display", lambda: True)
    assert main(["paraview", "-case", str(case)]) == 3
    assert (case / "called").read_text() == f"--script={state}\n"
    text = state.read_text()
    compile(text, str(state), "exec")
    assert "another script" not in text
    assert "ENLARGEMENT = 6.0\n" in text
    assert "bodies drawn 6x larger" in text


def test_moved_results_are_reported(case, monkeypatch):
    """ParaView's File > Load State runs the text without ``__file__``."""
    monkeypatch.setenv("PATH", "")
    main(["paraview", "-case", str(case)])
    text = (case / "postProcessing/softCloud/softCloud.py").read_text()
    (case / "postProcessing").rename(case / "moved")
    monkeypatch.setitem(sys.modules, "paraview", SimpleNamespace(simple=None))
    with pytest.raises(FileNotFoundError, match="set FILE in this script to its present path"):
        exec(text, {})
