"""Tables of moduli for dclab, and fits of its own."""

from __future__ import annotations

import json
import logging
import re

import numpy as np
import pytest
from pipe_case import copy_of_pipe
from pipe_cells import CYTOMETER, VOLUME_FLOW, cytometer_job, pipe_job, write_rtdc
from validation.quadratic import ELEMENTS

from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.run.device import Bodies, Device, plane_of, view_of
from foamprb.run.fit import entries_of, fit_job
from foamprb.run.job import prepare
from foamprb.run.lut import compute_lut, inflow, write_lut
from foamprb.run.measured import read_measured
from foamprb.view.report.fits import write_fit_page


@pytest.fixture(scope="module")
def cytometer(tmp_path_factory):
    return cytometer_job(tmp_path_factory.mktemp("cytometer"))


def read(path):
    """The columns and the metadata of a table."""
    text = path.read_text()
    meta = re.search(r"# BEGIN METADATA\n(.*)# END METADATA", text, re.DOTALL)[1]
    return np.loadtxt(path).T, json.loads(meta.replace("# ", ""))


def test_moduli_of_cells_are_those_of_finite_elements(cytometer):
    area, deformation, youngs = np.array(ELEMENTS).T
    measured = read_measured({"area": 1e-12 * area, "deformation": deformation})
    fits = fit_job(cytometer, measured, ("shearModulus",), overwrite=True)
    assert fits.fitted.all()
    np.testing.assert_allclose(3e-3 * fits.table["shearModulus"], youngs, rtol=0.03)


def test_moduli_of_a_measurement_follow_from_its_file(tmp_path):
    """dclab's, by its table LE-2D-FEM-19; the conditions are not those of the settings."""
    emodulus = pytest.importorskip("dclab.features.emodulus")
    job = cytometer_job(tmp_path)
    area, deformation, _ = np.array(ELEMENTS).T
    pixels = {"px_um": 0.34, "feat_corr": "deform", "feat_absc": "area_um"}
    deformation += emodulus.get_pixelation_delta(data_absc=area, **pixels)
    conditions = {"channel_width": 20.0, "flow_rate": 0.04, "medium": "CellCarrier", "temperature": 24.0}
    setup = {name.replace("_", " "): conditions[name] for name in ("channel_width", "flow_rate", "medium")}
    more = {"setup": {**setup, "temperature": 24.0}, "imaging": {"pixel size": 0.34}}
    measured = read_measured(write_rtdc(tmp_path / "cells.rtdc", area, deformation, **more))
    with pytest.raises(
        InputError, match=r"its viscosity is 0.00\d+ Pa s, that of the case 0.015 Pa s. Needed: "
    ):
        fit_job(job, measured, ("youngsModulus",))
    (entry,) = entries_of(measured, job.settings).items()
    job = cytometer_job(tmp_path, mu=entry[1])
    assert entry[0] == "constantProperties/mu"
    fits = fit_job(job, measured, ("youngsModulus",), overwrite=True)
    law = {"visc_model": "buyukurganci-2022", "lut_data": "LE-2D-FEM-19", "px_um": 0.34}
    expected = emodulus.get_emodulus(deform=deformation, area_um=area, **conditions, **law)
    np.testing.assert_allclose(1e-3 * fits.table["youngsModulus"], expected, rtol=0.03)
    more["setup"]["channel width"] = 30.0
    other = read_measured(write_rtdc(tmp_path / "other.rtdc", area, deformation, **more))
    with pytest.raises(InputError, match="its channel width is 3e-05 m, that of the case 2e-05 m"):
        fit_job(job, other, ("youngsModulus",))
    assert fit_job(job, other, ("youngsModulus",), force=True).fitted.all()


