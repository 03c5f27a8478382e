"""Compilation of plain formulas to machine code.

The mathematics of foamprb is written once, as plain functions of floats, tuples and array elements.
:func:`link` follows the functions that an entry function calls, through their module globals, and compiles
all of them with numba. The plain functions stay callable, on floats or on numpy arrays. A model that the user
selects (a traction, a drag law, a flow) is bound to the name by which the entry function calls it.

With ``NUMBA_DISABLE_JIT=1`` nothing is compiled: the same functions run in the interpreter, for a debugger.
"""

from __future__ import annotations

import dis
import hashlib
import logging
import os
import platform
import sys
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import version
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np

from foamprb.body.tensor import select
from foamprb.compile.cache import Store
from foamprb.compile.part import Keys, Part
from foamprb.compile.trace import TRACED, branch

if TYPE_CHECKING:
    from foamprb.compile.internals import Role

__all__ = [
    "allocating",
    "bound",
    "compiled",
    "is_compiled",
    "key_of",
    "link",
    "linked",
    "read_by",
    "traced",
]

log = logging.getLogger("foamprb")

TESTED = "0.68"
"""Minor version of numba with which :mod:`foamprb.compile.internals` was tested."""
SWITCH = "FOAMPRB_PLAIN_NUMBA"
"""Environment variable: 1 for plain numba, 0 for its internals with any version."""

# Contraction and the sign of zero only: results may not depend on how a sum is ordered.
_FAST_MATH = ("contract", "nsz")
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "nogil": True,
    "fastmath": set(_FAST_MATH),
    "no_cfunc_wrapper": True,
}
_ALLOCATES = "allocates"
_OPTIONS_OF: dict[Role, dict[str, Any]] = {
    "entry": {"forceinline": False},
    "stage": {"forceinline": False, "no_cpython_wrapper": True},
    "separate": {"forceinline": False, "no_cpython_wrapper": True},
    "inlined": {"forceinline": True, "no_cpython_wrapper": True},
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
        every other callee is inlined. Those that are :func:`traced` are stages.

    Returns
    -------
    A numba dispatcher. Equal code with equal bindings is compiled once per process; the entry and its
    separate callees are saved in :mod:`foamprb.compile.cache`, under keys made of the code of every function
    that was linked. Of stages the key of the entry contains the names only: an entry that differs in its
    stages is not compiled again.

    Raises
    ------
    NameError
        If no linked function reads a name in ``bindings`` (:func:`read_by` selects from a larger set).
    """
    from foamprb.compile.record_type import register_records

    register_records()
    bindings = dict(bindings or {})
    unread = bindings.keys() - read_by(entry, bindings).keys()
    if unread:
        names = ", ".join(sorted(unread))
        raise NameError(f"{entry.__qualname__} is bound to {names}, a name that no linked function reads")
    return _link(entry, _Linkage(bindings, frozenset(separate)), "entry").dispatcher


@cache
def compiled(entry: Callable[..., Any]) -> Any:
    """Return :func:`link` of a function without bindings, once per process."""
    return link(entry)


def read_by(entry: Callable[..., Any], bindings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the bindings whose names ``entry`` or a function linked with it reads."""
    names_read = {name for function in linked(entry, bindings) for name in _global_names(function.__code__)}
    return {name: value for name, value in bindings.items() if name in names_read}


def linked(entry: Callable[..., Any], bindings: Mapping[str, Any]) -> Collection[Callable[..., Any]]:
    """Return ``entry`` and the functions that are linked with it."""
    reached = {entry}
    pending = [entry]
    while pending:
        function = pending.pop()
        for name in _global_names(function.__code__):
            value = bindings.get(name, function.__globals__.get(name))
            if _is_linked(value) and value not in reached:
                reached.add(value)
                pending.append(value)
    return reached


def bound(function: Callable[..., Any], **names: Callable[..., Any] | int) -> Callable[..., Any]:
    """Return a copy of a plain function, with other functions or constants behind some of its names."""
    assert isinstance(function, FunctionType)
    return FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)


