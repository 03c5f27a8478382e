"""Bodies along given histories of velocity gradients."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from foamprb.cloud import histories
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.histories import along_history
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

OIL = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
SHEAR = np.array([[0.0, 80.0, 0.0], [0.0, 0.0, 20.0], [0.0, 0.0, 0.0]])
SPIN = np.array([10.0, -20.0, 30.0])


def soft(n):
    return spheres(np.zeros((n, 3)), d=1e-5, rho=1000.0, mu=0.3, poissons_ratio=0.4999)


def test_constant_histories_are_linear_flows(monkeypatch):
    """Whatever the time of the start, and though they are computed in parts."""
    t, rates = 3.0 + np.linspace(0.0, 0.05, 26), np.array([1.0, 0.2, 0.7])
    l = np.broadcast_to(rates[:, None, None, None] * SHEAR, (3, 26, 3, 3))
    monkeypatch.setattr(histories, "_BYTES", 2 * 72 * 26)
    found = along_history(t, l, soft(3), OIL, every=5)
    assert found.shape == (3, 6, 3, 3)
    for k, rate in enumerate(rates):
        p = soft(1)
        cloud = Cloud(p, analytic.linear(rate * SHEAR), OIL, (), 2e-3, Models(stride=5))
        for _ in range(5):
            cloud.advance(5)
        np.testing.assert_allclose(found[k, -1], p.F.reshape(3, 3), rtol=1e-9, atol=1e-9)


def test_bodies_that_come_from_another_flow_have_their_own_histories():
    """And not that of the place where they were: the same bits as each alone."""
    p, rates, models = soft(3), np.array([1.0, 0.2, 0.7]), Models(stride=1)
    Cloud(p, analytic.linear(SHEAR), OIL, (), 2e-3, models).advance(10)
    l = np.broadcast_to(rates[:, None, None, None] * SHEAR, (3, 11, 3, 3))
    found = along_history(np.linspace(0.02, 0.04, 11), l, p, OIL)
    np.testing.assert_array_equal(found[:, 0], p.F.reshape(3, 3, 3))
    for k in range(3):
        alone = along_history(np.linspace(0.02, 0.04, 11), l[k : k + 1], p.take(np.array([k])), OIL)
        np.testing.assert_array_equal(found[k], alone[0])


def test_histories_in_a_turning_frame_turn_the_shapes_to_second_order():
    """l' = Ω + Q·l·Qᵀ gives F' = Q·F: elasticity is objective."""
    p, exact, errors = soft(1), Models(tolerance=1e-8), []
    for n in (50, 100):
        t = np.linspace(0.0, 0.05, n + 1)
        Q = Rotation.from_rotvec(t[:, None] * SPIN).as_matrix()
        W = np.cross(np.eye(3), -SPIN).T
        still = along_history(t, np.broadcast_to(SHEAR, (1, n + 1, 3, 3)), p, OIL, exact)[0]
        turned = along_history(t, (W + Q @ SHEAR @ Q.transpose(0, 2, 1))[None], p, OIL, exact)[0]
        errors.append(np.abs(turned - Q @ still).max())
    assert errors[0] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_steps_over_many_times_meet_the_tolerance():
    """The same line through few times, and through many that steps span: with a kink, at which they end."""
    rates = np.interp(np.linspace(0.0, 0.1, 1601), [0.0, 0.0625, 0.1], [0.0, 3.0, -1.0])
    l, ends = rates[:, None, None] * SHEAR, []
    for every in (1, 100):
        few = l[None, ::every]
        ends.append(
            along_history(np.linspace(0.0, 0.1, len(few[0])), few, soft(1), OIL, Models(tolerance=1e-6), 16)
        )
    np.testing.assert_allclose(ends[0][0, -1], ends[1][0, -1], atol=1e-5)


@pytest.mark.filterwarnings("ignore::foamprb.errors.FailedParticlesWarning")
def test_a_body_that_fails_has_no_shape_from_then_on():
    """Extension without end tears a body that is too soft for it."""
    rate = np.linspace(0.0, 3e3, 101)
    l = rate[None, :, None, None] * np.diag([1.0, -0.5, -0.5])
    F = along_history(np.linspace(0.0, 0.1, 101), np.concatenate([l, 0.0 * l]), soft(2), OIL)
    lost = np.isnan(F[0]).any(axis=(1, 2))
    assert not lost[0]
    assert lost[-1]
    assert (np.diff(lost.astype(int)) >= 0).all()
    np.testing.assert_allclose(F[1], np.broadcast_to(np.eye(3), F[1].shape), atol=1e-12)


@pytest.mark.parametrize(
    ("times", "shape", "fault"),
    [
        ([0.0, 1.0, 3.0], (1, 3, 3, 3), "differ by up to 0.5 s from steps of 1.5 s"),
        ([0.0, 1.0], (1, 3, 3, 3), r"Allowed: \(1, 2, 3, 3\)"),
        ([0.0], (1, 1, 3, 3), "m of at least 2"),
        ([], (1, 0, 3, 3), "m of at least 2"),
        ([0.0, 1.0], (2, 2, 3, 3), r"Allowed: \(1, 2, 3, 3\)"),
    ],
)
def test_histories_that_do_not_fit_are_refused(times, shape, fault):
    with pytest.raises(InputError, match=fault):
        along_history(times, np.zeros(shape), soft(1), OIL)
    gradients = np.zeros((1, 2, 3, 3))
    gradients[0, 1, 2, 0] = np.nan
    with pytest.raises(InputError, match="1 numbers are not finite"):
        along_history([0.0, 1.0], gradients, soft(1), OIL)
    with pytest.raises(InputError, match="every is 0"):
        along_history([0.0, 1.0], np.zeros((1, 2, 3, 3)), soft(1), OIL, every=0)
