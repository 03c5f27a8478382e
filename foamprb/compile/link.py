"""Compilation of plain formulas to machine code.

The mathematics of foamprb is written once, as plain functions of floats, tuples and array elements.
:func:`link` follows the functions that an entry function calls, through their module globals, and compiles
all of them with numba. The plain functions stay callable, on floats or on numpy arrays.

Most functions are inlined in their callers. Three kinds are machine code of their own, which callers find by
a name, and are compiled once however many loops call them: :func:`traced` stages, :func:`separate` functions,
and those behind a :func:`slot`. A slot is a function that another one replaces: a model, an integrator's
stage, a kernel of a flow. Callers of a slot are not compiled again when what is behind it changes. A formula
of a stage that a model replaces (a traction, a drag law) is a :func:`foamprb.body.choice.choice`: what is
behind it is inlined.

With ``NUMBA_DISABLE_JIT=1`` nothing is compiled: the same functions run in the interpreter, for a debugger.
"""

from __future__ import annotations

import dis
import hashlib
import logging
import os
import sys
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import version
from inspect import signature
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, TypeVar

import numpy as np

from foamprb.body.choice import CHOICE
from foamprb.body.tensor import select
from foamprb.compile.cache import Store
from foamprb.compile.part import Keys, Part
from foamprb.compile.processor import processor
from foamprb.compile.trace import LANES, TRACED, branch

if TYPE_CHECKING:
    from numba.core.dispatcher import Dispatcher

    from foamprb.compile.internals import Role

__all__ = [
    "Function",
    "Slots",
    "allocating",
    "compiled",
    "conform",
    "is_compiled",
    "kernel",
    "key_of",
    "link",
    "linked",
    "packed",
    "separate",
    "slot",
    "traced",
]

log = logging.getLogger("foamprb")

F = TypeVar("F", bound=Callable[..., Any])
Function: TypeAlias = Callable[..., Any]
Slots: TypeAlias = Mapping[Function, Function]
"""Functions behind slots and choices."""

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
_ALLOCATES, _SEPARATE, _SLOT, _PACKED = "allocates", "separate", "slot", "packed"
"""Attributes of marked functions; the last one holds the first parameter of a kernel."""
_OPTIONS_OF: dict[Role, dict[str, Any]] = {
    "entry": {"forceinline": False},
    "lanes": {"forceinline": False, "no_cpython_wrapper": True},
    "scalar": {"forceinline": False, "no_cpython_wrapper": True},
    "inlined": {"forceinline": True, "no_cpython_wrapper": True},
}


def link(
    entry: Function,
    slots: Slots | None = None,
    **layouts: Any,
) -> Any:
    """Compile ``entry`` with everything it calls.

    Parameters
    ----------
    entry
        A plain function whose callees are module globals (imported by name, not as ``module.name``), or
        captured from the function around it. What else a function captures, or has as defaults, are
        numbers, or tuples of numbers.
    slots
        Functions behind a :func:`slot` or a :func:`foamprb.body.choice.choice`, e.g. ``{traction: jeffery}``;
        others have their defaults. It may have more than ``entry`` reaches.
    layouts
        By the name of the first parameter of :func:`kernel` functions, the ``layout`` of the :func:`packed`
        argument with which ``entry`` will be called.

    Returns
    -------
    A numba dispatcher. Equal code with equal functions behind its slots is compiled once per process; the
    entry and its callees that are machine code of their own are saved in :mod:`foamprb.compile.cache`, under
    keys made of the code of every function that was linked. Of callees with machine code of their own the key
    contains the names only: an entry that differs in these alone is not compiled again.

    Raises
    ------
    ValueError
        If a function in ``slots`` is not one that may be replaced.
    """
    from foamprb.compile.record_type import register_records

    register_records()
    slots = dict(slots or {})
    for function in slots:
        if not (hasattr(function, _SLOT) or hasattr(function, CHOICE)):
            raise ValueError(f"{function.__module__}.{function.__qualname__} is no slot and no choice")
    return _link(entry, _Linkage(slots, layouts), "entry").dispatcher


@cache
def compiled(entry: Function) -> Any:
    """Return :func:`link` of a function with the defaults of all slots, once per process."""
    return link(entry)