def traced(stage: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a stage that is traced where it is a separate callee (:mod:`foamprb.compile.trace`)."""
    setattr(stage, TRACED, True)
    return stage


def allocating(function: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a function that allocates arrays; wherever it is called, it is a separate callee."""
    setattr(function, _ALLOCATES, True)
    return function


def is_compiled(dispatcher: Any) -> bool:
    """Return True if a function that :func:`link` returned is compiled, here or in the cache."""
    import numba

    if numba.config.DISABLE_JIT or dispatcher.signatures:
        return True
    stores = _stores.get(id(dispatcher), ())
    return bool(stores) and all(stores)


@dataclass(frozen=True)
class _Linkage:
    """Arguments of :func:`link` that hold for all functions, and the functions that are linked already."""

    bindings: dict[str, Any]
    separate: frozenset[Callable[..., Any]]
    done: dict[tuple[Callable[..., Any], str], Part] = field(default_factory=dict)
    stages: dict[str, Part] = field(default_factory=dict)
    """By :attr:`Keys.outside`."""


# The code of this package is a part of every key.
_FILES = sorted(Path(__file__).parent.glob("*.py"))
_OWN_CODE = hashlib.sha256(b"".join(file.read_bytes() for file in _FILES)).hexdigest()[:8]


_parts: dict[str, Part] = {}
_stores: dict[int, tuple[Store, ...]] = {}
"""Where a function and its stages are saved, by the ``id`` of its dispatcher."""


def _link(function: Callable[..., Any], linkage: _Linkage, role: Role, called: str = "") -> Part:
    """Return a function linked after its callees, once however many callers it has.

    ``called`` is the name by which a stage is called.
    """
    task = function, f"{role} {called}"
    if task not in linkage.done:
        part = _link_once(function, linkage, role, called)
        if role == "stage" and linkage.stages.setdefault(part.keys.outside, part) is not part:
            # Another stage of this loop has the name, so the code must distinguish them.
            part = part._replace(keys=Keys(part.keys.full, part.keys.full))
            linkage.stages[part.keys.outside] = part
        linkage.done[task] = part
    return linkage.done[task]


def _link_callee(name: str, function: Callable[..., Any], linkage: _Linkage) -> Part:
    """Return a function that others call by a name."""
    if function not in linkage.separate and not hasattr(function, _ALLOCATES):
        return _link(function, linkage, "inlined")
    if not hasattr(function, TRACED) or _internals() is None:
        return _link(function, linkage, "separate")
    # A name that is not bound may mean other functions elsewhere.
    qualified = f"{function.__module__}.{function.__qualname__}"
    return _link(function, linkage, "stage", name if name in linkage.bindings else qualified)


def _link_once(function: Callable[..., Any], linkage: _Linkage, role: Role, called: str) -> Part:
    """Return a function compiled after its callees; each is compiled once per process."""
    if function is select:
        return _link_select()
    assert isinstance(function, FunctionType), f"{function!r} is not a plain function"
    names: dict[str, Any] = {}
    captured = [cell.cell_contents for cell in function.__closure__ or ()]
    is_traced = hasattr(function, TRACED)
    identity = f"{role} {called} {function.__module__} {function.__qualname__} {function.__defaults__!r}"
    code = f"{_fingerprint(function.__code__).hex()} {captured!r} {is_traced}"
    described = [Keys(identity, identity), Keys(code, code)]
    for name in sorted(_global_names(function.__code__)):
        value = linkage.bindings.get(name, function.__globals__.get(name))
        text = ""
        if _is_linked(value):
            part = _link_callee(name, value, linkage)
            names[name] = part.dispatcher
            described.append(Keys(*(f"{name}={key}" for key in part.keys)))
        elif isinstance(value, int | float | tuple):
            names[name] = _offsets(value) if _are_offsets(value) else _constant(value)
            text = f"{name}={value!r}"
        elif isinstance(value, type) and issubclass(value, tuple):
            text = f"{name}={getattr(value, '_fields', '')}"
        described.append(Keys(text, text))
    keys = Keys(*map(key_of, zip(*described, strict=True)))
    if role == "stage":
        keys = keys._replace(outside=key_of([called]))
    if keys.full not in _parts:
        cells = tuple(CellType(_constant(value)) for value in captured)
        scope = {**function.__globals__, **names}
        clone = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, cells)
        # Code is linked by name, and another process may have bound another model to the same name.
        clone.__qualname__ = f"{function.__qualname__}_{keys.full}"
        clone.__module__ = function.__module__
        if is_traced:
            traced(clone)
        if hasattr(function, _ALLOCATES):
            allocating(clone)
        _parts[keys.full] = Part(_compile(clone, role, keys, linkage.stages), keys)
    return _parts[keys.full]


def key_of(texts: Iterable[str]) -> str:
    """Return a hash of texts, of the versions and options of the compiler, and of the processor."""
    compiler = _compiler(plain=_internals() is None)
    return hashlib.sha256(";".join((compiler, *texts)).encode()).hexdigest()[:24]


