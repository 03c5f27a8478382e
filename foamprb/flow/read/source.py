"""Where a flow comes from: a case, a region of it, or a mesh file; and which of its fields count."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.case import regions, require_region
from foamprb.flow.read.decomposed import (
    describe_decomposed,
    is_only_decomposed,
    read_decomposed_case,
    read_decomposed_series,
)
from foamprb.flow.read.describe import describe
from foamprb.flow.read.division import Division
from foamprb.flow.read.meshfile import describe_file, read_mesh_file, read_mesh_series
from foamprb.flow.read.mrf import Rotation, read_rotations
from foamprb.flow.read.openfoam import read_case
from foamprb.flow.read.series import read_series
from foamprb.flow.series import SeriesFlow

__all__ = ["Source", "check_region", "describe_source", "read_flow", "read_transient_flow"]


@dataclass(frozen=True)
class Source:
    """What to read beside the case's folder and the time."""

    file: Path | None = None
    """A mesh file in place of the case's mesh and fields."""
    region: str = ""
    """A region of the case's mesh."""
    velocity: str = "U"
    """Name of the velocity."""
    gradient: str = ""
    """Name of the velocity's gradient, ``grad(U)``; without a name it is reconstructed."""
    division: Division | None = None
    """How the boundary of a mesh file without named patches is divided."""
    decomposed: bool = False
    """Whether to read the processor folders even if there is a flow beside them."""
    turbulent: bool = False
    """Whether to read k and ε, or k and ω, as well."""
    relative: bool = False
    """Whether rotating zones are seen from their rotors."""


def describe_source(case: Path, source: Source) -> Sequence[str]:
    """Lines that say what a case or a mesh file holds.

    Raises
    ------
    InputError
        As :func:`~foamprb.flow.read.openfoam.describe` and :func:`~foamprb.flow.read.meshfile.describe_file`.
    """
    if source.file is not None:
        return describe_file(source.file, source.velocity, source.division)
    decomposed = source.decomposed or is_only_decomposed(case, source.region)
    return (describe_decomposed if decomposed else describe)(case, source.region).lines()


def check_region(case: Path, source: Source) -> None:
    """Raise InputError, with all regions, if the source names one that the case does not have."""
    if source.file is None and source.region and case.is_dir():
        folders = [path for path in case.glob("processor*") if (path / "constant").is_dir()]
        names = regions(case) or (regions(folders[0]) if folders else ())
        require_region(case, source.region, names)


def read_flow(case: Path, time: float | str = "latestTime", source: Source | None = None) -> MeshFlow:
    """Read the flow of a case or of a mesh file at a time.

    Raises
    ------
    InputError
        As :func:`~foamprb.flow.read.openfoam.read_case` and
        :func:`~foamprb.flow.read.meshfile.read_mesh_file`; or the
        source asks for what its kind does not have.
    """
    source = source or Source()
    if source.file is None:
        _refuse_division(case, source)
        decomposed = source.decomposed or is_only_decomposed(case, source.region)
        read = read_decomposed_case if decomposed else read_case
        return read(
            case, time, source.velocity, source.region, source.gradient, turbulent=source.turbulent,
            rotations=rotations_of(case, source),
        )  # fmt: skip
    _refuse_of_case(source)
    return read_mesh_file(
        source.file, source.velocity, time=time, gradient=source.gradient, division=source.division
    )


def read_transient_flow(
    case: Path, times: str | None, period: float | None, source: Source
) -> SeriesFlow | MeshFlow:
    """Read the flow of a case or of a mesh file at several times, as it is needed.

    Raises
    ------
    InputError
        As :func:`~foamprb.flow.read.series.read_series` and
        :func:`~foamprb.flow.read.meshfile.read_mesh_series`; or the
        source asks for what its kind does not have.
    """
    if source.file is not None:
        _refuse_of_case(source)
        return read_mesh_series(
            source.file, times, period, source.velocity, gradient=source.gradient, division=source.division
        )
    _refuse_division(case, source)
    if rotations_of(case, source):
        raise InputError(
            f"{case}: rotating zones (MRFProperties) are seen from their rotors in steady flows only. "
            "Allowed: solution/transient no, or solution/rotatingZones absolute."
        )
    decomposed = source.decomposed or is_only_decomposed(case, source.region)
    read = read_decomposed_series if decomposed else read_series
    return read(
        case, times, period, source.velocity, source.region, source.gradient, turbulent=source.turbulent
    )


def rotations_of(case: Path, source: Source) -> tuple[Rotation, ...]:
    """The active zones of ``MRFProperties``, if they are to be seen from their rotors.

    Raises
    ------
    InputError
        The dictionary cannot be read, or an entry is missing or not a constant.
    """
    return read_rotations(case, source.region) if source.relative and source.file is None else ()


def _refuse_of_case(source: Source) -> None:
    if source.turbulent:
        raise InputError(
            f"{source.file}: of a mesh file only the velocity is read, but the dispersionModel needs k and "
            "epsilon or omega. Allowed: dispersionModel none, or the case itself."
        )
    if source.region:
        raise InputError(
            f"{source.file}: a mesh file has no regions, but region {source.region} is asked for."
        )


def _refuse_division(case: Path, source: Source) -> None:
    if source.division is not None:
        raise InputError(f"{case}: a case has its own patches; only those of a mesh file are divided.")
