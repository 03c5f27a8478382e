"""The one place where plain formulas become machine code.

The mathematics of foamprb is written once, as plain functions of floats, tuples and array elements.
:func:`link` follows the functions that an entry function calls, through their module globals, and compiles
the whole with numba; the plain text stays callable as it is, on
floats or on numpy arrays. A model that the user chooses (a traction, a drag law, a flow) is bound to the name
by which the entry function calls it.
"""

from __future__ import annotations

import dis
import hashlib
import inspect
import platform
import sys
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple, TypeGuard

import numba
import numpy as np
from llvmlite import binding  # type: ignore[import-untyped]

from foamprb.body.tensor import select
from foamprb.compile import internals as inner
from foamprb.compile import trace
from foamprb.compile.cache import Store
from foamprb.compile.internals import SIDE_BY_SIDE, Role, internals

__all__ = ["compile_part", "is_compiled", "link", "read_by", "side_by_side"]

# Contraction and the sign of zero only: results may not depend on how a sum is ordered.
_FAST_MATH = ("contract", "nsz")
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "nogil": True,
    "fastmath": set(_FAST_MATH),
}


def link(
    entry: Callable[..., Any],
    bindings: Mapping[str, Any] | None = None,
    separate: Collection[Callable[..., Any]] = (),
) -> Any:
    """Compile ``entry`` with everything it calls.

    Parameters
    ----------
    entry
        A plain function whose callees are module globals (imported by name, not as ``module.name``). What a
        function captures from the one around it, or has as defaults, are numbers, or tuples of numbers.
    bindings
        Functions and constants to put under a global name that ``entry`` or its callees use, e.g.
        ``{"traction": roscoe}``.
    separate
        Callees that are compiled on their own, and called, so that several entries of a process share them;
        every other callee is inlined.

    Returns
    -------
    A numba dispatcher. Equal code with equal bindings is compiled once per process; the entry and its
    separate callees are saved in :mod:`foamprb.compile.cache`, under keys made of the code of every function
    that was linked.

    Raises
    ------
    NameError
        If no linked function reads a name in ``bindings`` (:func:`read_by` selects from a larger set).
    """
    bindings = dict(bindings or {})
    unread = bindings.keys() - read_by(entry, bindings).keys()
    if unread:
        names = ", ".join(sorted(unread))
        raise NameError(f"{entry.__qualname__} is bound to {names}, a name that no linked function reads")
    return _link(entry, _Linkage(bindings, frozenset(separate)), "entry").dispatcher


def read_by(entry: Callable[..., Any], bindings: Mapping[str, Any]) -> dict[str, Any]:
    """Return those of the bindings whose names ``entry`` or a function linked with it reads."""
    found: set[str] = set()
    reached = {entry}
    pending = [entry]
    while pending:
        function = pending.pop()
        for name in _global_names(function.__code__):
            found.add(name)
            value = bindings.get(name, function.__globals__.get(name))
            if _is_linked(value) and value not in reached:
                reached.add(value)
                pending.append(value)
    return {name: value for name, value in bindings.items() if name in found}


