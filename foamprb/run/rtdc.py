"""Measurements of deformability cytometers: files ``.rtdc`` of dclab, with the conditions that they carry."""

from __future__ import annotations

import logging
import math
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.optional import load

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

LEAST = 5e-4
"""Smallest deformation that images resolve: that of dclab's tables."""
_NOISE, _NOISE_OF_AREA = 0.07, 0.25
"""Standard errors of deformations, and relative ones of areas, of bodies of one pixel."""
_LAW, _USUAL_TEMPERATURE = "buyukurganci-2022", 23.0


class Conditions(NamedTuple):
    """Conditions of a measurement; NaN for those that are unknown."""

    width: float
    """Width of the square channel, m."""
    flow_rate: float
    """m³/s."""
    viscosity: float
    """Pa s."""
    origin: str
    """What gives the viscosity."""


class Events(NamedTuple):
    """Events of a file."""

    area: Floats
    """m²."""
    deformation: Floats
    """Without the effect of pixels."""
    pixel: float
    """Size of a pixel, m; NaN if it is unknown."""
    conditions: Conditions
    sample: str


def read_rtdc(path: Path) -> Events:
    """Read area and deformation of all events; raise InputError for a file without them, or of a reservoir.

    The deformation is less by the effect of pixels (Herold, arXiv:1704.00572, as dclab has it).
    """
    dclab, pxcorr = _load("dclab"), _load("dclab.features.emodulus.pxcorr")
    try:
        with warnings.catch_warnings(), dclab.new_dataset(path) as data:
            warnings.simplefilter("ignore")
            if missing := [name for name in ("area_um", "deform") if name not in data]:
                raise InputError(f"{path}: no feature {missing[0]}. Needed: area_um and deform.")
            area, deformation = (np.array(data[name][:], dtype=float) for name in ("area_um", "deform"))
            setup = data.config.get("setup", {})
            if setup.get("chip region", "channel") != "channel":
                region = setup["chip region"]
                raise InputError(
                    f"{path}: its events were seen in the {region}. Needed: those of the channel."
                )
            pixel = float(data.config.get("imaging", {}).get("pixel size", math.nan))
            return Events(
                1e-12 * np.where(area > 0.0, area, np.nan),
                deformation
                - (pxcorr.get_pixelation_delta("deform", "area_um", area, pixel) if pixel > 0.0 else 0.0),
                1e-6 * pixel,
                _conditions(path, data),
                str(data.config.get("experiment", {}).get("sample", path.stem)),
            )
    except (OSError, ValueError, KeyError) as error:
        raise InputError(f"{path}: not a file of dclab ({error}).") from error


def _load(module: str) -> Any:
    return load(module, "cytometry", "files of dclab need")


def _conditions(path: Path, data: Any) -> Conditions:
    """Return width, flow rate and viscosity of a file, the latter by dclab's laws."""
    viscosity = _load("dclab.features.emodulus.viscosity")
    setup = data.config.get("setup", {})
    width, rate = (float(setup.get(name, math.nan)) for name in ("channel width", "flow rate"))
    mu, origin, medium = math.nan, "", str(setup.get("medium", "")).strip()
    known = next((name for name in (medium, medium.lower()) if name in viscosity.KNOWN_MEDIA), "")
    if known and width > 0.0 and rate > 0.0:
        temperature = setup.get("temperature")
        if "temp" in data:
            temperature = np.median(data["temp"][:])
        assumed = " (assumed)" if temperature is None else ""
        celsius = float(_USUAL_TEMPERATURE if temperature is None else temperature)
        mu = float(viscosity.get_viscosity(known, width, rate, celsius, _LAW))
        origin = f"{medium} at {celsius:.3g} °C{assumed} by {_LAW}"
    elif medium and not known:
        log.info("%s: the viscosity of its medium '%s' is not known.", path, medium)
    return Conditions(1e-6 * width, 1e-9 * rate, 1e-3 * mu, origin)


def pixel_noise(area: Floats, pixel: float) -> tuple[Floats, Floats]:
    """Return standard errors of deformations and areas, (n,), m², of outlines through pixels of sharp images.

    They fall as r^(−3/2) in pixels; those of ellipses depend on their direction, by a factor of 1.5.
    """
    small = (pixel / np.sqrt(area / np.pi)) ** 1.5
    return _NOISE * small, _NOISE_OF_AREA * small * area
