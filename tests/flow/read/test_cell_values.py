"""Values of cells, read without the mesh."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import GRADIENT, decompose, header, write_case

from foamprb.errors import InputError
from foamprb.flow.read.cell_values import cell_values, has_field, solution_times
from foamprb.flow.read.field import DENSITY_FIELD, VELOCITY_FIELD
from foamprb.flow.read.fluid import mean_field


@pytest.fixture
def parts(tmp_path):
    """A case that is only decomposed, and the centres of its cells."""
    mesh = write_case(tmp_path, "mixed")
    decompose(tmp_path, mesh, np.random.default_rng(5).integers(0, 3, mesh.n_cells), ("0", "2"))
    shutil.rmtree(tmp_path / "constant")
    return tmp_path, mesh.centres


def write_density(case, values):
    """Write rho at time 2, a number or an array for each processor."""
    for number, value in enumerate(values):
        numbers = " ".join(map(str, np.ravel(value)))
        inner = (
            f"uniform {numbers}" if np.isscalar(value) else f"nonuniform List<scalar> {len(value)}({numbers})"
        )
        text = f"dimensions [1 -3 0 0 0 0 0]; internalField {inner}; boundaryField {{ }}"
        (case / f"processor{number}/2/rho").write_text(header("volScalarField", "rho") + text)


def test_values_of_processor_folders_have_the_order_of_the_whole_mesh(parts):
    case, centres = parts
    assert solution_times(case, "") == ("0", "2")
    assert has_field(case, "", "2", "U")
    # The files have nine digits.
    values = cell_values(case, "", "2", "U", VELOCITY_FIELD)
    np.testing.assert_allclose(values, centres @ GRADIENT.T, rtol=0.0, atol=1e-7)


@pytest.mark.parametrize("addressed", [True, False])
def test_a_part_whose_values_are_alike_counts_with_all_its_cells(parts, addressed):
    case, centres = parts
    folders = [case / f"processor{k}/constant/polyMesh" for k in range(3)]
    texts = [(folder / "cellProcAddressing").read_text() for folder in folders]
    counts = [int(re.findall(r"\n(\d+)\n\(", text)[0]) for text in texts]
    if not addressed:
        for folder in folders:
            (folder / "cellProcAddressing").unlink()
    write_density(case, (1.0, np.full(counts[1], 3.0), 5.0))
    mean = np.dot(counts, [1.0, 3.0, 5.0]) / len(centres)
    assert mean_field(case, "", "latestTime", "rho") == (pytest.approx(mean, rel=1e-14), "2")
    write_density(case, (1.0, np.full(counts[1] - 1, 3.0), 5.0))
    with pytest.raises(InputError, match=rf"{counts[1] - 1} cells, but the mesh there has {counts[1]}"):
        mean_field(case, "", "latestTime", "rho")
    assert not has_field(case, "", "0", "rho")
    with pytest.raises(InputError, match="rho: no such file"):
        cell_values(case, "", "0", "rho", DENSITY_FIELD)
