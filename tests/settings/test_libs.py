"""Solids, forces and surroundings that users bring, from Python and by a file that the settings name."""

from __future__ import annotations

import csv
import hashlib
import json
import os
import pickle
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
import pyvista
from foam_writer import put_linear
from hypothesis import given
from hypothesis import strategies as st
from paths import ROOT
from pipe_case import END, copy_of_pipe, edit, fates, message, results, short_case, stop_after

import foamprb
from foamprb import Cloud, InputError, Medium, Models, analytic, spheres
from foamprb.body import material
from foamprb.body.drag import DRAGS, add_drag
from foamprb.body.material import MATERIALS, Parameter, add_material
from foamprb.body.tensor import log_ratio
from foamprb.cli import main
from foamprb.cloud.forces import FORCES, add_force
from foamprb.cloud.surroundings.registry import SURROUNDINGS, add_surrounding
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.flow.read.openfoam import Case
from foamprb.settings.libs import load_libs, loaded_libs

FUNG = """
import numpy as np

import foamprb
from foamprb.body.tensor import log_ratio


def energy(I1, I2, J, mu, lame, k):
    log_J = log_ratio(J)
    return 0.5 * mu / k * (np.exp(k * (I1 - 3.0 - 2.0 * log_J)) - 1.0) + 0.5 * lame * log_J * log_J


foamprb.add_material("fung", energy, parameter=foamprb.Parameter("stiffening", 0.0, 10.0))
"""

FORCE = "import foamprb\ndef push(inputs, a):\n"
ADD = "foamprb.add_force('push', push)\n"


@pytest.fixture(autouse=True)
def registry(monkeypatch, solids):
    """No file has been loaded, and none is afterwards."""
    monkeypatch.setattr("foamprb.settings.libs._loaded", {})
    before = [(registry, dict(registry)) for registry in (DRAGS, FORCES, SURROUNDINGS, FUNCTIONS)]
    yield
    for registry, names in before:
        registry.clear()
        registry.update(names)


def own_energy(I1, I2, J, mu, lame, k):
    """Mooney–Rivlin, written anew."""
    log_J = log_ratio(J)
    c1, c2 = 0.5 * mu * (1.0 - k), 0.5 * mu * k
    bulk = 0.5 * (lame - 4.0 * c2) * log_J * log_J
    return c1 * (I1 - 3.0) + c2 * (I2 - 3.0) - (2.0 * c1 + 4.0 * c2) * log_J + bulk


@given(st.floats(2.9, 8.0), st.floats(2.9, 8.0), st.floats(0.5, 2.0), st.floats(0.1, 1.0))
def test_derivatives_by_complex_steps_are_exact(I1, I2, J, k):
    own = material.FunctionType(
        material._complex_step.__code__, {**vars(material), "energy": own_energy}, "own"
    )
    expected = MATERIALS["mooneyRivlin"].derivatives(I1, I2, J, 2.0, 30.0, k)
    np.testing.assert_allclose(own(I1, I2, J, 2.0, 30.0, k), expected, rtol=1e-12, atol=1e-12)


def test_solid_given_by_its_energy_alone_moves_as_the_one_with_derivatives():
    """With rosenbrock, which needs second derivatives too."""
    add_material("own", own_energy, parameter=Parameter("share", 0.0, 1.0))
    found = []
    for name in ("own", "mooneyRivlin"):
        p = spheres(np.zeros((1, 3)), d=2.0, rho=1e-3, mu=5.0, k=0.4)
        models = Models(integrator="rosenbrock", material=name)
        cloud = Cloud(p, analytic.shear(1.0), Medium(1.0, 1.0, (0.0, 0.0, 0.0)), (), 0.1, models, threads=1)
        cloud.advance(20)
        found.append(p.F[0])
    assert abs(found[0] - np.eye(3).ravel()).max() > 0.1
    np.testing.assert_allclose(found[0], found[1], atol=1e-10)


