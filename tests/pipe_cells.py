"""A pipe as a shear flow deformation cytometer, and cells that were seen in it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from validation.fits import MEAN, RADIUS, SETTINGS

from foamprb import analytic
from foamprb.run.device import Bodies, Device, plane_of, view_of
from foamprb.run.job import Job, assemble
from foamprb.run.measured import Measured, read_measured
from foamprb.settings.settings import read_settings


def pipe_job(folder: Path, text: str = SETTINGS, flow=None, threads: int = 1) -> Job:
    """The job of these settings in Poiseuille flow."""
    (folder / "constant").mkdir(exist_ok=True, parents=True)
    (folder / "constant/softCloudProperties").write_text(text)
    flow = flow or analytic.pipe(RADIUS, MEAN, 2e-3)
    return replace(assemble(read_settings(folder), flow, threads), output=folder / "results")


def seen_cells(
    job: Job, n: int, noise: float = 1.0, seed: int = 0, viscosity: float = 1.0
) -> tuple[Measured, np.ndarray, np.ndarray]:
    """Cells at x = 1 mm, with errors of 2 % of the strain and 0.02 rad, and their properties."""
    random = np.random.default_rng(seed)
    G, eta = 300.0 * np.exp(random.normal(0.0, 0.3, n)), viscosity * np.exp(random.normal(0.0, 0.3, n))
    d, y = random.normal(15e-6, 1e-6, n), random.uniform(3e-5, 8e-5, n) * random.choice([-1.0, 1.0], n)
    plane = plane_of("x=1e-3", job)
    device = Device(job, plane, view_of("z", job, plane))
    device.pass_guides(1e-3)
    places = np.stack([np.full(n, np.nan), y, np.full(n, np.nan)], axis=1)
    guide, start, _ = device.lead_to(places)
    seen = device.follow(Bodies(guide, start, d, {"shearModulus": G, "viscosity": eta}), np.full(n, 1e-3))
    image = device.image(seen, d, ("strain", "angle"))
    strain = image["strain"] * (1.0 + 0.02 * noise * random.normal(size=n))
    angle = image["angle"] + 0.02 * noise * random.normal(size=n)
    errors = {"strainError": 0.02 * image["strain"], "angleError": np.full(n, 0.02)}
    return read_measured({"y": y, "d": d, "strain": strain, "angle": angle, **errors}), G, eta


CYTOMETER, VOLUME_FLOW = 10.94e-6, 0.04e-9
"""Radius of the tube that acts as a channel of 20 µm, m, and its volume flow, m³/s."""


def cytometer_job(
    folder: Path, channel: str = f"channel {{ type tube; radius {CYTOMETER}; }}", mu: float = 0.015
) -> Job:
    """The job of cells with the quadratic mode on the axis of the tube of a deformability cytometer."""
    text = SETTINGS.replace("mu 1;", f"mu {mu};").replace(
        "shearModulus 300; viscosity 1;", "shearModulus 1000;"
    )
    text = text.replace("deltaT 2e-3; endTime 2;", "deltaT 5e-6; endTime 0.01;").replace("15e-6", "8e-6")
    text = text.replace("-9e-5 0); end (1e-6 9e-5 0)", "0 0); end (1e-6 1e-9 0)").replace(
        "number 37", "number 2"
    )
    text = text.replace("patchInteractionModel", "shapeModel quadratic; patchInteractionModel")
    text += f"""
    cloudFunctions
    {{
        camera
        {{
            type deformabilityCytometry;
            origin (2e-4 0 0); normal (1 0 0); view (0 0 1);
            {channel}
        }}
    }}
    """
    flow = analytic.pipe(CYTOMETER, VOLUME_FLOW / (np.pi * CYTOMETER**2), 1e-3)
    return pipe_job(folder, text, flow)


def write_rtdc(path: Path, area_um, deform, **metadata) -> Path:
    """Write a file of dclab with these features; skip the test without dclab."""
    dclab = pytest.importorskip("dclab")
    with dclab.RTDCWriter(path, mode="reset") as writer:
        n = len(area_um)
        writer.store_metadata(
            {"experiment": {"sample": "beads", "run index": 1, "event count": n}, **metadata}
        )
        writer.store_feature("area_um", np.array(area_um))
        writer.store_feature("deform", np.array(deform))
    return path
