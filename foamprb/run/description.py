"""Description of a run: the log begins with it, and ``run.json`` records it."""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Mapping, Sequence
from functools import partial
from importlib.metadata import version
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.material import MATERIALS
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.state import VARIABLES, Particles
from foamprb.cloud.surroundings.base import Surrounding, Survey
from foamprb.cloud.viscosity import PhaseMixture, VaryingViscosity, medium_at, model_of
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.jumps import medians
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.nodes import NodeValues
from foamprb.results.atomic import atomic_write
from foamprb.results.record import RECORD_FORMAT
from foamprb.run.checks import (
    costly_settings,
    dimensionless_groups,
    doubtful_densities,
    doubtful_lengths,
    extension_rates,
    late_releases,
    outside_flow,
    validity_warnings,
)
from foamprb.settings.settings import Settings

_INCOMPRESSIBLE = 10.0
"""C of Skalak's law from which membranes keep their area nearly."""
_PACKAGES = ("foamprb", "numpy", "numba", "vtk")


def describe(settings: Settings, cloud: Cloud, steps: int) -> dict[str, Any]:
    """Return the selections of a run, their numbers, and warnings about doubtful ones.

    The description depends on the input alone: not on the date, the computer or the number of processes.

    Parameters
    ----------
    settings, cloud
        The input, and the cloud before its first step.
    steps
        Number of tracking steps.

    Returns
    -------
    Values of JSON by name. A range is a list of its ends; a number that is not finite is None.
    """
    flow, models = cloud.flow, cloud.models
    injections = []
    warnings = [str(note) for note in flow.notes if isinstance(note, Caveat)]
    extension = extension_rates(flow)
    for index, injection in enumerate(settings.injections):
        g = dimensionless_groups(cloud, index, extension)
        ranges = {name: value for name, value in g._asdict().items() if name != "n"} if g.n else {}
        n = g.n + (cloud.late if injection is settings.injections[-1] else 0)
        injections.append(
            {"name": injection.name, "type": type(injection.model).__name__, "particles": n, **ranges}
        )
        if g.n:
            kind, where = MATERIALS[models.material], f"injection model {injection.name}"
            soft = kind.slides and not kind.fluid and injection.solid.C < _INCOMPRESSIBLE
            warnings += validity_warnings(g, models.integrator, where, kind.liquid, soft, kind.fluid)
            warnings += late_releases(settings, cloud, index, g.n, n - g.n)
    sizes = [i["size"][1] for i in injections if "size" in i]
    warnings += doubtful_lengths(settings, cloud, max(sizes, default=math.nan))
    p = _surveyed(cloud)
    medium = medium_at(cloud.medium, flow, p, cloud.time) if models.surroundings else cloud.medium
    survey = Survey(p, flow, medium, cloud.dt, cloud.make_ready())
    remarks = [model.remarks(survey) for model in (*model_of(cloud.medium.mu), *models.surroundings)]
    notes = [line for remark in remarks for line in remark.notes]
    warnings += [line for remark in remarks for line in remark.warnings]
    warnings += doubtful_densities(settings)
    warnings += outside_flow(settings, flow)
    warnings += costly_settings(settings.solution, cloud, steps)
    if cloud.size == 0:
        warnings.append("there is no particle: no injection model releases any.")
    scale = settings.solution.scale
    number, path_number = cloud.stokes_numbers or (None, None)
    description: dict[str, Any] = _as_json({
        "format": RECORD_FORMAT,
        "versions": {"python": platform.python_version(), **{name: version(name) for name in _PACKAGES}},
        "settings": _text_of(settings),
        "fluid": {
            "rho": settings.fluid.rho, **_viscosity(settings, cloud), "gravity": settings.gravity,
        },
        "flow": _ranges(cloud) | ({} if scale == 1.0 else {"scale": scale}),
        "models": {
            "traction": settings.traction,
            "drag": settings.drag,
            "forces": _written(settings.forces),
            "surroundings": _written(settings.surroundings),
            "dispersion": _written(settings.dispersion),
            "fates": _written(settings.fates),
            "solid": models.material,
            "shape": settings.shape,
            "integrator": models.integrator,
            "integratorDescription": INTEGRATORS[models.integrator].description,
            "shapeStokesNumber": number,
            "pathStokesNumber": path_number,
            "tolerance": cloud.tolerance,
            "longestStep": cloud.tracker.stride,
            "stepsEnd": cloud.tracker.stretch_steps,
            "interaction": settings.interaction,
            "touching": settings.touching,
            "notes": notes,
        },
        "time": _times(settings, cloud, steps),
        "mesh": _mesh(cloud),
        "patches": [
            {"name": p.name, "type": p.type, "interaction": type(interaction).__name__.lower(), **place}
            for p, interaction, place in zip(flow.patches, cloud.interactions, _places(cloud), strict=True)
        ],
        "injections": injections,
        "functions": {name: type(function).__name__ for name, function in settings.functions.items()},
        "warnings": warnings,
    })  # fmt: skip
    return description


