"""Properties that are fitted to the shapes of bodies, against those of synthetic ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pipe_case import copy_of_pipe
from pipe_cells import MEAN, RADIUS, SETTINGS, pipe_job, seen_cells

from foamprb.cli import main
from foamprb.errors import InputError, RunInterrupted
from foamprb.results.atomic import only_writer
from foamprb.results.tables import read_table
from foamprb.run import fit as module
from foamprb.run.device import UNKNOWNS, Bodies, Device, plane_of, view_of
from foamprb.run.fit import fit_job
from foamprb.run.least_squares import gauss_newton
from foamprb.run.measured import read_measured
from foamprb.view.report.fits import UNITS

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


def test_membranes_of_capsules_are_recovered(tmp_path):
    """Each with its own size, on which the modulus of the body depends beside that of the surface."""
    solid = "type capsule; law neoHookean; surfaceShearModulus 3e-3;"
    job = pipe_job(tmp_path, SETTINGS.replace("type neoHooke; shearModulus 300; viscosity 1;", solid))
    G, d, y = np.array([[2e-3, 3e-3, 4e-3], [14e-6, 15e-6, 17e-6], [4e-5, 6e-5, 7e-5]])
    device = Device(job, plane := plane_of("x=1e-3", job), view_of("z", job, plane))
    device.pass_guides(1e-3)
    guide, start, _ = device.lead_to(np.stack([np.full(3, np.nan), y, np.full(3, np.nan)], axis=1))
    seen = device.follow(Bodies(guide, start, d, {"surfaceShearModulus": G}), np.full(3, 1e-3))
    measured = read_measured({"y": y, "d": d, **device.image(seen, d, ("strain", "angle"))})
    fits = fit_job(job, measured, ("surfaceShearModulus", "viscosity"), "x=1e-3")
    np.testing.assert_allclose(fits.table["surfaceShearModulus"], G, rtol=1e-4)
    np.testing.assert_allclose(fits.table["viscosity"], 1.0, rtol=1e-3)
    with pytest.raises(InputError, match="Allowed: surfaceShearModulus, viscosity"):
        fit_job(job, measured, ("shearModulus",), "x=1e-3")


def test_pages_have_a_unit_for_each_property():
    assert UNITS.keys() >= set(UNKNOWNS)


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


def test_one_process_at_a_time_fits_in_a_folder(job):
    measured, *_ = seen_cells(job, 2, noise=0.0)
    with only_writer(job.folder.path / "fit"), pytest.raises(InputError, match="is writing here"):
        fit_job(job, measured, BOTH, "x=1e-3")


def test_elastic_cells_have_no_viscosity(job):
    measured, G, _ = seen_cells(job, 200, viscosity=0.0)
    fits = fit_job(job, measured, BOTH, "x=1e-3", overwrite=True)
    table, fitted = fits.table, fits.fitted
    assert fitted.mean() > 0.985
    # The estimate is at the bound for half of the bodies; its interval is one-sided there.
    at_bound = table["viscosity"][fitted] == 0.0
    assert 0.4 < at_bound.mean() < 0.6
    assert (table["viscosityLow"][fitted] == 0.0).mean() > 0.95
    assert (table["viscosityHigh"][fitted] > 0.0).all()
    held = (table["shearModulusLow"] <= G) & (table["shearModulusHigh"] >= G)
    assert held[fitted].mean() > 0.93
    assert np.median(table["shearModulus"][fitted] / G[fitted]) == pytest.approx(1.0, abs=0.01)
    assert fits.population["bodies"].tolist() == 2 * [fitted.sum()]
    assert fits.population["medianLow"][1] == 0.0


def test_shapes_without_information_determine_nothing(job):
    measured, *_ = seen_cells(job, 4, noise=0.0)
    columns = {**measured.columns, "strainError": np.full(4, 1e300)}
    fits = fit_job(job, read_measured(columns), ("shearModulus",), "x=1e-3", overwrite=True)
    del columns["angle"]
    fits = fit_job(job, read_measured(columns), ("shearModulus",), "x=1e-3", overwrite=True)
    assert set(fits.reasons) == {"its shape does not determine shearModulus"}
    with pytest.raises(InputError, match="-view 'nan nan nan'"):
        fit_job(job, measured, BOTH, "x=1e-3", "nan nan nan")


def test_treading_is_that_at_the_plane(job, monkeypatch):
    spins = []
    for calls in (4, 400):
        monkeypatch.setattr("foamprb.run.device._CALLS", calls)
        plane = plane_of("x=2e-4", job)
        device = Device(job, plane, view_of("z", job, plane))
        device.pass_guides(2e-4)
        guide, release, _ = device.lead_to(np.array([[np.nan, 8e-5, np.nan]]))
        bodies = Bodies(guide, release, np.array([15e-6]), {"shearModulus": np.array([300.0])})
        spins.append(device.follow(bodies, np.array([2e-4])).spin[0])
    assert spins[0] == pytest.approx(spins[1], rel=1e-3)


def test_an_interrupted_fit_continues(job, monkeypatch, tmp_path):
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
    # Another table is another fit, as is the same one in another fluid, or with other names of the bodies.
    few = measured.take(slice(0, 20))
    thicker = replace(pipe_job(tmp_path, SETTINGS.replace("mu 1;", "mu 1.1;")), output=job.output)
    renamed = replace(few, ids=few.ids + 1)
    for its_job, table in ((job, few), (thicker, few), (job, few), (job, renamed)):
        batches.clear()
        fit_job(its_job, table, BOTH, "x=1e-3")
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

    free = np.zeros(2, bool)
    start, sign = np.full((3, 2), 2.0), np.zeros(5, bool)
    solution = gauss_newton(predict, values, np.tile(errors, (3, 1)), start, sign, free)
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
    assert page.count("<svg") == 4
    assert (folder / "fitPlots/strainPredicted.png").exists()
    table.write_text(table.read_text().replace("y [mm],d [µm]", "y [m],d [nm]"))
    assert main(["fit", *options, "-measured", str(table)]) == 1
    said = capsys.readouterr().err
    assert "0 of 3 bodies are fitted (3: its place is outside the flow)" in said
    assert "By d they are 1e+03 times smaller than in the case: is its unit right?" in said
    assert main(["fit", *options[:2], "-measured", str(table), "-noBrowser"]) == 1
    assert "where were the bodies seen? Needed: -plane" in capsys.readouterr().err


def test_an_unknown_without_influence_stays():
    def predict(rows, theta, moves):
        return np.exp(theta[:, :1]) * [1.0, 2.0], np.ones(len(theta), bool)

    values, start = np.array([[3.0, 6.0]]), np.zeros((1, 2))
    solution = gauss_newton(predict, values, np.ones((1, 2)), start, np.ones(2, bool), np.zeros(2, bool))
    np.testing.assert_allclose(solution.theta, [[np.log(3.0), 0.0]], atol=1e-4)
    # ∂y/∂ ln is 3 and 6, by differences of 2 %.
    assert solution.spread[0, 0] == pytest.approx(1.0 / np.sqrt(45.0), rel=0.02)
    assert np.isinf(solution.spread[0, 1])


def test_values_from_zero_on_meet_their_bound():
    """min (x − 1)² + (x + y + 2)² with y ≥ 0 is at x = −1/2, y = 0; a prediction of NaN is invalid."""

    def predict(rows, theta, moves):
        x, y = theta.T
        return np.where(x[:, None] < 3.0, np.stack([x, x + y], axis=1), np.nan), np.ones(len(x), bool)

    start, plain = np.array([[0.5, 1.0], [4.0, 1.0]]), np.zeros(2, bool)
    values, bounded = np.tile([1.0, -2.0], (2, 1)), np.array([False, True])
    solution = gauss_newton(predict, values, np.full((2, 2), 1e-3), start, plain, bounded)
    np.testing.assert_allclose(solution.theta[0], [-0.5, 0.0], atol=1e-4)
    assert solution.valid.tolist() == [True, False]
