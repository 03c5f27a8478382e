"""Cases that decomposePar has cut into processor folders: put together again, in the original order.

The addressing files tell which point, face, cell and patch of the whole each part holds. The mesh is put
together in a temporary folder, in OpenFOAM's binary format, and read from there as that of any other case;
fields are put together in memory. The flow is the same as that of the case before it was cut.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Caveat
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.case import (
    MissingFieldError,
    available_times,
    regions,
    require_choice,
    require_region,
    select_time,
    select_times,
)
from foamprb.flow.read.caveats import caveats_of_case
from foamprb.flow.read.describe import CaseInfo, TimeInfo, describe
from foamprb.flow.read.field import Field, Kind, read_field
from foamprb.flow.read.foamfile import header
from foamprb.flow.read.mrf import Rotation
from foamprb.flow.read.openfoam import read_case
from foamprb.flow.read.processors import common_times, processors, read_part, whole_patches
from foamprb.flow.read.reconstructpar import HEADER, checked, join_fields, write_mesh, write_zones
from foamprb.flow.read.series import read_series
from foamprb.flow.read.temporary import temporary_folder
from foamprb.flow.series import SeriesFlow

Result = TypeVar("Result")
AFlow = TypeVar("AFlow", MeshFlow, SeriesFlow, SeriesFlow | MeshFlow)


def is_only_decomposed(case: Path, region: str = "") -> bool:
    """Whether the solution is in processor folders alone: no mesh beside them, or no time but 0."""
    folders = [path for path in case.glob("processor*") if (path / "constant").is_dir()]
    if not folders:
        return False
    if existing(case / "constant" / region / "polyMesh/faces") is None:
        return not regions(case) or bool(region)
    later = any(float(name) != 0.0 for name in available_times(case))
    return not later and any(float(name) != 0.0 for name in available_times(folders[0]))


class ReconstructedCase:
    """A decomposed case, put together in a temporary folder that is removed with this object.

    Parameters
    ----------
    case
        The case.
    region
        Name of the mesh region, if the case has several.

    Raises
    ------
    InputError
        A file is missing or broken, or the parts do not make a whole; the message names file or folder.
    """

    def __init__(self, case: Path, region: str = "") -> None:
        self.case, self.region = case, region
        self._folders = processors(case)
        names = regions(self._folders[0])
        require_region(case, region, names)
        if not region and existing(self._folders[0] / "constant/polyMesh/faces") is None:
            require_choice(case, names)
        self.times = common_times(self._folders, region)
        self._parts = [read_part(case, folder, region) for folder in self._folders]
        self._patches, self._ranges = whole_patches(case, self._parts)
        self.folder = temporary_folder(self)
        for name in self.times:
            (self.folder / name / region).mkdir(parents=True)
        (self.folder / "system").mkdir()
        (self.folder / "system/controlDict").write_text(
            HEADER.format(kind="dictionary", note="", name="controlDict")
        )
        mesh = self.folder / "constant" / region / "polyMesh"
        write_mesh(mesh, case, self._parts, self._patches, self._ranges)
        write_zones(mesh / "cellZones", self._parts)
        # The fields need the addresses alone.
        nothing = np.empty(0, dtype=np.int64)
        self._parts = [
            part._replace(
                points=np.empty((0, 3)), face_start=nothing, face_points=nothing,
                owner=nothing, neighbour=nothing, point_at=nothing,
            )
            for part in self._parts
        ]  # fmt: skip

    def field(self, time: str, name: str, kind: Kind) -> Field:
        """Read a field at a time of all processors, and put it together.

        Raises
        ------
        InputError
            A processor misses it, or its file is broken.
        """
        fields = []
        for part, folder in zip(self._parts, self._folders, strict=True):
            path = folder / time / self.region / name
            if existing(path) is None:
                raise MissingFieldError(f"{path}: no such file.")
            fields.append(checked(read_field(path, kind, self.case), part))
        return join_fields(self._parts, fields, self._patches, self._ranges)

    def call(self, function: Callable[..., Result], *arguments: Any) -> Result:
        """Call a function of a case; its messages then name the case, not the temporary folder."""
        try:
            return function(self.folder, *arguments)
        except InputError as error:
            raise InputError(str(error).replace(str(self.folder), str(self.case))) from None

    def noted(self, flow: AFlow, time: str, turbulent: bool, relative: bool = False) -> AFlow:
        """The flow, with notes on where it comes from, at a time; the folder is removed after the flow."""
        weakref.finalize(flow, _let_go, self)
        folder = self._folders[0] / time / self.region
        at_rest = not isinstance(flow, SeriesFlow)
        caveats: list[Caveat] = caveats_of_case(
            self.case, folder, self.region, moving=at_rest, turbulent=turbulent, relative=relative
        )
        note = f"The flow was put together from {len(self._parts)} processor folders."
        flow.notes = (note, *flow.notes, *caveats)
        return flow


def _let_go(whole: ReconstructedCase) -> None:
    """Hold the folder until this is called."""


def read_decomposed_case(
    case: Path,
    time: float | str = "latestTime",
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    turbulent: bool = False,
    rotations: Sequence[Rotation] = (),
) -> MeshFlow:
    """Read the flow of a decomposed case at one time, as :func:`foamprb.flow.read.openfoam.read_case`.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent in the processor folders.
    """
    whole = ReconstructedCase(case, region)
    name = whole.call(select_time, time, region)
    flow = whole.call(read_case, name, velocity, region, gradient, whole.field, turbulent, rotations)
    return whole.noted(flow, name, turbulent, bool(rotations))


def read_decomposed_series(
    case: Path,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    turbulent: bool = False,
) -> SeriesFlow | MeshFlow:
    """Read the flow of a decomposed case at several times, as :func:`~foamprb.flow.read.series.read_series`.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent in the processor folders.
    """
    whole = ReconstructedCase(case, region)
    name = whole.call(select_times, times, region)[-1]
    flow = whole.call(read_series, times, period, velocity, region, gradient, whole.field, turbulent)
    return whole.noted(flow, name, turbulent)


def describe_decomposed(case: Path, region: str = "") -> CaseInfo:
    """Tell what a decomposed case holds, or a region: see :func:`~foamprb.flow.read.describe.describe`."""
    whole = ReconstructedCase(case, region)
    first = processors(case)[0]
    times = tuple(TimeInfo(name, _classes(first / name / region)) for name in whole.times)
    return replace(whole.call(describe, region), case=case, times=times, regions=regions(first))


def _classes(folder: Path) -> dict[str, str]:
    paths = sorted(folder.iterdir()) if folder.is_dir() else ()
    found = {path.name.removesuffix(".gz"): header(path).get("class", "") for path in paths if path.is_file()}
    return {name: kind for name, kind in found.items() if kind.endswith("Field")}
