"""What is reported of particles: the compiled formulas against the plain ones, whatever the share."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from foamprb import Cloud, Medium, analytic, set_rest_shape, spheres
from foamprb.body.ellipsoid import integrals, sorted_frame
from foamprb.body.tensor import (
    add,
    axial,
    det,
    dev,
    dot,
    from_frame,
    inverse,
    principal_frame,
    scale,
    skew,
    sym,
    to_frame,
)
from foamprb.body.traction import disturbance
from foamprb.cloud import measures
from foamprb.cloud.cloud import longest_semi_axis
from foamprb.cloud.measures import (
    MEASURES,
    context,
    contexts,
    flow_samples,
    measure,
    shape_stokes_number,
)
from foamprb.cloud.state import Particles, Status
from foamprb.results.shapes import DERIVED, derived

MU = 1.8e-5
N = 70
"""Two blocks of lanes and some lanes more."""


@pytest.fixture(scope="module")
def flow():
    return analytic.shear(200.0)


@pytest.fixture
def cloud() -> Particles:
    """Deformed particles of all kinds, at frames of their own, with pending ones among them."""
    random = np.random.default_rng(3)
    p = spheres(random.random((N, 3)), d=1e-6 * (1.0 + random.random(N)), rho=1000.0, mu=1.0)
    p.F[:] += 0.4 * random.standard_normal((N, 9))
    p.F[np.linalg.det(p.F.reshape(-1, 3, 3)) < 0.0] *= -1.0
    # Some like spheres, and some with frames that are not principal.
    p.F[3], p.F[4] = 1.1 * np.eye(3).ravel(), np.eye(3).ravel()
    p.F0[::2] = np.diag([2.0, 1.0, 0.5]).ravel()
    p.A[:] = 100.0 * random.standard_normal((N, 9))
    own, _ = principal_frame(tuple(p.F.T))
    p.Q[:] = np.stack(own, axis=1)
    p.Q[::5] = Rotation.random(len(p.Q[::5]), random_state=1).as_matrix().reshape(-1, 9)
    p.status[:] = Status.ACTIVE
    p.host[:] = 0
    p.status[[7, 40]] = Status.PENDING
    p.status[[8, 50]] = Status.STUCK
    return p


def test_measures_equal_the_plain_formulas(cloud, flow):
    found = measure(context(cloud, flow, MU, 0.0))
    rows = np.flatnonzero(cloud.status != Status.PENDING)
    p = cloud.take(rows)
    F, A = tuple(p.F.T), tuple(p.A.T)
    Q, stretches = sorted_frame(*principal_frame(F))
    l = tuple(flow.sample(p.x, p.host, 0.0)[1].reshape(-1, 9).T)
    body = dot(A, inverse(F))
    d = dev(add(sym(to_frame(Q, l)), scale(-1.0, sym(to_frame(Q, body)))))
    w = add(skew(to_frame(Q, l)), scale(-1.0, skew(to_frame(Q, body))))
    s, _ = disturbance(stretches, integrals(stretches), d, w)
    S = from_frame(Q, scale(4.0 / 3.0 * np.pi * p.R**3 * det(F) * MU, dev(sym(s))))
    expected = {
        "semiAxes": np.stack(stretches, axis=1) * p.R[:, None],
        "deformationGradient": np.stack(dot(F, inverse(tuple(p.F0.T))), axis=1),
        "J": det(F),
        "angularVelocity": np.stack(axial(skew(body)), axis=1),
        "stresslet": np.stack([S[0], S[4], S[8], S[1], S[5], S[2]], axis=1),
        "shearRate": np.full(len(rows), 200.0),
        "taylorDeformation": (stretches[0] - stretches[2]) / (stretches[0] + stretches[2]),
        "origId": rows,
        "U": p.v,
    }
    for name, values in expected.items():
        scale_of = np.abs(values[np.isfinite(values)]).max(initial=1e-300)
        np.testing.assert_allclose(found[name], values, rtol=1e-10, atol=1e-12 * scale_of, err_msg=name)


def test_orientation_turns_fixed_axes_onto_axes_of_the_particle(cloud, flow):
    found = measure(context(cloud, flow, MU, 0.0))
    q = found["orientation"]
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1.0, rtol=1e-14)
    assert (q[:, 0] >= 0.0).all()
    axes = Rotation.from_quat(q, scalar_first=True).as_matrix().transpose(0, 2, 1)
    F = cloud.F[found["origId"]].reshape(-1, 3, 3)
    b = axes @ F @ F.transpose(0, 2, 1) @ axes.transpose(0, 2, 1)
    R = cloud.R[found["origId"], None, None]
    diagonal = np.einsum("ni,ij->nij", (found["semiAxes"] / R[:, 0]) ** 2, np.eye(3))
    np.testing.assert_allclose(b, diagonal, atol=1e-11 * b.max())


def test_quaternion_is_that_of_any_rotation():
    turned = Rotation.random(1000, random_state=2)
    half = Rotation.from_rotvec(np.pi * np.eye(3))
    for rotation in (turned, half):
        Q = tuple(rotation.as_matrix().transpose(0, 2, 1).reshape(-1, 9).T)
        q = np.stack(measures.quaternion(Q), axis=1)
        back = Rotation.from_quat(q, scalar_first=True)
        assert (back * rotation.inv()).magnitude().max() < 1e-14


def test_circulation_is_the_frequency_of_points_on_a_steady_ellipsoid():
    """Material of semi-axes a and b that goes round with ν has l₁₂ = −ν a/b and l₂₁ = ν b/a."""
    a, b, nu = np.array([1.0, 1.5, 4.0]), np.array([1.0, 0.7, 0.3]), np.array([2.0, 0.5, 1e-6])
    l = np.zeros((3, 3, 3))
    l[:, 0, 1], l[:, 1, 0] = -nu * a / b, nu * b / a
    # Beside it, the body may change its width.
    l[:, 2, 2] = [0.0, 0.3, 0.0]
    turns = Rotation.random(3, random_state=3).as_matrix()
    turned = turns @ l @ turns.transpose(0, 2, 1)
    found = measures.circulation(tuple(turned.reshape(3, 9).T))
    np.testing.assert_allclose(found, nu, rtol=1e-12)
    assert measures.circulation(tuple(np.zeros(9))) == 0.0


@pytest.mark.parametrize("size", [1, 5, 33])
def test_a_few_at_a_time_are_the_same_bits(cloud, flow, size, monkeypatch):
    whole = measure(context(cloud, flow, MU, 0.0))
    monkeypatch.setattr(measures, "PER_CONTEXT", size)
    parts = [measure(c) for c in contexts(cloud, flow, MU, 0.0)]
    assert len(parts) == measures.number_of_contexts(N - 2)
    kept = [measure(c) for c in contexts(cloud, flow_samples(cloud, flow, 0.0), MU, 0.0)]
    for name in MEASURES:
        for found in (parts, kept):
            assert np.concatenate([part[name] for part in found]).tobytes() == whole[name].tobytes(), name


def test_shares_of_a_cloud_are_the_same_bits(cloud, flow):
    whole = measure(context(cloud, flow, MU, 0.0))
    for first in range(3):
        ids = np.arange(first, N, 3)
        share = measure(context(cloud.take(ids), flow, MU, 0.0, ids))
        rows = np.isin(whole["origId"], ids)
        for name, values in share.items():
            assert values.tobytes() == whole[name][rows].tobytes(), name


def test_velocity_of_the_fluid_contains_eddies(cloud, flow):
    cloud.eddy[:] = np.random.default_rng(1).standard_normal((N, 3))
    found = measure(context(cloud, flow, MU, 0.0))
    p = cloud.take(found["origId"])
    np.testing.assert_array_equal(found["Uc"], flow.sample(p.x, p.host, 0.0)[0] + p.eddy)
    np.testing.assert_array_equal(found["Ur"], found["U"] - found["Uc"])


@pytest.mark.parametrize("name", MEASURES)
def test_one_measure_alone_is_the_same_bits(cloud, flow, name):
    """The flow is sampled only for measures that depend on it."""

    class Sampled:
        n = 0

        def sample(self, *arguments):
            self.n += 1
            return flow.sample(*arguments)

    counted = Sampled()
    alone = measure(context(cloud, counted, MU, 0.0), [name])
    assert counted.n == MEASURES[name].of_flow
    assert alone[name].tobytes() == measure(context(cloud, flow, MU, 0.0))[name].tobytes()


def test_arrays_derived_from_a_file_are_the_measures(cloud, flow):
    """The frame is another one if two axes are equal, and its axes may have other signs."""
    cloud.F0[:] = np.eye(3).ravel()
    found = measure(context(cloud, flow, MU, 0.0))
    values = derived(found["glyph"], found["d"], found["status"], tuple(DERIVED))
    for name in ("active", "deformationGradient", "semiAxes", "taylorDeformation", "J"):
        np.testing.assert_allclose(values[name], found[name], rtol=1e-12, atol=1e-13 * np.max(found[name]))
        assert DERIVED[name] == (MEASURES[name].unit, found[name][0].size)
    axes = Rotation.from_quat(values["orientation"], scalar_first=True).as_matrix()
    F = found["deformationGradient"].reshape(-1, 3, 3)
    stretches = values["semiAxes"] / (0.5 * found["d"][:, None])
    b = axes @ (stretches[:, :, None] ** 2 * axes.transpose(0, 2, 1))
    np.testing.assert_allclose(b, F @ F.transpose(0, 2, 1), atol=1e-12 * b.max())
    assert (values["orientation"][:, 0] >= 0.0).all()


def test_measures_of_no_particles_are_empty(cloud, flow):
    cloud.status[:] = Status.PENDING
    (c,) = contexts(cloud, flow, MU, 0.0)
    assert {len(values) for values in measure(c).values()} == {0}


def test_where_the_flow_is_unknown_so_is_the_load(cloud, flow):
    cloud.host[5] = -1
    cloud.x[6, 1] = np.nan
    found = measure(context(cloud, flow, MU, 0.0))
    for values in (found["shearRate"], found["Uc"][:, 0], found["Ur"][:, 2]):
        assert np.isnan(values).tolist() == [row in (5, 6) for row in found["origId"]]
    assert np.isfinite(found["semiAxes"]).all()


def test_longest_semi_axis_is_that_of_moving_particles(cloud):
    _, stretches = principal_frame(tuple(cloud.F.T))
    lengths = np.max(stretches, axis=0) * cloud.R
    lengths[cloud.status > Status.ACTIVE] = 0.0
    assert lengths.max() * (1.0 - 1e-13) <= longest_semi_axis(cloud) <= np.sqrt(2.0) * lengths.max()
    cloud.status[:] = Status.ESCAPED
    assert longest_semi_axis(cloud) == 0.0


@pytest.mark.parametrize("threads", [1, 3])
def test_snapshot_is_a_copy(flow, threads):
    p = spheres(np.zeros((3, 3)), d=1e-6, rho=1000.0, mu=1.0)
    cloud = Cloud(p, flow, Medium(MU, 1.0, (0.0, 0.0, 0.0)), [], 1e-5, threads=threads)
    cloud.advance(1)
    snapshot = cloud.snapshot()
    before = [array.copy() for array in snapshot.particles]
    cloud.advance(3)
    assert all(np.array_equal(a, b, equal_nan=True) for a, b in zip(before, snapshot.particles, strict=True))
    assert not np.array_equal(snapshot.particles.F, cloud.particles.F)
    # What stays as it is needs no memory twice, and the next copy none of its own.
    assert snapshot.particles.x0 is cloud.particles.x0
    assert snapshot.particles.F0 is cloud.particles.F0
    assert snapshot.particles.eddy is cloud.particles.eddy
    again = cloud.snapshot(snapshot)
    assert again.particles.F is snapshot.particles.F
    assert np.array_equal(again.particles.F, cloud.particles.F)
    assert (snapshot.step, again.step) == (1, 4)


def test_the_shape_stokes_number_is_the_largest_shear_rate_times_relaxation_time():
    """γ̇ τ_s with τ_s = ρ R²/(15 μ_f) of a body without viscosity; twice the rate is twice the number."""
    p = spheres(np.zeros((2, 3)), d=[2e-3, 4e-3], rho=900.0, mu=1.0)
    p.host[:] = 0
    for rate in (3.0, 6.0):
        found = shape_stokes_number(p, analytic.shear(rate), 0.05, 0.0)
        assert found == pytest.approx(rate * 900.0 * 4e-6 / (15.0 * 0.05), rel=1e-9)


def test_the_deformation_of_particles():
    p = spheres(np.zeros((2, 3)), d=1e-5, rho=1e3, mu=1.0)
    set_rest_shape(p, [[2.0, 1.0, 0.5], [1.0, 1.0, 1.0]])
    np.testing.assert_allclose(p.D, [0.6, 0.0], atol=1e-15)
