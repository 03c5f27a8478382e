"""Cases that decomposePar has cut into processor folders, put together in the original order.

The addressing files give the point, face, cell and patch of the whole for each piece of a part. The mesh is
written to a temporary folder in OpenFOAM's binary format, and read from there as the mesh of any other case;
fields are joined in memory. The flow is the same as that of the case before it was cut.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
import weakref
from pathlib import Path

from foamprb.dictionary.files import existing
from foamprb.flow.read.case import (
    MissingFieldError,
    available_times,
    regions,
    require_choice,
    require_region,
)
from foamprb.flow.read.field import FoamField, Kind, read_field
from foamprb.flow.read.openfoam import Case
from foamprb.flow.read.processors import (
    HEADER,
    checked,
    common_times,
    join_fields,
    processors,
    read_part,
    whole_patches,
    write_mesh,
    write_zones,
)

_PREFIX = "foamprb-temporary-"
_LOCK = ".lock"
"""File in each temporary folder that marks it, and is locked while its process lives."""


def is_only_decomposed(case: Path, region: str = "") -> bool:
    """Return True if only the processor folders hold the solution: no mesh beside them, or no time but 0."""
    folders = [path for path in case.glob("processor*") if (path / "constant").is_dir()]
    if not folders:
        return False
    if existing(case / "constant" / region / "polyMesh/faces") is None:
        return not regions(case) or bool(region)
    later = any(float(name) != 0.0 for name in available_times(case))
    return not later and any(float(name) != 0.0 for name in available_times(folders[0]))


class DecomposedCase(Case):
    """Decomposed case, whose mesh lies in a temporary folder that is removed with this object.

    Parameters
    ----------
    root, region
        See :class:`Case`.

    Raises
    ------
    InputError
        A file is missing or broken, or the parts do not make a whole; the message names file or folder.
    """

    def __init__(self, root: Path, region: str = "") -> None:
        super().__init__(root, region)
        self._folders = processors(root)
        names = self.regions()
        require_region(root, region, names)
        if not region and existing(self._folders[0] / "constant/polyMesh/faces") is None:
            require_choice(root, names)
        times = common_times(self._folders, region)
        parts = [read_part(root, folder, region) for folder in self._folders]
        self._patches, self._ranges = whole_patches(root, parts)
        self.mesh_root = temporary_folder(self)
        for name in times:
            (self.mesh_root / name / region).mkdir(parents=True)
        (self.mesh_root / "system").mkdir()
        (self.mesh_root / "system/controlDict").write_text(
            HEADER.format(kind="dictionary", note="", name="controlDict")
        )
        mesh = self.mesh_root / "constant" / region / "polyMesh"
        write_mesh(mesh, root, parts, self._patches, self._ranges)
        write_zones(mesh / "cellZones", parts)
        self._parts = [part.without_mesh() for part in parts]
        self.notes = (f"The flow was put together from {len(parts)} processor folders.",)

    def folder(self, time: str) -> Path:
        """Return the folder of the first processor's fields at a time."""
        return self._folders[0] / time / self.region

    def regions(self) -> tuple[str, ...]:
        """Return the names of all regions."""
        return regions(self._folders[0])

    def field(self, time: str, name: str, kind: Kind) -> FoamField:
        """Read a field at a time of all processors, and join it; InputError if one is missing or broken."""
        fields = []
        for part, folder in zip(self._parts, self._folders, strict=True):
            path = folder / time / self.region / name
            if existing(path) is None:
                raise MissingFieldError(f"{path}: no such file.")
            fields.append(checked(read_field(path, kind, self.root), part))
        return join_fields(self._parts, fields, self._patches, self._ranges)


def temporary_folder(owner: object) -> Path:
    """Return a new temporary folder, which is removed with its owner.

    A killed process leaves its folder behind, with a lock file that no process locks any more. Such folders
    are removed here, and no others.
    """
    _remove_left()
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
        descriptor = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o600)
        # Before it was locked, another process may have removed it as one left behind.
        if _lock(descriptor) and (folder / _LOCK).exists():
            weakref.finalize(owner, _remove, folder, descriptor)
            return folder
        os.close(descriptor)


def _lock(descriptor: int) -> bool:
    """Lock a file; return False if another process holds it. File systems without locks count as locked."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        pass
    return True


def _remove(folder: Path, descriptor: int) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    os.close(descriptor)


def _remove_left() -> None:
    """Remove the folders that no process holds."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        try:
            descriptor = os.open(folder / _LOCK, os.O_RDWR | os.O_NOFOLLOW)
        except OSError:
            # It belongs to another user, is of another kind, or is gone.
            continue
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
        else:
            _remove(folder, descriptor)
