"""What foamprb init writes: a dictionary that a run accepts, with what the case says."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from foam_writer import header, put_linear, put_scalar, put_zones, write_case
from paths import PIPE

from foamprb.cli import main
from foamprb.dictionary.grammar import read_dictionary
from foamprb.errors import InputError
from foamprb.flow.base import Patch
from foamprb.flow.read.flows import read_flow
from foamprb.flow.read.fluid import apparent_viscosity
from foamprb.flow.read.source import Division, FlowSource
from foamprb.run.job import prepare
from foamprb.run.template import (
    FlowScales,
    _nice,
    _Paths,
    _shape_model,
    _stiffness,
    diameter,
    rates_on_paths,
    scales_of,
    times,
    write_template,
)
from foamprb.settings.patches import match_patches
from foamprb.settings.settings import read_settings


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """The pipe, without the settings of its particles."""
    shutil.copytree(PIPE, tmp_path / "pipe", ignore=shutil.ignore_patterns("postProcessing", "soft*"))
    return tmp_path / "pipe"


@pytest.fixture(autouse=True)
def _few_moves(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Follow the fluid of small boxes for two cells; its rates are the subject of tests with the pipe."""
    if "case" not in request.fixturenames:
        monkeypatch.setattr("foamprb.run.template._MOVES", 2)


@pytest.fixture
def box(tmp_path: Path) -> Path:
    """Eight cells, for which the settings are written at once; the fluid is the test's."""
    write_case(tmp_path / "box", perturbation=0.0, times=("1",))
    return tmp_path / "box"


def test_template_is_accepted_without_warnings(case, capsys):
    assert main(["init", "-case", str(case)]) == 0
    assert main(["run", "-dry-run", "-case", str(case)]) == 0
    said = capsys.readouterr().out
    assert "Warning" not in said
    assert "particles                1000" in said


def test_a_case_is_read_without_vtk(case):
    command = f"main(['init', '-case', {str(case)!r}])"
    code = f"import sys; from foamprb.cli import main; {command}; print('vtkmodules' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "False"


def write_box(folder):
    """A case with all that a run needs."""
    mesh = write_case(folder, perturbation=0.0)
    (folder / "constant/transportProperties").write_text("nu 1e-6; rho 1000;")
    return mesh


