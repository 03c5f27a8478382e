"""Particles at their start, made in parts of any size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from paths import PIPE
from scipy import stats

from foamprb.cloud.block import Medium
from foamprb.cloud.injection import models
from foamprb.cloud.injection.distribution import Normal, RosinRammler, Uniform
from foamprb.cloud.injection.models import (
    BoxInjection,
    CellZoneInjection,
    ConeInjection,
    PatchFlowRateInjection,
    PatchInjection,
    SphereInjection,
)
from foamprb.cloud.injection.shapes import Ellipsoid, Sphere
from foamprb.cloud.state import concatenate
from foamprb.errors import InputError
from foamprb.flow.read.openfoam import read_case
from foamprb.run.release import Release
from foamprb.settings.injections import InjectionSettings, Solid

AIR = Medium(1.8e-5, 1.2, (0.0, -9.81, 0.0))
SIZES = Normal(3e-6, 8e-6, 5e-6, 1e-6)
CONE = ConeInjection((((0.1, 0.0, 0.0), (1.0, 0.0, 0.0)),), 0.01, 200.0, 1.0, 0.0, 20.0)
BOX = BoxInjection(min=(0.1, -0.002, -0.002), max=(0.2, 0.002, 0.002), number=300)


@pytest.fixture(scope="module")
def flow():
    return read_case(PIPE)


def injection(name, model, solid, sizes=SIZES, rho=1000.0, shape=Sphere()):  # noqa: B008
    return InjectionSettings(name, model, rho, solid, 0.0, sizes, shape)


INJECTIONS = (
    # The first Lamé parameter follows from the largest viscous stress around all particles.
    injection(
        "one", PatchInjection("inlet", 1e5, 0.005), Solid(type="neoHooke", shearModulus=Uniform(0.1, 1.0))
    ),
    injection(
        "two", CONE, Solid(type="neoHooke", poissonsRatio=0.49, shearModulus=1.0), rho=Uniform(900.0, 2000.0)
    ),
    injection(
        "three",
        BOX,
        Solid(
            type="neoHooke", bulkModulus=10.0, shearModulus=0.5, viscosity=RosinRammler(1e-3, 1e-2, 2e-3, 2.0)
        ),
        shape=Ellipsoid((2.0, 1.0, 0.5), "random"),
    ),
)


@pytest.mark.parametrize("most", [1, 7, 250])
def test_particles_do_not_depend_on_the_size_of_the_parts(most, flow, monkeypatch):
    whole = concatenate(Release(INJECTIONS, flow, AIR).parts())
    assert whole.size == 1000
    assert whole.number.tolist() == list(range(1000))
    monkeypatch.setattr("foamprb.cloud.communicator.PART", most)
    release = Release(INJECTIONS, flow, AIR)
    parts = list(release.parts(most))
    assert release.size == 1000
    assert max(part.size for part in parts) <= most
    for name, found, expected in zip(whole._fields, concatenate(parts), whole, strict=True):
        assert found.tobytes() == expected.tobytes(), name
    for name in ("R", "rho", "mu", "eta", "Ca", "lame", "v", "F0"):
        assert len(np.unique(getattr(whole, name)[~np.isnan(whole.t)], axis=0)) > 2, name


def test_particles_that_never_enter_are_not_made(flow):
    """The others, also their first Lamé parameter, are those of a run that lasts for longer."""
    injections = (INJECTIONS[1], INJECTIONS[0])
    whole = concatenate(Release(injections, flow, AIR).parts())
    release = Release(injections, flow, AIR, end=0.001)
    p = concatenate(release.parts(77))
    # 1e5 1/s enter for 5 ms; of the first model all are made.
    assert (release.late, p.size) == (400, whole.size - 400)
    assert (whole.t0[p.size :] >= 0.001).all()
    for name, found, expected in zip(p._fields, p, whole, strict=True):
        assert found.tobytes() == expected[: p.size].tobytes(), name


def test_the_draw_of_places_does_not_depend_on_the_size_of_its_parts(flow, monkeypatch):
    model = PatchInjection("inlet", 1e5, 0.005)
    whole = models.pending(model.places(flow, np.random.default_rng(1), None))
    monkeypatch.setattr("foamprb.cloud.communicator.PART", 7)
    again = models.pending(model.places(flow, np.random.default_rng(1), None))
    assert again.x.tobytes() == whole.x.tobytes()


def test_a_stiffness_that_is_no_number_is_reported(flow):
    solid = Solid(type="neoHooke", poissonsRatio=0.49, shearModulus=np.inf)
    with pytest.raises(InputError, match="one: the shear modulus of 5 of 5 particles is inf"):
        list(Release([injection("one", PatchInjection("inlet", 5.0, 1.0), solid)], flow, AIR).parts(5))


RADIUS = 2.1e-3
"""Of the pipe, m."""
WIDE = Uniform(8e-4, 1.4e-3)
"""Diameters of bodies, many of which would overlap the wall, m."""
SOFT = Solid(type="neoHooke", shearModulus=1.0)
FREELY = {
    "patch": PatchInjection("inlet", 1e5, 0.005),
    "rate": PatchFlowRateInjection("inlet", 1e9, 0.06),
    "box": BOX,
    "sphere": SphereInjection(origin=(0.1, 0.0, 0.0), radius=0.003, number=400),
    "zone": CellZoneInjection(3e8, selectionMode="all"),
}


def cleared(model, flow, sizes=WIDE, shape=Sphere()):  # noqa: B008
    model = replace(model, clearance=True)
    wall = [k for k, patch in enumerate(flow.patches) if patch.type == "wall"]
    return Release([injection("one", model, SOFT, sizes, shape=shape)], flow, AIR, walls=wall)


@pytest.mark.parametrize("name", FREELY)
def test_bodies_with_clearance_overlap_no_wall(name, flow, caplog):
    with caplog.at_level("INFO", "foamprb"):
        p = concatenate(cleared(FREELY[name], flow).parts())
    freely = concatenate(Release([injection("one", FREELY[name], SOFT, WIDE)], flow, AIR).parts())
    # The polygon of the wall is within its circle.
    outside = np.hypot(*freely.x[:, 1:].T) + freely.R > RADIUS
    assert (np.hypot(*p.x[:, 1:].T) + p.R < RADIUS).all()
    assert outside.sum() > 50
    # Sizes and times are those without clearance, and so are places with room, if all are drawn before.
    np.testing.assert_array_equal(p.R, freely.R)
    np.testing.assert_array_equal(p.t0, freely.t0)
    moved = (p.x != freely.x).any(axis=1)
    assert moved[outside].all()
    assert (
        name == "rate" or f"injection model one: {moved.sum()} of {p.size} places had no room" in caplog.text
    )


def test_places_with_room_keep_the_density_of_the_flux_and_depend_on_no_parts(flow, monkeypatch):
    model, d = PatchInjection("inlet", 2e5, 0.02), Uniform(1e-3, 1e-3 + 1e-12)
    shape = Ellipsoid((2.0, 1.0, 1.0), e1=(1.0, 0.0, 0.0))
    p = concatenate(cleared(model, flow, d, shape).parts())
    # Along the axis the section is a circle of this radius.
    r, most = np.hypot(*p.x[:, 1:].T), RADIUS - 5e-4 * 2.0 ** (-1.0 / 3.0)
    assert (r < most).all()

    def share(rho):
        return 2.0 * (rho / RADIUS) ** 2 - (rho / RADIUS) ** 4

    # Poiseuille's flux within r, over that within the free circle.
    assert stats.kstest(share(r) / share(most), "uniform").pvalue > 0.05
    monkeypatch.setattr("foamprb.cloud.communicator.PART", 77)
    again = concatenate(cleared(model, flow, d, shape).parts(31))
    assert again.x.tobytes() == p.x.tobytes()


def test_a_body_without_room_is_reported(flow):
    message = "one: clearance yes: a body of diameter 0.00.* m has no room at any of 1000 random places"
    with pytest.raises(InputError, match=message):
        cleared(PatchInjection("inlet", 50.0, 1.0), flow, Uniform(3e-3, 5e-3))
