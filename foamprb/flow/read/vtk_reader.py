"""VTK's OpenFOAM reader, which gives points in single precision, and the messages of VTK."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.mesh.cells import poly_of_grid
from foamprb.flow.read.boundary import PatchInfo, patches_of_mesh

_MESSAGE = re.compile(
    r"^(ERROR|Warning|Generic Warning): In .*?, line \d+\n(?:\S+ \(0x[0-9a-f]+\): )?(.*)", re.MULTILINE
)
_MOST_MESSAGES = 100


class Messages(NamedTuple):
    """Messages of VTK, each once."""

    errors: list[str]
    warnings: list[str]


class _LogHandler(logging.Handler):
    """Collector of logged errors."""

    def __init__(self, errors: list[str]) -> None:
        super().__init__(logging.ERROR)
        self._errors = errors

    def emit(self, record: logging.LogRecord) -> None:
        self._errors.append(" ".join(record.getMessage().split()))


@contextmanager
def vtk_messages() -> Iterator[Messages]:
    """Collect VTK's output in lists that are filled when the block ends."""
    messages = Messages([], [])
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    # Pyvista logs some of VTK's errors.
    handler = _LogHandler(messages.errors)
    logging.getLogger().addHandler(handler)
    try:
        yield messages
    finally:
        logging.getLogger().removeHandler(handler)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
        vtkOutputWindow.SetInstance(before)
        text: Any = window.GetOutput()
        if isinstance(text, bytes):
            # VTK quotes the contents of broken files.
            text = text.decode("utf-8", "replace")
        for kind, message in _MESSAGE.findall(text):
            message = " ".join(message.split())
            # VTK's legacy reader only warns of truncated files.
            fatal = kind == "ERROR" or (kind == "Generic Warning" and message.startswith("Error"))
            similar = messages.errors if fatal else messages.warnings
            if message not in similar and len(similar) < _MOST_MESSAGES:
                similar.append(message)


def read_poly_by_vtk(files: Sequence[Path], patches: Sequence[PatchInfo]) -> PolyMesh:
    """Read a mesh.

    Parameters
    ----------
    files
        ``points``, ``faces``, ``owner``, ``neighbour`` and ``boundary``, plain or compressed. VTK reads links
        to them in a separate folder; in the case it would look for other times, and prefer compressed files.
    patches
        The patches of the last.

    Raises
    ------
    InputError
        The mesh cannot be read, or its patches do not fit.
    """
    source = files[-1].parent
    with TemporaryDirectory(prefix="foamprb-mesh-") as name:
        folder = Path(name) / "constant/polyMesh"
        folder.mkdir(parents=True)
        (Path(name) / "system").mkdir()
        (Path(name) / "system/controlDict").write_text("FoamFile { class dictionary; }\n")
        for path in filter(None, map(existing, files)):
            (folder / path.name).symlink_to(path.resolve())
        with vtk_messages() as messages:
            blocks = _update(Path(name))
    grid = blocks.get("internalMesh")
    if messages.errors or grid is None or grid.GetNumberOfCells() == 0:
        said = messages.errors[0].replace(str(folder), str(source)) if messages.errors else "no mesh"
        raise InputError(f"{source}: VTK's OpenFOAM reader says: {said}")
    surfaces = [
        patch._replace(surface=blocks.get(patch.name, vtkPolyData())) for patch in patches_of_mesh(patches)
    ]
    return poly_of_grid(grid, surfaces, str(source))


def _update(case: Path) -> dict[str, Any]:
    """Return the mesh and the patches by name."""
    reader = vtkOpenFOAMReader()
    # Only the folder of this name is used; the file need not exist.
    reader.SetFileName(str(case / "case.foam"))
    reader.SetCreateCellToPoint(False)
    reader.SetSkipZeroTime(False)
    reader.SetReadZones(False)
    reader.UpdateInformation()
    for index in range(reader.GetNumberOfPatchArrays()):
        part = reader.GetPatchArrayName(index)
        reader.SetPatchArrayStatus(part, int(part == "internalMesh" or part.startswith("patch/")))
    reader.Update()
    return dict(_leaves(reader.GetOutput()))


def _leaves(block: Any) -> Iterator[tuple[str, Any]]:
    for index in range(block.GetNumberOfBlocks()):
        part = block.GetBlock(index)
        if isinstance(part, vtkMultiBlockDataSet):
            yield from _leaves(part)
        elif part is not None:
            yield block.GetMetaData(index).Get(vtkCompositeDataSet.NAME()), part
