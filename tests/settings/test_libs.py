"""Solids that users bring, from Python and by a file that the settings name."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pipe_case import copy_of_pipe, edit, fates

import foamprb
from foamprb import Cloud, InputError, Medium, Models, analytic, spheres
from foamprb.body import material
from foamprb.body.material import MATERIALS, Parameter, add_material
from foamprb.body.tensor import log_ratio
from foamprb.cli import main
from foamprb.settings.libs import load_libs

FUNG = """
import numpy as np

import foamprb
from foamprb.body.tensor import log_ratio


def energy(I1, I2, J, mu, lame, k):
    log_J = log_ratio(J)
    return 0.5 * mu / k * (np.exp(k * (I1 - 3.0 - 2.0 * log_J)) - 1.0) + 0.5 * lame * log_J * log_J


foamprb.add_material("fung", energy, parameter=foamprb.Parameter("stiffening", 0.0, 10.0))
"""


@pytest.fixture(autouse=True)
def registry(monkeypatch, solids):
    """No file has been loaded."""
    monkeypatch.setattr("foamprb.settings.libs._loaded", {})


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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = 1\nimport nothing_of_that_name\n", r"rubber.py, line 2: ModuleNotFoundError"),
        ("def f(:\n", r"rubber.py, line 1: SyntaxError"),
        (FUNG.replace("0.5 * mu / k", "0.6 * mu / k"), r"line 13: ValueError: solid fung: its shear modulus"),
        (FUNG.replace("np.exp(", "np.frompyfunc(np.exp, 1, 1)("), "fung cannot be compiled"),
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
        "import sys, pathlib; from foamprb.settings.libs import load_libs; "
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
