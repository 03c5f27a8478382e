"""User-made solids in Python files of the settings: ``libs ("rubber.py");``."""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import sys
import traceback
from collections.abc import Iterable
from pathlib import Path

from numba.core.errors import NumbaError

from foamprb.body.material import MATERIALS
from foamprb.compile.link import link
from foamprb.errors import InputError

log = logging.getLogger("foamprb")

_loaded: dict[Path, tuple[str, tuple[str, ...]]] = {}


def loaded_libs() -> tuple[Path, ...]:
    """Return the files whose solids are loaded."""
    return tuple(path for path, (digest, _) in _loaded.items() if digest)


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


def load_libs(files: Iterable[Path]) -> None:
    """Run Python files, which add solids by :func:`foamprb.add_material`, and compile these solids.

    An unchanged file is not run again; the earlier solids of a changed file are removed.

    Raises
    ------
    InputError
        If a file fails, or adds a solid that is unsound or cannot be compiled; with place and reason.
    """
    for file in files:
        path = file.resolve()
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        before, names = _loaded.get(path, ("", ()))
        if before == digest:
            continue
        for name in names:
            MATERIALS.pop(name, None)
        known = set(MATERIALS)
        log.info("Running the Python file %s of libs", path)
        try:
            _run(path, digest)
        finally:
            _loaded[path] = ("", tuple(set(MATERIALS) - known))
        for name in _loaded[path][1]:
            _compile(file, name)
        _loaded[path] = (digest, _loaded[path][1])


def _run(path: Path, digest: str) -> None:
    name = f"foamprb_libs_{path.stem}_{digest[:12]}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"{path} is not a Python file (.py).")
    module = importlib.util.module_from_spec(spec)
    # Cached machine code imports the module by its name.
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == str(path)]
        line = error.lineno if isinstance(error, SyntaxError) else (lines[-1] if lines else None)
        where = f"{path}, line {line}" if line else str(path)
        raise InputError(f"{where}: {type(error).__name__}: {error}.") from error


def _compile(file: Path, name: str) -> None:
    material = MATERIALS[name]
    k = 1.0 if material.parameter is None else material.parameter.lower + 1.0
    try:
        link(material.derivatives)(3.0, 3.0, 1.0, 1.0, 1.0, k)
    except NumbaError as error:
        first = next((line.strip() for line in str(error).splitlines() if line.strip()), "")
        raise InputError(
            f"{file}: the solid {name} cannot be compiled: {first} "
            "Use arithmetic and numpy functions of numbers."
        ) from error
