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
from typing import Any, NamedTuple

import numba
import platformdirs

from foamprb.body.tensor import select

__all__ = ["cache_directory", "is_compiled", "link"]

# Contraction and the sign of zero only: results may not depend on how a sum is ordered.
_FAST_MATH = ("contract", "nsz")
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "nogil": True,
    "fastmath": set(_FAST_MATH),
    # No function allocates or keeps an array; counting references to those it is given would take more time
    # than all else.
    "_nrt": False,
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
    return _link(entry, dict(bindings or {}), frozenset(separate), _ENTRY).dispatcher


def is_compiled(dispatcher: Any) -> bool:
    """Whether what :func:`link` gave has been compiled, in this process or in one whose code is kept."""
    folder = _folders.get(id(dispatcher))
    return bool(dispatcher.signatures) or (folder is not None and any(folder.glob("*.nbc")))


class _Part(NamedTuple):
    """A compiled function, and a key that changes with its code and with that of all it calls."""

    dispatcher: Any
    key: str


@numba.njit(inline="always")  # type: ignore[untyped-decorator]
def _select_scalar(condition: Any, a: Any, b: Any) -> Any:
    return a if condition else b


# A set has another order in every process.
_COMPILER = (
    f"{numba.__version__} {_FAST_MATH} {[_OPTIONS[name] for name in sorted(_OPTIONS) if name != 'fastmath']}"
)
_ENTRY: dict[str, Any] = {}
# Only compiled code calls these: wrappers for Python would cost a quarter of the compilation.
_SEPARATE: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
_INLINE: dict[str, Any] = {"forceinline": True, **_SEPARATE}

_parts: dict[str, _Part] = {}
_folders: dict[int, Path] = {}
_SELECT = _Part(_select_scalar, "select")


def _link(
    function: Callable[..., Any],
    bindings: dict[str, Callable[..., Any]],
    separate: frozenset[Callable[..., Any]],
    role: dict[str, Any],
) -> _Part:
    """Compile a function after its callees; a part that has been compiled before is used again."""
    if function is select:
        return _SELECT
    assert isinstance(function, FunctionType), f"{function!r} is not a plain function"
    scope = dict(function.__globals__)
    own = f"{_COMPILER} {role} {function.__module__} {function.__qualname__}"
    digest = hashlib.sha256(own.encode())
    digest.update(_fingerprint(function.__code__))
    for name in sorted(_global_names(function.__code__)):
        value = bindings.get(name, scope.get(name))
        if isinstance(value, FunctionType) and not value.__module__.startswith(("numpy", "numba")):
            part = _link(value, bindings, separate, _SEPARATE if value in separate else _INLINE)
            scope[name] = part.dispatcher
            digest.update(f"{name}={part.key};".encode())
        elif isinstance(value, int | float | tuple):
            digest.update(f"{name}={value!r};".encode())
    key = digest.hexdigest()[:24]
    if key not in _parts:
        clone = FunctionType(function.__code__, scope, function.__name__, function.__defaults__)
        clone.__qualname__ = function.__qualname__
        clone.__module__ = function.__module__
        dispatcher = numba.njit(**role, **_OPTIONS)(clone)
        if role is not _INLINE:
            _enable_cache(dispatcher, key)
        _parts[key] = _Part(dispatcher, key)
    return _parts[key]


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
    folder = _folders[id(dispatcher)] = cache_directory() / key
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
