"""The pipe case of the tree, through the command line."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
import pyvista
from paths import PIPE, ROOT
from pipe_case import copy_of_pipe, edit, fates, message, short_case
from scipy import stats

from foamprb.cli import main
from foamprb.cloud.measures import WRITTEN
from foamprb.cloud.tracker import Tracker
from foamprb.cloudfunctions.base import STATUS_NAMES
from foamprb.errors import InputError
from foamprb.flow import fluxes
from foamprb.results.pvd import read_pvd
from foamprb.run.job import likely_integrator, prepare
from foamprb.run.template import write_template
from foamprb.settings.settings import read_settings

HEADER = "id,d,rho,Ca,t0,x0,y0,z0,t1,x1,y1,z1,fate,patch,touchedAtRelease,a,b,c,D,"
LARGEST = "maxD,maxShearRate,maxShearStress,maxReynolds,minGap,curvatureNumber,maxBulletAmplitude"
D = 5e-6


@pytest.fixture
def case(tmp_path):
    return copy_of_pipe(tmp_path)


@pytest.fixture(scope="module")
def short_run(tmp_path_factory):
    """A run of 0.03 s that writes three times."""
    case = copy_of_pipe(tmp_path_factory.mktemp("short"))
    edit(case, r"endTime\s+\S+;", "endTime 0.03;")
    assert main(["run", "-case", str(case)]) == 0
    return case


def test_fates_have_a_row_for_every_particle_that_entered(short_run):
    table = short_run / "postProcessing/softCloud/fates.csv"
    assert table.read_text().splitlines()[0] == HEADER + LARGEST
    rows = fates(short_run)
    # 3000 1/s for 30 ms, and five at the start.
    assert [int(row["id"]) for row in rows] == list(range(95))
    assert {row["fate"] for row in rows} <= set(STATUS_NAMES)
    assert [float(row["Ca"]) for row in rows[:5]] == pytest.approx([1e-4, 0.25, 0.5, 0.75, 1.0], rel=1e-12)
    for row in rows:
        a, b, c = (float(row[name]) for name in "abc")
        assert a >= b >= c > 0
        assert float(row["maxD"]) >= float(row["D"])
        assert float(row["D"]) == pytest.approx((a - c) / (a + c), rel=1e-12, abs=1e-15)
        assert (row["patch"] == "") == (row["fate"] == "active")


def test_bodies_that_never_entered_have_no_row(tmp_path, capsys):
    case = short_case(tmp_path)
    # 75 000 1/s enter through the inlet for 4 ms, and 10 bodies begin at places of a file.
    edit(case, r"endTime\s+\S+;", "endTime 0.002;")
    assert main(["run", "-case", str(case)]) == 0
    assert main(["report", "-case", str(case)]) == 0
    assert "150 particles were not yet injected at the end time." in capsys.readouterr().out
    rows = fates(case)
    assert [int(row["id"]) for row in rows] == list(range(160))
    assert {row["fate"] for row in rows} <= {"active", "stuck"}
    page = (case / "postProcessing/softCloud/report.html").read_text()
    assert '<span class="figures">160</span>injected' in page


def test_series_holds_every_write_time_and_quantity(short_run):
    folder = short_run / "postProcessing/softCloud"
    entries = read_pvd(folder / "softCloud.pvd")
    assert [entry.time for entry in entries] == pytest.approx([0.0, 0.01, 0.02, 0.03])
    injected = [pyvista.read(folder / entry.file) for entry in entries]
    # 3000 a second, and five from the start; the one due at the write time itself comes after it.
    assert [cloud.n_points for cloud in injected] == [6, 35, 65, 95]
    for entry, cloud in zip(entries, injected, strict=True):
        assert set(WRITTEN) <= set(cloud.point_data.keys())
        assert cloud.field_data["TimeValue"][0] == entry.time
        assert list(cloud.field_data["statusNames"]) == list(STATUS_NAMES)


def test_dry_run_reports_and_writes_nothing(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    for expected in ("305 particles", "shape Stokes number", "Reynolds number", "size/cell size", "stick"):
        assert expected in out
    assert not (case / "postProcessing").exists()


def test_log_ends_with_the_fate_of_every_particle(short_run, capsys):
    assert main(["run", "--case", str(short_run)]) == 0
    out = capsys.readouterr().out
    table = re.findall(r"^    (injected|active|stuck|escaped|failed) +(\d+)\b", out, re.MULTILINE)
    numbers = {name: int(n) for name, n in table}
    assert numbers.pop("injected") == sum(numbers.values())
    assert out.rstrip().endswith("End")
    assert "Time = 0.02" in out


MISTAKES = {
    "no such case": (shutil.rmtree, ["pipe"]),
    "no settings": (lambda c: (c / "constant/softCloudProperties").unlink(), ["softCloudProperties"]),
    "patch that matches nothing": (
        lambda c: edit(c, r'"\(inlet\|outlet\)"', '"(inlt|outlt)"'),
        ["softCloudProperties", "inlt", "inlet"],
    ),
    "patch without a rule": (lambda c: edit(c, r'"\(inlet\|outlet\)"', "outlet"), ["inlet"]),
    "injection through no patch": (lambda c: edit(c, r"patch\s+inlet;", "patch inlt;"), ["inlt", "inlet"]),
    "injection through the wall": (lambda c: edit(c, r"patch\s+inlet;", "patch wall;"), ["no fluid enters"]),
    "particle outside the mesh": (
        lambda c: edit(c, r"-0\.00165|-1\.65e-0?3", "-0.0022", "constant/softCloudPositions"),
        ["1 of 1", "outside the mesh", "-0.0022"],
    ),
    "broken viscosity": (
        lambda c: edit(c, r"nu\s+.*;", "nu air;", "constant/transportProperties"),
        ["transportProperties", "nu", "air"],
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_has_its_one_message(name, case, capsys):
    make, expected = MISTAKES[name]
    make(case)
    text = message(case, capsys)
    for words in expected:
        assert words in text


@pytest.mark.parametrize(
    ("words", "status", "expected"),
    [
        (["rnu"], 2, "Did you mean 'run'"),
        (["run", "-cas", "x"], 2, "-cas"),
        (["run", "-threads", "0"], 1, ">= 1"),
        (["run", "-threads", "many"], 2, "many"),
        (["run", "-time", "1", "-latestTime"], 2, "latestTime"),
    ],
)
def test_mistakes_in_the_arguments(words, status, expected, capsys):
    assert main(words) == status
    err = capsys.readouterr().err
    assert expected in err
    assert "Traceback" not in err


def population(case, threads=None):
    return prepare(case, threads=threads).cloud.particles


def of(p, injector):
    return p.take(np.flatnonzero(p.injector == injector))


def test_a_population_is_spread_and_reproducible(case):
    """Size, density and stiffness are drawn by the model's name, whatever else is injected."""
    plain = of(population(case), 5)
    names = {"rho0": (900.0, 1100.0), "shearModulus": (50.0, 500.0), "viscosity": (0.1, 0.2)}
    rho, mu, eta = (
        f"{name} {{ type uniform; uniformDistribution {{ minValue {low}; maxValue {high}; }} }}"
        for name, (low, high) in names.items()
    )
    sizes = "{ type uniform; uniformDistribution { minValue 2e-6; maxValue 9e-6; } }"
    edit(case, r"(patch\s+inlet;)", rf"\1 {rho} solid {{ {mu} {eta} }}")
    edit(case, r"sizeDistribution\s*\{\s*\$:onePoint\.sizeDistribution;\s*\}", f"sizeDistribution {sizes}")
    both = of(population(case, threads=1), 5), of(population(case, threads=2), 5)
    for array, other in zip(*both, strict=True):
        np.testing.assert_array_equal(array, other)
    p = both[0]
    np.testing.assert_array_equal(p.x, plain.x)
    for values, (low, high) in ((p.rho, names["rho0"]), (p.mu, names["shearModulus"]),
                                (p.eta, names["viscosity"]), (2e6 * p.R, (2.0, 9.0))):  # fmt: skip
        share = (values - low) / (high - low)
        assert stats.ks_1samp(share, stats.uniform.cdf).pvalue > 0.01
    np.testing.assert_allclose(p.lame, p.mu * 2.0 * 0.499 / (1.0 - 2.0 * 0.499), rtol=1e-12)
    np.testing.assert_allclose(p.Ca * p.mu, 1.208 * 1.491e-5 * 923.8, rtol=1e-4)
    # No two quantities share their random numbers, or who is large would be stiff.
    columns = [p.rho, p.mu, p.eta, p.R]
    correlation = np.corrcoef(columns) - np.eye(4)
    assert np.abs(correlation).max() < 4.0 / np.sqrt(p.size)
    text = (case / "constant/softCloudProperties").read_text()
    (case / "constant/softCloudProperties").write_text(re.sub(r"Ca025\s*\{[^{}]*\{[^{}]*\}\s*\}", "", text))
    alone = of(population(case), 4)
    for name, array, other in zip(p._fields, p, alone, strict=True):
        if name not in ("injector", "number"):
            np.testing.assert_array_equal(array, other)


