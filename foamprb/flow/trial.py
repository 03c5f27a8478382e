"""Tries whether VTK survives a file: some damaged ones it ends the whole process on, with no error to catch.

A process apart, started when it is first needed, reads each file in a copy of itself and tells how the copy
ended.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

from foamprb.errors import InputError

__all__ = ["require_survival"]

_lock = threading.Lock()
_server: Any = None


def require_survival(path: Path) -> None:
    """Refuse a file that VTK does not survive.

    Raises
    ------
    InputError
        Reading the file ended the process that tried; the signal by which.
    """
    with _lock:
        number = _ask(path)
    if number:
        name = signal.Signals(number).name
        raise InputError(f"{path}: VTK cannot read it and does not survive it ({name}); the file is damaged.")


def _ask(path: Path) -> int:
    """The signal that ended the copy which read the file, 0 if none did."""
    global _server
    if _server is None or _server.poll() is not None:
        command = [sys.executable, "-W", "ignore", "-m", "foamprb.flow.trial"]
        _server = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
    try:
        _server.stdin.write(json.dumps(str(path.resolve())) + "\n")
        _server.stdin.flush()
        return int(_server.stdout.readline())
    except (OSError, ValueError) as error:
        raise InputError(
            f"{path}: the process that tries whether VTK can read it has ended: {error}."
        ) from None


def _serve() -> None:
    """Answer paths, one in each line of the standard input, with numbers of signals."""
    import contextlib

    import pyvista

    answers = os.fdopen(os.dup(1), "w")
    with open(os.devnull, "wb") as nothing:  # noqa: PTH123
        os.dup2(nothing.fileno(), 1)
    for line in sys.stdin:
        copy = os.fork()
        if copy == 0:
            with contextlib.suppress(BaseException):
                _touch(pyvista.get_reader(json.loads(line)).read())
            os._exit(0)
        _, status = os.waitpid(copy, 0)
        answers.write(f"{os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0}\n")
        answers.flush()


def _touch(data: Any) -> None:
    """Read every number of what was read."""
    import pyvista

    for part in data.recursive_iterator() if isinstance(data, pyvista.MultiBlock) else [data]:
        for values in (part.points, *part.cell_data.values(), *part.point_data.values()):
            values.sum()


if __name__ == "__main__":
    _serve()