def _surveyed(cloud: Cloud) -> Particles:
    """Return all particles with the arrays that the surroundings' remarks read.

    Of several processes the first gathers these; the others are zero, and take no memory of the machine.
    """
    if cloud.comm.size == 1 or not (cloud.models.surroundings or model_of(cloud.medium.mu)):
        return cloud.particles
    models = [m for m in cloud.models.surroundings if type(m).remarks is not Surrounding.remarks]
    names = {name for model in models for name in model.surveys}
    if model_of(cloud.medium.mu):
        names |= {"x", "host", "R", "t"}
    arrays = {name: np.zeros((cloud.size, *v.shape), dtype=v.dtype) for name, v in VARIABLES.items()}
    for some in cloud.map_by_id(_arrays_of, tuple(names)):
        rows = some.pop("number")
        for name, array in some.items():
            if arrays[name].shape[1:] != array.shape[1:]:
                # Relaxation times have a column each.
                arrays[name] = np.zeros((cloud.size, *array.shape[1:]))
            arrays[name][rows] = array
    return Particles(**arrays)


def _arrays_of(p: Particles, names: Sequence[str]) -> dict[str, NDArray[Any]]:
    """Return the numbers and some further arrays of particles."""
    return {name: getattr(p, name) for name in (*names, "number")}


def _viscosity(settings: Settings, cloud: Cloud) -> dict[str, object]:
    """Return the viscosities; of one that varies, its ranges over the nodes and its origin."""
    fluid = settings.fluid
    if fluid.varying is None:
        return {"nu": fluid.nu, "mu": fluid.mu}
    mu, nu = cloud.flow.ends_at_nodes(partial(_viscosities_in, fluid.varying, fluid.rho))
    return {"nu": list(nu), "mu": list(mu), "viscosity": fluid.origin}


def write_record(path: Path, description: Mapping[str, object]) -> None:
    """Write a description, in one step."""
    with atomic_write(path) as temporary:
        text = json.dumps(description, indent=1, ensure_ascii=False, allow_nan=False)
        temporary.write_text(f"{text}\n", encoding="utf-8")


def _text_of(settings: Settings) -> dict[str, object]:
    try:
        text = settings.file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        text = ""
    further = {"overrides": dict(settings.overrides), "libs": dict(settings.libs)}
    return {
        "file": settings.file.name, "text": text, **{key: value for key, value in further.items() if value}
    }  # fmt: skip


def _written(selected: Mapping[str, object]) -> dict[str, str]:
    """Return the entries of selected models, as in a dictionary, by their names."""
    return {name: str(model) for name, model in selected.items()}


def _ranges(cloud: Cloud) -> dict[str, object]:
    """Return the time of the flow, s, and the ranges of |U|, m/s, and shear rate, 1/s, at its nodes.

    ``direction`` is the mean velocity of some nodes over their mean speed, ``gradientJump`` the median
    difference of ∇u between neighbouring cells over its size: of all, and of those at walls. ``roughness`` is
    that of the second time, if there are several.
    """
    some = cloud.flow.at_some_nodes()
    speeds, rates = cloud.flow.ends_at_nodes(_speeds_and_rates) or (None, None)
    total = float(np.linalg.norm(some.u, axis=1).sum())
    return {
        "time": some.time,
        "U": speeds,
        "shearRate": rates,
        "gradientJump": medians(cloud.flow.gradient_jumps()),
        "roughness": cloud.flow.roughness(),
        "direction": (some.u.sum(axis=0) / total).tolist() if total > 0.0 else None,
    }


def _speeds_and_rates(values: NodeValues) -> tuple[Floats, Floats]:
    return np.linalg.norm(values.u, axis=1), np.asarray(shear_rate(tuple(values.l.T)))


def _viscosities_in(law: VaryingViscosity, rho: float, values: NodeValues) -> tuple[Floats, Floats]:
    mu = law.at_nodes(values)
    return mu, mu / (law.density_at_nodes(values) if isinstance(law, PhaseMixture) else rho)


def _times(settings: Settings, cloud: Cloud, steps: int) -> dict[str, object]:
    return {
        "deltaT": cloud.dt,
        "start": cloud.start,
        "end": settings.solution.endTime,
        "steps": steps,
        "transient": settings.solution.transient,
    }


def _mesh(cloud: Cloud) -> dict[str, int]:
    mesh = getattr(cloud.flow, "mesh", None)
    if mesh is None:
        return {}
    return {"cells": mesh.n_cells, "points": mesh.n_points, "tetrahedra": len(mesh.tets)}


def _places(cloud: Cloud) -> list[dict[str, object]]:
    """Return the area, m², and its centre, m, of each patch that has faces in the mesh of this process."""
    mesh: Mesh | None = getattr(cloud.flow, "mesh", None)
    if mesh is None:
        return [{} for _ in cloud.flow.patches]
    places: list[dict[str, object]] = []
    for first, end in pairwise(mesh.patch_start):
        sizes = np.linalg.norm(mesh.boundary_areas[first:end], axis=1)
        area = float(sizes.sum())
        centre = sizes @ mesh.boundary_centres[first:end]
        places.append({"area": area, "centre": (centre / area).tolist()} if area else {})
    return places


def _as_json(value: object) -> Any:
    """Return a value with lists for tuples, and None for numbers that are not finite."""
    if isinstance(value, Mapping):
        return {key: _as_json(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_as_json(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