def test_intervals_by_a_given_error_hold_and_groups_differ(cytometer):
    """Images of cells of 3 and 4 kPa, with noise of 0.001."""
    random, n = np.random.default_rng(1), 200
    modulus, d = np.repeat([1000.0, 4000.0 / 3.0], n), random.normal(12e-6, 5e-7, 2 * n)
    plane = plane_of(None, cytometer)
    device = Device(cytometer, plane, view_of(None, cytometer, plane))
    device.pass_guides(plane.point[0])
    guide, start, _ = device.lead_to(np.full((2 * n, 3), np.nan))
    seen = device.follow(Bodies(guide, start, d, {"shearModulus": modulus}), np.full(2 * n, plane.point[0]))
    image = device.image(seen, d, ("area", "deformation"))
    image["deformation"] += random.normal(0.0, 1e-3, 2 * n)
    image["deformation"][0] = 1e-4
    groups = {"sample": np.repeat(["soft", "stiff"], n)}
    fits = fit_job(
        cytometer, read_measured({**image, **groups}, "sample", 1e-3), ("shearModulus",), overwrite=True
    )
    low, high = (fits.table[f"shearModulus{end}"][fits.fitted] for end in ("Low", "High"))
    held = ((low <= modulus[fits.fitted]) & (high >= modulus[fits.fitted])).mean()
    assert 0.93 <= held <= 0.97
    np.testing.assert_allclose(fits.population["median"], [1000.0, 4000.0 / 3.0], rtol=0.02)
    (row,) = zip(*fits.differences.values(), strict=True)
    assert row[:3] == ("shearModulus", "soft", "stiff")
    assert row[4] < -1000.0 / 3.0 < row[5] < 0.0
    page = write_fit_page(fits, fits.folder / "fit.html").read_text()
    for text in (
        "<title>Fit: ",
        "lines of equal shearModulus, Pa",
        "left out",
        "shearModulus [Pa]",
        "Differences of medians",
    ):
        assert text in page
    # Bodies on a line of the page have its modulus.
    lines = {name: values[::7] for name, values in fits.lines.items()}
    shapes = read_measured({name: lines[name] for name in ("area", "deformation")})
    again = fit_job(cytometer, shapes, ("shearModulus",), overwrite=True)
    np.testing.assert_allclose(again.table["shearModulus"], lines["value"], rtol=0.01)


def test_a_fit_without_the_walls_says_by_how_much_it_is_wrong(tmp_path, caplog):
    measured = read_measured({"area": [np.pi * 6e-6**2], "deformation": [0.01]})
    moduli = []
    for k, channel in enumerate((f"channel {{ type square; width {2.0 * CYTOMETER}; }}", "")):
        job = cytometer_job(tmp_path / str(k), channel)
        with caplog.at_level(logging.WARNING, "foamprb"):
            moduli.append(fit_job(job, measured, ("shearModulus",)).table["shearModulus"][0])
    (text,) = (record.getMessage() for record in caplog.records)
    factor = float(re.search(r"too small by a factor of ([\d.]+)\.", text)[1])
    assert moduli[0] / moduli[1] == pytest.approx(factor, rel=0.005)
    assert 1.05 < factor < 1.2
    assert f"channel {{ type square; width {2.0 * CYTOMETER:.4g}; }}" in text


def test_cells_beyond_the_mode_have_a_reason(cytometer):
    # Of 0.75 of the tube's radius; then soft ones.
    area = np.pi * np.array([0.75, 0.6, 0.4]) ** 2 * CYTOMETER**2
    measured = read_measured({"area": area, "deformation": [0.01, 0.12, 0.12]})
    fits = fit_job(cytometer, measured, ("shearModulus",), overwrite=True)
    reasons = [
        "it is away from the axis of the channel, or too large for it",
        *2 * ["its bullet amplitude is above 0.26"],
    ]
    assert fits.table["reason"].tolist() == reasons


def test_a_table_has_the_form_of_dclab(cytometer, tmp_path):
    lut = compute_lut(cytometer, (7e-6, 12e-6), (600.0, 3000.0), 6, flow_rate=VOLUME_FLOW, width=20e-6)
    path = tmp_path / "lut.txt"
    write_lut(lut, path, "mine")
    (area, deformation, youngs), meta = read(path)
    assert path.read_text().splitlines()[-len(area) - 1] == "# area_um [um^2]\tdeform\temodulus [kPa]"
    units = {"channel_width": (20.0, "um"), "flow_rate": (0.04, "uL/s"), "fluid_viscosity": (15.0, "mPa s")}
    for name, (value, unit) in units.items():
        assert meta[name] == pytest.approx(value)
        assert meta[f"{name}_unit"] == unit
    assert meta["identifier"] == "mine"
    # Steady bullets have ε = 7/8 μ_f U a/(μ_s R²), without the effect of the walls.
    a, mu = np.sqrt(area / np.pi) * 1e-6, 1e3 * youngs / 3.0
    eps = 0.875 * 0.015 * 2.0 * VOLUME_FLOW / (np.pi * CYTOMETER**2) * a / (mu * CYTOMETER**2)
    ratio = deformation / (25.0 / 32.0 * eps**2)
    small = a < 0.35 * CYTOMETER
    assert small.any()
    assert ((ratio[small] > 1.0) & (ratio[small] < 1.1)).all()
    with pytest.raises(InputError, match="letters, digits"):
        write_lut(lut, path, "two words")
    (tmp_path / "other.txt").write_text("a file of mine")
    with pytest.raises(InputError, match="a file of another kind"):
        write_lut(lut, tmp_path / "other.txt", "mine")