def test_settings_of_a_case_that_cannot_be_written(case, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = Path("mine/settings")
    with monkeypatch.context() as patch:
        patch.setattr(
            Path, "open", lambda *_, **__: (_ for _ in ()).throw(OSError(30, "Read-only file system"))
        )
        patch.setattr("foamprb.run.template.template", lambda *_: "")
        patch.setattr("foamprb.run.template.read_flow", lambda *_: None)
        with pytest.raises(InputError, match=r"Read-only file system\. The option -output FILE writes"):
            write_template(case)
    assert main(["init", "-case", str(case), "-output", str(file)]) == 0
    assert f"foamprb run -case {case} -dict {tmp_path / file} -dry-run" in capsys.readouterr().out
    assert not (case / "constant/softCloudProperties").exists()
    assert main(["run", "-dry-run", "-case", str(case), "-dict", str(file)]) == 0


def test_template_quotes_the_case(case):
    text = write_template(case).read_text()
    assert re.search(r"^ +patch +inlet; +// largest inflow$", text, re.MULTILINE)
    assert re.search(r"^ +wall +\{ type stick; \} // wall", text, re.MULTILINE)
    assert re.search(r"^ +outlet +\{ type escape; \}$", text, re.MULTILINE)
    assert "constant/g: (0 -9.81 0) m/s2" in text
    assert re.search(r"// nu +\S+: from constant/transportProperties", text)
    assert len(text.splitlines()) < 110
    assert max(map(len, text.splitlines())) <= 110


def test_first_guesses_suit_the_flow(case):
    """The pipe's mean speed and length, its cells and its shear rate."""
    write_template(case)
    settings = read_settings(case)
    job = prepare(case)
    flow, solution = job.cloud.flow, settings.solution
    length = (flow.bounds[1] - flow.bounds[0]).max()
    speed = max(abs(flow.arrays().nodes[:, 4:7]).ravel())
    assert 1.0 < solution.endTime * speed / length < 20.0
    assert solution.deltaT * speed < length / 50
    assert solution.writeInterval * 50 == pytest.approx(solution.endTime)
    job.cloud.advance(round(solution.endTime / solution.deltaT))
    left = job.cloud.particles.status > 1
    assert left.mean() > 0.5


def test_nothing_is_ever_overwritten(case, capsys):
    file = case / "constant/softCloudProperties"
    file.write_text("mine")
    assert main(["init", "-case", str(case)]) == 1
    assert "exists and is not changed" in capsys.readouterr().err
    assert file.read_text() == "mine"


def test_hints_name_the_region(tmp_path, capsys):
    write_case(tmp_path)
    for folder in (tmp_path / "constant", tmp_path / "1e1"):
        parts = list(folder.iterdir())
        (folder / "air").mkdir()
        for part in parts:
            part.rename(folder / "air" / part.name)
    assert main(["init", "-case", str(tmp_path), "-region", "air"]) == 0
    options = f"-case {tmp_path} -region air"
    hint = f"then: foamprb run {options} -dry-run, foamprb run {options}, foamprb view {options}."
    assert hint in capsys.readouterr().out
    assert "foamprb run -dry-run -region air" in (tmp_path / "constant/air/softCloudProperties").read_text()
    assert main(["init", "-case", str(tmp_path), "-region", "air"]) == 1
    assert "foamprb run -dry-run -region air, or rename it" in capsys.readouterr().err


def test_hints_repeat_the_options_of_the_flow():
    source = FlowSource(Path("a b.vtu"), "air", "Urel", Division(feature_angle=40.0), True, scale=1e-6)
    assert source.options == (
        " -flow 'a b.vtu' -region air -velocity Urel -featureAngle 40.0 -scale 1e-06 -decomposed"
    )
    assert FlowSource().options == ""


def test_without_a_case_or_a_flow(tmp_path, case):
    with pytest.raises(InputError, match="no such folder"):
        write_template(tmp_path / "none")
    for time in [path for path in case.iterdir() if path.name[0].isdigit()]:
        shutil.rmtree(time)
    with pytest.raises(InputError, match="has the solver been run"):
        write_template(case)
    assert not (case / "constant/softCloudProperties").exists()


def test_the_viscosity_of_another_model_is_local(box):
    """By the model that is selected, not by the one beside it; its value is that at the mean shear rate."""
    (box / "constant/transportProperties").write_text(
        "transportModel CrossPowerLaw; CrossPowerLawCoeffs { nu0 nu0 [0 2 -1 0 0 0 0] 0.01; nuInf 10; m 0.4; "
        "n 3; } BirdCarreauCoeffs { nu0 1e-06; nuInf 1e-06; k 0; n 1; }"
    )
    rate = scales_of(read_flow(box)).shear
    text = write_template(box).read_text()
    nu = 10.0 - 9.99 / (1.0 + (0.4 * rate) ** 3)
    comment = f"local, by CrossPowerLaw of constant/transportProperties; {nu:.4g} m2/s at {rate:.3g} 1/s"
    assert f"// nu          {comment}" in text
    fluid = read_settings(box).fluid
    assert fluid.mu.at_rate(rate) == pytest.approx(fluid.rho * nu)


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("BirdCarreau; nu0 1.6e-5; nuInf 1e-6; k 1; n 0", 1e-6 + 1.5e-5 / np.sqrt(17.0)),
        ("powerLaw; k 1e-5; n 0.5; nuMin 1e-6; nuMax 1e-3", 5e-6),
        ("HerschelBulkley; nu0 1; tau0 1e-5; k 1e-5; n 1", 1.25e-5),
        ("Casson; m 1e-6; tau0 4e-6; nuMin 1e-7; nuMax 1", 4e-6),
        ("Newtonian; nu 2e-6", 2e-6),
        ("ArrheniusCasson; m 1e-6; tau0 4e-6; nuMin 0; nuMax 1; alpha 0.1; Talpha 300", 4e-6 / np.e),
    ],
)
def test_viscosities_at_four_per_second(tmp_path, model, expected):
    file = tmp_path / "transportProperties"
    file.write_text(f"transportModel {model};")
    name, nu = apparent_viscosity(read_dictionary(file, tmp_path), 4.0, 310.0)
    assert model.startswith(name)
    assert nu == pytest.approx(expected)


