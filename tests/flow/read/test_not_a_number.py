"""NaN in any array that is read, or that passes between parts of the program, is never agreement."""

from __future__ import annotations

import re

import numpy as np
import pytest
from foam_writer import put_linear, write_case
from mesh_shapes import block, box_patches

from foamprb.errors import InputError
from foamprb.flow.balance import CONSTANT
from foamprb.flow.fluxes import Conservation, UnbalancedFlowError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.checks import caveat_of_order
from foamprb.flow.read.openfoam import Case, steady_flow
from foamprb.flow.read.source import FlowSource
from foamprb.run.restart import _agree

FIELDS = ("U", "k", "epsilon", "T", "rho", "phi")


@pytest.fixture
def case(tmp_path):
    mesh = write_case(tmp_path, perturbation=0.0)
    time = tmp_path / "1e1"
    for name, units in (("k", "0 2 -2"), ("epsilon", "0 2 -3"), ("rho", "1 -3 0")):
        put_linear(time, mesh, name, at=(0.0, 0.0, 1e-9), begin=1.0, dimensions=f"[{units} 0 0 0 0]")
    put_linear(time, mesh)
    text = (time / "rho").read_text().replace("volScalarField", "surfaceScalarField")
    inner = f"internalField nonuniform List<scalar> {mesh.n_internal}({' 0' * mesh.n_internal});"
    text = re.sub(r"internalField.*?;", inner, text.replace("[1 -3 0", "[0 3 -1"), flags=re.DOTALL)
    (time / "phi").write_text(text)
    return tmp_path


@pytest.mark.parametrize(
    ("name", "where"),
    [*((name, "internalField") for name in FIELDS), ("U", "boundaryField"), ("phi", "boundaryField")],
)
def test_fields_of_a_case_are_numbers(case, name, where):
    file = case / "1e1" / name
    head, tail = file.read_text().split(where, 1)
    file.write_text(head + where + re.sub(r"(\([\s(]*)[-+.\deE]+", r"\1nan", tail, count=1))
    with pytest.raises(InputError, match=rf"1e1/{name}: 1 of \d+ values are not finite numbers"):
        steady_flow(Case(case), "latestTime", FlowSource(turbulent=True, sampled=("T",)))


def test_comparisons_with_nan_end_in_a_word():
    """Of two checkpoints, of a balance of fluxes, and of neighbouring cells."""
    assert not _agree([[1.0], [np.nan]], [[1.0], [np.nan]])
    cube = block(5, 0.0)
    mesh = build_mesh(cube, box_patches(cube))
    u = np.full((mesh.n_points + mesh.n_cells, 3), np.nan)
    with pytest.raises(UnbalancedFlowError, match="the velocity of flow is not finite"):
        Conservation(mesh)(u, np.zeros((len(u), 3, 3)), CONSTANT)
    assert len(caveat_of_order(mesh, u[: mesh.n_cells])) == 1