def test_overrides_take_the_place_of_entries(case):
    changes = {"solution/endTime": 0.02, "solution/deltaT": 1e-5}
    job = prepare(case, overrides=changes)
    assert job.steps == 2000
    assert job.description["settings"]["overrides"] == {
        name: f"{value:g};" for name, value in changes.items()
    }


def test_a_mesh_that_moves_is_an_error_unless_accepted(case):
    (case / "constant/dynamicMeshDict").write_text("dynamicFvMesh dynamicMotionSolverFvMesh;")
    points = max(case.glob("[0-9]*")) / "polyMesh/points.gz"
    points.parent.mkdir()
    points.write_bytes((case / "constant/polyMesh/points.gz").read_bytes())
    with pytest.raises(InputError, match=r"moves \(dynamicMotionSolverFvMesh\).*accept \( movingMesh \)"):
        prepare(case)
    assert prepare(case, overrides={"solution/accept": ["movingMesh"]}).cloud.size
    (case / "constant/softCloudProperties").unlink()
    assert (
        "// accept ( movingMesh ); // to go on, although the mesh moves" in write_template(case).read_text()
    )


def test_fluxes_that_cannot_be_balanced_are_an_error_unless_accepted(case, monkeypatch):
    monkeypatch.setattr(fluxes, "_LARGEST_CHANGE", -1.0)
    with pytest.raises(InputError, match=r"cannot be balanced.*accept \( unbalanced \)"):
        prepare(case)
    job = prepare(case, overrides={"solution/accept": ["unbalanced"]})
    assert len(job.cloud.flow.arrays().correction) == 0
    assert any("cannot be balanced" in line for line in job.description["warnings"])
    (case / "constant/softCloudProperties").unlink()
    assert "// accept ( unbalanced ); // to go on, although the fl" in write_template(case).read_text()


