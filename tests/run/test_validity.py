"""Largest values on the paths of a cloud, and particles that are beyond the model."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.cloud.state import Status, spheres
from foamprb.cloud.surroundings.largest import LARGEST
from foamprb.cloud.tracker import Models
from foamprb.run.validity import PathRecord, are_curved, path_values, warnings_of

N = 100


def bodies(D=0.1, curvature=0.0, **material):
    """Active bodies that were sheared at 10 1/s in water, with the same largest D and mean curvature."""
    p = spheres(np.zeros((N, 3)), d=1e-5, rho=1000.0, mu=1.0, **material)
    p.status[:], p.number[:] = Status.ACTIVE, np.arange(N)
    p.largest[:, LARGEST.D], p.largest[:, LARGEST.shear_rate], p.largest[:, LARGEST.shear_stress] = (
        D,
        10.0,
        0.01,
    )
    p.curved[:] = np.stack([np.broadcast_to(curvature, N), np.ones(N), np.ones(N)], axis=1)
    return p


def record(p, models, parts=1):
    rows = np.array_split(np.random.default_rng(0).permutation(N), parts)
    return PathRecord.total([PathRecord.of(p.take(k), 1000.0, models) for k in rows])


def warnings(record, material="neoHooke"):
    return warnings_of(record.n, record.beyond, material)


def test_particles_beyond_the_largest_compared_deformation_are_named():
    D = np.full(N, 0.2)
    D[[7, 40, 41]] = 0.95, 0.31, 0.99
    solid, capsule = (warnings(record(bodies(D), Models(material=m)), m) for m in ("neoHooke", "capsule"))
    assert solid[0].startswith("2 of 100 particles reached D beyond 0.94")
    assert "particles 7, 41 (" in solid[0]
    assert "particles 7, 40, 41 (" in capsule[0]
    assert warnings(record(bodies(0.2), Models())) == []


def test_compressed_membranes_are_counted():
    """In shear neo-Hookean ones are, those that keep their area are not."""
    p = bodies()
    p.F[:3, [0, 4]] = 1.4, 1.0 / 1.4
    (text,) = record(p, Models(material="capsule neoHookean"), 3).warnings("capsule neoHookean")
    assert text.startswith("3 of 100 capsules have a membrane that is compressed at the end, by up to 0.2")
    skalak = record(p, Models(material="capsule Skalak 10"))
    assert skalak.warnings("capsule Skalak 10") == []
    assert not any("bullet" in line for line in skalak.lines(affine=True))


def test_a_record_is_the_same_for_any_distribution_of_the_particles():
    p = bodies(np.linspace(0.0, 0.99, N), np.linspace(0.0, 0.3, N))
    whole, parts = (record(p, Models(), n) for n in (1, 7))
    assert whole.lines(affine=True) == parts.lines(affine=True)
    assert warnings(whole) == warnings(parts)
    assert whole.lines(affine=True)[0].endswith("at most 0.99")
    median = float(whole.lines(affine=True)[0].split("50 % below ")[1].split(",")[0])
    assert median == pytest.approx(0.49, rel=0.03)


def test_affine_bodies_in_a_curved_flow_get_the_proposal_of_the_quadratic_mode():
    """More than 5 % of them over a curvature number of 0.1, or 1 % over 1."""
    six, axis = np.where(np.arange(N) < 6, 0.2, 0.0), np.where(np.arange(N) < 2, 2.0, 0.0)
    assert (
        "6 of 100 particles have curvature numbers over 0.1; 0 of them"
        in record(bodies(curvature=six), Models()).advice()
    )
    assert (
        "2 of 100 particles have curvature numbers over 0.1; 2 of them"
        in record(bodies(curvature=axis), Models()).advice()
    )
    assert record(bodies(curvature=np.where(np.arange(N) < 5, 0.2, 0.0)), Models()).advice() == ""
    assert [are_curved(numbers) for numbers in (six, axis, 0.4 * six)] == [True, True, False]


def test_pending_particles_have_no_values_and_stuck_ones_no_gap():
    p = bodies()
    p.largest[:, LARGEST.closeness] = 0.5
    p.status[:2] = Status.PENDING, Status.STUCK
    gap = path_values(p, 1000.0, False)["minGap"]
    assert np.isnan(gap[0])
    assert gap[1:3].tolist() == [0.0, 1.0]
    assert record(p, Models()).n == N - 1


def test_particles_that_were_not_sampled_do_no_harm():
    p = bodies()
    p.curved[:] = 0.0
    lines = record(p, Models()).lines(affine=True)
    assert not any("nan" in line for line in lines)
