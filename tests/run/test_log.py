"""What the log says of a run: how far it is, how steps are cut, and what does not fit before it begins."""

from __future__ import annotations

import logging
import re
import time
from types import SimpleNamespace

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from paths import PIPE
from small_clouds import box_cloud

import foamprb
import foamprb.run.log as log_module
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.forces import DuctLift
from foamprb.cloud.measures import path_stokes_number
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import Status, drops, spheres, with_relaxation
from foamprb.cloud.surroundings.largest import LARGEST
from foamprb.cloud.tracker import Models
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.run import log
from foamprb.run.checks import (
    dimensionless_groups,
    doubtful_lengths,
    extension_rates,
    outside_flow,
    validity_warnings,
)
from foamprb.run.description import describe

OIL = Medium(1.0, 1000.0, (0.0, 0.0, 0.0))


def flow_of(gradient):
    shape = block(2, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    l = np.asarray(gradient, dtype=float)
    return MeshFlow(mesh, mesh.nodes @ l.T, np.broadcast_to(l, (len(mesh.nodes), 3, 3)))


def warnings_in(gradient, Ca, ratio=None, relaxing=0.0, tension=0.0):
    """Warnings of a solid, or of a drop of this ratio of the viscosities.

    Nine tenths of the solid's modulus relax if ``relaxing`` is nine; ``tension`` is γ/R over the modulus.
    """
    flow, x = flow_of(gradient), np.full((1, 3), 0.5)
    if ratio is None:
        p, material = spheres(x, d=1e-4, rho=1000.0, mu=1.0 / Ca / (1.0 + relaxing)), "neoHooke"
        p.gamma[:] = tension * p.mu * p.R
        if relaxing:
            p = with_relaxation(p, [relaxing * p.mu[0]], [1.0])
    else:
        p, material = drops(x, d=1e-4, rho=1000.0, gamma=5e-5 / Ca, eta=ratio), "drop"
    models = Models(integrator="stokes", material=material)
    cloud = Cloud(p, flow, OIL, [Stick()] * len(flow.patches), 1e-3, models)
    return warnings_about(cloud, liquid=ratio is not None)


def warnings_about(cloud, liquid=False):
    return validity_warnings(
        dimensionless_groups(cloud, 0, extension_rates(cloud.flow)), "stokes", "it", liquid
    )


def test_a_viscous_liquid_wrinkles_membranes():
    flow = flow_of(np.zeros((3, 3)))
    p = spheres(np.full((2, 3), 0.5), d=1e-4, rho=1000.0, mu=1.0, eta=[4.0, 8.0])
    g = dimensionless_groups(
        Cloud(p, flow, OIL, [Stick()] * len(flow.patches), 1e-3, Models(integrator="stokes")), 0, np.empty(0)
    )
    (text,) = validity_warnings(g, "stokes", "it", membrane=True)
    assert "8 times as viscous" in text
    assert validity_warnings(g, "stokes", "it") == []


def test_progress_lines_give_the_time_left(caplog, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(log.clock, "perf_counter", lambda: now[0])
    with caplog.at_level(logging.INFO, "foamprb"), log.progress_bar(1.0, 3.0) as show:
        for now[0], t in ((5.0, 1.0), (15.0, 1.1), (45.0, 1.5), (60.0, 1.6), (80.0, 2.0)):
            show(t)
    # What came before the first call, such as compiling, does not count: 0.5 s in 40 s, then 1 s in 75 s.
    assert caplog.messages == [
        "t = 1.5 s, 25 % of the run, about 2 min left",
        "t = 2 s, 50 % of the run, about 75 s left",
    ]


def test_round_off_is_shown_as_zero(caplog):
    caplog.set_level(logging.INFO, "foamprb")
    for ends in ((3e-17, 0.97), (-3e-17, 2e-16), (2e-12, 1.0)):
        log_module._log_range("|U|", ends)
    assert [message.split("|U|")[1].strip() for message in caplog.messages] == [
        "0 to 0.97", "0", "2e-12 to 1"
    ]  # fmt: skip


def test_extension_beyond_steady_shapes_is_a_doubt_and_shear_is_none():
    rate = 1.0 / np.sqrt(3.0)
    extension = np.diag([rate, -rate / 2, -rate / 2])
    (text,) = warnings_in(extension, 0.4)
    assert "in 100 % of the flow" in text
    assert "no steady shape" in text
    assert warnings_in(extension, 0.25) == []
    assert warnings_in([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], 10.0) == []
    # Of a solid with memory the modulus that stays counts.
    assert len(warnings_in(extension, 0.04, relaxing=9.0)) == 1
    assert warnings_in(extension, 0.025, relaxing=9.0) == []
    # Surface tension holds a body, too.
    assert warnings_in(extension, 0.5, tension=5.0) == []
    assert len(warnings_in(extension, 1.5, tension=5.0)) == 1


@pytest.mark.parametrize(("ratio", "critical"), [(0.1, 0.51909), (1.0, 0.59795), (2.0, 0.87803)])
def test_shear_beyond_breakup_is_a_doubt_for_drops(ratio, critical):
    """Critical numbers of the equation of Maffettone and Minale; from a ratio of 4 on drops never break."""
    shear = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    (text,) = warnings_in(shear, 1.001 * critical, ratio)
    assert "in 100 % of the flow a drop has no steady shape" in text
    assert warnings_in(shear, 0.999 * critical, ratio) == []
    assert warnings_in(shear, 10.0, 4.0) == []


def test_steps_of_the_last_tracking_step_are_counted(caplog):
    cloud = box_cloud("stokes")
    Stepper(cloud).advance(3)
    moved = (cloud.particles.status == 1) & (cloud.particles.substeps > 0)
    job = type("Job", (), {"cloud": cloud})
    with caplog.at_level(logging.INFO, "foamprb"):
        log.RunLog(job)._log_steps()
    steps = cloud.particles.substeps[moved]
    assert f"= {1.0 / steps.mean():.3g} deltaT, at most {steps.max():.3g} steps" in caplog.messages[0]
    assert caplog.messages[1].endswith("%")


def test_clocks_begin_with_the_program(caplog, monkeypatch):
    monkeypatch.setattr(foamprb, "started", time.perf_counter() - 398.0)
    job = type("Job", (), {"cloud": box_cloud("stokes")})
    with caplog.at_level(logging.INFO, "foamprb"):
        log.RunLog(job)._log_clocks()
    cpu, wall = map(float, re.findall(r"= (\S+) s", caplog.messages[0]))
    assert 398.0 <= wall < 400.0
    assert cpu == pytest.approx(time.process_time(), abs=1.0)


@pytest.mark.parametrize(
    ("seconds", "text"), [(59.0, "59 s"), (600.0, "10 min"), (7.3e3, "2 h"), (4e5, "5 days")]
)
def test_durations(seconds, text):
    assert log._duration(seconds) == text


def falling(width, v=(np.nan, np.nan, np.nan), g=-9.81, G=1.0):
    """A sphere of 1 mm and 1000 kg/m3 in air at rest of this width: τ_p = 3.09 s, settling speed 30.3 m/s."""
    shape = block(2, 0.0)
    shape.points = shape.points * width
    mesh = build_mesh(shape, box_patches(shape))
    nodes = np.zeros((len(mesh.nodes), 3))
    flow = MeshFlow(mesh, nodes, np.zeros((len(nodes), 3, 3)))
    p = spheres(np.full((1, 3), 0.5 * width), d=1e-3, rho=1000.0, mu=G)
    p.v[:] = v
    air = Medium(1.8e-5, 1.2, (0.0, 0.0, g))
    return Cloud(p, flow, air, [Stick()] * len(flow.patches), 1e-3, Models(integrator="auto"))


def test_bodies_that_glide_far_keep_their_inertia():
    """A fluid at rest has no shear rate, but drag stops these bodies within 93 m."""
    tau = 2.0 * 1000.0 * 0.5e-3**2 / (9.0 * 1.8e-5)
    cloud = falling(1.0)
    number = path_stokes_number(cloud.particles, cloud.flow, cloud.medium, 0.0)
    assert number == pytest.approx(tau**2 * 9.81 * (1.0 - 1.2e-3), rel=1e-9)
    assert cloud.models.integrator == "rosenbrock"
    assert falling(1.0, g=-1e-4).models.integrator == "stokes"
    # With 1 m/s they stop within 3 m.
    assert falling(1.0, v=(1.0, 0.0, 0.0), g=0.0).models.integrator == "rosenbrock"
    assert falling(1000.0, v=(1.0, 0.0, 0.0), g=0.0).models.integrator == "stokes"
    (text,) = warnings_about(cloud)
    assert "drag stops the particles within 93.3 times the width of the flow" in text


def test_a_modulus_that_round_off_limits_is_a_doubt():
    (text,) = warnings_about(falling(1.0, g=0.0, G=1e7))
    assert "the shear modulus is 5.6e+08 times mu/deltaT" in text
    assert warnings_about(falling(1.0, g=0.0, G=1e5)) == []


def test_planes_and_ducts_that_miss_the_flow_are_named():
    """A unit cube; of a slanted plane, the corners decide."""
    flow = SimpleNamespace(bounds=(np.zeros(3), np.ones(3)))
    duct = {"direction": (1.0, 0.0, 0.0), "size": 0.5, "shearRate": 1.0}

    def missed(origin, normal, shape, at):
        functions = {"camera": SimpleNamespace(origin=origin, normal=normal)}
        forces = {"ductLift": DuctLift(shape=shape, origin=at, **duct)}
        return outside_flow(SimpleNamespace(functions=functions, forces=forces), flow)

    assert missed((9.0, 9.0, 1.0), (0.0, 0.0, -2.0), "pipe", (9.0, 0.5, 0.5)) == []
    assert missed((1.4, 1.5, 0.0), (1.0, 1.0, 1.0), "channel", (0.5, 9.0, 9.0)) == []
    plane, middle = missed((1.6, 1.5, 0.0), (1.0, 1.0, 1.0), "pipe", (0.5, 0.5, 1.1))
    assert plane == "cloudFunctions/camera: its plane misses the flow, which is in (0 0 0) to (1 1 1) m."
    assert middle.startswith("particleForces/ductLift: its axis or middle plane misses the flow")


def test_a_channel_of_mm_read_as_m_is_told():
    """Of 1 mm and 10 mm/s of water, bodies of 10 um in cells of 20 um; no flow of eddies has such limits."""
    speed = SimpleNamespace(u=np.array([[0.02, 0.0, 0.0]]))

    def told(width, size, *notes):
        flow = SimpleNamespace(width=width, notes=notes, at_some_nodes=lambda: speed)
        fluid = SimpleNamespace(nu=1e-6, varying=None)
        settings = SimpleNamespace(dispersion={}, solution=SimpleNamespace(transient=False), fluid=fluid)
        return doubtful_lengths(settings, SimpleNamespace(flow=flow), size)

    assert told(1e-3, 0.5) == []
    (text,) = told(1.0, 5e-4)
    assert text.startswith(
        "the flow has bodies of 0.0005 cells and a Reynolds number of 2e+04 in a laminar flow of 1 m"
    )
    assert (
        told(1.0, 5e-4, "the flow is the mean or the resolved part of a turbulent one (there is nut)") == []
    )


def test_warnings_of_validity_are_in_the_log_and_in_the_record(caplog):
    """Before the run and at its end."""
    job = foamprb.prepare(PIPE, overrides={"solution/endTime": 1e-3})
    job.description["warnings"][:] = ["first", "second"]
    with caplog.at_level("WARNING", "foamprb"):
        log.log_description(job)
        job.cloud.particles.largest[:, LARGEST.D] = 0.95
        job.cloud.particles.status[:] = Status.ACTIVE
        end = log.RunLog(job)
        end._log_paths()
    beyond = end.warnings_at_end()[0]
    assert "reached D beyond 0.94" in beyond
    assert [record.message for record in caplog.records if record.message in ("first", "second", beyond)] == [
        "first", "second", beyond,
    ]  # fmt: skip
    job.cloud.particles.R[:] *= 100.0
    text = "the particle Reynolds number is"
    assert any(text in line for line in describe(job.settings, job.cloud, 1)["warnings"])


def test_bodies_that_stuck_at_their_release_are_counted():
    p = spheres(np.zeros((3, 3)), d=1e-3, rho=1000.0, mu=1.0)
    p.status[:], p.patch[:], p.t[:] = (Status.STUCK, Status.STUCK, Status.ACTIVE), (0, 0, -1), (0.0, 1.0, 0.0)
    numbers, _, touched = log_module._fates_of(p, None, 1.0, 1)
    assert (numbers[Status.STUCK, 0], touched) == (2, 1)