def test_all_faults_of_a_flow_are_told_at_once(case, monkeypatch):
    monkeypatch.setattr(fluxes, "_LARGEST_CHANGE", -1.0)
    (case / "constant/dynamicMeshDict").write_text("dynamicFvMesh dynamicMotionSolverFvMesh;")
    points = max(case.glob("[0-9]*")) / "polyMesh/points.gz"
    points.parent.mkdir()
    points.write_bytes((case / "constant/polyMesh/points.gz").read_bytes())
    with pytest.raises(InputError, match=r"accept \( unbalanced movingMesh \)"):
        prepare(case)
    (case / "constant/softCloudProperties").unlink()
    assert "// accept ( unbalanced movingMesh );" in write_template(case).read_text()


def test_a_dry_run_compiles_nothing(case, capsys, monkeypatch):
    monkeypatch.setattr(
        "foamprb.run.compilation.subprocess.Popen", lambda *_, **__: pytest.fail("it compiles")
    )
    monkeypatch.setattr("foamprb.run.compilation.available_threads", lambda: 2)
    monkeypatch.setattr(Tracker, "compiled", False)
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    assert "ompiling" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("rho", "nu", "expected"), [(1.208, 1.491e-5, "rosenbrock"), (1000.0, 1e-6, "stokes")]
)
@pytest.mark.parametrize("solid", ["Ca 0.5; referenceShearRate 923.8", "shearModulus 0.033"])
def test_choice_of_auto_is_estimated_before_the_flow_is_read(rho, nu, expected, solid, case):
    """In air and in water: else a process compiles a loop that nobody wants."""
    edit(case, r"shape\s+paper;", "shape auto;")
    edit(case, r"rhoInf\s+\S+;", f"rhoInf {rho};")
    edit(case, r"nu\s+.*;", f"nu [0 2 -1 0 0 0 0] {nu};", "constant/transportProperties")
    if solid.startswith("shear"):
        edit(case, r"solid \{ Ca \S+; \}", "")
        edit(case, r"Ca\s+0.5;.*\n\s+referenceShearRate\s+\S+;", f"{solid};")
    assert likely_integrator(read_settings(case)) == expected
    assert prepare(case).cloud.models.integrator == expected