TWO = (
    "phases (air water); water { transportModel Newtonian; nu 1e-06; rho 1000; } "
    "air { transportModel Newtonian; nu 1.48e-05; rho 1; } sigma 0.07;"
)


def latest(case):
    return max((each for each in case.iterdir() if each.name.isdigit()), key=lambda each: float(each.name))


@pytest.mark.parametrize(
    ("alpha", "main", "nu", "rho", "share"),
    [(0.9, "water", 1e-6, 1000.0, "90 %"), (0.2, "air", 1.48e-5, 1.0, "80 %")],
)
def test_the_phase_with_most_volume_at_the_release_counts(
    box, alpha, main, nu, rho, share, caplog, monkeypatch
):
    """Not that which the file names first; of one field of two."""
    monkeypatch.setattr("foamprb.run.template.log.propagate", True)
    caplog.set_level("INFO")
    (box / "constant/transportProperties").write_text(TWO)
    put_scalar(latest(box), "alpha.water", "0 0 0", alpha)
    text = write_template(box).read_text()
    said = f"of {main}, {share} of the inflow at time {latest(box).name}"
    assert re.search(rf"^ +nu +{nu:g}; +// m2/s, {said}$", text, re.MULTILINE)
    assert f"Particles move in {said.removeprefix('of ')}." in caplog.text
    assert text.count("\n    // nu ") == 1
    fluid = read_settings(box).fluid
    assert (fluid.nu, fluid.rho) == (nu, rho)
    assert "// mixture true; // local nu and rho of air and water" in text


def test_the_phase_at_the_inlet_counts_not_the_mean(tmp_path):
    """Below half the height there is oil; the fluid enters through the lid."""
    mesh = write_case(tmp_path, perturbation=0.0, times=("1",))
    (tmp_path / "constant/transportProperties").write_text(
        "phases ( oil { transportModel Newtonian; nu 2e-06; rho 900; } "
        "sludge { transportModel BinghamPlastic; rho 1996; } );"
    )
    put_linear(tmp_path / "1", mesh, "alpha.oil", (0.0, 0.0, 2.0), -0.9, "[0 0 0 0 0 0 0]")
    text = write_template(tmp_path).read_text()
    assert re.search(r"^ +patch +lid;", text, re.MULTILINE)
    assert re.search(r"^ +nu +2e-06; +// m2/s, of oil, \S+ % of the inflow", text, re.MULTILINE)
    assert "// rhoInf 1996; // kg/m3, of sludge" in text
    assert "// nu          unknown: sludge has none that is read" in text
    assert "mixture" not in text