def neo_hooke_stress(b, J, mu, lame, _k):
    p = lame * log_ratio(J) - mu
    return (
        mu * b[0] + p, mu * b[1], mu * b[2],
        mu * b[3], mu * b[4] + p, mu * b[5],
        mu * b[6], mu * b[7], mu * b[8] + p,
    )  # fmt: skip


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_solid_given_by_its_stress_moves_as_the_one_with_an_energy(integrator):
    """Of an ellipsoid at rest, with stokes and without resistance to dilation."""
    add_material("own", stress=neo_hooke_stress)
    found = []
    for name in ("own", "neoHooke"):
        p = spheres(np.zeros((1, 3)), d=2.0, rho=1e-3, mu=5.0, poissons_ratio=0.4)
        if integrator == "stokes":
            p.F[:] = p.F0[:] = (1.25, 0.0, 0.0, 0.0, 0.8, 0.0, 0.0, 0.0, 1.0)
        models = Models(integrator=integrator, material=name)
        cloud = Cloud(p, analytic.shear(1.0), Medium(1.0, 1.0, (0.0, 0.0, 0.0)), (), 0.1, models, threads=1)
        cloud.advance(20)
        found.append(p.F[0])
    assert abs(found[0] - np.eye(3).ravel()).max() > 0.1
    np.testing.assert_allclose(found[0], found[1], atol=1e-8)


def skew_stress(b, J, mu, lame, k):
    return *neo_hooke_stress(b, J, mu, lame, k)[:8], mu * (b[8] - 1.0) + 0.1 * mu * (b[8] - 1.0) * b[2]


@pytest.mark.parametrize(
    ("functions", "message"),
    [
        ({}, "it needs an energy or a stress"),
        ({"stress": neo_hooke_stress, "energy": own_energy}, "it needs an energy or a stress"),
        ({"stress": lambda b, *_: b}, "at rest its stress is"),
        ({"stress": lambda b, J, mu, lame, k: neo_hooke_stress(b, J, 2.0 * mu, lame, k)}, "is 2 mu, not mu"),
        ({"stress": skew_stress}, "does not turn with b"),
    ],
)
def test_unsound_stress_is_refused(functions, message):
    with pytest.raises(ValueError, match=message):
        add_material("x", **functions)


def stressed(I1, I2, J, mu, lame, k):
    return 0.5 * mu * (I1 - 3.0)


def too_soft(I1, I2, J, mu, lame, k):
    return 0.25 * mu * (I1 - 3.0 - 2.0 * np.log(J))


def not_analytic(I1, I2, J, mu, lame, k):
    return 0.5 * mu * (I1 - 3.0 - 2.0 * np.log(J)) + 0.1 * mu * abs(I2 - 3.0) * (I2 - 3.0)


def wrong_derivatives(I1, I2, J, mu, lame, k):
    return 0.5 * mu + mu * (I1 - 3.0), 0.0, -mu / J


@pytest.mark.parametrize(
    ("energy", "derivatives", "message"),
    [
        (stressed, None, "at rest its stress is 1 mu"),
        (too_soft, None, "shear modulus at rest is 0.5 mu"),
        (not_analytic, None, "derivative 2 of its energy"),
        (material.neo_hooke_energy, wrong_derivatives, "derivative 1 of its energy"),
        (lambda *_: 0.0, None, "at rest|shear modulus"),
        (len, None, "plain function"),
    ],
)
def test_unsound_solid_is_refused(energy, derivatives, message):
    with pytest.raises(ValueError, match=message):
        add_material("x", energy, derivatives)
    assert "x" not in MATERIALS


def test_name_of_a_solid_is_taken_once():
    with pytest.raises(ValueError, match="exists already"):
        add_material("neoHooke", own_energy)


def test_file_is_run_again_only_when_it_has_changed(tmp_path):
    file = tmp_path / "rubber.py"
    file.write_text(FUNG)
    load_libs([file])
    first = MATERIALS["fung"]
    load_libs([file])
    assert MATERIALS["fung"] is first
    file.write_text(FUNG.replace('"stiffening", 0.0, 10.0', '"stiffening", 0.0, 5.0'))
    load_libs([file])
    assert MATERIALS["fung"].parameter == Parameter("stiffening", 0.0, 5.0)