def test_dclab_finds_moduli_by_a_table(cytometer, tmp_path):
    emodulus = pytest.importorskip("dclab.features.emodulus")
    lut = compute_lut(cytometer, (6e-6, 14e-6), (500.0, 4000.0), 24, flow_rate=VOLUME_FLOW, width=20e-6)
    write_lut(lut, tmp_path / "lut.txt", "foamprb-test")
    emodulus.register_lut(tmp_path / "lut.txt")
    area, deformation, youngs = np.array(ELEMENTS).T
    conditions = {"channel_width": 20.0, "flow_rate": 0.04, "medium": 15.0}
    options = {"px_um": 0.0, "temperature": None, "visc_model": None, "lut_data": "foamprb-test"}
    moduli = emodulus.get_emodulus(deform=deformation, area_um=area, **conditions, **options)
    np.testing.assert_allclose(moduli, youngs, rtol=0.05)


def test_bodies_that_stay_round_give_no_table(cytometer):
    with pytest.raises(InputError, match=r"0 of 4 bodies have deformations from 0\.0005 to 0\.05"):
        compute_lut(cytometer, (7e-6, 8e-6), (1e6, 2e6), 2, flow_rate=VOLUME_FLOW, width=20e-6)


def test_command_takes_width_and_flow_rate_from_the_case(tmp_path, capsys):
    case = copy_of_pipe(tmp_path)
    settings = (pipe_job(tmp_path / "other").settings.file).read_text()
    settings = settings.replace("9e-5", "1.9e-3").replace(
        "deltaT 2e-3; endTime 2;", "deltaT 2e-4; endTime 0.05;"
    )
    (case / "constant/softCloudProperties").write_text(settings)
    job = prepare(case)
    assert inflow(job) == pytest.approx(np.pi * 2.1e-3**2 * 0.485, rel=1e-3)
    options = ["lut", "-case", str(case), "-diameters", "4e-5", "8e-5", "-number", "4"]
    options += ["-plane", "(0.01 0.001 0) (1 0 0)", "-output", str(tmp_path / "lut.txt")]
    assert main([*options, "-moduli", "1e3", "1e4"]) == 0
    assert "16 rows: channel 4200 um, 6720 uL/s, 1000 mPa s" in capsys.readouterr().out
    assert read(tmp_path / "lut.txt")[1]["identifier"] == "foamprb-softCloud"
    assert main([*options, "-moduli", "1e4", "1e3"]) == 1
    assert "-moduli 10000 1000: two numbers > 0 are needed, the smaller one first." in capsys.readouterr().err


def test_diameters_in_micrometres_are_questioned(tmp_path, capsys):
    options = ["-case", str(tmp_path), "-diameters", "6", "14", "-moduli", "200", "5000"]
    assert main(["lut", *options]) == 1
    said = capsys.readouterr().err
    assert said.startswith("--> foamprb Error : -diameters 6 14: are metres meant? ")
    assert said.endswith(" smaller than 0.001 m: diameters of 6 to 14 um are -diameters 6e-6 14e-6.\n")


def test_moduli_of_the_table_of_dclab_are_met(cytometer):
    """Every fiftieth of the points of docs/moduli.md, with deformations from 0.006 to 0.05."""
    emodulus = pytest.importorskip("dclab.features.emodulus")
    table, _ = emodulus.load_lut("LE-2D-FEM-19")
    area, deformation, youngs = table[(table[:, 1] > 0.006) & (table[:, 1] < 0.05)][::50].T
    measured = read_measured({"area": 1e-12 * area, "deformation": deformation})
    fits = fit_job(cytometer, measured, ("shearModulus",), overwrite=True)
    ratio = (3e-3 * fits.table["shearModulus"] / youngs)[fits.fitted]
    assert len(ratio) > 85
    assert -0.025 < ratio.min() - 1.0 < ratio.max() - 1.0 < 0.075