@pytest.mark.parametrize("transient", ["yes", "no"])
def test_the_mixture_that_is_offered_runs(tmp_path, transient, capsys):
    mesh = write_case(tmp_path, perturbation=0.0, times=("1", "9"))
    (tmp_path / "constant/transportProperties").write_text(TWO)
    for time in ("1", "9"):
        put_linear(tmp_path / time, mesh, "alpha.water", (0.0, 0.0, 0.5), -1e-9, "[0 0 0 0 0 0 0]")
    file = write_template(tmp_path)
    text = re.sub(r"// (mixture true;)", rf"\1 transient {transient};", file.read_text())
    file.write_text(re.sub(r"\n +(nu|rhoInf) .*", "", text))
    assert main(["run", "-dry-run", "-case", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "mixture of water and air, rho 1000 and 1 kg/m3, by alpha.water" in said
    assert ", by alpha.water, 1.48e-05 to 0.000452 Pa s over the nodes" in said
    assert "phases" not in said


def test_without_fractions_no_phase_is_chosen(box):
    (box / "constant/transportProperties").write_text(TWO)
    text = write_template(box).read_text()
    assert "// unknown: the phase of the particles; no field alpha.air" in text
    with pytest.raises(InputError, match=r"nu is missing.*or solution \{ mixture true; \}"):
        read_settings(box)


MIXTURE = (
    "thermoType {{ mixture pureMixture; transport const; equationOfState {kind}; }} "
    "mixture {{ specie {{ molWeight 28.96; }} equationOfState {{ R 3000; rho0 1027; pRef 2e5; rho 870; }} "
    "transport {{ mu 1e-3; }} }}"
)


def put_state(case):
    rest = 'boundaryField { ".*" { type zeroGradient; } }'
    for name, dimensions, value in (
        ("T", "0 0 0 1 0 0 0", 300),
        ("T.air", "0 0 0 1 0 0 0", 600),
        ("p", "1 -1 -2 0 0 0 0", 3e5),
    ):
        field = f"dimensions [{dimensions}]; internalField uniform {value}; {rest}"
        (latest(case) / f"{name}.gz").unlink(missing_ok=True)
        (latest(case) / name).write_text(header("volScalarField", name) + field)


def test_the_phase_of_the_velocity_goes_first(case):
    """Each phase has its own file, density by its equation of state, and temperature."""
    (case / "constant/transportProperties").unlink()
    for name, kind in (("air", "perfectGas"), ("water", "perfectFluid")):
        (case / f"constant/thermophysicalProperties.{name}").write_text(MIXTURE.format(kind=kind))
    shutil.copy(latest(case) / "U.gz", latest(case) / "U.water.gz")
    put_state(case)
    text = write_template(case, FlowSource(velocity="U.water")).read_text()
    rho = 1027.0 + 3e5 / (3000.0 * 300.0)
    assert re.search(r"rhoInf +1027.33; +// kg/m3, of water", text)
    assert f"// rhoInf {3e5 * 28.96 / (8314.46 * 600.0):.6g}; // kg/m3, of air" in text
    assert read_settings(case).fluid.nu == pytest.approx(1e-3 / rho, rel=1e-3)


@pytest.mark.parametrize(
    ("kind", "rho"), [("perfectGas", 3.483), ("incompressiblePerfectGas", 2.322), ("Boussinesq", 1027.0)]
)
def test_the_density_is_that_of_the_equation_of_state(box, kind, rho):
    """At the means of p and T, in the settings and in a run."""
    state = MIXTURE.format(kind=kind).replace("rho 870;", "")
    (box / "constant/thermophysicalProperties").write_text(state)
    put_state(box)
    assert f"// rhoInf      {rho:.4g}: from " in write_template(box).read_text()
    assert read_settings(box).fluid.rho == pytest.approx(rho, rel=1e-3)


@pytest.mark.parametrize(
    ("dictionary", "missing"),
    [
        ("DT 0.01;", ["nu", "rhoInf"]),
        ("mu 1e-3;", ["rhoInf"]),
        ("thermoType { transport const; } mixture { transport { mu 1e-3; } }", ["rhoInf"]),
        ("thermoType { mixture reactingMixture; transport sutherland; equationOfState perfectGas; }",
         ["nu", "rhoInf"]),
        ("thermoType { transport sutherland; } mixture { transport { As 1.458e-06; Ts 110.4; } }",
         ["nu", "rhoInf"]),
        ("thermoType { properties liquid; } mixture { H2O; }", ["nu", "rhoInf"]),
        ("transportModel strainRateFunction; rho 1000;", ["nu"]),
    ],
)  # fmt: skip
def test_what_the_case_lacks_is_not_invented(box, dictionary, missing):
    """It is in a comment, and an error of a run that names the entry."""
    (box / "constant/transportProperties").write_text(dictionary)
    text = write_template(box).read_text()
    unknown = re.findall(r"// (\w+) +unknown: .*", text)
    assert unknown == missing
    with pytest.raises(InputError) as caught:
        read_settings(box)
    for name in missing:
        assert ("rhoInf is missing" if name == "rhoInf" else "nu") in str(caught.value)
    assert ("shearModulus" in text) == ("mu 1e-3" in dictionary)
    for name, value in (("nu", 1e-6), ("rhoInf", 1000.0)):
        if name in missing:
            text = re.sub(rf"// {name} +unknown: .*", f"{name} {value};", text)
            assert f"set {name}, " in text
    (box / "constant/softCloudProperties").write_text(text)
    assert main(["run", "-dry-run", "-case", str(box)]) == 0


def test_the_density_of_an_incompressible_solver_is_assumed_and_said(box, caplog, monkeypatch):
    monkeypatch.setattr("foamprb.run.template.log.propagate", True)
    caplog.set_level("INFO")
    for nu, rho, like in ((1e-6, 1000, "water"), (1.5e-5, 1.2, "air")):
        (box / "constant/transportProperties").write_text(f"transportModel Newtonian; nu {nu};")
        text = write_template(box).read_text()
        said = f"kg/m3, assumed: the case has no density; like {like}"
        assert re.search(rf"rhoInf +{rho}; +// {said}", text)
        assert f"rhoInf {rho}; // {said}" in caplog.text
        (box / "constant/softCloudProperties").unlink()


def test_the_viscosity_is_that_of_the_local_temperature(box):
    (box / "constant/thermophysicalProperties").write_text(
        "rho 1.2; thermoType { transport sutherland; } mixture { transport { As 1.458e-06; Ts 110.4; } }"
    )
    (latest(box) / "T").write_text(
        header("volScalarField", "T") + "dimensions [0 0 0 1 0 0 0]; internalField uniform 977; "
        'boundaryField { ".*" { type zeroGradient; } }'
    )
    mu = 1.458e-6 * np.sqrt(977.0) / (1.0 + 110.4 / 977.0)
    comment = f"// mu          local, by sutherland at the local T; {mu:.4g} Pa s on average"
    assert comment in write_template(box).read_text()
    fluid = read_settings(box).fluid
    assert (fluid.field.name, fluid.mu.mean) == ("T", pytest.approx(mu))


def scales(**changed):
    values = {"speed": 1.0, "step": 1e-3, "duration": 2.0, "shear": 10.0, "most_shear": 100.0, "cell": 1e-3,
              "volume": 1e-3, "inlet": ""}  # fmt: skip
    return FlowScales(**(values | changed))


def test_stiffness_is_that_for_the_rates_where_the_fluid_goes(case):
    """In a pipe of wall rate γ̇_w half of the fluid passes where the rate is below γ̇_w √(1 − 1/√2)."""
    flow = read_flow(case)
    paths = rates_on_paths(flow, scales_of(flow), 1e-4)
    found, wall = paths.shear, scales_of(flow).most_shear
    assert np.median(found) == pytest.approx(wall * np.sqrt(1.0 - np.sqrt(0.5)), rel=0.25)
    assert found.max() < 1.1 * wall
    # κ = √0.8 a/r, and half of the fluid passes within r = R √(1 − √½).
    assert np.median(paths.curvature) == pytest.approx(0.894e-4 / (2.1e-3 * 0.541), rel=0.2)


def test_the_quadratic_mode_is_proposed_for_bodies_that_are_large_in_the_curved_flow(case):
    """A body of 0.1 R has κ > 0.1 within 0.9 R of the axis of a pipe; one of 0.001 R, within 0.009 R."""
    flow = read_flow(case)
    large, small = (_shape_model(rates_on_paths(flow, scales_of(flow), a)) for a in (2.1e-4, 2.1e-6))
    assert large[0].startswith("shapeModel quadratic; // curvature number over 0.1 on ")
    assert small == _shape_model(None) == []


def stiffness(shear, extension, duration):
    """The modulus over the viscosity by given rates on paths."""
    paths = _Paths(*map(np.asarray, (shear, 0.0 * shear, extension, duration)))
    flow = SimpleNamespace(bounds=np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]))
    (line,) = (line for line in _stiffness(flow, scales(), 1.0, paths) if "shearModulus" in line)
    return float(line.split()[1].rstrip(";")), line