def test_files_of_two_cases_may_add_the_same_name(tmp_path):
    files = [tmp_path / "one.py", tmp_path / "two.py"]
    for file, value in zip(files, "ab", strict=True):
        file.write_text(FORCE.replace("a)", f"{value})") + f"    return ({value}, 0.0, 0.0), 0.0\n" + ADD)
    for file, value in zip([*files, files[0]], "aba", strict=True):
        load_libs([file])
        assert FORCES["push"](**{value: 2.0}).coefficients == (2.0,)
        assert loaded_libs() == (file,)
    with pytest.raises(InputError, match="push exists already"):
        load_libs(files)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = 1\nimport nothing_of_that_name\n", r"rubber.py, line 2: ModuleNotFoundError"),
        ("def f(:\n", r"rubber.py, line 1: SyntaxError"),
        (FUNG.replace("0.5 * mu / k", "0.6 * mu / k"), r"line 13: ValueError: solid fung: its shear modulus"),
        (FUNG.replace("np.exp(", "np.frompyfunc(np.exp, 1, 1)("), "rubber.py.*cannot be compiled"),
        (FORCE + "    return (a, 0.0, 0.0)\n" + ADD, "line 4: ValueError: force push: ValueError: too many"),
        (
            FORCE + "    return (a, b, 0.0), 0.0\n" + ADD,
            "line 4: ValueError: force push: NameError: name 'b'",
        ),
        (FORCE + "    return (a / 0.0, 0.0, 0.0), 0.0\n" + ADD, "force push: ZeroDivisionError"),
        (FORCE + "    return ('a', 0.0, 0.0), 0.0\n" + ADD, r"it returns \(\('a', 0.0, 0.0\), 0.0\), not"),
        (
            FORCE.replace("(inputs, a)", "(inputs, a: int)") + "    return a\n" + ADD,
            "the entry a is no float",
        ),
        (
            FORCE + "    return ({a: a}[a], [*range(int(a))][0] + 0.0, a), 0.0\n" + ADD,
            r"rubber.py, line 3: 'return .* cannot be compiled",
        ),
        (FORCE + "    return (a, a, a), 0.0\n" + ADD.replace("push", "gravity", 1), "gravity exists already"),
        (
            FORCE + "    return (a, a, a), 0.0\n" + ADD.replace("push", "wallLift", 1),
            "an entry wallLift already",
        ),
        (
            "import foamprb\nfoamprb.add_surrounding('drift', int)\n",
            "model drift: <class 'int'> is not a plain function",
        ),
    ],
)
def test_mistake_in_a_file_is_one_message(tmp_path, text, message):
    (tmp_path / "rubber.py").write_text(text)
    with pytest.raises(InputError, match=message):
        load_libs([tmp_path / "rubber.py"])


def test_run_with_a_users_solid_and_shape(tmp_path, capsys):
    case = copy_of_pipe(tmp_path)
    (case / "constant/rubber.py").write_text(FUNG)
    edit(case, r"type\s+neoHooke;", "type fung; stiffening 0.5; viscosity 1e-5;")
    edit(case, r"^solution", 'libs ("rubber.py");\nsolution')
    edit(case, r"shape\s+paper;", "shape rosenbrock;")
    edit(case, r"endTime\s+\S+;", "endTime 0.01;")
    edit(case, r"^\s+gravity;", "gravity; pressureGradient; virtualMass { Cvm 0.5; }")
    edit(
        case,
        r"^constantProperties\n{",
        "constantProperties\n{ shape { type ellipsoid; axisRatios (2 1 1); orientation random; }",
    )
    assert main(["run", "-case", str(case)]) == 0
    log = capsys.readouterr().out
    assert f"Running the Python file {case / 'constant/rubber.py'} of libs" in log
    assert "Selecting solid fung" in log
    assert "gravity, pressureGradient, virtualMass (Cvm 0.5)" in log
    rows = [row for row in fates(case) if row["fate"] == "active" and float(row["Ca"]) < 1e-3]
    # Almost rigid, and twice as long as thick.
    assert len(rows) == 1
    np.testing.assert_allclose(float(rows[0]["a"]) / float(rows[0]["c"]), 2.0, rtol=1e-3)
    assert foamprb.add_material is add_material
    record = json.loads((case / "postProcessing/softCloud/run.json").read_text())
    assert record["settings"]["libs"] == {"rubber.py": hashlib.sha256(FUNG.encode()).hexdigest()}
    # As each run of a study does.
    edit(case, '"stiffening", 0.0', '"stiffening", 0.1', "constant/rubber.py")
    assert "else: libs/rubber.py has changed. Undo" in message(case, capsys, "-resume")


