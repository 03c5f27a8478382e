"""Haemolysis of cells with a memory (beyond the paper)."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Literal, cast

import numpy as np
from scipy.integrate import quad

from foamprb.cloud.paths import COLUMNS, Steps, step
from foamprb.cloudfunctions.haemolysis import (
    POWER_LAWS,
    Haemolysis,
    effective_shear_rate,
    index_of_haemolysis,
)
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared
from validation.references.morphology import shapes, taylor
from validation.references.shear import SHEAR

MEASURED = ((100.0, 1.5), (200.0, 0.5), (200.0, 1.5), (320.0, 1.5))
"""Stresses, Pa, and times, s, within the range of the experiments."""
DING = "human blood, fit of Ding et al. (2015), r² 0.18, to whose data the pores are fitted"
MU, F1, F2 = 3.5e-3, 5.0, 4.2298e-4
Cell = Literal["fluid", "KelvinVoigt", "morphology"]


def _released(constants: str, stress: Cell, rate: float, time: float, samples: int) -> Floats:
    """Return the per cent released in simple shear until each sample."""
    function = Haemolysis(constants=constants, stress=stress, mu=MU)
    fluid = SimpleNamespace(medium=SimpleNamespace(mu=MU), flow=None)
    cloud = cast("Any", SimpleNamespace(particles=SimpleNamespace(size=1), cloud=fluid))
    memory, shares = function.initial(cloud), []
    tables, fresh = np.zeros((1, COLUMNS, 1)), np.ones(1, dtype=np.bool_)
    for first in (step.l0, step.l1):
        tables[0, first : first + 9, 0] = rate * SHEAR.ravel()
    tables[0, step.t1] = time / samples
    for _ in range(samples):
        function.add(memory, cloud, Steps(tables, in_frame=False), fresh)
        shares.append(float(index_of_haemolysis(function.law, memory["dose"])[0]))
    return np.array(shares)


def _expected(stress: Cell, rate: float, times: Floats) -> Floats:
    """Return Giersiepen's per cent at times of a constant shear, from G by the equation of the cell."""
    A, alpha, beta = 3.62e-5, 2.416, 0.785
    fine = np.linspace(0.0, times[-1], 20_001)[1:]
    if stress == "KelvinVoigt":
        G = rate * -np.expm1(-F1 * fine)
    else:
        G = effective_shear_rate(taylor(shapes(rate * SHEAR, (F1, F2, F2), fine)), F1, F2)
    power = (MU * G) ** (alpha / beta)
    dose = np.cumsum(0.5 * (power + np.concatenate([[0.0], power[:-1]]))) * fine[0]
    return np.asarray(A * np.interp(times, fine, dose) ** beta)


def cells(quick: bool) -> Outcome:
    """Haemolysis with a memory."""
    rows, curves = [], []
    n = 50
    for colour, stress in enumerate(cast("tuple[Cell, ...]", ("KelvinVoigt", "morphology"))):
        for rate, time in ((5000.0, 0.05), (20_500.0, 0.005)) if quick else (
            (5000.0, 0.05), (20_500.0, 0.005), (5000.0, 1.0), (42_000.0, 0.5),
        ):  # fmt: skip
            times = np.linspace(0.0, time, n + 1)[1:]
            ours, expected = _released("Giersiepen", stress, rate, time, n), _expected(stress, rate, times)
            name = f"{stress}: {rate:g} 1/s for {time:g} s, %"
            rows.append(Row(name, ours[-1], expected[-1], "equation of the cell", 1e-3, True))
            if time == 0.05:
                labels = f"foamprb, {stress}", "solve_ivp" if colour == 0 else ""
                curves += compared(times, ours, expected, labels, colour)
    fluid = 3.62e-5 * (MU * 5000.0) ** 2.416 * times_of(n) ** 0.785
    curves.append(Curve(times_of(n), fluid, "stress of the fluid", "guide"))
    for rate, time in ((5000.0, 1.0), (10_000.0, 0.1), (20_000.0, 0.05), (40_000.0, 0.05)):
        expected_share = _pores(rate, time)
        share = _released("pores", "KelvinVoigt", rate, time, 2000)[-1]
        name = f"pores: {rate:g} 1/s for {time:g} s, %"
        rows.append(Row(name, share, 100.0 * expected_share, "quadrature of A_p", 3e-3, True))
    for stress_of_fluid, time in MEASURED:
        share = _released("pores", "KelvinVoigt", stress_of_fluid / MU, time, 2000)[-1]
        law = POWER_LAWS["Ding"]
        measured = law.A * stress_of_fluid**law.alpha * time**law.beta
        name = f"pores: {stress_of_fluid:g} Pa for {time:g} s, %"
        rows.append(Row(name, share, measured, DING, relative=True, kind="measured"))
    figure = Figure(
        "haemolysis",
        "Release in simple shear of 5000 1/s by the constants of Giersiepen.",
        [Panel("t [s]", "haemolysis [%]", curves, "log")],
    )
    return Outcome(rows, [figure], [_REMARK])


def times_of(n: int) -> Floats:
    """Return n times up to 0.05 s."""
    return np.linspace(0.0, 0.05, n + 1)[1:]


def _pores(rate: float, time: float) -> float:
    """Return the share that pores release in a constant shear, with G = γ̇ (1 − exp(−f₁ t))."""
    polynomial = [-13.4134, 37.3125, -48.9149, 32.3921, 0.6332, -0.1593]

    def area(t: float) -> float:
        return float(np.polyval(polynomial, -rate * np.expm1(-F1 * t) / 42e3))

    opening = -np.log1p(-3750.0 / rate) / F1
    return float(2.187e-6 * (MU * rate) ** 0.9271 * quad(area, opening, time, epsrel=1e-10)[0])


_REMARK = (
    "In the first 0.05 s the damage of a cell with a memory is a hundredth of that by the fluid's stress. "
    "The references are solutions of the cells' equations, and the fit of Ding et al. to experiments with "
    "human blood. Pores release 0.6 to 2.3 times as much as measured."
)
