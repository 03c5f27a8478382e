"""Messages of VTK, collected."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

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
