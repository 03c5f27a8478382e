"""Properties that are fitted to the shapes of bodies, against those of synthetic ones."""

from __future__ import annotations

import numpy as np
import pytest
from pipe_case import copy_of_pipe
from pipe_cells import MEAN, RADIUS, SETTINGS, pipe_job, seen_cells

from foamprb.cli import main
from foamprb.errors import InputError, RunInterrupted
from foamprb.results.tables import read_table
from foamprb.run import fit as module
from foamprb.run.device import Bodies, Device, plane_of, view_of
from foamprb.run.fit import fit_job
from foamprb.run.least_squares import gauss_newton
from foamprb.run.measured import read_measured

BOTH = ("shearModulus", "viscosity")


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    return pipe_job(tmp_path_factory.mktemp("case"))


def test_properties_of_cells_are_recovered(job):
    measured, G, eta = seen_cells(job, 40, noise=0.0)
    fits = fit_job(job, measured, BOTH, "x=1e-3", overwrite=True)
    assert fits.fitted.all()
    np.testing.assert_allclose(fits.table["shearModulus"], G, rtol=1e-4)
    np.testing.assert_allclose(fits.table["viscosity"], eta, rtol=2e-3)
    np.testing.assert_allclose(fits.table["y"], measured.of("y"), atol=1e-9)


def test_the_interval_of_a_population_holds_its_median(job):
    """`tools/validation/fits.py` has the intervals of single cells, and the bias."""
    measured, *properties = seen_cells(job, 60)
    fits = fit_job(job, measured, BOTH, "x=1e-3", overwrite=True)
    for row, true in enumerate(properties):
        assert fits.population["medianLow"][row] < np.median(true) < fits.population["medianHigh"][row]


def test_errors_follow_from_residuals_without_measured_ones(job):
    """Strain and deformation of an ellipse are one quantity, measured twice."""
    measured, *_ = seen_cells(job, 200, noise=0.0)
    random = np.random.default_rng(3)
    ratio = np.square(0.5 * (measured.of("strain") + np.sqrt(measured.of("strain") ** 2 + 4.0)))
    e = 1.0 - 1.0 / ratio**2
    from scipy.special import ellipe

    deformation = 1.0 - np.pi / (2.0 * np.sqrt(ratio) * ellipe(e))
    columns = {name: measured.of(name) for name in ("y", "d")}
    columns["strain"] = measured.of("strain") * random.normal(1.0, 0.05, 200)
    columns["deformation"] = deformation * random.normal(1.0, 0.05, 200)
    fits = fit_job(job, read_measured(columns), ("shearModulus",), "x=1e-3", overwrite=True)
    half = np.log(fits.table["shearModulusHigh"] / fits.table["shearModulus"])[fits.fitted]
    # The strain is about 1/G, the deformation its square: of errors s each, that of ln G is s/√5 at most.
    assert 0.5 < np.median(half) / (1.96 * 0.05 / np.sqrt(5.0)) < 2.0


def test_bodies_without_a_fit_have_a_reason(job):
    measured, *_ = seen_cells(job, 8, noise=0.0)
    columns = {name: values.copy() for name, values in measured.columns.items()}
    columns["y"][:4] = 0.0, 2.0 * RADIUS, np.nan, columns["y"][3]
    columns["strain"][3], columns["d"][4], columns["angle"][5], columns["angle"][6] = (
        30.0,
        np.nan,
        np.nan,
        1.5,
    )
    columns["d"][7] = 1.5 * RADIUS
    fits = fit_job(job, read_measured(columns), BOTH, "x=1e-3", overwrite=True)
    starts = [
        "the curvature number",
        "its place is outside",
        "",
        "no value explains its strain",
        "its size is",
    ]
    starts += ["fewer values than", "no value explains its angle", "the curvature number"]
    assert [
        reason.startswith(start) for reason, start in zip(fits.table["reason"], starts, strict=True)
    ] == 8 * [True]
    assert np.isfinite(fits.table["shearModulus"]).tolist() == (fits.table["reason"] == "").tolist()


def test_an_interrupted_fit_continues(job, monkeypatch):
    monkeypatch.setattr(module, "_BATCH", 16)
    measured, *_ = seen_cells(job, 40)
    whole = fit_job(job, measured, BOTH, "x=1e-3", overwrite=True)
    batches = []
    solve = module._Problem.solve
    monkeypatch.setattr(
        module._Problem, "solve", lambda self, rows: batches.append(rows) or solve(self, rows)
    )
    with pytest.raises(RunInterrupted, match=r"stopped after 16 of 40 bodies, which are in .*fits\.csv"):
        fit_job(job, measured, BOTH, "x=1e-3", overwrite=True, stop=lambda: len(batches) > 1)
    assert len(read_table(whole.folder / "fits.csv", ("id", "reason"))["id"]) == 16
    batches.clear()
    continued = fit_job(job, measured, BOTH, "x=1e-3")
    assert [rows.start for rows in batches] == [16, 32]
    for name, column in whole.table.items():
        np.testing.assert_array_equal(continued.table[name], column)
    # Another table is another fit.
    batches.clear()
    fit_job(job, measured.take(slice(0, 20)), BOTH, "x=1e-3")
    assert [rows.start for rows in batches] == [0, 16]


