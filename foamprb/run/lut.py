"""Table of moduli over area and deformation of a device, in the form that dclab loads."""

from __future__ import annotations

import json
import logging
import math
import re
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.viscosity import VaryingViscosity, viscosity_at_rate
from foamprb.errors import InputError
from foamprb.flow.patches import PatchKind
from foamprb.results.atomic import refuse_other_kind, write_text
from foamprb.run.compilation import compile_run
from foamprb.run.device import Bodies, Device, plane_of, view_of, youngs_factor
from foamprb.run.job import Job
from foamprb.run.measured import Measured
from foamprb.run.rtdc import LEAST

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_HEAD = "# Look-up table of foamprb"
_LARGEST = 0.05
"""Largest deformation by the quadratic mode, which is of first order."""
_WORD = re.compile(r"[\w.+-]+")


@dataclass(frozen=True)
class Lut:
    """Look-up table.

    Parameters
    ----------
    area, deformation, modulus
        Areas of outlines, m², their deformations 1 − 2√(πA)/P, and Young's moduli, Pa, (n,).
    width, flow_rate, viscosity
        Of the channel, m, m³/s and Pa s, to which dclab refers other conditions.
    quadratic
        Whether bodies have the quadratic mode.
    solid
        Name of the solid.
    """

    area: Floats
    deformation: Floats
    modulus: Floats
    width: float
    flow_rate: float
    viscosity: float
    quadratic: bool
    solid: str


def compute_lut(
    job: Job,
    diameters: tuple[float, float],
    moduli: tuple[float, float],
    number: int = 24,
    plane: str | None = None,
    view: str | None = None,
    width: float | None = None,
    flow_rate: float | None = None,
) -> Lut:
    """Follow bodies of ``number``² sizes and moduli through a device.

    Parameters
    ----------
    job, plane, view
        See :func:`foamprb.run.fit.fit_job`. Bodies go to the point of the plane, or along the path in the
        middle.
    diameters, moduli
        Smallest and largest diameter, m, and shear modulus, Pa.
    width, flow_rate
        Width of the channel, m, by default the smallest one of the flow; volume flow, m³/s, by default that
        through the openings.

    Raises
    ------
    InputError
        If the case is no device, or no body gives a deformation that is large enough.
    """
    plane_ = plane_of(plane, job)
    device = Device(job, plane_, view_of(view, job, plane_))
    device.require_property("shearModulus", "-moduli of shearModulus")
    device.warn_of_walls(np.array(diameters))
    compile_run(job.cloud, job.compilation)
    flow, medium = job.cloud.flow, job.cloud.medium
    width = flow.width if width is None else width
    if not width < math.inf:
        raise InputError("the flow has no walls, by which the width is known. Needed: -channelWidth.")
    rate = inflow(job) if flow_rate is None else flow_rate
    grid = np.meshgrid(np.linspace(*diameters, number), np.geomspace(*moduli, number), indexing="ij")
    d, G = (axis.ravel() for axis in grid)
    place = {
        name: np.full(len(d), x) for name, x in zip("xyz", plane_.point, strict=True) if math.isfinite(x)
    }
    places, offsets = device.places(Measured("the plane", place, np.arange(len(d))))
    device.pass_guides(float(offsets[0]))
    guide, release, _ = device.lead_to(places)
    seen = device.follow(Bodies(guide, release, d, {"shearModulus": G}), offsets)
    image = device.image(seen, d, ("area", "deformation"))
    area, deformation = image["area"], image["deformation"]
    largest = _LARGEST if job.cloud.models.has_quadratic else math.inf
    good = seen.passed & (deformation >= LEAST) & (deformation <= largest)
    if good.sum() < 4:
        raise InputError(
            f"{good.sum()} of {len(d)} bodies have deformations from {LEAST:g} to {largest:g} in the plane; "
            f"the largest is {np.max(deformation, initial=0.0, where=seen.passed):.3g}. Needed: others of "
            "-moduli or -diameters, or a place away from the axis, or shapeModel quadratic."
        )
    solid = job.settings.injections[0].solid
    if isinstance(medium.mu, VaryingViscosity):
        log.warning(
            "The viscosity of the table is that at the shear rate 8 Q/L³; dclab has only one viscosity."
        )
    mu = float(viscosity_at_rate(medium.mu, wall_rate(rate, width)))
    quadratic = job.cloud.models.has_quadratic
    return Lut(
        area[good], deformation[good], youngs_factor(solid) * G[good], width, rate, mu, quadratic, solid.type
    )


def wall_rate(flow_rate: float, width: float) -> float:
    """Return a usual shear rate in a square channel, 8 Q/L³, 1/s."""
    return 8.0 * flow_rate / width**3


def inflow(job: Job) -> float:
    """Return the volume flow into the flow of a job, m³/s.

    Raises
    ------
    InputError
        If the fluxes are unknown, or nothing enters.
    """
    flow: Any = job.cloud.flow
    mesh: Any = getattr(flow, "mesh", None)
    phi = np.empty(0) if mesh is None else flow.arrays(0.0, ()).phi
    if not len(phi):
        raise InputError("the fluxes through the openings of the flow are unknown. Needed: -flowRate, m3/s.")
    ends = mesh.n_internal + mesh.patch_start
    openings = [k for k, patch in enumerate(flow.patches) if patch.kind == PatchKind.OPENING]
    total = sum(max(0.0, -float(phi[ends[k] : ends[k + 1]].sum())) for k in openings)
    if total <= 0.0:
        raise InputError("nothing flows in through the openings of the flow. Needed: -flowRate, m3/s.")
    return total


def write_lut(lut: Lut, target: Path, identifier: str) -> None:
    """Write a table that ``dclab.register_lut`` loads."""
    if not _WORD.fullmatch(identifier):
        raise InputError(f"-identifier '{identifier}'. Allowed: letters, digits, +, -, _ and points.")
    refuse_other_kind(target, _HEAD.encode())
    mode = "quadratic mode" if lut.quadratic else "ellipsoid"
    meta = {
        "authors": "foamprb",
        "channel_width": 1e6 * lut.width,
        "channel_width_unit": "um",
        "dimensionality": "3D",
        "flow_rate": 1e9 * lut.flow_rate,
        "flow_rate_unit": "uL/s",
        "fluid_viscosity": 1e3 * lut.viscosity,
        "fluid_viscosity_unit": "mPa s",
        "identifier": identifier,
        "method": "pseudo-rigid bodies",
        "model": f"{lut.solid}, {mode}",
        "software": f"foamprb {version('foamprb')}",
        "summary": f"Shapes of soft bodies in the flow of a case: {mode}",
    }
    heads = [_HEAD, "#", "# BEGIN METADATA"]
    heads += [f"# {line}" for line in json.dumps(meta, indent=2).splitlines()]
    heads += ["# END METADATA", "#", "# area_um [um^2]\tdeform\temodulus [kPa]"]
    columns = zip(1e12 * lut.area, lut.deformation, 1e-3 * lut.modulus, strict=True)
    rows = [f"{a:.6e}\t{D:.6e}\t{E:.6e}" for a, D, E in columns]
    write_text(target, "\n".join([*heads, *rows]) + "\n")
