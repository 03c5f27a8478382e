"""What a run was, ``run.json``: the settings as they were written, versions, mesh, groups, warnings."""

from __future__ import annotations

import json
import math
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

from foamprb.flow.base import Caveat
from foamprb.results.atomic import atomic_write
from foamprb.run.checks import doubts, groups
from foamprb.run.job import Job

__all__ = ["record_of", "renew_record", "write_record"]

_FORMAT = 1
_PACKAGES = ("foamprb", "numpy", "numba", "vtk")


def write_record(path: Path, job: Job) -> None:
    """Write what is about to be run, in one step.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    _write(path, record_of(job))


def renew_record(path: Path, job: Job) -> None:
    """Write the settings and times of a run that goes on into its record; do nothing where there is none.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return
    if isinstance(record, dict) and record.get("format") == _FORMAT:
        record |= {"settings": _settings(job), "time": _time(job)}
        _write(path, record)


def _write(path: Path, record: dict[str, Any]) -> None:
    with atomic_write(path) as temporary:
        text = json.dumps(record, indent=1, ensure_ascii=False)
        temporary.write_text(f"{text}\n", encoding="utf-8")


def _settings(job: Job) -> dict[str, str]:
    file = job.settings.file
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        text = ""
    return {"file": file.name, "text": text}


def _time(job: Job) -> dict[str, Any]:
    return {
        "deltaT": job.cloud.dt,
        "start": job.cloud.start,
        "end": job.settings.solution.endTime,
        "steps": job.steps,
        "transient": job.settings.solution.transient,
    }


def record_of(job: Job) -> dict[str, Any]:
    """Return what is about to be run; nothing in it depends on when, where or by how many it is."""
    settings, cloud = job.settings, job.cloud
    warnings = [str(note) for note in cloud.flow.notes if isinstance(note, Caveat)]
    injections = []
    for index, injection in enumerate(settings.injections):
        g = groups(cloud, index)
        warnings += doubts(g, cloud.models.integrator, f"injection model {injection.name}") if g.n else []
        ranges = {name: _finite(value) for name, value in g._asdict().items() if name != "n"} if g.n else {}
        injections.append(
            {"name": injection.name, "type": type(injection.model).__name__, "particles": g.n, **ranges}
        )
    return {
        "format": _FORMAT,
        "versions": {"python": platform.python_version(), **{name: version(name) for name in _PACKAGES}},
        "settings": _settings(job),
        "fluid": {"rho": settings.fluid.rho, "nu": settings.fluid.nu, "gravity": list(settings.gravity)},
        "models": {
            "traction": settings.traction,
            "drag": settings.drag,
            "forces": list(settings.forces),
            "solid": cloud.models.material,
            "integrator": cloud.models.integrator,
            "touching": settings.touching,
        },
        "time": _time(job),
        "mesh": _mesh(job),
        "patches": [
            {"name": patch.name, "type": patch.type, "interaction": type(interaction).__name__.lower()}
            for patch, interaction in zip(cloud.flow.patches, cloud.interactions, strict=True)
        ],
        "injections": injections,
        "functions": {name: type(function).__name__ for name, function in settings.functions.items()},
        "warnings": warnings,
    }


def _finite(value: Any) -> Any:
    """A number, or a range as a list of its ends; null, of which JSON knows, for what is no number."""
    if isinstance(value, tuple):
        return [_finite(end) for end in value]
    return value if not isinstance(value, float) or math.isfinite(value) else None


def _mesh(job: Job) -> dict[str, int]:
    mesh = getattr(job.cloud.flow, "mesh", None)
    if mesh is None:
        return {}
    return {"cells": mesh.n_cells, "points": mesh.n_points, "tetrahedra": len(mesh.tets)}
