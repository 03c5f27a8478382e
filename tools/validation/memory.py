"""Solids with memory: creep, oscillations and power laws (beyond the paper)."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.linalg import expm

from foamprb.body.memory import complex_modulus, times_of_power_law
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, spheres, with_relaxation
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Flow
from foamprb.run.fit import fit_job
from foamprb.run.job import assemble
from foamprb.run.measured import read_measured
from foamprb.run.release import with_power_law
from foamprb.settings.settings import read_settings
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst
from validation.fits import MEAN, RADIUS, SETTINGS
from validation.references.power_law import creep_of_power_law

MODULI, TIMES = np.array([2.0, 1.0]), np.array([0.3, 2.0])
RATE = 1e-5
"""Strain rate of small strains, 1/s; moduli and viscosity are 1 Pa and 1 Pa s."""
MAXWELL = "linear equations of the moduli, matrix exponential"
FRACTIONAL = "fractional equation, inverse Laplace transform"
ROSCOE = "Roscoe (1967), complex modulus"
SOURCES = (
    "Small strains of a sphere obey 3 μ_f de/dt + 2 ∫G(t − s) de = 5 μ_f E, with e and E in the frame that "
    "turns with the material. Fitted cells have strain and angle of that equation with a power law."
)


def _sphere(scale: float) -> Particles:
    p = spheres([(0.0, 0.0, 0.0)], d=2.0, rho=1e-6, mu=scale, poissons_ratio=0.4999)
    return with_relaxation(p, scale * MODULI, TIMES)


def _cloud(p: Particles, flow: Flow, dt: float, integrator: str) -> Cloud:
    models = Models(integrator=integrator, tolerance=1e-6)
    return Cloud(p, flow, Medium(1.0, 1e-6, (0.0, 0.0, 0.0)), (), dt, models, threads=1)


def _strain(cloud: Cloud) -> Floats:
    F = cloud.particles.F[0].reshape(3, 3)
    return np.asarray(0.5 * (F @ F.T - np.eye(3)))


def _strains(cloud: Cloud, times: Floats) -> Floats:
    """Return e_xx over the rate at times, s."""
    values = []
    for t in times:
        cloud.advance(round(t / cloud.dt) - cloud.step)
        values.append(_strain(cloud)[0, 0] / RATE)
    return np.array(values)


def _maxwell(t: float) -> float:
    """Return e/E after t of a constant E, s."""
    A = np.zeros((4, 4))
    A[:3, :3], A[:3, 3] = -2.0 / 3.0 * np.array([1.0, *MODULI]), 5.0 / 3.0
    A[1, 1] -= 1.0 / TIMES[0]
    A[2, 2] -= 1.0 / TIMES[1]
    return float((expm(A * t) @ np.array([0.0, 0.0, 0.0, 1.0]))[0])


def relaxation(quick: bool) -> Outcome:
    """Solids with memory."""
    rows: list[Row] = []
    curves: list[Curve] = []
    times = np.array([0.2, 0.6, 1.0, 2.0, 4.0, 8.0])
    exact = np.array([_maxwell(t) for t in times])
    for integrator in ("stokes", "rosenbrock"):
        ours = _strains(_cloud(_sphere(1.0), analytic.extension(RATE), 0.05, integrator), times)
        title = (
            f"creep of a Prony solid, {integrator}: strain over that of the closed form, worst of all times"
        )
        rows.append(worst(title, ours / exact, np.ones(len(times)), MAXWELL, 2e-4))
        for ratio in (0.1, 1.0) if quick else (0.03, 0.1, 0.3, 1.0, 3.0):
            scale = 1e5
            cloud = _cloud(_sphere(scale), analytic.shear(ratio), 0.05, integrator)
            cloud.advance(round(100.0 / cloud.dt))
            e = _strain(cloud)
            ours_here = (e[0, 0] + 1j * e[0, 1]) * scale / ratio
            G = complex_modulus(ratio, 1.0, MODULI, TIMES)
            expected = 2.5j / (2.0 * G + 3.0j * ratio / scale)
            title = f"stiff sphere in shear at 1/s = {ratio:g}, {integrator}: strain over that by G*"
            rows.append(Row(title, float(abs(ours_here / expected)), 1.0, ROSCOE, 1e-4))
            phase = float(np.degrees(np.angle(ours_here / expected)))
            rows.append(Row(f"{title}: difference of phase, deg", phase, 0.0, ROSCOE, 0.01))
    for colour, alpha in enumerate((0.2, 0.44, 0.7)):
        p = spheres([(0.0, 0.0, 0.0)], d=2.0, rho=1e-6, mu=1.0)
        p = with_power_law(p, np.array([3.0]), np.array([alpha]), times_of_power_law(0.01, 10.0), 1.0)
        creep = np.geomspace(0.1, 10.0, 6 if quick else 20).round(2)
        ours = _strains(_cloud(p, analytic.extension(RATE), 0.01, "stokes"), creep)
        law = creep_of_power_law(creep, 3.0, alpha).real
        rows.append(worst(f"creep of a power law, α = {alpha:g}: strain over the exact one", ours / law,
                          np.ones(len(creep)), FRACTIONAL, 5e-3))  # fmt: skip
        labels = f"foamprb, α = {alpha:g}", "exact" if colour == 0 else ""
        curves += compared(creep, ours, law, labels, colour)
    rows += fitted(24 if quick else 200)
    panel = Panel("t [s]", "strain over strain rate of the fluid [s]", curves)
    figure = Figure("memory", "Creep of spheres of power laws, k = 3 Pa, in a fluid of 1 Pa s.", [panel])
    return Outcome(rows, [figure], [SOURCES])


def fitted(n: int) -> list[Row]:
    """Return the largest errors of the power laws of n cells, fitted to their exact creep."""
    random = np.random.default_rng(0)
    k, alpha = 5e4 * np.exp(random.normal(0.0, 0.4, n)), random.uniform(0.25, 0.6, n)
    y, sheared = random.uniform(4e-5, 8e-5, n), random.uniform(6.0, 14.0, n)
    rate, u = 4.0 * MEAN * y / RADIUS**2, 2.0 * MEAN * (1.0 - (y / RADIUS) ** 2)
    x = 1e-6 + sheared * u / rate
    c = 0.5j * rate * creep_of_power_law(sheared / rate, k, alpha, rate)
    table = {"x": x, "y": y, "d": np.full(n, 15e-6), "strain": 2.0 * np.abs(c), "angle": 0.5 * np.angle(c)}
    solid = SETTINGS.replace(
        "type neoHooke; shearModulus 300; viscosity 1;", "type powerLaw; k 5e4; alpha 0.4;"
    )
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "constant").mkdir()
        (folder / "constant/softCloudProperties").write_text(solid.replace("deltaT 2e-3", "deltaT 1e-3"))
        job = assemble(read_settings(folder), analytic.pipe(RADIUS, MEAN, 2e-3))
        job = replace(job, output=folder / "results")
        fits = fit_job(job, read_measured(table), ("k", "alpha"), "x")
    title = "power laws of cells by strain and angle on their way: {}, fitted over true, worst of all"
    return [
        worst(title.format(symbol), fits.table[name] / true, np.ones(n), FRACTIONAL, 0.02)
        for symbol, name, true in (("k", "k", k), ("α", "alpha", alpha))
    ]