def test_stiffness_is_that_for_the_worst_path():
    """Ca is at most 2 in shear; extension above Ca 0.3 may strain a body by 1 on its way."""
    still = np.zeros((1, 100)), np.zeros((1, 100))
    shear = np.full(100, 10.0)
    assert stiffness(shear, *still)[0] == 100.0
    shear[7] = 1000.0
    assert stiffness(shear, *still)[0] == 500.0
    extension, duration = still
    extension[0, 7], duration[0, 7] = 900.0, 0.01
    # (900 − 0.3 G) 0.01 = 1 for G = 2667, on a scale of steps of 10 %.
    G, line = stiffness(shear, extension, duration)
    assert 2667.0 <= G <= 2667.0 * 1.15
    assert "at 10 1/s, the largest on half of the paths" in line
    assert "as the flow is uniform" in stiffness(np.full(100, 1e-9), *still)[1]


def put_uniform(case, u):
    for file in case.glob("[0-9]*/U"):
        file.write_text(
            header("volVectorField", "U") + f"dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 {-u}); "
            f'boundaryField {{ ".*" {{ type fixedValue; value uniform (0 0 {-u}); }} }}'
        )


@pytest.mark.parametrize(
    ("u", "time", "g", "rests"),
    [(1e-7, "10", 9.81, True), (1e-7, "10", 0.0, True), (1e-4, "10", 9.81, False), (1e-4, "0.1", 0.0, True)],
)
def test_a_fluid_at_rest_is_told_by_scale(tmp_path, u, time, g, rests):
    """Against √(g L) of waves, and by its way in the solver's time; here L is 1.7 m and a cell 0.5 m."""
    write_case(tmp_path, perturbation=0.0, times=(time,))
    put_uniform(tmp_path, u)
    (tmp_path / "constant/g").write_text(
        header("uniformDimensionedVectorField", "g") + f"dimensions [0 1 -2 0 0 0 0]; value (0 0 {-g});"
    )
    text = write_template(tmp_path).read_text()
    assert (re.search(r"endTime +1;", text) is not None) == rests
    assert ("as the fluid is at rest" if rests else "as the flow is uniform") in text
    assert ("cellZoneInjection" if rests else "patchInjection") in text


