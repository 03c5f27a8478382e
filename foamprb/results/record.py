"""The record of a run, ``run.json``, as its readers use it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypedDict

from foamprb.results.reading import read_json

RECORD_FORMAT = 2
"""Version of the entries of the record."""


class Settings(TypedDict, total=False):
    """Settings of a run."""

    file: str
    text: str
    overrides: dict[str, str]
    libs: dict[str, str]


class FlowRecord(TypedDict, total=False):
    """Ranges of a flow."""

    direction: list[float] | None
    gradientJump: list[float | None] | None
    scale: float


class FluidRecord(TypedDict, total=False):
    """The fluid; the ends of a range where it varies."""

    rho: float
    nu: float | list[float | None]
    mu: float | list[float | None]
    gravity: list[float]


class InjectionRecord(TypedDict, total=False):
    """An injection model, with the ranges of its particles at release."""

    name: str
    type: str
    particles: int
    shear_rate: list[float | None]
    capillary: list[float | None]
    reynolds: list[float | None]
    stokes: list[float | None]
    size: list[float | None]


class TimeRecord(TypedDict):
    """Times of a run, s."""

    start: float
    end: float
    deltaT: float
    steps: int
    transient: bool


class ModelsRecord(TypedDict, total=False):
    """Selected models."""

    solid: str
    shape: str
    traction: str
    drag: str
    integrator: str
    forces: dict[str, str]
    surroundings: dict[str, str]
    dispersion: dict[str, str]


class Record(TypedDict, total=False):
    """Contents of a record; other versions of foamprb may have left out any."""

    format: int
    versions: dict[str, str]
    settings: Settings
    fluid: FluidRecord
    flow: FlowRecord
    models: ModelsRecord
    time: TimeRecord
    mesh: dict[str, int]
    patches: list[dict[str, Any]]
    injections: list[InjectionRecord]
    functions: dict[str, str]
    warnings: list[str]


def read_record(path: Path) -> Record:
    """Read a record; it is empty without the file."""
    return read_json(path, Record) if path.exists() or path.is_symlink() else {}