@pytest.mark.parametrize("link", [False, True])
def test_a_file_outside_the_case_is_run_by_an_option_only(link, tmp_path, capsys):
    case = copy_of_pipe(tmp_path)
    rubber = tmp_path / "rubber.py"
    rubber.write_text(f"from pathlib import Path\nPath({str(tmp_path / 'ran')!r}).touch()\n")
    named = case / "constant/rubber.py" if link else rubber
    if link:
        named.symlink_to(rubber)
    edit(case, r"^solution", f'libs ("{named}");\nsolution')
    assert main(["run", "-case", str(case), "-dry-run"]) == 1
    assert f"{named} of libs lies outside the case" in capsys.readouterr().err
    assert not (tmp_path / "ran").exists()
    assert main(["run", "-case", str(case), "-dry-run", "-outsideLibs"]) == 0
    assert (tmp_path / "ran").exists()


def test_compiled_solid_is_found_again_by_the_next_process(tmp_path):
    """What the first process compiled and kept on disk, the second one reads."""
    (tmp_path / "rubber.py").write_text(FUNG)
    text = (
        "import sys, pathlib; from foamprb.settings.libs import load_libs, loaded_libs; "
        "from foamprb.compile.link import link; "
        "from foamprb.body.material import MATERIALS; load_libs([pathlib.Path(sys.argv[1])]); "
        "f = link(MATERIALS['fung'].derivatives); f(3.0, 3.0, 1.0, 1.0, 1.0, 1.0); "
        "print(sum(f.stats.cache_hits.values()))"
    )
    command = [sys.executable, "-c", text, str(tmp_path / "rubber.py")]
    environment = {**os.environ, "FOAMPRB_CACHE_DIR": str(tmp_path / "cache")}
    hits = [
        subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.strip()
        for _ in range(2)
    ]
    assert hits == ["0", "1"]


POROUS = """
import math

import foamprb


def porous(semi_axes, g):
    a, b, c = semi_axes
    k = 0.8 * 16.0 * math.pi
    x, y, z = g.chi + g.alpha[0] * a * a, g.chi + g.alpha[1] * b * b, g.chi + g.alpha[2] * c * c
    return k / x, k / y, k / z


foamprb.add_drag("porous", porous)
"""


def test_a_users_law_of_drag_sets_how_fast_a_body_settles(tmp_path):
    """By 2/9 (ρ_s − ρ_f) g R²/μ_f over .8, within the strain of the stiff sphere."""
    (tmp_path / "drag.py").write_text(POROUS)
    load_libs([tmp_path / "drag.py"])
    p = spheres([[0.0, 0.0, 0.0]], d=2e-5, rho=1100.0, mu=1e5, poissons_ratio=0.4999)
    water = Medium(1e-3, 1000.0, (0.0, 0.0, -9.81))
    Cloud(p, analytic.linear(np.zeros((3, 3))), water, (), 1e-3, Models(drag="porous")).advance(2)
    assert p.v[0, 2] == pytest.approx(-2.0 / 9.0 * 100.0 * 9.81 * 1e-10 / 1e-3 / 0.8, rel=1e-5)


@pytest.mark.parametrize(
    ("law", "fault"),
    [
        (lambda r, _: (r[0] / r[0], 1.0, 1.0), "twice the size"),
        (lambda r, _: (r[0], -r[1], r[2]), "not three positive numbers"),
        (lambda r, _: (r[0], r[0], r[0]), "at the semi-axes 1, 3, 2"),
    ],
)
def test_a_law_of_drag_is_one_of_an_ellipsoid(law, fault):
    with pytest.raises(ValueError, match=f"drag own: .*{fault}"):
        add_drag("own", law)


