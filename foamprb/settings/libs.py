"""Models and cloud functions of users in Python files of the settings: ``libs ("rubber.py");``."""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import re
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from foamprb.body.drag import DRAGS
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import MATERIALS
from foamprb.cloud.forces import FORCES, SAMPLE, STATE, tried
from foamprb.cloud.layout import IDENTITY
from foamprb.cloud.surroundings.registry import SURROUNDINGS, UserSurrounding
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.compile.link import link
from foamprb.errors import InputError

log = logging.getLogger("foamprb")

_REGISTRIES: dict[str, dict[str, Any]] = {
    "solid": MATERIALS,
    "drag": DRAGS,
    "force": FORCES,
    "surroundings": SURROUNDINGS,
    "cloud function": FUNCTIONS,
}
_loaded: dict[Path, tuple[str, dict[tuple[str, str], Any]]] = {}
"""Checksum of each file, empty if it failed, and the models that it has added, by registry and name."""
_of_case: list[Path] = []
"""Files of the case whose settings were read last."""


def loaded_libs() -> tuple[Path, ...]:
    """Return the files of the case whose settings were read last."""
    return tuple(_of_case)


def require_inside(files: Iterable[Path], case: Path) -> None:
    """Refuse Python files outside a case.

    Raises
    ------
    InputError
        If one of them lies elsewhere, or a link leads there.
    """
    for file in files:
        if not file.resolve().is_relative_to(case.resolve()):
            raise InputError(
                f"{file} of libs lies outside the case. It is not run. If you trust it, add the option "
                "-outsideLibs."
            )


def load_libs(files: Iterable[Path]) -> list[str]:
    """Run Python files, which add models, and compile them.

    They call :func:`foamprb.add_material`, :func:`foamprb.add_drag`, :func:`foamprb.add_force`,
    :func:`foamprb.add_surrounding` and :func:`foamprb.add_cloud_function`. An unchanged file is not run
    again; the earlier models of a changed file are removed. Models of files of other cases stay, but for
    those that have the name of a model of these files.
    Returns the SHA-256 of each file.

    Raises
    ------
    InputError
        If a file fails, or adds a model that is unsound or cannot be compiled; with place and reason.
    """
    paths = [file.resolve() for file in files]
    before = _registered()
    for path, (_, models) in _loaded.items():
        for (kind, name), model in models.items():
            if _REGISTRIES[kind].get(name) is model:
                del _REGISTRIES[kind][name]
            if path in paths:
                before.pop((kind, name), None)
    _of_case.clear()
    try:
        for path in paths:
            _load(path)
            _of_case.append(path)
    finally:
        for (kind, name), model in before.items():
            _REGISTRIES[kind].setdefault(name, model)
    return [_loaded[path][0] for path in paths]


def _load(path: Path) -> None:
    """Add the models of a file."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    before, models = _loaded.get(path, ("", {}))
    if before == digest:
        for (kind, name), model in models.items():
            if _REGISTRIES[kind].setdefault(name, model) is not model:
                raise InputError(f"{path}: the {kind} {name} exists already.")
        return
    earlier = _registered()
    log.info("Running the Python file %s of libs", path)
    try:
        _run(path, digest)
    finally:
        added = {key: model for key, model in _registered().items() if key not in earlier}
        _loaded[path] = ("", added)
    for kind, name in sorted(added):
        _check(path, kind, name)
    _loaded[path] = (digest, added)


def _registered() -> dict[tuple[str, str], Any]:
    """Return all models, by registry and name."""
    return {(kind, name): model for kind, models in _REGISTRIES.items() for name, model in models.items()}


def _run(path: Path, digest: str) -> None:
    name = f"foamprb_libs_{path.stem}_{digest[:12]}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"{path} is not a Python file (.py).")
    module = importlib.util.module_from_spec(spec)
    # Cached machine code imports the module by its name.
    sys.modules[name] = module
    with _one_message(path):
        spec.loader.exec_module(module)


@contextmanager
def _one_message(path: Path) -> Iterator[None]:
    """Raise InputError, with the line of a file, in place of any error."""
    try:
        yield
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == str(path)]
        line = error.lineno if isinstance(error, SyntaxError) else (lines[-1] if lines else None)
        where = f"{path}, line {line}" if line else str(path)
        raise InputError(f"{where}: {type(error).__name__}: {error}.") from error


@contextmanager
def compiling_libs() -> Iterator[None]:
    """Raise InputError in place of an error of compilation, if models of ``libs`` are compiled."""
    from numba.core.errors import NumbaError

    try:
        yield
    except (NumbaError, TypeError, ValueError) as error:
        files = loaded_libs()
        if not files:
            raise
        raise InputError(_fault_of(error, files)) from error


def _fault_of(error: Exception, files: Sequence[Path]) -> str:
    """Return a message with the line of a file that numba could not compile, if it names one."""
    for path in files:
        match = re.search(rf'File "[^"]*{re.escape(path.name)}", line (\d+)', str(error))
        if match is not None:
            line = path.read_text().splitlines()[int(match[1]) - 1].strip()
            return f"{path}, line {match[1]}: '{line}' cannot be compiled. {_ADVICE}"
    first = next((line.strip() for line in str(error).splitlines() if line.strip()), "")
    return f"{', '.join(map(str, files))}: the models cannot be compiled: {first} {_ADVICE}"


_ADVICE = "Use arithmetic and numpy functions of numbers."


def _check(file: Path, kind: str, name: str) -> None:
    """Try a model as far as it needs no flow; refuse a name that two entries of ``particleForces`` have."""
    if kind == "cloud function":
        # It is tried with the cloud.
        return
    if kind == "drag":
        axes = (3.0, 2.0, 1.0)
        _compile(file, DRAGS[name], axes, integrals(axes))
    elif name == "ellipsoidDrag" or (name in FORCES and name in SURROUNDINGS):
        raise InputError(f"{file}: particleForces has an entry {name} already.")
    elif kind == "solid":
        material = MATERIALS[name]
        k = 1.0 if material.parameter is None else material.parameter.lower + 1.0
        if material.stress is None:
            _compile(file, material.derivatives, 3.0, 3.0, 1.0, 1.0, 1.0, k)
        else:
            _compile(file, material.stress, IDENTITY, 1.0, 1.0, 1.0, k)
    elif kind == "force":
        force = tried(FORCES[name])
        # The kinds of fields are known with the case.
        if not force.needed_fields:
            needed = [STATE[need] for need in force.needs]
            _compile(file, type(force).evaluate, SAMPLE, *needed, *force.coefficients)
    else:
        model = tried(SURROUNDINGS[name])
        assert isinstance(model, UserSurrounding)
        _compile(file, model.evaluate, *model.samples, *model.coefficients(()))


def _compile(file: Path, function: Callable[..., Any], *arguments: object) -> None:
    from numba.core.errors import NumbaError

    try:
        link(function)(*arguments)
    except (NumbaError, TypeError, ValueError) as error:
        raise InputError(_fault_of(error, [file.resolve()])) from error