@pytest.mark.parametrize(("rho", "nu", "expected"), [(1.2, 1.5e-5, "rosenbrock"), (1000.0, 1e-6, "stokes")])
def test_fast_settling_is_estimated_too(rho, nu, expected, case):
    """Balls of a third of a millimetre, hardly sheared: the way in which they stop is 5 m in air."""
    edit(case, r"shape\s+paper;", "shape auto;")
    edit(case, r"rhoInf\s+\S+;", f"rhoInf {rho};")
    edit(case, r"nu\s+.*;", f"nu {nu};", "constant/transportProperties")
    edit(case, r"referenceShearRate\s+\S+;", "referenceShearRate 1e-3;")
    edit(case, r"value\s+\S+;", "value 3e-4;")
    assert likely_integrator(read_settings(case)) == expected


def test_a_cloud_function_that_cannot_work_stops_a_dry_run(case, capsys):
    edit(
        case, r"cloudFunctions\s*\{\}", "cloudFunctions { hits { type patchPostProcessing; patches (wal); } }"
    )
    text = message(case, capsys, "-dry-run")
    assert (
        "softCloudProperties: cloudFunctions/hits: patch wal is not in the mesh. Did you mean 'wall'" in text
    )


def test_positions_that_are_left_out_are_counted(case, capsys):
    edit(case, r"^\(\s*$|^\(", "( (0 -0.0022 0) ", "constant/softCloudPositions")
    edit(case, r"type(\s+)manualInjection;", r"type\1manualInjection; ignoreOutOfBounds true;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    assert "1 of 2 positions lie outside the mesh and are left out" in capsys.readouterr().out


def test_models_that_do_not_go_together_name_the_file(case, capsys):
    edit(case, r"shape(\s+)paper;", r"shape\1stokes;")
    edit(case, r"tractionModel(\s+)roscoe;", r"tractionModel\1jeffery;")
    text = message(case, capsys)
    assert "softCloudProperties" in text
    assert "roscoe" in text


def test_debug_shows_where_an_error_arose(case):
    (case / "constant/softCloudProperties").unlink()
    with pytest.raises(Exception, match="softCloudProperties"):
        main(["run", "-case", str(case), "--debug"])


def test_doubtful_numbers_are_warned_of_with_their_size(case, capsys):
    edit(case, r"deltaT\s+\S+;", "deltaT 0.001;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert re.search(r"Warning : .*deltaT is 16\.\d times the shape's relaxation time", out)
    edit(case, r"value\s+5e-0?6;", "value 5e-4;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert "Warning" in out
    assert "particle Reynolds number is" in out


def test_releases_after_the_end_and_densities_in_grams_are_warned_of(case, capsys):
    """Half of the injection through the inlet, and all of a point, are due too late."""
    edit(case, r"endTime\s+1;", "endTime 0.05;")
    edit(case, r"SOI\s+0;\s+U0", "SOI 2; U0")
    edit(case, r"rho0\s+2560;", "rho0 2.56;")
    edit(case, r"rhoInf\s+1.208;", "rhoInf 0.998; nu 1e-6;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    for text in (
        "Ca1: none of 1 particles is released before endTime, 0.05 s: injection begins at 2 s.",
        "inlet: 150 of 300 particles are due at or after endTime, 0.05 s: injection begins at 0 s and lasts "
        "0.1 s.",
        "inlet: rho0 is 2.56 kg/m3, less than solids have. If 2.56 g/cm3 are meant: 2560 kg/m3.",
    ):
        assert f"Warning : injection model {text}\n" in out
    fluid = (
        "Warning : the density of the fluid is 0.998 kg/m3 and its viscosity 9.98e-07 Pa s, which no gas has."
    )
    assert f"{fluid} If 0.998 g/cm3 are meant: 998 kg/m3.\n" in out


def test_settings_that_cost_more_than_the_run_are_warned_of(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    assert "solution: " not in capsys.readouterr().out
    edit(case, r"shape\s+paper;", "shape stokes; tolerance 1e-7;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 2e-4; maxDeltaT 2e-5;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    # So fine a tolerance is not worth its steps on this mesh, unless it is wanted.
    out = capsys.readouterr().out
    assert "    roughness of grad U      0.085 %, about the error of strains by the mesh\n" in out
    assert "    tolerance 4.2e-05, by the roughness of grad U; roughnessShare 0 keeps 1e-07\n" in out
    assert "with the tolerance" not in out
    edit(case, r"tolerance 1e-7;", "tolerance 1e-7; roughnessShare 0;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert "Warning : solution: maxDeltaT is 1 deltaT" in out
    assert "with the tolerance 1e-07 steps are about 10 times as many" in out
    assert "results are written every 10 deltaT" in out
    edit(case, r"maxDeltaT 2e-5;", "")
    edit(case, r"deltaT\s+\S+;", "deltaT 1e-15;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    (steps, longest, least) = re.search(
        r"the run is (\S+) deltaT, and no step is longer than (\d+) deltaT: a particle takes (\S+) steps",
        capsys.readouterr().out,
    ).groups()
    assert float(least) == pytest.approx(float(steps) / float(longest), rel=0.05)


def test_first_example_of_the_python_page_runs():
    """The ten lines, as they stand."""
    text = (ROOT / "docs/python.md").read_text()
    lines = re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]
    names: dict[str, object] = {}
    exec(lines.replace('"cases/pipe"', f'"{PIPE}"').replace("20_000", "200"), names)
    assert names["particles"].x[0, 0] > 0.0


TABLE = """# from a microscope
x, y, z, d, rho, shearModulus, viscosity
0, -1e-3, 0, 2e-6, 1100, 5, 0.01
0, 5, 0, 3e-6, 1200, 6, 0.02   # outside
0, 1e-3, 0, 4e-6, 1300, 7, 0
"""


def test_a_table_gives_each_particle_its_own_properties(case, capsys):
    (case / "constant/table.csv").write_text(TABLE)
    edit(case, r"Ca025\s*\{[^{}]*\{[^{}]*\}\s*\}",
         'Ca025 { type manualInjection; positionsFile "table.csv"; ignoreOutOfBounds true; }')  # fmt: skip
    p = of(population(case), 1)
    np.testing.assert_array_equal(p.x[:, 1], [-1e-3, 1e-3])
    np.testing.assert_allclose(p.R, [1e-6, 2e-6], rtol=1e-15)
    np.testing.assert_array_equal(p.rho, [1100.0, 1300.0])
    np.testing.assert_array_equal(p.mu, [5.0, 7.0])
    np.testing.assert_array_equal(p.eta, [0.01, 0.0])
    np.testing.assert_allclose(p.lame, p.mu * 2.0 * 0.499 / (1.0 - 2.0 * 0.499), rtol=1e-12)
    np.testing.assert_allclose(p.Ca, 1.208 * 1.491e-5 * 923.8 / p.mu, rtol=1e-12)
    # Nothing of it has an effect on the other models.
    others = of(population(case), 0)
    np.testing.assert_allclose(others.R, D / 2, rtol=1e-15)


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        ("d", None),
        (
            "rho",
            "injection model Ca025: sizeDistribution is missing, and the file of positions has no column d.",
        ),
        ("shearModulus,Ca", "injection model Ca025: the file of positions gives shearModulus and Ca"),
        ("diameter", "sizeDistribution is missing, and the file of positions has no column d."),
    ],
)
def test_without_a_size_distribution_the_table_must_give_sizes(case, capsys, columns, expected):
    n = 1 + columns.count(",")
    (case / "constant/table.csv").write_text(f"x,y,z,{columns}\n0,0,0{',1e-6' * n}\n")
    edit(
        case, r"Ca025\s*\{[^{}]*\{[^{}]*\}\s*\}", 'Ca025 { type manualInjection; positionsFile "table.csv"; }'
    )
    if expected is None:
        assert of(population(case), 1).R[0] == 0.5e-6
    else:
        assert expected in message(case, capsys, "-dry-run")
