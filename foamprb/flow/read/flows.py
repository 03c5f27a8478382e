"""Flow of a case, whole or decomposed, or of a mesh file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.case import is_only_decomposed, later_times, processor_folders, regions, require_region
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.describe import describe, describe_file
from foamprb.flow.read.mrf import Rotation, read_rotations
from foamprb.flow.read.openfoam import Case, steady_flow, transient_flow
from foamprb.flow.read.source import FlowSource


def open_case(case: Path, source: FlowSource) -> Case:
    """Return the case with its files, put together if only its processor folders hold the solution."""
    if source.division is not None:
        raise InputError(f"{case}: a case has its own patches; only those of a mesh file are divided.")
    if source.scale is not None:
        raise InputError(f"{case}: a case is in m; only the lengths of a mesh file (-flow) have a scale.")
    if not source.decomposed and not is_only_decomposed(case, source.region):
        opened = Case(case, source.region)
        opened.notes += later_times(case)
        return opened
    return DecomposedCase(case, source.region)


def describe_source(case: Path, source: FlowSource) -> Sequence[str]:
    """Return lines that describe a case or a mesh file; InputError if it cannot be read."""
    if source.file is not None:
        return describe_file(source.file, source.velocity, source.division, source.length_scale)
    return describe(open_case(case, source)).lines()


def check_region(case: Path, source: FlowSource) -> None:
    """Raise InputError, with the names of all regions, if the case does not have the region of the source."""
    if source.file is None and source.region and case.is_dir():
        folders = processor_folders(case)
        names = regions(case) or (regions(folders[0]) if folders else ())
        require_region(case, source.region, names)


def read_flow(case: Path, time: float | str = "latestTime", source: FlowSource | None = None) -> MeshFlow:
    """Read the flow of a case or of a mesh file at a time."""
    source = source or FlowSource()
    if source.file is None:
        return steady_flow(open_case(case, source), time, source)
    # Only mesh files need VTK.
    from foamprb.flow.read.meshfile import read_mesh_file

    _refuse_of_case(source)
    return read_mesh_file(source.file, source.velocity, time=time, **source.of_file)


def read_mesh(case: Path, time: float | str, source: FlowSource) -> Mesh:
    """Read the mesh of a case or of a mesh file at a time, without the flow of a case."""
    if source.file is not None:
        return read_flow(case, time, source).mesh
    opened = open_case(case, source)
    return opened.mesh(opened.select_time(time)).mesh


def read_transient_flow(case: Path, times: str | None, period: float | None, source: FlowSource) -> MeshFlow:
    """Prepare the flow of a case or of a mesh file at several times, which are read when needed."""
    if source.file is not None:
        from foamprb.flow.read.meshfile import read_mesh_series

        _refuse_of_case(source)
        return read_mesh_series(
            source.file, times, period, source.velocity, **source.of_file, accept=source.accept
        )
    return transient_flow(open_case(case, source), times, period, source)


def rotations_of(case: Path, source: FlowSource) -> tuple[Rotation, ...]:
    """Read the active zones of ``MRFProperties`` if they are described in the frames of their rotors.

    Raises
    ------
    InputError
        The dictionary cannot be read, or an entry is missing or not a constant.
    """
    return read_rotations(case, source.region) if source.relative and source.file is None else ()


def _refuse_of_case(source: FlowSource) -> None:
    if source.cache is not None:
        raise InputError(f"{source.file}: -cache keeps flows of cases only. Allowed: no -cache.")
    if source.turbulent:
        raise InputError(
            f"{source.file}: only the velocity is read from a mesh file, but the dispersionModel needs k and "
            "epsilon or omega. Allowed: dispersionModel none, or the case itself."
        )
    if source.viscosity is not None:
        raise InputError(
            f"{source.file}: only the velocity is read from a mesh file, but the viscosity is a field of the "
            "case. Allowed: nu or mu in constantProperties, or the case itself."
        )
    if source.sampled:
        raise InputError(
            f"{source.file}: only the velocity is read from a mesh file, but fieldSampling needs the fields "
            f"{' '.join(source.sampled)}. Allowed: no fieldSampling, or the case itself."
        )
    if source.region:
        raise InputError(f"{source.file}: a mesh file has no regions, but the region is {source.region}.")
