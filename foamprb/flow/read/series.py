"""The flow of a case at several of its times, read as they are needed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.case import cell_zones, mesh_folder, notes_of_forms, select_times
from foamprb.flow.read.caveats import caveat_of_flux, caveats_of_case
from foamprb.flow.read.field import GRADIENT_FIELD, VELOCITY_FIELD
from foamprb.flow.read.openfoam import (
    PRECISION_NOTE,
    ReadField,
    fields_of_case,
    gradients,
    read_case,
    read_mesh,
    velocities,
)
from foamprb.flow.read.turbulence import read_turbulence
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow

_MOST_IN_MEMORY = 1 << 28
"""Bytes up to which all times of a periodic flow stay in memory."""


def read_series(
    case: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    fields: ReadField | None = None,
    turbulent: bool = False,
) -> SeriesFlow | MeshFlow:
    """Read the flow of a case at several of its times, as it is needed; a single time is a steady flow.

    Parameters
    ----------
    case
        The case's folder.
    times
        As :func:`~foamprb.flow.read.times.choose_times`.
    period
        Duration after which the flow repeats itself, s.
    velocity, region, gradient, fields, turbulent
        As :func:`foamprb.flow.read.openfoam.read_case`.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent: the case, a time, a field, the mesh or a patch; a mesh that
        moves; times that do not fill the period.
    """
    case = Path(case)
    names = select_times(case, times, region)
    if len(names) == 1:
        return read_case(case, names[0], velocity, region, gradient, fields, turbulent)
    _refuse_moving(case, names, region)
    read_field = fields or fields_of_case(case, region)
    field = read_field(names[0], velocity, VELOCITY_FIELD)
    whole = read_mesh(case, names[0], region)
    first_cells, boundary = velocities(field, whole)
    reconstruct = Reconstruction(whole.mesh)
    folder = mesh_folder(case, names[0], region)

    def read(name: str) -> tuple[Floats, ...]:
        cells, boundary = velocities(read_field(name, velocity, VELOCITY_FIELD), whole)
        given = gradients(read_field(name, gradient, GRADIENT_FIELD), whole.mesh) if gradient else None
        flow = reconstruct(cells, boundary, given)
        if not turbulent:
            return flow
        at_time = partial(read_field, name)
        return *flow, read_turbulence(at_time, case / name / region, whole.patches, whole.mesh, reconstruct)

    notes = [PRECISION_NOTE, *whole.notes]
    notes += notes_of_forms(case / name / region / velocity for name in names)[:1]
    first = case / names[0] / region
    notes += caveats_of_case(case, case / names[-1] / region, region, moving=False, turbulent=turbulent)
    notes += caveat_of_flux(whole.mesh, whole.patches, first_cells, boundary, case, first, velocity)
    zones = partial(cell_zones, folder)
    return series_of(case, whole.mesh, names, read, period, notes, zones, turbulent)


def series_of(
    source: Path,
    mesh: Mesh,
    names: Sequence[str],
    read: Callable[[str], tuple[Floats, ...]],
    period: float | None,
    notes: Sequence[str],
    zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
    turbulent: bool = False,
) -> SeriesFlow:
    """Make a flow of the times of a case or a file: few of them in memory, or all of a short period.

    Parameters
    ----------
    source
        What it comes from, for the messages.
    mesh
        The mesh, of all times.
    names
        The names of the times, rising.
    read
        Gives u and l at the nodes at the time of a given name, as :class:`SeriesFlow`'s.
    period, notes, zones, turbulent
        As :class:`SeriesFlow`'s.

    Raises
    ------
    InputError
        The times do not rise, or do not fill the period.
    """
    note = f"The flow is linear in time between {len(names)} times from {names[0]} to {names[-1]}"
    note += "." if period is None else f", and repeats itself every {period:g} s."
    a_time = 8 * (20 if turbulent else 12) * (mesh.n_points + mesh.n_cells)
    keep = _MOST_IN_MEMORY // a_time if period is not None else 0
    times = [float(name) for name in names]
    try:
        return SeriesFlow(
            mesh, times, lambda i: read(names[i]), period, [*notes, note], keep, zones, turbulent
        )
    except InputError as error:
        raise InputError(f"{source}: {error}") from None


def _refuse_moving(case: Path, names: Sequence[str], region: str) -> None:
    for name in names[1:]:
        for part in ("points", "faces"):
            path = existing(case / name / region / "polyMesh" / part)
            if path is not None:
                raise InputError(f"{path}: the mesh changes in time; only meshes at rest can be read.")