def swirl(inputs, rate, scale=0.5):
    x, y, _ = inputs.x
    return (-rate * y, scale * rate * x, inputs.t + inputs.R), 0.0


def test_entries_of_a_force_are_the_parameters_of_its_function():
    Swirl = add_force("swirl", swirl)
    force = Swirl(rate=3.0)
    assert force.coefficients == (3.0, 0.5)
    assert pickle.loads(pickle.dumps(force)) == force
    with pytest.raises(TypeError, match="rate"):
        Swirl(scale=1.0)
    with pytest.raises(ValueError, match=r"force lambda: <function .* is not a plain function"):
        add_force("lambda", (lambda k: lambda _: ((k, k, k), 0.0))(1.0))


def test_function_of_surroundings_is_checked():
    def still(x):
        return 0.0 * x[0], 0.0, 0.0

    for arguments, fault in (
        (("wallLift", still), "wallLift exists already"),
        (("still", still, ("T",)), r"T is unknown\. Allowed: x, u, grad\(u\), v, F, R, rho, t"),
        (("still", still, ("x",), ("v",)), r"v is unknown\. Allowed: u, grad\(u\)"),
        (("still", still, ("x", "t")), "it has 1 parameters for x, t"),
        (("still", max), "is not a plain function"),
        (("my-drift", still, ("x",)), "model my-drift: the name is no word"),
        (("still", still, ("R",)), "TypeError: 'float' object is not subscriptable"),
        (("still", still, ("x",), ("grad(u)",)), r"it returns \(0.0, 0.0, 0.0\), not 9 numbers"),
    ):
        with pytest.raises(ValueError, match=fault):
            add_surrounding(*arguments)
    assert "still" not in SURROUNDINGS


def calm(vx=0.0, vy=1.0):
    return vx, vy, 0.0


def test_a_users_surrounding_is_sent_to_other_processes():
    model = add_surrounding("calm", calm)(vx=2.0)
    sent = pickle.loads(pickle.dumps(model))
    assert sent == model
    assert sent.coefficients(()) == (2.0, 1.0)


def gradient_by(model):
    """Velocity gradient of a sphere in a fluid at rest, 1/s."""
    p = spheres(np.zeros((1, 3)), d=1e-5, rho=1e3, mu=1e3)
    still, water = analytic.linear(np.zeros((3, 3))), Medium(1e-3, 1e3, (0.0, 0.0, 0.0))
    Cloud(p, still, water, (), 1e-6, Models(integrator="stokes", surroundings=(model,))).advance(1)
    return (p.A[0].reshape(3, 3) @ np.linalg.inv(p.F[0].reshape(3, 3))).ravel()


