"""Guard against damaged files on which VTK crashes, so that no error can be caught.

A second process, started on demand, first reads each file in a fork of itself, and reports how the fork
ended.
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

_LEAST_TIME = 20
_MOST_FILES = 10_000
_LISTS = frozenset({".vtm", ".pvd", ".pvtu", ".pvti", ".pvtr", ".pvts", ".case"})
"""Suffixes of files that include other files."""
_lock = threading.Lock()
_server: Any = None


def load_pyvista() -> Any:
    """Import pyvista, by which mesh files are read."""
    return load("pyvista", "meshes", "mesh files need")


def times_of(path: Path) -> list[float]:
    """Return the times of a VTK file, rising; empty if it has no times."""
    return _times(_reader_of(path))


def read_vtk(path: Path, step: int | None = None) -> Any:
    """Read a VTK file, at the ``step``-th of its times if it has any."""
    pyvista = load_pyvista()
    reader = _reader_of(path)
    if step is not None and isinstance(reader, pyvista.HDFReader):
        reader.reader.SetStep(step)
    elif step is not None and isinstance(reader, pyvista.CGNSReader):
        reader.reader.UpdateTimeStep(_times(reader)[step])
    elif step is not None:
        reader.set_active_time_value(_times(reader)[step])
    return reader.read()


def _reader_of(path: Path) -> Any:
    pyvista = load_pyvista()
    reader = pyvista.get_reader(path, force_ext=".xdmf" if path.suffix == ".xmf" else None)
    if isinstance(reader, pyvista.CGNSReader):
        # The patches of CGNS need not cover the boundary.
        reader.load_boundary_patch = False
    return reader


def _times(reader: Any) -> list[float]:
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

    if not isinstance(reader, load_pyvista().HDFReader | load_pyvista().CGNSReader):
        return list(getattr(reader, "time_values", None) or [])
    # Pyvista ignores the times of these files.
    reader.reader.UpdateInformation()
    about, key = reader.reader.GetOutputInformation(0), vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return list(about.Get(key)) if about.Has(key) else []


def require_survival(path: Path, step: int | None = None) -> None:
    """Check that VTK can read a file, at the ``step``-th of its times if it has any, without crashing.

    Raises
    ------
    InputError
        A signal ended the process that read the file, or it exceeded its processor time.
    """
    with _lock:
        number = _ask(path, step)
    if number == signal.SIGXCPU:
        raise InputError(
            f"{path}: VTK has not finished within {_limit(path)} s of processor time; the file is damaged."
        )
    if number:
        name = signal.Signals(number).name
        raise InputError(f"{path}: VTK cannot read it and crashes ({name}); the file is damaged.")


def _limit(path: Path) -> int:
    """Return the limit of processor time for reading a file, s: 20 s plus one second per megabyte."""
    # The folder may hold many other files.
    files = islice(path.parent.rglob("*"), _MOST_FILES) if path.suffix in _LISTS else [path]
    return _LEAST_TIME + sum(file.stat().st_size for file in files if file.is_file()) // 1_000_000


def _ask(path: Path, step: int | None) -> int:
    """Return the signal that ended the fork that read the file, or 0."""
    global _server
    if _server is None or _server.poll() is not None:
        command = [sys.executable, "-P", "-W", "ignore", "-m", "foamprb.flow.read.vtk_guard"]
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
            f"{path}: the process that tests whether VTK can read the file has ended: {error}."
        ) from None


def _end(server: Any) -> None:
    """End the second process."""
    with server:
        server.kill()


def _serve() -> None:
    """Read lines of path, time and limit from the standard input; print numbers of signals."""
    import contextlib

    # Imported once for all forks.
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
    """Access every number of the data."""
    for part in data.recursive_iterator() if isinstance(data, load_pyvista().MultiBlock) else [data]:
        for values in (part.points, *part.cell_data.values(), *part.point_data.values()):
            values.sum()


if __name__ == "__main__":
    _serve()