def test_a_run_is_not_much_longer_than_the_solvers(tmp_path):
    """A unit cube is replaced in 500 s; 2 s of the solver allow 200 s, rounded up."""
    write_case(tmp_path, perturbation=0.0, times=("2",))
    put_uniform(tmp_path, 4e-3)
    ends = []
    for scheme in ("steadyState", "Euler"):
        (tmp_path / "system").mkdir(exist_ok=True)
        (tmp_path / "system/fvSchemes").write_text(f"ddtSchemes {{ default {scheme}; }}")
        text = write_template(tmp_path, output=tmp_path / scheme).read_text()
        ends.append(float(re.search(r"endTime +(.*?);", text)[1]))
    assert ends == [500.0, 250.0]


def test_the_regions_beside_the_mesh_are_named(tmp_path, capsys):
    """As splitMeshRegions leaves them without -overwrite."""
    write_box(tmp_path)
    for name in ("air", "heater"):
        shutil.copytree(tmp_path / "constant/polyMesh", tmp_path / "constant" / name / "polyMesh")
    assert main(["init", "-case", str(tmp_path)]) == 0
    assert "The case has the regions air, heater: -region NAME." in capsys.readouterr().out
    (tmp_path / "constant/softCloudProperties").unlink()
    (tmp_path / "1e1/air").mkdir()
    (tmp_path / "1e1/U").rename(tmp_path / "1e1/air/U")
    assert main(["init", "-case", str(tmp_path)]) == 1
    assert "no field U; the fields are p. These regions have it: air; choose" in capsys.readouterr().err


