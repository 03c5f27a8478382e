"""What VTK says while it reads, and which parts of a case it reads."""

from __future__ import annotations

import logging

import numpy as np
import pytest
from foam_writer import write_case
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import assemble
from foamprb.flow.read.boundary import read_boundary
from foamprb.flow.read.openfoam import PRECISION_NOTE, Case, steady_flow
from foamprb.flow.read.polymesh import read_poly
from foamprb.flow.read.source import FlowSource
from foamprb.flow.read.vtk_reader import read_poly_by_vtk, vtk_messages

NAMES = ("points", "faces", "owner", "neighbour", "boundary")


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


@pytest.mark.parametrize("kind", ["mixed", "polyhedra"])
def test_vtk_reads_the_same_mesh(kind, tmp_path):
    """In single precision; a group of patches, which VTK lists among them, is none."""
    write_case(tmp_path, kind)
    files = [tmp_path / "constant/polyMesh" / name for name in NAMES]
    assert "inGroups" in files[-1].read_text()
    patches = read_boundary(files[-1], tmp_path)
    own, other = (assemble(read(files, patches), "mesh") for read in (read_poly, read_poly_by_vtk))
    assert own.patches == other.patches
    np.testing.assert_array_equal(own.patch_start, other.patch_start)
    np.testing.assert_allclose(other.points, own.points, rtol=6e-8)
    assert np.abs(other.points - own.points).max() > 0.0
    np.testing.assert_allclose(other.volumes, own.volumes, rtol=1e-5)
    np.testing.assert_allclose(other.boundary_areas, own.boundary_areas, atol=1e-6)
    assert set(zip(own.owner[: own.n_internal].tolist(), own.neighbour.tolist(), strict=True)) == set(
        zip(other.owner[: other.n_internal].tolist(), other.neighbour.tolist(), strict=True)
    )
    flow = steady_flow(Case(tmp_path, reader="vtk"), "latestTime", FlowSource())
    assert flow.notes[0] == PRECISION_NOTE