def test_each_body_has_its_own_plane(job):
    measured, G, _ = seen_cells(job, 12, noise=0.0)
    x = np.linspace(5e-4, 1.5e-3, 12)
    columns = {**measured.columns, "x": x}
    fits = fit_job(job, read_measured(columns), BOTH, "x", overwrite=True)
    np.testing.assert_allclose(fits.table["x"], x, atol=1e-9)
    # The shape is steady after a millimetre, and nearly so before.
    np.testing.assert_allclose(fits.table["shearModulus"], G, rtol=0.05)


def test_a_body_that_drifts_is_released_where_it_arrives_at_its_place(tmp_path):
    job = pipe_job(tmp_path, SETTINGS.replace("ellipsoidDrag;", "ellipsoidDrag; wallLift;"))
    plane = plane_of("x=1e-3", job)
    device = Device(job, plane, view_of("z", job, plane))
    device.pass_guides(1e-3)
    release = np.stack([np.full(8, 1e-6), np.linspace(5e-5, 8.5e-5, 8), np.zeros(8)], axis=1)
    d, G = np.full(8, 15e-6), np.geomspace(150.0, 600.0, 8)
    guide = device.lead_to(np.where(np.arange(3) == 1, release, np.nan))[0]
    seen = device.follow(Bodies(guide, release, d, {"shearModulus": G}), np.full(8, 1e-3))
    assert (release[:, 1] - seen.x[:, 1]).max() > 5e-6
    strain = device.image(seen, d, ("strain",))["strain"]
    table = {"y": seen.x[:, 1], "d": d, "strain": strain}
    fits = fit_job(job, read_measured(table), ("shearModulus",), "x=1e-3")
    np.testing.assert_allclose(fits.table["y"], seen.x[:, 1], atol=0.05 * 15e-6)
    np.testing.assert_allclose(fits.table["shearModulus"], G, rtol=0.01)


def test_a_compressible_body_keeps_its_poissons_ratio_at_each_modulus(tmp_path):
    """The modulus of the settings does not matter."""
    shapes = []
    for modulus in (100, 300):
        solid = f"shearModulus {modulus}; poissonsRatio 0.2;"
        text = SETTINGS.replace("shearModulus 300;", solid).replace("shape stokes", "shape rosenbrock")
        job = pipe_job(tmp_path / str(modulus), text)
        plane = plane_of("x=1e-4", job)
        device = Device(job, plane, view_of("z", job, plane))
        device.pass_guides(1e-4)
        guide, release, _ = device.lead_to(np.array([[np.nan, 8e-5, np.nan]]))
        bodies = Bodies(guide, release, np.array([15e-6]), {"shearModulus": np.array([300.0])})
        shapes.append(device.follow(bodies, np.array([1e-4])).F)
    assert np.abs(shapes[0] - np.eye(3)).max() > 0.1
    np.testing.assert_allclose(*shapes, rtol=1e-6)


def test_a_stiff_sphere_spins_with_half_of_the_shear_rate(job):
    plane = plane_of("x=1e-3", job)
    device = Device(job, plane, view_of("z", job, plane))
    device.pass_guides(1e-3)
    y = np.array([[np.nan, 5e-5, np.nan]])
    guide, release, _ = device.lead_to(y)
    seen = device.follow(
        Bodies(guide, release, np.array([1e-5]), {"shearModulus": np.array([1e6])}), np.array([1e-3])
    )
    rate = 4.0 * MEAN * 5e-5 / RADIUS**2
    assert seen.spin[0] == pytest.approx(0.5 * rate, rel=1e-3)
    assert device.curvature_number(seen.x, np.array([1e-5]))[0] == pytest.approx(np.sqrt(0.8) * 5e-6 / 5e-5)


def test_an_area_gives_the_size(job):
    measured, G, _ = seen_cells(job, 12, noise=0.0)
    plane = plane_of("x=1e-3", job)
    device = Device(job, plane, view_of("z", job, plane))
    device.pass_guides(1e-3)
    guide, release, _ = device.lead_to(device.places(measured)[0])
    d, G = measured.of("d"), np.full(12, 250.0)
    seen = device.follow(Bodies(guide, release, d, {"shearModulus": G}), np.full(12, 1e-3))
    image = device.image(seen, d, ("area", "deformation"))
    fits = fit_job(
        job, read_measured({"y": measured.of("y"), **image}), ("shearModulus",), "x=1e-3", overwrite=True
    )
    np.testing.assert_allclose(fits.table["d"], d, rtol=1e-4)
    np.testing.assert_allclose(fits.table["shearModulus"], G, rtol=1e-3)