def test_times_are_multiples_of_each_other():
    for step, duration in product([1e-9, 3e-4, 7.7e-3, 1.0], [1e-6, 0.37, 5e3]):
        dt, interval, end = times(scales(step=step, duration=duration))
        assert interval / dt == pytest.approx(round(interval / dt))
        assert end / interval == pytest.approx(50)
        assert duration <= end * (1 + 1e-9)
        assert end / dt <= 5000 * 2.51


def test_times_of_a_fluid_at_rest():
    assert times(scales(speed=0.0)) == (0.01, 0.02, 1.0)


def test_the_diameter_keeps_the_reynolds_number_small():
    for most in (1.0, 1e4, 1e7):
        d = diameter(scales(most_shear=most), 1e-6)
        assert most * d * d / 1e-6 <= 0.05 * (1 + 1e-9)
        assert d <= 1e-5
        # The shape Stokes number of a solid a thousand times denser, too, where its inertia is left out.
        d = diameter(scales(most_shear=most), 1e-6, 1000.0)
        assert 1000.0 * most * d * d / (60.0 * 1e-6) <= 0.01 * (1 + 1e-9)
    assert diameter(scales(most_shear=0.0, cell=1e-6), 1e-6) == 2e-7


def test_round_numbers():
    assert [_nice(x, up=True) for x in (1.0, 1.1, 2.5, 6e-7)] == [1.0, 2.0, 5.0, 1e-6]
    assert [_nice(x, up=False) for x in (1.0, 1.9, 9.9, 6e-7)] == [1.0, 1.0, 5.0, 5e-7]


def test_a_coupled_patch_that_particles_cannot_pass_is_left_to_the_user(tmp_path, capsys):
    """OpenFOAM writes cyclicAMI for the field on a cyclicPeriodicAMI patch."""
    write_box(tmp_path)
    file = tmp_path / "constant/polyMesh/boundary"
    file.write_text(re.sub(r"(lid // a patch\s*\{ type )\w+", r"\1cyclicPeriodicAMI", file.read_text()))
    file = tmp_path / "1e1/U"
    file.write_text(file.read_text().replace("lid { type fixedValue;", "lid { type cyclicAMI;"))
    assert main(["init", "-case", str(tmp_path)]) == 0
    text = (tmp_path / "constant/softCloudProperties").read_text()
    assert re.search(r"// lid +\{ type rebound; \} // particles cannot pass a cyclicPeriodicAMI", text)
    assert main(["run", "-dry-run", "-case", str(tmp_path)]) == 1
    assert "cannot pass through 'lid', a patch of type cyclicPeriodicAMI" in capsys.readouterr().err


def test_patches_with_odd_names_and_many_walls_are_matched(case):
    from foamprb.run.template import _patches

    patches = [Patch("in(let)", "patch"), Patch("a", "cyclicAMI", "b"), Patch("front", "empty")]
    patches += [Patch(f"wall{i}", "wall") for i in range(9)]
    text = write_template(case).read_text()
    inner = "\n".join(_patches(patches))
    assert "wall                { type stick; } // all 9 walls" in inner
    start, end = text.index("patches\n"), text.index(");", text.index("patches\n"))
    changed = f"{text[:start]}patches\n(\n{inner}\n{text[end:]}"
    (case / "constant/softCloudProperties").write_text(changed)
    names = [type(i).__name__ for i in match_patches(read_settings(case).patches, patches, "file")]
    assert names == ["Escape", "Cyclic", "Mirror", *["Stick"] * 9]


@pytest.mark.parametrize(("second", "unit"), [("epsilon", "0 2 -3"), ("omega", "0 0 -1")])
def test_a_mean_flow_is_offered_the_dispersion_by_its_eddies(tmp_path, second, unit):
    write_box(tmp_path)
    put_scalar(tmp_path / "1e1", "k", "0 2 -2", 0.01)
    put_scalar(tmp_path / "1e1", second, unit, 3)
    file = write_template(tmp_path)
    text = file.read_text()
    assert re.search(rf"dispersionModel +none; +// or stochasticDispersionRAS: k and {second} are", text)
    assert main(["run", "-dry-run", "-case", str(tmp_path)]) == 0
    file.write_text(re.sub(r"(dispersionModel +)none", r"\1stochasticDispersionRAS", text))
    assert main(["run", "-dry-run", "-case", str(tmp_path)]) == 0


