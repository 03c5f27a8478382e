"""Command ``foamprb paraview``."""

from __future__ import annotations

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