def test_force_and_surroundings_of_the_page_move_particles(tmp_path, capsys):
    """The slip of a rigid sphere is τ_p f + v, f = −rate² (y − y0) at its place."""
    case = copy_of_pipe(tmp_path)
    page = (ROOT / "docs/own-models.md").read_text()
    force, *_, model, magnet, _ = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    (case / "constant/trap.py").write_text(force)
    (case / "constant/field.py").write_text(model)
    (case / "constant/magnet.py").write_text(magnet)
    edit(case, r"^solution", 'libs ("trap.py" "field.py");\nsolution')
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(case, r"endTime\s+\S+;", "endTime 0.002;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.001;")
    edit(case, r"^\s+gravity;", "trap { rate 300; y0 1e-4; } electrophoresis { vz 0.02; }")
    assert main(["run", "-case", str(case)]) == 0
    log = capsys.readouterr().out
    load_libs([case / "constant/magnet.py"])
    assert gradient_by(SURROUNDINGS["magnet"](w=10.0)) == pytest.approx(
        [0, -10, 0, 10, 0, 0, 0, 0, 0], abs=1e-6
    )
    assert "trap (rate 300, y0 0.0001), electrophoresis (vx 0, vy 0, vz 0.02)" in log
    output = case / "postProcessing/softCloud"
    with (output / "fates.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if float(row["Ca"]) < 1e-3]
    rigid = [int(row["id"]) for row in rows]
    cloud = pyvista.read(output / "softCloud_000002.vtp")
    at = np.flatnonzero(np.isin(cloud["origId"], rigid) & (cloud["status"] == 1))
    assert len(at) > 0
    points = np.asarray(cloud.points)[at]
    flow = foamprb.read_case(case)
    u, _ = flow.sample(points, flow.locate(points), 0.0)
    tau = cloud["rho"][at] * cloud["d"][at] ** 2 / (18.0 * 1.208 * 1.491e-5)
    slip = cloud["U"][at] - u
    np.testing.assert_allclose(slip[:, 1], -tau * 300.0**2 * (points[:, 1] - 1e-4), rtol=2e-3)
    np.testing.assert_allclose(slip[:, 2], 0.02, rtol=1e-3)


def test_function_of_the_page_is_called_at_write_times(tmp_path, capsys):
    """Its rows are those of the snapshots, also where the run was stopped between."""
    case = short_case(tmp_path)
    page = (ROOT / "docs/own-models.md").read_text()
    (code,) = (c for c in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "add_cloud_function" in c)
    (case / "constant/front.py").write_text(code)
    edit(case, r"^solution", 'libs ("front.py");\nsolution')
    edit(case, r"cloudFunctions\s*\{\s*\}", "cloudFunctions { halfway { type front; x 0.001; } }")
    stop_after(case, 0.003)
    assert main(["run", "-case", str(case), "-resume"]) == 0
    with (case / "postProcessing/softCloud/halfway/front.csv").open() as file:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]
    run = foamprb.open_run(case)
    assert [row["time"] for row in rows] == pytest.approx(run.times[-len(rows) :])
    assert len(rows) >= 6
    for row in rows:
        cloud = run.snapshot(row["time"])
        beyond = (cloud["status"] == 1) & (np.asarray(cloud.points)[:, 0] > 1e-3)
        assert row["bodies"] == beyond.sum()
        if beyond.any():
            assert row["meanD"] == pytest.approx(cloud["taylorDeformation"][beyond].mean(), rel=1e-5)
    assert rows[-1]["bodies"] > 0
    edit(case, r"\(D,\) = .*", "D = p.colour", "constant/front.py")
    assert main(["run", "-case", str(case), "-dry-run"]) == 1
    assert (
        "cloudFunctions/halfway: front must return bodies, meanD: AttributeError" in capsys.readouterr().err
    )


GAS = 'libs ("thermophoresis.py");\nsolution'


def test_force_reads_a_field_of_a_case_and_goes_on_after_a_restart(tmp_path, capsys):
    """The slip of a rigid sphere in T = 300 + 1e5 x is −3/2 ν ∇T/(T (2 + k))."""
    case = short_case(tmp_path)
    shutil.copy(ROOT / "examples/forces/thermophoresis.py", case / "constant")
    edit(case, r"^solution", GAS)
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(case, r"^\s+gravity;", "thermophoresis { k 1; }")
    edit(case, r"deltaT\s", "writeFields (taylorDeformation); writePrecision double; deltaT ")
    assert main(["run", "-case", str(case), "-dry-run"]) == 1
    assert "there is no field T at time 249. Allowed: U, p." in capsys.readouterr().err
    mesh = Case(case).mesh("249").mesh
    put_linear(case / "249", mesh, at=np.array([0.0, 1e5, 0.0]), begin=300.0)
    stop_after(case, 0.5 * END)
    assert main(["run", "-case", str(case), "-resume"]) == 0
    resumed = results(case)
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert results(case) == resumed
    cloud = pyvista.read(sorted((case / "postProcessing/softCloud").glob("*.vtp"))[-1])
    at = np.flatnonzero((cloud["taylorDeformation"] < 1e-3) & (cloud["status"] == 1))
    assert len(at) > 0
    points = np.asarray(cloud.points)[at]
    flow = foamprb.read_case(case)
    u, _ = flow.sample(points, flow.locate(points), 0.0)
    T = 300.0 + 1e5 * points[:, 1]
    np.testing.assert_allclose(cloud["T"][at], T, rtol=1e-9)
    assert "grad(T)" not in cloud.point_data
    np.testing.assert_allclose((cloud["U"][at] - u)[:, 1], -0.5 * 1.491e-5 * 1e5 / T, rtol=2e-3)