def test_a_laminar_flow_is_offered_no_eddies(tmp_path):
    write_box(tmp_path)
    put_scalar(tmp_path / "1e1", "k", "0 2 -2", 0)
    put_scalar(tmp_path / "1e1", "epsilon", "0 2 -3", 0)
    assert "dispersion" not in write_template(tmp_path).read_text()


@pytest.mark.parametrize(
    ("omega", "zone", "expected"),
    [("3", "upper", "relative"), ("table ((0 1) (1 3))", "upper", "absolute"), ("3", "lower", "absolute")],
)
def test_rotating_zones_are_named(tmp_path, omega, zone, expected, capsys):
    mesh = write_box(tmp_path)
    cells = np.flatnonzero(mesh.centres[:, 2] > 0.5)
    put_zones(tmp_path, upper=cells)
    (tmp_path / "constant/MRFProperties").write_text(
        header("dictionary", "MRFProperties")
        + f"rotor {{ cellZone {zone}; origin (0.5 0.5 0); axis (0 0 1); omega {omega}; }}"
    )
    assert re.search(rf"rotatingZones +{expected};", write_template(tmp_path).read_text())
    assert main(["run", "-dry-run", "-case", str(tmp_path)]) == 0
    assert ("zone rotor of" in capsys.readouterr().out) == (expected == "relative")


def test_iterations_of_a_steady_solver_are_no_times(tmp_path):
    write_box(tmp_path)
    assert "// transient" in write_template(tmp_path).read_text()
    (tmp_path / "constant/softCloudProperties").unlink()
    (tmp_path / "system").mkdir(exist_ok=True)
    for entry, scheme in (("steadyState", "steadyState"), ("bounded localEuler rDeltaT", "localEuler")):
        (tmp_path / "system/fvSchemes").write_text(f"ddtSchemes {{ default {entry}; }}")
        file = write_template(tmp_path)
        hint = f"// no transient flow: the times of the flow are iterations (ddtSchemes {scheme})\n"
        assert hint in file.read_text()
        file.unlink()


@pytest.mark.parametrize("zones", [False, True])
def test_a_mesh_that_moves_is_followed(tmp_path, zones):
    """Also beside a rotating zone, whose entries alone would leave a run at one time, which is refused."""
    mesh = write_box(tmp_path)
    if zones:
        put_zones(tmp_path, upper=np.flatnonzero(mesh.centres[:, 2] > 0.5))
        entry = "rotor { cellZone upper; origin (0.5 0.5 0); axis (0 0 1); omega 3; }"
        text = header("dictionary", "MRFProperties") + entry
        (tmp_path / "constant/MRFProperties").write_text(text)
    (tmp_path / "constant/dynamicMeshDict").write_text("dynamicFvMesh dynamicMotionSolverFvMesh;")
    for time in ("0.5", "1e1"):
        (tmp_path / time / "polyMesh").mkdir()
        shutil.copy(tmp_path / "constant/polyMesh/points", tmp_path / time / "polyMesh")
    text = " ".join(write_template(tmp_path).read_text().split())
    assert "endTime 10; " in text
    assert "transient true; // the mesh moves, times 0.5 to 1e1" in text
    assert "movingMesh" not in text
    assert ("rotatingZones" in text) == zones
    assert "type patchInjection;" in text
    # At SOI, the first time, no fluid enters.
    put_linear(tmp_path / "0", mesh, "U", np.zeros((3, 3)), 0.0, "[0 1 -1 0 0 0 0]")
    (tmp_path / "constant/softCloudProperties").unlink()
    text = write_template(tmp_path).read_text()
    assert "cellZoneInjection; // no patch has inflow at the start" in " ".join(text.split())
