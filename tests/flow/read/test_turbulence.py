"""k and ε of a case, read and reconstructed."""

from __future__ import annotations

import gzip
import shutil

import numpy as np
import pytest
from foam_writer import decompose, header, write_case

from foamprb.errors import InputError
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.openfoam import read_case, read_series, steady_flow
from foamprb.flow.read.source import FlowSource

UNITS = {"k": "[0 2 -2 0 0 0 0]", "epsilon": "[0 2 -3 0 0 0 0]", "omega": "[0 0 -1 0 0 0 0]"}
PATCHES = '".*" { type zeroGradient; }'


def put(folder, name, values, patches=PATCHES):
    field = f"nonuniform List<scalar> {len(values)}({' '.join(f'{v:.12g}' for v in values)})"
    (folder / name).write_text(
        header("volScalarField", name) + f"dimensions {UNITS[name]}; internalField {field}; "
        f"boundaryField {{ {patches} }}"
    )


@pytest.fixture
def case(tmp_path):
    mesh = write_case(tmp_path, perturbation=0.0)
    x = mesh.centres[:, 0]
    for time in ("0.5", "1e1"):
        put(tmp_path / time, "k", 1.0 + x)
        put(tmp_path / time, "epsilon", 3.0 + 0.0 * x)
    return tmp_path, mesh


def at_centres(flow, mesh):
    return flow.turbulence_at_nodes()[mesh.n_points :]


def test_values_of_cells_are_those_of_the_file(case):
    folder, mesh = case
    x = mesh.centres[:, 0]
    table = at_centres(read_case(folder, turbulent=True), mesh)
    np.testing.assert_allclose(table[:, 0], 1.0 + x, rtol=1e-6)
    np.testing.assert_allclose(table[:, 1], 3.0)
    assert np.all(table[:, 2] > 0.0)
    assert np.abs(table[:, [3, 4]]).max() < 1e-6


def test_omega_stands_for_epsilon(case):
    folder, mesh = case
    expected = at_centres(read_case(folder, turbulent=True), mesh)
    (folder / "1e1/epsilon").unlink()
    put(folder / "1e1", "omega", 3.0 / (0.09 * (1.0 + mesh.centres[:, 0])))
    np.testing.assert_allclose(at_centres(read_case(folder, turbulent=True), mesh), expected, rtol=1e-6)


def test_a_wall_has_the_k_of_its_own(case):
    folder, mesh = case
    put(folder / "1e1", "k", np.ones(mesh.n_cells), '".*" { type fixedValue; value uniform 0; }')
    table = read_case(folder, turbulent=True).turbulence_at_nodes()
    floor = np.flatnonzero(mesh.points[:, 2] == 0.0)
    assert not np.any(table[floor, 0])
    assert np.all(table[floor, 1] == pytest.approx(3.0))
    assert np.all((table[:, 0] >= 0.0) & (table[:, 0] <= 1.0 + 1e-12))


def test_it_is_read_compressed_decomposed_and_at_all_times(case, tmp_path_factory):
    folder, mesh = case
    expected = at_centres(read_case(folder, turbulent=True), mesh)
    series = read_series(folder, "0.5:10", turbulent=True)
    np.testing.assert_allclose(at_centres(series, mesh), expected)
    parts = tmp_path_factory.mktemp("decomposed") / "case"
    shutil.copytree(folder, parts)
    part_of = (mesh.centres[:, 1] > 0.5).astype(int)
    decompose(parts, mesh, part_of, ("0", "0.5", "1e1"))
    for part in (0, 1):
        cells = np.flatnonzero(part_of == part)
        extra = PATCHES + " procBoundary { type processor; value uniform 1; }"
        put(parts / f"processor{part}/1e1", "k", 1.0 + mesh.centres[cells, 0], extra)
        put(parts / f"processor{part}/1e1", "epsilon", 3.0 + 0.0 * cells, extra)
    np.testing.assert_allclose(
        at_centres(steady_flow(DecomposedCase(parts), "latestTime", FlowSource(turbulent=True)), mesh),
        expected,
    )
    k = folder / "1e1/k"
    (folder / "1e1/k.gz").write_bytes(gzip.compress(k.read_bytes()))
    k.unlink()
    np.testing.assert_allclose(at_centres(read_case(folder, turbulent=True), mesh), expected)


def test_what_is_missing_or_wrong_is_named(case):
    folder, mesh = case
    (folder / "1e1/epsilon").unlink()
    with pytest.raises(InputError, match=r"1e1/epsilon: no such field, and no omega\. The dispersionModel"):
        read_case(folder, turbulent=True)
    put(folder / "1e1", "epsilon", np.full(mesh.n_cells, -1.0))
    with pytest.raises(InputError, match=r"epsilon: the value at cell 0 is -1\. Allowed: none below 0"):
        read_case(folder, turbulent=True)
    put(folder / "1e1", "epsilon", np.ones(mesh.n_cells + 1))
    with pytest.raises(InputError, match=r"epsilon: internalField has 9 values, but there are 8 cells"):
        read_case(folder, turbulent=True)
    (folder / "1e1/k").unlink()
    with pytest.raises(InputError, match=r"1e1/k: no such field\. The dispersionModel needs k and epsilon"):
        read_case(folder, turbulent=True)


def test_diffusivity_of_eddies_is_that_of_their_energy_and_life(case):
    """k²/3ε is k/9 where ε is 3 k."""
    folder, mesh = case
    put(folder / "1e1", "epsilon", 3.0 * (1.0 + mesh.centres[:, 0]))
    table = read_case(folder, turbulent=True).turbulence_at_nodes()
    assert table[:, 2].min() > 0.4
    np.testing.assert_allclose(table[:, 5:], table[:, 2:5] / 9.0, atol=1e-9)