def _is_linked(value: Any) -> TypeGuard[FunctionType]:
    """Return True for a plain function, which is compiled with its callers."""
    return isinstance(value, FunctionType) and not value.__module__.startswith(("numpy", "numba"))


def _constant(value: Any) -> Any:
    """Return a constant for numba, which compiles a function again for each Python int in its arguments."""
    return np.int64(value) if type(value) is int else value


def _are_offsets(value: Any) -> bool:
    """Return True for a named tuple of integers, e.g. the offsets of a block's rows."""
    return hasattr(value, "_fields") and all(type(item) is int for item in value)


def _offsets(value: Any) -> ModuleType:
    """Return a module with the items of a named tuple, which numba reads as constants."""
    module = ModuleType(type(value).__name__)
    vars(module).update({name: _constant(item) for name, item in value._asdict().items()})
    return module


def _link_select() -> Part:
    """Return the branch that ``select`` is on scalars."""
    import numba

    key = "select"
    if key not in _parts:
        _parts[key] = Part(numba.njit(inline="always")(branch), Keys(key, key))
    return _parts[key]


# Cached: a process that has switched to another user may be unable to read a version again.
@cache
def _compiler(plain: bool) -> str:
    """Return versions, options and processor, on which machine code depends."""
    import numba

    python = f"{sys.implementation.cache_tag} numba {numba.__version__} {_OWN_CODE}"
    how = "plain" if plain else ""
    return f"{python} llvmlite {version('llvmlite')} {how} {_processor()}"


@cache
def _processor() -> str:
    """Return name and features of the processor: several machines may share a home."""
    import numba
    from llvmlite import binding  # type: ignore[import-untyped]

    with suppress(RuntimeError):
        features = binding.get_host_cpu_features().flatten()
        # From NUMBA_CPU_NAME and NUMBA_CPU_FEATURES.
        override = f"{numba.config.CPU_NAME} {numba.config.CPU_FEATURES}"
        return f"{binding.get_host_cpu_name()} {features} {override}"
    return platform.machine()


def _internals() -> ModuleType | None:
    """Return the module that uses numba internals, None for plain numba."""
    return _internals_by(os.environ.get(SWITCH, ""))


@cache
def _internals_by(switch: str) -> ModuleType | None:
    import numba

    if switch == "1" or numba.config.DISABLE_JIT:
        return None
    if switch != "0" and not numba.__version__.startswith(f"{TESTED}."):
        log.warning(
            "numba %s is untested (tested: %s); some optimisations are off", numba.__version__, TESTED
        )
        return None
    try:
        from foamprb.compile import internals
    except (ImportError, AttributeError) as error:
        log.warning("Some optimisations are off, as numba %s has changed: %s", numba.__version__, error)
        return None
    return internals


def _compile(function: Callable[..., Any], role: Role, keys: Keys, stages: Mapping[str, Part]) -> Any:
    import numba

    internals = _internals()
    # No function outlives its arguments, and only some allocate arrays.
    options = _OPTIONS | _OPTIONS_OF[role] | {"_nrt": hasattr(function, _ALLOCATES)}
    if internals is None:
        return numba.njit(**options)(function)
    dispatcher = numba.njit(**options, **internals.pipeline(role))(function)
    if role == "entry":
        of_stages = [_stores[id(part.dispatcher)] for part in stages.values()]
        store_of_entry = internals.use_cache_of_entry(dispatcher, keys, stages)
        _stores[id(dispatcher)] = (store_of_entry, *(store for stores in of_stages for store in stores))
    elif role != "inlined":
        _stores[id(dispatcher)] = (internals.use_cache(dispatcher, keys.full, stages),)
    return dispatcher


@cache
def _global_names(code: CodeType) -> frozenset[str]:
    """Return the names that the code reads from its module; ``co_names`` has attributes as well."""
    names = frozenset(step.argval for step in dis.get_instructions(code) if step.opname == "LOAD_GLOBAL")
    return names.union(*(_global_names(item) for item in code.co_consts if isinstance(item, CodeType)))


@cache
def _fingerprint(code: CodeType) -> bytes:
    """Return bytes that change with the code and not with its place in a file."""
    parts = [code.co_code, repr(code.co_names).encode(), repr(code.co_varnames).encode()]
    for constant in code.co_consts:
        parts.append(_fingerprint(constant) if isinstance(constant, CodeType) else repr(constant).encode())
    return b"|".join(parts)
