"""VTK's OpenFOAM reader, and the messages of VTK."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import pyvista
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

from foamprb.errors import InputError

_MESSAGE = re.compile(
    r"^(ERROR|Warning|Generic Warning): In .*?, line \d+\n(?:\S+ \(0x[0-9a-f]+\): )?(.*)", re.MULTILINE
)
_MOST_MESSAGES = 100


class Messages(NamedTuple):
    """The messages of VTK, each once."""

    errors: list[str]
    warnings: list[str]


class _LogHandler(logging.Handler):
    """Collects the errors that are logged."""

    def __init__(self, errors: list[str]) -> None:
        super().__init__(logging.ERROR)
        self._errors = errors

    def emit(self, record: logging.LogRecord) -> None:
        self._errors.append(" ".join(record.getMessage().split()))


@contextmanager
def vtk_messages() -> Iterator[Messages]:
    """Collect what VTK would print, in lists that are filled when the block ends."""
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
            # VTK quotes the contents of a broken file.
            text = text.decode("utf-8", "replace")
        for kind, message in _MESSAGE.findall(text):
            message = " ".join(message.split())
            # VTK's old reader only warns of a file that is cut short.
            fatal = kind == "ERROR" or (kind == "Generic Warning" and message.startswith("Error"))
            similar = messages.errors if fatal else messages.warnings
            if message not in similar and len(similar) < _MOST_MESSAGES:
                similar.append(message)


def read_blocks(
    case: Path, time: str | None, region: str, *, patches: bool
) -> tuple[dict[str, Any], Messages]:
    """The reader's blocks by name, ``internalMesh`` and the patches, without fields; and VTK's messages."""
    with vtk_messages() as messages:
        blocks = _update(_open(case, region, patches=patches), time)
    grid = blocks.get("internalMesh")
    if grid is None or grid.n_cells == 0:
        raise_first_error(case, messages)
        raise InputError(
            f"{case / 'constant' / region / 'polyMesh'}: no mesh could be read; a file is missing, broken or "
            "cut short."
        )
    return blocks, messages


def _open(case: Path, region: str, *, patches: bool) -> Any:
    """VTK's reader of the mesh and the patches."""
    reader = vtkOpenFOAMReader()
    # The name only tells the folder; the file need not be there.
    reader.SetFileName(str(case.resolve() / "case.foam"))
    reader.SetCreateCellToPoint(False)
    reader.SetSkipZeroTime(False)
    reader.SetReadZones(False)
    reader.UpdateInformation()
    reader.DisableAllCellArrays()
    reader.DisableAllPointArrays()
    reader.DisableAllLagrangianArrays()
    for index in range(reader.GetNumberOfPatchArrays()):
        part = reader.GetPatchArrayName(index)
        of_region = f"/{region}/" if region else ""
        inner = part.removeprefix(of_region)
        wanted = part.startswith(of_region) and (
            inner == "internalMesh" or (patches and inner.startswith("patch/"))
        )
        reader.SetPatchArrayStatus(part, int(wanted))
    return reader


def _update(reader: Any, time: str | None) -> dict[str, Any]:
    """The reader's blocks by name at a time."""
    if time is None:
        reader.Update()
    else:
        reader.UpdateTimeStep(float(time))
    return dict(_leaves(pyvista.wrap(reader.GetOutput())))


def raise_first_error(case: Path, messages: Messages) -> None:
    """Raise VTK's first error, which names the cause; those after it follow from it."""
    if messages.errors:
        raise InputError(f"{case}: VTK's OpenFOAM reader says: {messages.errors[0]}")


def _leaves(block: Any) -> Iterator[tuple[str, Any]]:
    for name, part in zip(block.keys(), block, strict=True):
        if isinstance(part, pyvista.MultiBlock):
            yield from _leaves(part)
        elif part is not None:
            yield name, part
