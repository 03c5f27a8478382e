"""Reynolds and Stokes numbers of slip over a run."""

from __future__ import annotations

import logging
from types import SimpleNamespace

import numpy as np
import pytest

from foamprb import Medium, analytic, spheres
from foamprb.cloud.cloud import Cloud
from foamprb.run import slip
from foamprb.run.log import RunLog
from foamprb.run.slip import Slip, drag_excess, slip_of

WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
RATE, D, RHO = 100.0, 1e-4, 2500.0


def sliding(speeds):
    """Active particles where the fluid of a simple shear is at rest, with these velocities."""
    p = spheres(np.zeros((len(speeds), 3)), d=D, rho=RHO, mu=10.0)
    cloud = Cloud(p, analytic.shear(RATE), WATER, (), 1e-3)
    p.v[:, 0], p.status[:], p.host[:] = speeds, 1, 0
    return cloud


def largest_in(cloud):
    return cloud.map_in_flow(slip_of, WATER, cloud.size)[0]


def test_largest_of_both_numbers():
    assert Slip().lines() == []
    largest = Slip()
    # 0.1 m/s of 1e-4 m in water are a Reynolds number of 10.
    for speeds in np.array_split(np.repeat([1e-5, 1.01e-4, 0.1], [10, 995, 5]), 8):
        largest = largest.or_more(largest_in(sliding(speeds)))
    assert largest == pytest.approx((10.0, RATE * RHO * D**2 / (18.0 * WATER.mu)))
    assert largest.lines() == [
        "Reynolds number of slip  at most 10; the drag of a sphere is 73 % more than Stokes'",
        "Stokes number            at most 0.139",
    ]


def test_of_a_large_cloud_some_particles_are_compared(monkeypatch):
    """Those of evenly spread numbers, on whichever process they are."""
    monkeypatch.setattr(slip, "_MOST", 20)
    assert largest_in(sliding(np.repeat([1e-4, 0.1], [990, 10]))).reynolds == pytest.approx(1e-2)


def test_further_turns_compare_the_others(monkeypatch):
    monkeypatch.setattr(slip, "_MOST", 20)
    cloud = sliding(np.repeat([1e-4, 0.1, 1e-4], [502, 1, 497]))
    largest = [cloud.map_in_flow(slip_of, WATER, cloud.size, turn)[0].reynolds for turn in range(50)]
    assert max(largest) == pytest.approx(10.0)
    assert sum(value > 1.0 for value in largest) == 1


def test_the_velocity_of_its_eddy_is_no_slip_of_a_particle():
    cloud = sliding([0.1])
    cloud.particles.eddy[:, 0] = 0.09
    assert largest_in(cloud).reynolds == pytest.approx(1.0)


def test_drag_of_a_sphere_exceeds_that_of_stokes():
    assert drag_excess(0.1) == pytest.approx(0.0308, abs=1e-4)


def test_a_large_reynolds_number_is_warned_of_once(caplog):
    cloud = sliding([1e-4])
    log = RunLog(SimpleNamespace(cloud=cloud))
    with caplog.at_level(logging.WARNING, "foamprb"):
        log._log_slip()
        assert not caplog.records
        cloud.particles.v[:, 0] = 0.01
        log._log_slip()
        log._log_slip()
    (record,) = caplog.records
    assert "slip exceeds 0.1: drag is that of Stokes flow, which is 3.1 % or more too small" in record.message
    assert "at most 1; the drag of a sphere is 15 % more than Stokes'" in log._slip.lines()[0]