def linked(entry: Function, slots: Slots | None = None) -> Collection[Function]:
    """Return ``entry`` and the functions that are linked with it."""
    slots = slots or {}
    reached = {entry}
    pending = [entry]
    while pending:
        function = pending.pop()
        read = [function.__globals__.get(name) for name in _global_names(function.__code__)]
        for value in (*read, *_captured(function)):
            if _is_linked(value):
                value = slots.get(value, value)
                if value not in reached:
                    reached.add(value)
                    pending.append(value)
    return reached


def traced(stage: Function) -> Function:
    """Mark a stage: machine code of its own, made by tracing (:mod:`foamprb.compile.trace`)."""
    setattr(stage, TRACED, True)
    return stage


def separate(function: F) -> F:
    """Mark a long function that is machine code of its own, compiled once for all of its callers."""
    setattr(function, _SEPARATE, True)
    return function


def slot(function: F) -> F:
    """Mark a function that :func:`link` may replace, of which callers know the name and the signature only.

    The function itself is the default. Others take and return the same types.
    """
    setattr(function, _SLOT, True)
    return function


def kernel(function: F) -> F:
    """Mark a slot whose first argument goes by address (:func:`packed`).

    The functions behind it read the argument itself. They have the same parameters, or leave some out that
    they do not need; the others then have the same names.
    """
    setattr(function, _PACKED, _parameters(function)[0])
    return slot(function)


def conform(placeholder: Function, implementation: Function) -> Function:
    """Return a function with the parameters of a kernel that calls another, for callers that inline it."""
    return _unpacking(placeholder, implementation, {})


def packed(argument: Any) -> Any:
    """Return an argument of kernels in the form in which loops pass it on, which does not depend on its type.

    Without compilation that is the argument itself.
    """
    if not _compiles():
        return argument
    from foamprb.compile.record_type import Packed, register_records

    register_records()
    return Packed(argument)


def allocating(function: Function) -> Function:
    """Mark a :func:`separate` function that allocates arrays."""
    setattr(function, _ALLOCATES, True)
    return function


def is_compiled(dispatcher: Dispatcher) -> bool:
    """Return True if a function that :func:`link` returned is compiled, here or in the cache."""
    import numba

    if numba.config.DISABLE_JIT or dispatcher.signatures:
        return True
    stores = _stores.get(id(dispatcher), ())
    return bool(stores) and all(stores)


@dataclass(frozen=True)
class _Linkage:
    """Arguments of :func:`link` that hold for all functions, and the functions that are linked already."""

    slots: dict[Function, Function] = field(default_factory=dict)
    layouts: dict[str, Any] = field(default_factory=dict)
    """Types of packed arguments."""
    done: dict[tuple[Function, str], Part] = field(default_factory=dict)
    named: dict[str, Part] = field(default_factory=dict)
    """Functions that are found by a name, by :attr:`Keys.outside`."""


# The code of this package is a part of every key.
_FILES = sorted(Path(__file__).parent.glob("*.py"))
_OWN_CODE = hashlib.sha256(b"".join(file.read_bytes() for file in _FILES)).hexdigest()[:8]


_dispatchers: dict[str, Any] = {}
"""By :attr:`Keys.full`."""
_stores: dict[int, tuple[Store, ...]] = {}
"""Where a function and, of an entry, all that it calls are saved, by the ``id`` of its dispatcher."""


def _link(function: Function, linkage: _Linkage, role: Role, called: str = "") -> Part:
    """Return a function linked after its callees, once however many callers it has.

    ``called`` is the name by which machine code of its own is called.
    """
    task = function, f"{role} {called}"
    if task not in linkage.done:
        part = _link_once(function, linkage, role, called)
        if called and _has_another_name(part.keys, linkage):
            # Code calls functions by their keys, so it could not distinguish the names.
            part = _link_once(function, linkage, role, called, apart=called)
        if called and linkage.named.setdefault(part.keys.outside, part).dispatcher is not part.dispatcher:
            # Another function of this loop has the name, so the code must distinguish them.
            part = part._replace(keys=Keys(part.keys.full, part.keys.full))
            linkage.named[part.keys.outside] = part
        linkage.done[task] = part
    return linkage.done[task]