def side_by_side(function: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a stage in which each operation waits for the one before: two registers full of lanes go together.

    It holds for separate callees that are traced (:mod:`foamprb.compile.trace`). Where much is at hand to be
    computed there are not enough registers.
    """
    setattr(function, SIDE_BY_SIDE, True)
    return function


def compile_part(
    function: Callable[..., Any],
    arguments: Mapping[str, Any],
    bindings: Mapping[str, Any],
    separate: Collection[Callable[..., Any]],
) -> None:
    """Compile a callee of an entry before that is compiled, here or by another process.

    Parameters
    ----------
    arguments
        An example of each argument, by the names of the parameters; there may be others.
    bindings, separate
        As the entry will have them. Only separate callees are saved in the cache, for others to find.
    """
    role: Role = "separate" if function in separate else "inlined"
    part = _link(function, _Linkage(dict(bindings), frozenset(separate)), role)
    names = inspect.signature(function).parameters
    part.dispatcher.compile(tuple(numba.typeof(arguments[name]) for name in names))


def is_compiled(dispatcher: Any) -> bool:
    """Whether what :func:`link` gave has been compiled, in this process or in one that saved the code."""
    return bool(dispatcher.signatures) or bool(_stores.get(id(dispatcher)))


class _Linkage(NamedTuple):
    """What holds for all functions of one linking."""

    bindings: dict[str, Any]
    separate: frozenset[Callable[..., Any]]


class _Part(NamedTuple):
    """A compiled function, and a key that changes with its code and with that of all it calls."""

    dispatcher: Any
    key: str


# How functions are linked is a part of what makes their code.
_HOW = (inner.__file__, trace.__file__, __file__)
_LINKING = hashlib.sha256(b"".join(Path(file).read_bytes() for file in _HOW)).hexdigest()[:8]


_parts: dict[str, _Part] = {}
_stores: dict[int, Store | None] = {}


def _link(function: Callable[..., Any], linkage: _Linkage, role: Role) -> _Part:
    """Compile a function after its callees; a part that has been compiled before is used again."""
    if function is select:
        return _link_select()
    assert isinstance(function, FunctionType), f"{function!r} is not a plain function"
    scope = dict(function.__globals__)
    own = f"{_compiler()} {role} {function.__module__} {function.__qualname__} {function.__defaults__!r}"
    digest = hashlib.sha256(own.encode())
    digest.update(_fingerprint(function.__code__))
    captured = [cell.cell_contents for cell in function.__closure__ or ()]
    together = getattr(function, SIDE_BY_SIDE, False)
    digest.update(f"{captured!r} {together}".encode())
    for name in sorted(_global_names(function.__code__)):
        value = linkage.bindings.get(name, scope.get(name))
        if _is_linked(value):
            part = _link(value, linkage, "separate" if value in linkage.separate else "inlined")
            scope[name] = part.dispatcher
            digest.update(f"{name}={part.key};".encode())
        elif isinstance(value, int | float | tuple):
            scope[name] = _offsets(value) if _are_offsets(value) else _constant(value)
            digest.update(f"{name}={value!r};".encode())
        elif isinstance(value, type) and issubclass(value, tuple):
            digest.update(f"{name}={getattr(value, '_fields', '')};".encode())
    key = digest.hexdigest()[:24]
    if key not in _parts:
        cells = tuple(CellType(_constant(value)) for value in captured)
        clone = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, cells)
        # Code is linked by name, and other processes may have put other models behind a name.
        clone.__qualname__ = f"{function.__qualname__}_{key}"
        clone.__module__ = function.__module__
        setattr(clone, SIDE_BY_SIDE, together)
        _parts[key] = _Part(_compile(clone, role, key), key)
    return _parts[key]


def _is_linked(value: Any) -> TypeGuard[FunctionType]:
    """Return True for a plain function, which is compiled with its callers."""
    return isinstance(value, FunctionType) and not value.__module__.startswith(("numpy", "numba"))


def _constant(value: Any) -> Any:
    """What stands for a constant: numba compiles a function anew for each Python int that it is given."""
    return np.int64(value) if type(value) is int else value


def _are_offsets(value: Any) -> bool:
    """Whether a constant is a named tuple of whole numbers, such as those at which a block's rows begin."""
    return hasattr(value, "_fields") and all(type(item) is int for item in value)


def _offsets(value: Any) -> ModuleType:
    """What stands for such a tuple: numba takes a module's attribute for the constant that it is."""
    module = ModuleType(type(value).__name__)
    vars(module).update({name: _constant(item) for name, item in value._asdict().items()})
    return module


def _link_select() -> _Part:
    """The branch that ``select`` is of scalars."""
    key = "select"
    if key not in _parts:
        _parts[key] = _Part(numba.njit(inline="always")(trace.branch), key)
    return _parts[key]


# Found once: a process that has gone to another user may not be able to look again.
_version = cache(version)


def _compiler() -> str:
    """What makes the code, and how, and for which processor."""
    python = f"{sys.implementation.cache_tag} numba {numba.__version__} {_LINKING}"
    # A set has another order in every process.
    options = [_OPTIONS[name] for name in sorted(_OPTIONS) if name != "fastmath"]
    how = f"{_FAST_MATH} {options} {internals().parts}"
    return f"{python} llvmlite {_version('llvmlite')} {how} {_processor()}"


@cache
def _processor() -> str:
    """Name and features of the processor that the code is made for: a home may be shared by many machines."""
    with suppress(RuntimeError):
        features = binding.get_host_cpu_features().flatten()
        # As NUMBA_CPU_NAME and NUMBA_CPU_FEATURES set them.
        chosen = f"{numba.config.CPU_NAME} {numba.config.CPU_FEATURES}"
        return f"{binding.get_host_cpu_name()} {features} {chosen}"
    return platform.machine()


def _compile(function: Callable[..., Any], role: Role, key: str) -> Any:
    used = internals()
    dispatcher = numba.njit(**used.options[role], **_OPTIONS)(function)
    used.prepare(dispatcher)
    if role != "inlined":
        _stores[id(dispatcher)] = used.use_cache(dispatcher, key, role)
    return dispatcher


@cache
def _global_names(code: CodeType) -> frozenset[str]:
    """Names that the code reads from its module; ``co_names`` has those of attributes as well."""
    own = frozenset(step.argval for step in dis.get_instructions(code) if step.opname == "LOAD_GLOBAL")
    return own.union(*(_global_names(item) for item in code.co_consts if isinstance(item, CodeType)))


def _fingerprint(code: CodeType) -> bytes:
    """Bytes that change with what the code does, and not with where it stands."""
    parts = [code.co_code, repr(code.co_names).encode(), repr(code.co_varnames).encode()]
    for constant in code.co_consts:
        parts.append(_fingerprint(constant) if isinstance(constant, CodeType) else repr(constant).encode())
    return b"|".join(parts)