def test_gauss_newton_solves_a_regression():
    """Of y = ln-linear values the estimate and its error are those of linear least squares."""
    random = np.random.default_rng(0)
    A, errors = random.normal(size=(5, 2)), random.uniform(0.5, 2.0, 5)
    values = random.normal(size=(3, 5))

    def predict(rows, theta, moves):
        # Points outside the unit square are invalid: steps there are halved.
        return theta @ A.T, np.abs(theta).max(axis=1) < 40.0

    solution = gauss_newton(predict, values, np.tile(errors, (3, 1)), np.full((3, 2), 2.0), np.zeros(5, bool))
    weighted = A / errors[:, None]
    expected = np.linalg.lstsq(weighted, (values / errors).T, rcond=None)[0].T
    np.testing.assert_allclose(solution.theta, expected, atol=0.02)
    spread = np.sqrt(np.diag(np.linalg.inv(weighted.T @ weighted)))
    np.testing.assert_allclose(solution.spread, np.tile(spread, (3, 1)), rtol=1e-6)
    assert solution.converged.all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("solution/transient", "solution/transient is yes. Allowed: a steady flow"),
        ("BrownianMotion", "BrownianMotion moves bodies at random"),
        ("endTime 2;", "no particle of the injection models passes the plane"),
    ],
)
def test_a_case_that_is_no_device_is_refused(tmp_path, change, message):
    text = SETTINGS
    if change == "BrownianMotion":
        text = text.replace("ellipsoidDrag;", "ellipsoidDrag; BrownianMotion { T 293; }")
    elif change.startswith("endTime"):
        text = text.replace(change, "endTime 0.02;")
    job = pipe_job(tmp_path, text)
    if change.startswith("solution"):
        from dataclasses import replace

        solution = replace(job.settings.solution, transient=True)
        job = replace(job, settings=replace(job.settings, solution=solution))
    measured = read_measured({"y": [5e-5], "d": [1e-5], "strain": [0.3]})
    with pytest.raises(InputError, match=message):
        fit_job(job, measured, ("shearModulus",), "x=1e-3")


def test_command_writes_tables_and_a_page(tmp_path, capsys):
    case = copy_of_pipe(tmp_path)
    text = SETTINGS.replace("-9e-5", "-1.9e-3").replace("9e-5", "1.9e-3").replace("15e-6", "5e-5")
    text = (
        text.replace("deltaT 2e-3; endTime 2;", "deltaT 2e-4; endTime 0.05;")
        .replace("mu 1;", "mu 0.1;")
        .replace("viscosity 1;", "")
    )
    (case / "constant/softCloudProperties").write_text(text)
    table = tmp_path / "beads.csv"
    table.write_text("y [mm],d [µm],strain [%],note\n1.0,50,20,a\n-1.2,52,25,b\n1.5,48,30,c\n")
    options = ["-case", str(case), "-plane", "x=0.01", "-noBrowser"]
    assert main(["fit", *options, "-measured", str(table)]) == 0
    printed = capsys.readouterr().out
    assert "Fitted: 3 of 3 bodies" in printed
    folder = case / "postProcessing/softCloud/fit"
    values = read_table(folder / "fits.csv")
    # Without errors, as many values as unknown properties have no interval.
    assert np.isnan(values["shearModulusLow"]).all()
    # Of a solid without viscosity small strains are 5/2 μ_f γ̇/μ_s; in the air of the case U is 0.485 m/s.
    rate = 4.0 * 0.485 * np.array([1.0e-3, 1.2e-3, 1.5e-3]) / 2.1e-3**2
    expected = 2.5 * 0.1 * rate / np.array([0.20, 0.25, 0.30])
    np.testing.assert_allclose(values["shearModulus"], expected, rtol=0.06)
    page = (folder / "fit.html").read_text()
    assert page.count("<svg") == 3
    assert (folder / "fitPlots/strainPredicted.png").exists()
    assert main(["fit", *options[:2], "-measured", str(table), "-noBrowser"]) == 1
    assert "where were the bodies seen? Needed: -plane" in capsys.readouterr().err


def test_an_unknown_without_influence_stays():
    def predict(rows, theta, moves):
        return np.exp(theta[:, :1]) * [1.0, 2.0], np.ones(len(theta), bool)

    values, start = np.array([[3.0, 6.0]]), np.zeros((1, 2))
    solution = gauss_newton(predict, values, np.ones((1, 2)), start, np.ones(2, bool))
    np.testing.assert_allclose(solution.theta, [[np.log(3.0), 0.0]], atol=1e-4)
    # ∂y/∂ ln is 3 and 6, by differences of 2 %.
    assert solution.spread[0, 0] == pytest.approx(1.0 / np.sqrt(45.0), rel=0.02)
    assert np.isinf(solution.spread[0, 1])
