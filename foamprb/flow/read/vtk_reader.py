"""VTK's OpenFOAM reader, and the messages of VTK."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

from foamprb.dictionary.files import existing
from foamprb.errors import InputError

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


def read_blocks(files: Iterable[Path], *, patches: bool) -> tuple[dict[str, Any], Messages]:
    """Read a mesh.

    Parameters
    ----------
    files
        ``points``, ``faces``, ``owner``, ``neighbour`` and ``boundary``, plain or compressed. VTK reads links
        to them in a separate folder; in the case it would look for other times, and prefer compressed files.
    patches
        Read the patches as well.

    Returns
    -------
    The reader's blocks by name, ``internalMesh`` and the patches; and VTK's messages.

    Raises
    ------
    InputError
        There is no mesh, or it cannot be read.
    """
    with TemporaryDirectory(prefix="foamprb-mesh-") as name:
        folder = Path(name) / "constant/polyMesh"
        folder.mkdir(parents=True)
        (Path(name) / "system").mkdir()
        (Path(name) / "system/controlDict").write_text("FoamFile { class dictionary; }\n")
        paths = [found for file in files if (found := existing(file)) is not None]
        for path in paths:
            (folder / path.name).symlink_to(path.resolve())
        with vtk_messages() as messages:
            blocks = _update(_open(Path(name), patches=patches))
    source = paths[-1].parent
    places = {str(folder / path.name): str(path) for path in paths} | {str(folder): str(source)}
    messages = Messages(*([_replaced(text, places) for text in texts] for texts in messages))
    grid = blocks.get("internalMesh")
    if grid is None or grid.GetNumberOfCells() == 0:
        raise_first_error(source, messages)
        raise InputError(f"{source}: no mesh could be read; a file is missing, broken or cut short.")
    return blocks, messages


def _replaced(text: str, names: Mapping[str, str]) -> str:
    for name, other in names.items():
        text = text.replace(name, other)
    return text


def _open(case: Path, *, patches: bool) -> Any:
    """Return VTK's reader of the mesh and the patches."""
    reader = vtkOpenFOAMReader()
    # Only the folder of this name is used; the file need not exist.
    reader.SetFileName(str(case / "case.foam"))
    reader.SetCreateCellToPoint(False)
    reader.SetSkipZeroTime(False)
    reader.SetReadZones(False)
    reader.UpdateInformation()
    reader.DisableAllCellArrays()
    reader.DisableAllPointArrays()
    reader.DisableAllLagrangianArrays()
    for index in range(reader.GetNumberOfPatchArrays()):
        part = reader.GetPatchArrayName(index)
        wanted = part == "internalMesh" or (patches and part.startswith("patch/"))
        reader.SetPatchArrayStatus(part, int(wanted))
    return reader


def _update(reader: Any) -> dict[str, Any]:
    """Return the reader's blocks by name."""
    reader.Update()
    return dict(_leaves(reader.GetOutput()))


def raise_first_error(source: Path, messages: Messages) -> None:
    """Raise VTK's first error, which names the cause of the others."""
    if messages.errors:
        raise InputError(f"{source}: VTK's OpenFOAM reader says: {messages.errors[0]}")


def _leaves(block: Any) -> Iterator[tuple[str, Any]]:
    for index in range(block.GetNumberOfBlocks()):
        part = block.GetBlock(index)
        if isinstance(part, vtkMultiBlockDataSet):
            yield from _leaves(part)
        elif part is not None:
            yield block.GetMetaData(index).Get(vtkCompositeDataSet.NAME()), part
