"""The T-junction run live: who takes which branch, against how the flow divides."""

from __future__ import annotations

import numpy as np
import pytest
from figures import t_junction
from paths import ROOT

from foamprb.cli import main

pytestmark = pytest.mark.openfoam

CASE = ROOT / "cases/tJunction"
FLOW, SHARE = 1e-10, 0.5
STIFF, SOFT = 0.001, 0.1
BAND = 2e-6
"""About the dividing streamline, m: a bead so close to it may creep along the wall for seconds."""


@pytest.fixture(scope="module")
def lines(job):
    """Fates of stiff and of soft beads from one line across the channel, as far as a bead has room."""
    y = np.arange(-38e-6, 38.5e-6, 2e-6)
    starts = np.column_stack([y, np.zeros_like(y)])
    return y, t_junction.send(job, starts, STIFF), t_junction.send(job, starts, SOFT)


def test_settings_hold(live):
    assert main(["run", "-case", str(live), "-dry-run"]) == 0


def test_flow_enters_leaves_and_divides_as_prescribed(live):
    rates = t_junction.flow_rates(live)
    assert rates["inlet"] == pytest.approx(-FLOW, rel=1e-9)
    assert rates["side"] == pytest.approx(SHARE * FLOW, rel=1e-9)
    assert sum(rates.values()) == pytest.approx(0.0, abs=1e-6 * FLOW)


def test_the_flow_is_developed_where_beads_start(job):
    """The peak of a square duct is 2.096 times the mean (Shah and London 1978); the coarse mesh cuts 2 %."""
    assert t_junction.speeds(job, np.zeros((1, 2)))[0] == pytest.approx(2.096e-2, rel=0.03)


@pytest.mark.parametrize("Ca", [STIFF, SOFT])
def test_beads_as_frequent_as_the_flux_divide_as_the_flow(job, Ca):
    n = 1000
    patch = t_junction.send(job, t_junction.random_by_flux(job, n), Ca).patch
    straight, side, wall, under_way, failed = (
        np.count_nonzero(patch == name) for name in ("straight", "side", "wall", "", "failed")
    )
    assert failed == 0
    assert straight + side + wall + under_way == n
    error = np.sqrt(n * SHARE * (1.0 - SHARE))
    assert abs(side - SHARE * n) < 2.0 * error
    assert abs(straight - (1.0 - SHARE) * n) < 2.0 * error
    assert wall + under_way < 0.02 * n


def test_stiff_and_soft_take_the_same_branch_away_from_the_dividing_streamline(lines):
    y, stiff, soft = lines
    edge = (y[stiff.patch == "straight"].max() + y[stiff.patch == "side"].min()) / 2.0
    far = np.abs(y - edge) > BAND
    expected = np.where(y < edge, "straight", "side")
    assert set(expected[far]) == {"straight", "side"}
    for fates in (stiff, soft):
        np.testing.assert_array_equal(fates.patch[far], expected[far])


def test_deformation_in_the_junction_is_what_tells_them_apart(lines):
    """Small strains are proportional to Ca; the soft bead's are not small, and it has a history."""
    _, stiff, soft = lines
    assert (stiff.D > 0.0).all()
    assert (stiff.D < 0.02).all()
    assert (soft.D > 20.0 * stiff.D).all()
    assert (soft.D < 1.0).all()
