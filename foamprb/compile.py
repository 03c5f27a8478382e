"""The one place where plain formulas become machine code.

The mathematics of foamprb is written once, as plain functions of floats, tuples and array elements.
:func:`link` follows the functions that an entry function calls, through their module globals, and compiles
the whole with numba; the plain text stays callable as it is, on floats or on numpy arrays. A model that the
user chooses (a traction, a drag law, a flow) is bound to the name by which the entry function calls it.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import numba
import platformdirs

from foamprb.body.tensor import select

__all__ = ["cache_directory", "link"]

# Contraction and the sign of zero only: results may not depend on how a sum is ordered.
_FAST_MATH = ("contract", "nsz")
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "nogil": True,
    "fastmath": set(_FAST_MATH),
}


def cache_directory() -> Path:
    """Folder of the compiled code: ``$FOAMPRB_CACHE_DIR``, else the user's cache folder."""
    chosen = os.environ.get("FOAMPRB_CACHE_DIR")
    return Path(chosen) if chosen else Path(platformdirs.user_cache_dir("foamprb", appauthor=False))


def link(
    entry: Callable[..., Any],
    bindings: Mapping[str, Callable[..., Any]] | None = None,
    separate: Collection[Callable[..., Any]] = (),
) -> Any:
    """Compile ``entry`` with everything it calls.

    Parameters
    ----------
    entry
        A plain function whose callees are module globals (imported by name, not as ``module.name``).
    bindings
        Functions to put under a global name that ``entry`` or its callees use, e.g. ``{"traction": roscoe}``.
    separate
        Callees that are compiled and cached on their own, and called, so that several entries share them;
        every other callee is inlined.

    Returns
    -------
    A numba dispatcher. Equal code with equal bindings is compiled once per process and kept on disk in
    :func:`cache_directory`, under a key made of the code of every function that was linked.
    """
    linker = _Linker(dict(bindings or {}), separate)
    clone = linker.clone(entry)
    key = linker.key()
    if key not in _compiled:
        dispatcher = numba.njit(**_OPTIONS)(clone)
        _enable_cache(dispatcher, key)
        _compiled[key] = dispatcher
        _keys[dispatcher] = key
    return _compiled[key]


_compiled: dict[str, Any] = {}
_keys: dict[Any, str] = {}


@numba.njit(inline="always")  # type: ignore[untyped-decorator]
def _select_scalar(condition: Any, a: Any, b: Any) -> Any:
    return a if condition else b


class _Linker:
    """Clones functions so that each global callee is a compiled one; remembers what it has seen."""

    def __init__(
        self, bindings: dict[str, Callable[..., Any]], separate: Collection[Callable[..., Any]]
    ) -> None:
        self._bindings = bindings
        self._separate = separate
        self._linked: dict[Callable[..., Any], Any] = {select: _select_scalar}
        self._digest = hashlib.sha256(f"{numba.__version__} {_FAST_MATH}".encode())

    def key(self) -> str:
        return self._digest.hexdigest()[:24]

    def clone(self, function: Callable[..., Any]) -> FunctionType:
        assert isinstance(function, FunctionType), f"{function!r} is not a plain function"
        names = _global_names(function.__code__)
        values = {name: self._bindings.get(name, function.__globals__.get(name)) for name in names}
        scope = dict(function.__globals__)
        for name, value in sorted(values.items()):
            if isinstance(value, FunctionType) and not value.__module__.startswith(("numpy", "numba")):
                scope[name] = self._compiled(value)
            elif isinstance(value, int | float | tuple):
                self._digest.update(f"{name}={value!r};".encode())
        self._digest.update(_fingerprint(function.__code__))
        clone = FunctionType(function.__code__, scope, function.__name__, function.__defaults__)
        clone.__qualname__ = function.__qualname__
        clone.__module__ = function.__module__
        return clone

    def _compiled(self, function: FunctionType) -> Any:
        if function not in self._linked:
            if function in self._separate:
                part = link(function, self._bindings)
                self._digest.update(_keys[part].encode())
            else:
                part = numba.njit(forceinline=True, **_OPTIONS)(self.clone(function))
            self._linked[function] = part
        return self._linked[function]


def _global_names(code: CodeType) -> set[str]:
    inner = (_global_names(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*inner)


def _fingerprint(code: CodeType) -> bytes:
    """Bytes that change with what the code does, and not with where it stands."""
    parts = [code.co_code, repr(code.co_names).encode(), repr(code.co_varnames).encode()]
    for constant in code.co_consts:
        parts.append(_fingerprint(constant) if isinstance(constant, CodeType) else repr(constant).encode())
    return b"|".join(parts)


def _enable_cache(dispatcher: Any, key: str) -> None:
    folder = cache_directory() / key
    previous = numba.config.CACHE_DIR
    try:
        folder.mkdir(parents=True, exist_ok=True)
        numba.config.CACHE_DIR = str(folder)
        dispatcher.enable_caching()
    except (OSError, RuntimeError):
        # A read-only home costs the compilation anew in each run, nothing else.
        pass
    finally:
        numba.config.CACHE_DIR = previous
