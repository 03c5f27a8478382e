"""Guards against files on which VTK crashes: some damaged ones end the process, with no error to catch.

A second process, started when it is first needed, reads each file first, in a copy of itself, and reports how
the copy ended.
"""

from __future__ import annotations

import atexit
import json
import os
import resource
import signal
import subprocess
import sys
import threading
from itertools import islice
from pathlib import Path
from typing import Any

from foamprb.errors import InputError
from foamprb.optional import load

__all__ = ["load_pyvista", "read_vtk", "require_survival", "times_of"]

_LEAST_TIME = 20
_MOST_FILES = 10_000
_LISTS = frozenset({".vtm", ".pvd", ".pvtu"})
"""Files that name others, which are read with them."""
_lock = threading.Lock()
_server: Any = None


def load_pyvista() -> Any:
    """Import pyvista, by which mesh files are read.

    Raises
    ------
    InputError
        If it is not installed.
    """
    return load("pyvista", "meshes", "mesh files need")


def times_of(path: Path) -> list[float]:
    """The times of a file of VTK's, rising; none if it has no time."""
    return _times(load_pyvista().get_reader(path))


def read_vtk(path: Path, step: int | None = None) -> Any:
    """Read a file of VTK's, at the ``step``-th of its times if it has any."""
    pyvista = load_pyvista()
    reader = pyvista.get_reader(path)
    if step is not None and isinstance(reader, pyvista.HDFReader):
        reader.reader.SetStep(step)
    elif step is not None:
        reader.set_active_time_value(_times(reader)[step])
    return reader.read()


def _times(reader: Any) -> list[float]:
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

    if not isinstance(reader, load_pyvista().HDFReader):
        return list(getattr(reader, "time_values", None) or [])
    # Pyvista passes over the times of these.
    reader.reader.UpdateInformation()
    about, key = reader.reader.GetOutputInformation(0), vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return list(about.Get(key)) if about.Has(key) else []


def require_survival(path: Path, step: int | None = None) -> None:
    """Raise InputError for a file that VTK does not survive, at the ``step``-th of its times if it has any.

    Raises
    ------
    InputError
        Reading the file ended the process that tried, by which signal; or it did not come to an end.
    """
    with _lock:
        number = _ask(path, step)
    if number == signal.SIGXCPU:
        raise InputError(
            f"{path}: VTK has not come to an end within {_limit(path)} s of processor time; the file is "
            "damaged."
        )
    if number:
        name = signal.Signals(number).name
        raise InputError(f"{path}: VTK cannot read it and does not survive it ({name}); the file is damaged.")


def _limit(path: Path) -> int:
    """Processor time after which reading a file is given up, s: 20 s, and a second more per megabyte."""
    # The folder may be one in which much else lies.
    files = islice(path.parent.rglob("*"), _MOST_FILES) if path.suffix in _LISTS else [path]
    return _LEAST_TIME + sum(file.stat().st_size for file in files if file.is_file()) // 1_000_000


def _ask(path: Path, step: int | None) -> int:
    """The signal that ended the copy that read the file, 0 if none did."""
    global _server
    if _server is None or _server.poll() is not None:
        command = [sys.executable, "-W", "ignore", "-m", "foamprb.flow.read.vtk_guard"]
        _server = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        atexit.register(_end, _server)
    try:
        _server.stdin.write(json.dumps([str(path.resolve()), step, _limit(path)]) + "\n")
        _server.stdin.flush()
        return int(_server.stdout.readline())
    except (OSError, ValueError) as error:
        raise InputError(
            f"{path}: the process that tries whether VTK can read it has ended: {error}."
        ) from None


def _end(server: Any) -> None:
    """End the second process, whatever it is at."""
    with server:
        server.kill()


def _serve() -> None:
    """Answer lines of path, time and limit on the standard input with numbers of signals."""
    import contextlib

    # Once for all the copies.
    load_pyvista()
    answers = os.fdopen(os.dup(1), "w")
    with open(os.devnull, "wb") as nothing:  # noqa: PTH123
        os.dup2(nothing.fileno(), 1)
    for line in sys.stdin:
        copy = os.fork()
        if copy == 0:
            with contextlib.suppress(BaseException):
                path, step, limit = json.loads(line)
                resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
                _touch(read_vtk(Path(path), step))
            os._exit(0)
        _, status = os.waitpid(copy, 0)
        answers.write(f"{os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0}\n")
        answers.flush()


def _touch(data: Any) -> None:
    """Read every number of what was read."""
    for part in data.recursive_iterator() if isinstance(data, load_pyvista().MultiBlock) else [data]:
        for values in (part.points, *part.cell_data.values(), *part.point_data.values()):
            values.sum()


if __name__ == "__main__":
    _serve()
