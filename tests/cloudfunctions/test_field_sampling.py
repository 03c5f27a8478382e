"""Fields of a case along the paths of particles."""

from __future__ import annotations

import numpy as np
import pytest
from foam_writer import header, write_case
from observing import column, table
from pipe_case import END, edit, results, short_case, stop_after, time_folder

from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.flow.read.flows import read_transient_flow
from foamprb.flow.read.openfoam import Case, steady_flow
from foamprb.flow.read.source import FlowSource

SLOPE = np.array([2.0, -3.0, 0.5])


def put_linear(folder, mesh, name="T", at=SLOPE):
    """-1 + at · x, with values on all patches."""

    def listed(x):
        values = x @ at - 1.0
        return f"nonuniform List<scalar> {len(values)}({' '.join(f'{v:.17g}' for v in values)})"

    starts = mesh.patch_start
    patches = " ".join(
        f"{patch.name} {{ type fixedValue; value {listed(mesh.boundary_centres[a:b])}; }}"
        for patch, a, b in zip(mesh.patches, starts, starts[1:], strict=False)
    )
    (folder / name).write_text(
        header("volScalarField", name) + "dimensions [0 0 0 1 0 0 0]; "
        f"internalField {listed(mesh.centres)}; boundaryField {{ {patches} }}"
    )


def test_a_linear_field_is_exact(tmp_path):
    write_case(tmp_path)
    mesh = Case(tmp_path).mesh("1e1").mesh
    put_linear(tmp_path / "1e1", mesh)
    flow = steady_flow(Case(tmp_path), "1e1", FlowSource(scalars=("T",)))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    x = low + (high - low) * np.random.default_rng(1).uniform(0.02, 0.98, (50, 3))
    hosts = flow.locate(x)
    x, hosts = x[hosts >= 0], hosts[hosts >= 0]
    assert len(x) > 40
    np.testing.assert_allclose(flow.scalar("T", x, hosts), x @ SLOPE - 1.0, atol=1e-12)


def test_what_cannot_be_sampled_has_one_message(tmp_path):
    mesh = write_case(tmp_path)
    put_linear(tmp_path / "1e1", mesh)
    with pytest.raises(
        InputError,
        match=r"fieldSampling: no field Tt at the time of the flow\. Did you mean 'T'\? Allowed: T, p\.",
    ):
        steady_flow(Case(tmp_path), "1e1", FlowSource(scalars=("Tt",)))
    with pytest.raises(InputError, match="sampled in steady flows only"):
        read_transient_flow(tmp_path, None, None, FlowSource(scalars=("T",)))


def test_values_along_paths_and_after_a_restart(tmp_path):
    case = short_case(tmp_path)
    time = time_folder(case)
    mesh = Case(case).mesh(time.name).mesh
    put_linear(time, mesh, at=np.array([100.0, 0.0, 0.0]))
    entry = "cloudFunctions { sample { type fieldSampling; fields (T); }"
    edit(case, r"^cloudFunctions\s*\{", entry)
    stop_after(case, 0.5 * END)
    assert main(["run", "-case", str(case), "-resume"]) == 0
    resumed = results(case)
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert results(case) == resumed
    output = case / "postProcessing/softCloud"
    rows, fates = (table(next(output.rglob(name))) for name in ("fields.csv", "fates.csv"))
    assert [row["id"] for row in rows] == [row["id"] for row in fates]
    assert "stuck" in {row["fate"] for row in rows}
    first, last = (100.0 * column(fates, x) - 1.0 for x in ("x0", "x1"))
    np.testing.assert_allclose(column(rows, "T"), last, atol=1e-9)
    # The field rises along the pipe, in which a particle soon has the speed of the fluid.
    np.testing.assert_array_equal(column(rows, "TMax"), column(rows, "T"))
    moved = column(rows, "time") > column(fates, "t0")
    np.testing.assert_allclose(column(rows, "TMean")[moved], 0.5 * (first + last)[moved], rtol=0.01)
