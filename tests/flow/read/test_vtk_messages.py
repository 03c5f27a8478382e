"""Messages of VTK while it reads."""

from __future__ import annotations

import logging

import pytest
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

from foamprb.errors import InputError
from foamprb.flow.read.vtk_messages import vtk_messages


def say(kind, text):
    vtkOutputWindow.GetInstance().DisplayText(f"{kind}: In reader.cxx, line 7\nvtkReader (0x1f): {text}\n\n")


@pytest.fixture
def window():
    """Where VTK writes beside the collected messages."""
    before, own = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(own)
    yield own
    vtkOutputWindow.SetInstance(before)


@pytest.mark.parametrize("fails", [False, True])
def test_messages_are_collected_within_and_go_where_they_went_after(window, fails):
    say("ERROR", "before")
    try:
        with vtk_messages() as messages:
            for _ in range(2):
                say("ERROR", "no  such\nfile")
                say("Warning", "odd")
                say("Generic Warning", "Error in x")
            if fails:
                raise InputError("broken")
    except InputError:
        assert fails
    say("ERROR", "after")
    assert messages.errors == ["no such", "Error in x"]
    assert messages.warnings == ["odd"]
    assert vtkOutputWindow.GetInstance() is window
    told = window.GetOutput()
    assert [word in told for word in ("before", "no  such", "odd", "after")] == [True, False, False, True]


def test_of_what_is_logged_errors_are_collected(caplog):
    handlers = list(logging.getLogger().handlers)
    caplog.set_level(logging.DEBUG)
    with vtk_messages() as messages:
        for level in (logging.DEBUG, logging.INFO, logging.WARNING):
            logging.getLogger("vtk").log(level, "all is well")
        logging.getLogger("vtk").error("a line\nand %d more", 3)
        logging.getLogger("vtk").critical("the end")
    logging.getLogger("vtk").error("later")
    assert messages.errors == ["a line and 3 more", "the end"]
    assert logging.getLogger().handlers == handlers