def _has_another_name(keys: Keys, linkage: _Linkage) -> bool:
    """Return True if the same function is behind another name of this loop."""
    return any(
        part.keys.full == keys.full and part.keys.outside != keys.outside for part in linkage.named.values()
    )


def _link_callee(function: Function, linkage: _Linkage) -> Part:
    """Return a function that others call by a name."""
    called = f"{function.__module__}.{function.__qualname__}"
    implementation = linkage.slots.get(function, function)
    if hasattr(function, _SLOT):
        # A default reads nothing of its packed argument.
        if hasattr(function, _PACKED) and implementation is not function:
            implementation = _unpacking(function, implementation, linkage.layouts)
        return _link(implementation, linkage, _role_of(implementation), called)
    own = any(hasattr(implementation, mark) for mark in (TRACED, _SEPARATE, _ALLOCATES))
    return _link(implementation, linkage, *((_role_of(implementation), called) if own else ("inlined",)))


def _role_of(function: Function) -> Role:
    """Return the role of machine code of its own: that with loops over lanes uses wide registers."""
    return "lanes" if LANES in function.__code__.co_names else "scalar"


def _unpacking(placeholder: Function, implementation: Function, layouts: Mapping[str, Any]) -> Function:
    """Return a function with the parameters of a kernel that calls another with the unpacked argument."""
    layout = layouts.get(getattr(placeholder, _PACKED, ""))
    key = placeholder, implementation, layout
    if key not in _unpackers:
        names, parameters = _parameters(placeholder), _parameters(implementation)
        wanted = parameters if len(parameters) < len(names) else names
        passed = ", ".join("unpack(packed)" if k == 0 else name for k, name in enumerate(wanted))
        text = f"def unpacking(packed, {', '.join(names[1:])}):\n    return implementation({passed})\n"
        scope = {"implementation": implementation, "unpack": _unpack_as(layout), "__name__": __name__}
        exec(text, scope)
        unpacking: Any = scope["unpacking"]
        unpacking.layout = str(layout)
        _unpackers[key] = unpacking
    return _unpackers[key]


def _parameters(function: Function) -> list[str]:
    return [name.lstrip("_") for name in signature(function).parameters]


def _unpack_as(layout: Any) -> Callable[[Any], Any]:
    if layout is None:
        return _as_it_is
    from foamprb.compile.record_type import unpack_as

    return unpack_as(layout)


def _as_it_is(argument: Any) -> Any:
    return argument


_unpackers: dict[Any, Function] = {}


def _link_once(function: Function, linkage: _Linkage, role: Role, called: str, apart: str = "") -> Part:
    """Return a function compiled after its callees; each is compiled once per process for each ``apart``."""
    if function is select:
        return _link_select()
    assert isinstance(function, FunctionType), f"{function!r} is not a plain function"
    names: dict[str, Any] = {}
    parts = [_link_callee(value, linkage) if _is_linked(value) else value for value in _captured(function)]
    is_traced = hasattr(function, TRACED)
    defaults, layout = function.__defaults__, getattr(function, "layout", "")
    identity = f"{role} {function.__module__} {function.__qualname__} {defaults!r} {layout} {apart}"
    code = f"{_fingerprint(function.__code__).hex()} {is_traced}"
    described = [Keys(identity, identity), Keys(code, code)]
    described += [part.keys if isinstance(part, Part) else Keys(repr(part), repr(part)) for part in parts]
    for name in sorted(_global_names(function.__code__)):
        value, text = function.__globals__.get(name), ""
        if _is_linked(value):
            part = _link_callee(value, linkage)
            names[name] = part.dispatcher
            described.append(Keys(*(f"{name}={key}" for key in part.keys)))
        elif isinstance(value, int | float | tuple):
            names[name] = _offsets(value) if _are_offsets(value) else _constant(value)
            text = f"{name}={value!r}"
        elif isinstance(value, type) and issubclass(value, tuple):
            text = f"{name}={getattr(value, '_fields', '')}"
        elif hasattr(value, "item_names"):
            text = _register_stand_in(value)
        described.append(Keys(text, text))
    keys = Keys(*map(key_of, zip(*described, strict=True)))
    if keys.full not in _dispatchers:
        cells = tuple(CellType(p.dispatcher if isinstance(p, Part) else _constant(p)) for p in parts)
        scope = {**function.__globals__, **names}
        clone = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, cells)
        # Code is linked by name, and another process may have put another model behind the same one.
        clone.__qualname__ = f"{function.__qualname__}_{keys.full}"
        clone.__module__ = function.__module__
        if is_traced:
            traced(clone)
        if hasattr(function, _ALLOCATES):
            allocating(clone)
        _dispatchers[keys.full] = _compile(clone, role, keys, linkage.named)
    return Part(_dispatchers[keys.full], keys._replace(outside=key_of([called])) if called else keys)


def _register_stand_in(cls: Any) -> str:
    """Let compiled code make a class of :func:`~foamprb.compile.record.stand_in`; return its code."""
    from foamprb.compile.record_type import register_stand_in

    register_stand_in(cls)
    item = getattr(cls, "item", None)
    return f"{cls.item_names} {_fingerprint(item.__code__).hex() if item else ''}"


def key_of(texts: Iterable[str]) -> str:
    """Return a hash of texts, of the versions and options of the compiler, and of the processor."""
    compiler = _compiler(plain=_internals() is None)
    return hashlib.sha256(";".join((compiler, *texts)).encode()).hexdigest()[:24]


def _captured(function: Function) -> list[Any]:
    """Return what a function captures from the one around it."""
    return [cell.cell_contents for cell in function.__closure__ or ()]


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
    if key not in _dispatchers:
        _dispatchers[key] = numba.njit(inline="always")(branch)
    return Part(_dispatchers[key], Keys(key, key))


# Cached: a process that has switched to another user may be unable to read a version again.
@cache
def _compiler(plain: bool) -> str:
    """Return versions, options and processor, on which machine code depends."""
    import numba
    from llvmlite import binding  # type: ignore[import-untyped]

    python = f"{sys.implementation.cache_tag} numba {numba.__version__} {_OWN_CODE}"
    how = "plain" if plain else ""
    system = binding.get_process_triple()
    return f"{python} llvmlite {version('llvmlite')} {how} {system} {processor().level}"


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


def _compiles() -> bool:
    """Return False if functions run in the interpreter."""
    import numba

    return not numba.config.DISABLE_JIT


def _compile(function: Function, role: Role, keys: Keys, named: Mapping[str, Part]) -> Any:
    import numba

    internals = _internals()
    # No function outlives its arguments, and only some allocate arrays.
    options = _OPTIONS | _OPTIONS_OF[role] | {"_nrt": hasattr(function, _ALLOCATES)}
    if internals is None:
        return numba.njit(**options)(function)
    dispatcher = numba.njit(**options, **internals.pipeline(role))(function)
    internals.widen_indices(dispatcher)
    if role != "inlined":
        store = internals.use_cache(dispatcher, keys, named, is_entry=role == "entry")
        others = [_stores[id(part.dispatcher)] for part in named.values()] if role == "entry" else []
        _stores[id(dispatcher)] = (store, *(each for stores in others for each in stores))
    return dispatcher


@cache
def _global_names(code: CodeType) -> frozenset[str]:
    """Return the names that the code reads from its module; ``co_names`` has attributes as well."""
    names, argument, load = set(), 0, dis.opmap["LOAD_GLOBAL"]
    # dis.get_instructions takes twenty times as long.
    for operation, low in zip(code.co_code[::2], code.co_code[1::2], strict=True):
        argument = argument << 8 | low
        if operation == load:
            names.add(code.co_names[argument >> 1])
        argument = argument if operation == dis.EXTENDED_ARG else 0
    return frozenset(names).union(
        *(_global_names(item) for item in code.co_consts if isinstance(item, CodeType))
    )


@cache
def _fingerprint(code: CodeType) -> bytes:
    """Return bytes that change with the code and not with its place in a file."""
    parts = [code.co_code, repr(code.co_names).encode(), repr(code.co_varnames).encode()]
    for constant in code.co_consts:
        parts.append(_fingerprint(constant) if isinstance(constant, CodeType) else repr(constant).encode())
    return b"|".join(parts)
