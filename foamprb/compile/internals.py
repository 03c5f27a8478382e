"""All that foamprb uses of numba's inner workings, and how it does without.

Numba documents none of what is used here, and the next version may lack it. So it is divided into parts.
Each is a function of :data:`PARTS` that says what it gains, and each can be left out: machine code is then
made more slowly or is slower, but it is made, and its results differ by round-off at most.

A part is left out

* if the environment variable ``FOAMPRB_PLAIN_NUMBA`` is ``1``, or a list that names it (``cache,inlining``);
* if numba lacks what the part takes;
* if numba is of a version with which the part was never tried, and the small program in
  :mod:`foamprb.compile.trial` goes wrong with it; what came of that is saved in the cache.

What a part gains is what is lost without it and with all others: user CPU seconds on one core of an AMD
EPYC with AVX-512 to compile the loop of the integrator stokes for a steady flow on a mesh, from nothing,
numba 0.68.1. With all parts it took 9.5 s; with none 78 s, and a step took 15 times as long.
``tools/benchmarks/compile_parts.py`` measures it again.
"""

from __future__ import annotations

import copy
import gc
import inspect
import logging
import operator
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import cache, partial
from importlib.metadata import version
from typing import Any, Literal, NamedTuple, TypeAlias

import numba
from llvmlite import binding, ir  # type: ignore[import-untyped]

from foamprb.compile.cache import Store
from foamprb.compile.trace import LANES, Code, UntraceableError, trace
from foamprb.errors import InputError, suggestion

__all__ = ["Internals", "Role", "internals"]

log = logging.getLogger("foamprb")

TRIED = "0.68"
"""The version of numba, but for its last number, for which the parts were written."""
SWITCH = "FOAMPRB_PLAIN_NUMBA"

Role: TypeAlias = Literal["entry", "separate", "inlined"]
"""Python calls an entry; compiled code calls a separate function; an inlined one is a part of its callers."""
_ROLES: tuple[Role, ...] = ("entry", "separate", "inlined")
_TIMEOUT = 300.0
"""Of a trial, s."""


class _Called(NamedTuple):
    """How functions are kept that only compiled code calls."""

    library: Callable[[Any, str], Any]
    """``library(codegen, name)`` is where one goes that need not be optimised."""
    context: Callable[[Any], Any]
    """Numba's context of a target, for such functions."""
    stand_in: Callable[[Any, Any, Any], Any]
    """Of one's library, descriptor and environment, what takes the place of what Python would call."""


@dataclass
class _Changes:
    """What a part changes of how functions of each role are compiled."""

    options: dict[Role, dict[str, Any]] = field(default_factory=dict)
    """Options of ``numba.njit``."""
    passes: dict[Role, dict[type, type | None]] = field(default_factory=dict)
    """Passes of the compiler, and what takes their place, if anything."""
    rebuild: dict[Role, Callable[..., Any]] = field(default_factory=dict)
    """How the result of a compilation is made from what was saved of it, if not as numba makes it."""
    called: _Called | None = None
    """How separate functions are kept."""
    shortcut: Callable[[_Called, Any, Any], Any] | None = None
    """``shortcut(called, state, function)`` is the result of the compilation of a separate function where all
    passes can be done without, else None; ``state`` is that of numba's compiler."""
    use_cache: Callable[..., Store] | None = None
    """How a dispatcher is given its :class:`~foamprb.compile.cache.Store`."""
    prepare: Callable[[Any], None] | None = None
    """What is done to a dispatcher before it is used."""


def _collector() -> _Changes:
    """No garbage is collected while numba compiles.

    Gains 1.8 s: numba makes millions of objects, and the collector looks through them again and again for
    nothing. Without it, it does.
    """
    from numba.core.event import Event, Listener, register

    class WithoutCollector(Listener):  # type: ignore[misc]
        # Compilations are nested, but only one thread at a time compiles.
        depth, enabled = 0, True

        def on_start(self, event: Event) -> None:  # noqa: ARG002
            if self.depth == 0:
                self.enabled = gc.isenabled()
                gc.disable()
            self.depth += 1

        def on_end(self, event: Event) -> None:  # noqa: ARG002
            self.depth -= 1
            if self.depth == 0 and self.enabled:
                gc.enable()

    register("numba:compile", WithoutCollector())
    return _Changes()


def _references() -> _Changes:
    """References to arrays are not counted.

    Gains 3.4 s and a step that takes a sixth of the time. No function allocates an array, or outlives those
    it is given, so that counts are only raised and lowered again; without the part they are, in every stage.
    """
    return _Changes(options={role: {"_nrt": False} for role in _ROLES})


def _wrappers() -> _Changes:
    """Python cannot call what only compiled code calls, and C nothing at all.

    Gains 4.3 s: without it numba compiles two more functions for each, which convert the arguments.
    """
    neither = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return _Changes(options={"entry": {"no_cfunc_wrapper": True}, "separate": neither, "inlined": neither})


def _inlining() -> _Changes:
    """Functions are inlined by order, not at LLVM's choice.

    Gains a step that takes half the time, and 0.3 s: without it LLVM leaves calls in the loop.
    """
    # What is not said is inherited from the caller.
    return _Changes(options={role: {"forceinline": role == "inlined"} for role in _ROLES})


def _machine_code() -> _Changes:
    """Machine code is made of entries only, with all that they call in them.

    Gains 18 s beside what :func:`_tracing` does, which it is needed for: without it numba makes machine code
    of every function by itself, which of one that is always
    inlined is never used, and functions are nested. Such a function is left as LLVM's intermediate code. So
    is a separate one, which is optimised by itself, and linked with its callers after these are: LLVM would
    make one huge function of a loop and its stages, or optimise each of them in every caller again.

    Gains also a sixth of a step: what is called is handed no arguments that it does not use, and uses the
    widest registers that there are. What is inlined takes its arguments whole: numba would take a flow apart
    into some two hundred numbers and put it together again in each function.
    """
    from numba import _dynfunc
    from numba.core.callconv import CPUCallConv
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompileResult
    from numba.core.compiler_machinery import register_pass
    from numba.core.cpu import CPUContext
    from numba.core.typed_passes import NativeLowering

    used = ("_optimize_final_module", "_finalize_final_module", "_finalize_dynamic_globals", "_finalized")
    _need(JITCodeLibrary, *used, "add_linking_library", "_get_module_for_linking", "_optimize_functions")
    _need(CPUCallConv, "_get_arg_packer", "decode_arguments", "call_function")
    _need(binding, "create_new_function_pass_manager")

    class Library(JITCodeLibrary):  # type: ignore[misc]
        """Code of which functions are made short one by one, and good once they are together."""

        of_stage = False
        """Whether it is good before: loops over lanes would not all be vectorised, and what is traced goes
        through no other passes."""

        def _optimize_functions(self, ll_module: Any) -> None:
            # Numba sets the passes up anew for each, also for those that are only declared.
            ll_module.data_layout = self._codegen._data_layout
            if self.of_stage:
                passes, builder = self._codegen._function_pass_manager()
            else:
                passes, builder = binding.create_new_function_pass_manager(), self._codegen._pass_builder()
                passes.add_sroa_pass()
                passes.add_simplify_cfg_pass()
                passes.add_instruction_combine_pass()
            for function in ll_module.functions:
                if not function.is_declaration:
                    passes.run(function, builder)

    class Inlined(Library):
        """Intermediate code that becomes a part of others, with what it inlines itself."""

        def finalize(self) -> None:
            self._finalize_dynamic_globals()
            _let_be_linked(self._final_module)
            self._finalized = True

        def _get_module_for_linking(self) -> Any:
            return self._final_module

    class Entry(Library):
        """Machine code: what is inlined becomes a part of it before it is optimised, what it calls after."""

        def finalize(self) -> None:
            inlined: dict[Any, None] = {}
            called: dict[Any, None] = {}
            sort(self, inlined, called)
            for library in inlined:
                self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._optimize_final_module()
            for library in called:
                self._final_module.link_in(library._final_module, preserve=True)
            self._final_module.verify()
            self._finalize_final_module()

        def _finalize_final_module(self) -> None:
            # A flow's arrays are some two hundred numbers, and a walk needs few of them.
            for function in self.get_defined_functions():
                if function.linkage == binding.Linkage.linkonce_odr:
                    function.linkage = "internal"
            passes = binding.create_new_module_pass_manager()
            passes.add_dead_arg_elimination_pass()
            passes.run(self._final_module, self._codegen._pass_builder())
            super()._finalize_final_module()

        def serialize_using_object_code(self) -> Any:
            """What numba saves: of the intermediate code, which nobody inlines, no more than names."""
            names = [function.name for function in self.get_defined_functions()]
            text = "".join(f'define void @"{name}"() {{ ret void }}\n' for name in names)
            module = binding.parse_assembly(text)
            return self.name, "object", (self._get_compiled_object(), module.as_bitcode())

    class Separate(Entry):
        """Intermediate code that others call, optimised, with that of all that it calls."""

        of_stage = True

        def add_ir_module(self, ir_module: Any) -> None:
            for function in ir_module.functions:
                # Llvmlite knows no attributes of this kind. It means nothing to other processors.
                set.add(function.attributes, _WIDE)
                set.add(function.attributes, _ALIGNED)
            super().add_ir_module(ir_module)

        def _finalize_final_module(self) -> None:
            self._finalize_dynamic_globals()
            _let_be_linked(self._final_module)
            self._finalized = True

        def serialize_using_object_code(self) -> Any:
            """What numba saves: there is no machine code."""
            return self.serialize_using_bitcode()

    class Ready(Separate):
        """The same, of what is so already but for what stands in functions of their own."""

        def finalize(self) -> None:
            passes = binding.create_new_module_pass_manager()
            passes.add_always_inliner_pass()
            passes.add_instruction_combine_pass()
            passes.add_dead_code_elimination_pass()
            passes.add_global_dead_code_eliminate_pass()
            passes.run(self._final_module, self._codegen._pass_builder())
            self._final_module.verify()
            self._finalize_final_module()

    def sort(library: Any, inlined: dict[Any, None], called: dict[Any, None]) -> None:
        """Put what a library refers to among what is inlined, with what that refers to, or what is called."""
        for other in library._linking_libraries:
            if isinstance(other, Separate):
                called[other] = None
            elif other not in inlined:
                inlined[other] = None
                if isinstance(other, Inlined):
                    sort(other, inlined, called)

    class Reader:
        """A code generator that reads what was saved of a :class:`Separate`."""

        def __init__(self, codegen: Any) -> None:
            self._codegen = codegen

        def unserialize_library(self, state: Any) -> Any:
            name, _, code = state
            library = Separate(self._codegen, name)
            library._final_module = binding.parse_bitcode(code)
            library._finalize_final_module()
            return library

    def not_executable(library: Any, fndesc: Any, env: Any) -> Any:
        """Stand-in for what Python would call, which numba wants of every function."""
        library._ensure_finalized()
        name = fndesc.qualname.split(".")[-1]
        return _dynfunc.make_function(fndesc.lookup_module(), name, "", 0, env, (library,))

    def made_anew(builder: Any, value: Any, kind: Any) -> Any:
        """A value of another kind that has the same numbers: three are an array, or a structure."""
        if value.type == kind:
            return value
        made = ir.Constant(kind, ir.Undefined)
        for k, part in enumerate(kind.elements):
            made = builder.insert_value(made, made_anew(builder, builder.extract_value(value, k), part), k)
        return made

    class Whole:
        """What a function takes of which each argument stays one, whatever it is made of."""

        def __init__(self, context: Any, kinds: Any) -> None:
            self.argument_types = tuple(map(context.get_value_type, kinds))

        def as_arguments(self, builder: Any, values: Any) -> Any:
            return [made_anew(builder, *each) for each in zip(values, self.argument_types, strict=True)]

        def from_arguments(self, builder: Any, values: Any) -> Any:  # noqa: ARG002
            return values

        def assign_names(self, values: Any, names: Any) -> None:
            for value, name in zip(values, names, strict=True):
                value.name = name

    class WholeCalls(CPUCallConv):  # type: ignore[misc]
        """How those are called."""

        def _get_arg_packer(self, argtypes: Any) -> Whole:
            return Whole(self.context, argtypes)

    class Calls(CPUCallConv):  # type: ignore[misc]
        """How functions are called: as numba has it, but for those that are inlined."""

        def decode_arguments(self, builder: Any, argtypes: Any, func: Any) -> Any:
            return self._of(func).decode_arguments(builder, argtypes, func)

        def call_function(self, builder: Any, callee: Any, *rest: Any, **options: Any) -> Any:
            return self._of(callee).call_function(builder, callee, *rest, **options)

        def _of(self, function: Any) -> CPUCallConv:
            inlined = "alwaysinline" in function.attributes
            return (WholeCalls if inlined else CPUCallConv)(self.context)

    class Context(CPUContext):  # type: ignore[misc]
        """Numba's context of a target, with such calls."""

        declaring_inlined = False

        @property
        def call_conv(self) -> Any:
            return WholeCalls(self) if self.declaring_inlined else Calls(self)

        def declare_function(self, module: Any, fndesc: Any) -> Any:
            self.declaring_inlined = fndesc.inline
            try:
                return super().declare_function(module, fndesc)
            finally:
                self.declaring_inlined = False

    # What numba itself adds to a function is inlined in ours only, where it is compiled for them.
    added: dict[Any, Any] = {}

    def with_calls(context: Any) -> Any:
        context = copy.copy(context)
        context.__class__ = Context
        context.cached_internal_func = added
        return context

    def for_code(context: Any) -> Any:
        """Numba's context of a target, for a function that only compiled code calls."""
        context = with_calls(context)
        context.get_executable = not_executable
        return context

    def lower(lowering: Any, state: Any, library: Any, changed: Callable[[Any], Any]) -> bool:
        """Numba's last pass, into a library of another kind, with another context."""
        state.library = library
        context, state.targetctx = state.targetctx, changed(state.targetctx)
        try:
            return bool(NativeLowering.run_pass(lowering, state))
        finally:
            state.targetctx = context

    @register_pass(mutates_CFG=True, analysis_only=False)
    class LoweringOfInlined(NativeLowering):  # type: ignore[misc]
        _name = "lowering_of_inlined"

        def run_pass(self, state: Any) -> bool:
            library = Inlined(state.targetctx.codegen(), state.func_id.func_qualname)
            library.of_stage = _is_of_stage(state.func_id.func)
            return lower(self, state, library, for_code)

    @register_pass(mutates_CFG=True, analysis_only=False)
    class LoweringOfSeparate(NativeLowering):  # type: ignore[misc]
        _name = "lowering_of_separate"

        def run_pass(self, state: Any) -> bool:
            library = Separate(state.targetctx.codegen(), state.func_id.func_qualname)
            return lower(self, state, library, for_code)

    @register_pass(mutates_CFG=True, analysis_only=False)
    class LoweringOfEntry(NativeLowering):  # type: ignore[misc]
        _name = "lowering_of_entry"

        def run_pass(self, state: Any) -> bool:
            library = Entry(state.targetctx.codegen(), state.func_id.func_qualname)
            library.enable_object_caching()
            return lower(self, state, library, with_calls)

    def rebuild(context: Any, payload: Any) -> Any:
        """What numba makes of what was saved of a separate function."""
        context, codegen = for_code(context), context.codegen()
        context.codegen = lambda: Reader(codegen)
        # The last are environments of interpreted code, to be put into machine code that is not there.
        return CompileResult._rebuild(context, *payload[:-1], ())

    return _Changes(
        passes={
            "entry": {NativeLowering: LoweringOfEntry},
            "separate": {NativeLowering: LoweringOfSeparate},
            "inlined": {NativeLowering: LoweringOfInlined},
        },
        rebuild={"separate": rebuild},
        called=_Called(Ready, for_code, not_executable),
    )


def _is_of_stage(function: Any) -> bool:
    """Whether a function goes through the lanes of a block, its first argument."""
    code = function.__code__
    return {LANES, "range"} <= {*code.co_names} and code.co_varnames[:1] == ("block",)


_WIDE = '"prefer-vector-width"="512"'
"""On a processor that has registers of 512 bits LLVM uses those of 256: stages take a tenth longer."""
_ALIGNED = '"stackrealign"'
"""What registers have no room for goes to the stack, where else it may lie on two lines or two pages."""


SIDE_BY_SIDE = "side_by_side"
"""Attribute of stages that go through two registers full of lanes at a time."""


def _tracing() -> _Changes:
    """Stages are traced (:mod:`foamprb.compile.trace`).

    Gains 7.8 s and a tenth of a step: without it numba finds the types of all that is in a stage, and LLVM
    inlines, simplifies and vectorises it. It takes what :func:`_machine_code` has for separate functions.
    """
    from numba import types
    from numba.core.bytecode import FunctionIdentity
    from numba.core.compiler import compile_result
    from numba.core.funcdesc import PythonFunctionDescriptor
    from numba.core.lowering import Environment
    from numba.core.typing import signature

    def shortcut(called: _Called, state: Any, function: Any) -> Any:
        context, identity = called.context(state.targetctx), FunctionIdentity.from_function(function)
        together = _register() * (2 if getattr(function, SIDE_BY_SIDE, False) else 1)
        flags = " ".join(sorted(state.flags.fastmath.flags))

        def arguments(code: Code) -> list[Any]:
            return [symbols(kind, code, (k,)) for k, kind in enumerate(state.args)]

        try:
            code = trace(function, together, flags, arguments)
        except UntraceableError as why:
            log.debug("%s is not traced: %s", function.__qualname__, why)
            return None
        names = tuple(inspect.signature(function).parameters)
        descriptor = PythonFunctionDescriptor(
            True, identity.modname, identity.func_qualname, identity.unique_name, "", {}, types.none, {},
            names, (), mangler=context.mangler, argtypes=tuple(state.args),
            abi_tags=[state.flags.get_mangle_string()], uid=identity.unique_id,
        )  # fmt: skip
        library = called.library(context.codegen(), identity.func_qualname)
        library.add_ir_module(calling(context, library, descriptor, code))
        lanes = binding.parse_assembly(code.function(f"{identity.func_qualname}_lanes"))
        library.add_llvm_module(lanes)
        library.finalize()
        environment = Environment.from_fndesc(descriptor)
        entry_point = called.stand_in(library, descriptor, environment)
        state.targetctx.insert_user_function(entry_point, descriptor, [library])
        return compile_result(
            typing_context=state.typingctx, target_context=state.targetctx, entry_point=entry_point,
            typing_error=None, type_annotation="", library=library, call_helper=None,
            signature=signature(types.none, *state.args), objectmode=False, lifted=(), fndesc=descriptor,
            environment=environment, metadata=state.metadata, reload_init=[],
        )  # fmt: skip

    def symbols(kind: Any, code: Code, path: tuple[int, ...]) -> Any:
        """What stands for an argument of some type, found under ``path`` among the arguments."""
        if kind == types.Array(types.float64, 1, "C") and path == (0,):
            return code.block
        if kind == types.float64:
            return code.argument(path)
        if isinstance(kind, types.BaseTuple):
            items = [symbols(item, code, (*path, k)) for k, item in enumerate(kind)]
            return kind.instance_class(*items) if isinstance(kind, types.BaseNamedTuple) else tuple(items)
        return object()

    def calling(context: Any, library: Any, descriptor: Any, code: Code) -> Any:
        """LLVM's module of a function that numba can call, which calls that of the lanes."""
        module = library.create_ir_module(descriptor.unique_name)
        outer = context.declare_function(module, descriptor)
        builder = ir.IRBuilder(outer.append_basic_block())
        arguments = context.call_conv.decode_arguments(builder, descriptor.argtypes, outer)
        block = context.make_array(descriptor.argtypes[0])(context, builder, arguments[0]).data
        numbers = [
            builder.extract_value(arguments[path[0]], path[1:]) if path[1:] else arguments[path[0]]
            for path in code.arguments
        ]
        kind = ir.FunctionType(ir.VoidType(), [block.type, *(number.type for number in numbers)])
        builder.call(ir.Function(module, kind, f"{descriptor.qualname}_lanes"), [block, *numbers])
        context.call_conv.return_value(builder, context.get_dummy_value())
        return module

    return _Changes(shortcut=shortcut)


def _register() -> int:
    """How many numbers a register of this processor has room for."""
    features: dict[str, bool] = {}
    with suppress(RuntimeError):
        features = binding.get_host_cpu_features()
    return 8 if features.get("avx512f") else 4 if features.get("avx") else 2


def _let_be_linked(module: Any) -> None:
    """Let a module's functions stand in several that are linked, and go where nobody calls them."""
    for function in module.functions:
        if not function.is_declaration and function.linkage == binding.Linkage.external:
            function.linkage = "linkonce_odr"


def _arithmetic() -> _Changes:
    """The types of results of what numba itself has for numbers and arrays are remembered.

    Gains 4.4 s: without it numba finds out anew for each sum and product which type it has, and the formulas
    have hardly another than float.
    """
    from numba import types
    from numba.core.compiler_machinery import register_pass
    from numba.core.typed_passes import NopythonTypeInference

    operators = frozenset(getattr(operator, name) for name in operator.__all__)
    operands = types.Number, types.Boolean, types.Array
    known: dict[tuple[Any, ...], tuple[Any, Any]] = {}

    @contextmanager
    def remembering(context: Any, flags: str) -> Iterator[None]:
        """Let numba's context remember, of functions that are compiled with some flags."""
        if "resolve_function_type" in vars(context):
            yield
            return
        resolve = context.resolve_function_type

        def remembered(function: Any, arguments: Any, keywords: Any) -> Any:
            of_numba = type(function) is types.Function or function in operators
            if keywords or not of_numba or not all(isinstance(argument, operands) for argument in arguments):
                return resolve(function, arguments, keywords)
            key = flags, function, *arguments
            # Some functions know their code by the types of the arguments alone, whatever the flags are.
            codes = getattr(function, "_impl_keys", {})
            if key not in known:
                found = resolve(function, arguments, keywords)
                known[key] = found, codes.get(found and found.args)
            signature, code = known[key]
            if code is not None:
                codes[signature.args] = code
            return signature

        context.resolve_function_type = remembered
        try:
            yield
        finally:
            del context.resolve_function_type

    @register_pass(mutates_CFG=True, analysis_only=False)
    class TypeInference(NopythonTypeInference):  # type: ignore[misc]
        _name = "type_inference_of_arithmetic"

        def run_pass(self, state: Any) -> bool:
            with remembering(state.typingctx, state.flags.get_mangle_string()):
                return bool(NopythonTypeInference.run_pass(self, state))

    return _Changes(passes={role: {NopythonTypeInference: TypeInference} for role in _ROLES})


def _integers() -> _Changes:
    """Functions are compiled for whole numbers of 64 bits only.

    Gains 3.7 s, with what :func:`_arithmetic` remembers of arrays: without it numba compiles a function anew
    for an element of an array of 32 bits, and for each constant.
    """
    from numba import int64, types
    from numba.core.dispatcher import Dispatcher

    _need(Dispatcher, "get_call_template")

    def wide(argument: Any) -> Any:
        if isinstance(argument, types.IntegerLiteral) or (
            isinstance(argument, types.Integer) and argument.signed
        ):
            return int64
        if isinstance(argument, types.UniTuple):
            return types.UniTuple(wide(argument.dtype), argument.count)
        return argument

    def prepare(dispatcher: Any) -> None:
        resolve = dispatcher.get_call_template

        def get_call_template(arguments: Any, keywords: Any) -> Any:
            return resolve(tuple(map(wide, arguments)), keywords)

        dispatcher.get_call_template = get_call_template

    return _Changes(prepare=prepare)


def _needless() -> _Changes:
    """Numba does not look for what the formulas have not: closures, ``with``, operations on whole arrays.

    Gains 0.9 s; without it, it looks.
    """
    from numba.core.typed_passes import InlineOverloads, NopythonRewrites
    from numba.core.untyped_passes import InlineClosureLikes, WithLifting

    needless: dict[type, type | None] = dict.fromkeys(
        (InlineClosureLikes, WithLifting, InlineOverloads, NopythonRewrites)
    )
    return _Changes(passes=dict.fromkeys(_ROLES, needless))


def _cache() -> _Changes:
    """Compiled code is saved on disk, as :mod:`foamprb.compile.cache` does it.

    Gains all 9.5 s in each process after the first. Numba's own cache goes by the path of a function's file
    and not by the code of what it calls, loads what it finds without a checksum, whoever wrote it, and ends a
    program that cannot write there; so that without this part there is none.
    """
    from numba.core.compiler import CompileResult
    from numba.core.dispatcher import Dispatcher
    from numba.core.serialize import dumps

    _need(CompileResult, "_reduce", "_rebuild")
    _need(Dispatcher, "enable_caching")

    class Cache:
        """What numba asks before it compiles a function for some types of arguments, and tells after."""

        def __init__(self, store: Store, rebuild: Callable[..., Any]) -> None:
            self._store, self._rebuild = store, rebuild
            self.cache_path = str(store.folder)

        def load_overload(self, signature: Any, context: Any) -> Any:
            context.refresh()
            saved = self._store.load((signature, context.codegen().magic_tuple()))
            try:
                return None if saved is None else self._rebuild(context, saved)
            except Exception:
                # It names something that has gone.
                return None

        def save_overload(self, signature: Any, result: Any) -> None:
            # Machine code with addresses in it serves one process only.
            if not result.library.has_dynamic_globals:
                codegen = result.target_context.codegen()
                self._store.save((signature, codegen.magic_tuple()), result._reduce())

        def flush(self) -> None:
            self._store.flush()

    def use_cache(dispatcher: Any, name: str, rebuild: Callable[..., Any] | None) -> Store:
        store = Store(name, dumps)
        _need(dispatcher, "_cache")
        dispatcher._cache = Cache(store, rebuild or _rebuild)
        return store

    def _rebuild(context: Any, payload: Any) -> Any:
        return CompileResult._rebuild(context, *payload)

    return _Changes(use_cache=use_cache)


PARTS: dict[str, Callable[[], _Changes]] = {
    "collector": _collector,
    "references": _references,
    "wrappers": _wrappers,
    "inlining": _inlining,
    "machineCode": _machine_code,
    "tracing": _tracing,
    "arithmetic": _arithmetic,
    "integers": _integers,
    "needless": _needless,
    "cache": _cache,
}


@dataclass(frozen=True)
class Internals:
    """What this process uses of numba's inner workings."""

    parts: tuple[str, ...]
    options: Mapping[Role, Mapping[str, Any]]
    """Options of ``numba.njit`` for functions of each role."""
    _rebuild: Mapping[Role, Callable[..., Any]]
    _use_cache: Callable[..., Store] | None
    _prepare: tuple[Callable[[Any], None], ...]

    def prepare(self, dispatcher: Any) -> None:
        """Do to a dispatcher what the parts want done."""
        for prepare in self._prepare:
            prepare(dispatcher)

    def use_cache(self, dispatcher: Any, name: str, role: Role) -> Store | None:
        """Give a dispatcher a place in the cache under a name, if there is a cache."""
        return self._use_cache(dispatcher, name, self._rebuild.get(role)) if self._use_cache else None


def internals() -> Internals:
    """What this process uses: found out once, unless :data:`SWITCH` changes.

    Raises
    ------
    InputError
        If :data:`SWITCH` names what is no part.
    """
    with _lock:
        return _with(*_chosen(os.environ.get(SWITCH, "")))


# Numba takes no pass of the same name twice.
_lock = threading.Lock()


@cache
def _chosen(switch: str) -> tuple[str, ...]:
    """The parts that are not left out."""
    if switch == "1":
        return ()
    without = [name for name in switch.split(",") if name not in ("", "0")]
    for name in without:
        if name not in PARTS:
            raise InputError(f"{SWITCH}={switch}: there is no part {name}. {suggestion(name, PARTS)}")
    parts = tuple(name for name in PARTS if name not in without and _changes(name) is not None)
    if not switch and not numba.__version__.startswith(f"{TRIED}."):
        parts = _tried(parts)
    missing = [name for name in PARTS if name not in (*parts, *without)]
    if missing:
        log.info(
            "numba %s is not the version that foamprb knows best, %s: it compiles more slowly, without %s.",
            numba.__version__, TRIED, ", ".join(missing),
        )  # fmt: skip
    return parts


@cache
def _changes(name: str) -> _Changes | None:
    """What a part changes; None if numba lacks what it takes."""
    try:
        made = PARTS[name]()
        for role, replaced in made.passes.items():
            _pipeline(role, replaced)
    except Exception as error:
        log.debug("numba has not what %s takes: %r", name, error)
        return None
    return made


@cache
def _with(*parts: str) -> Internals:
    options: dict[Role, dict[str, Any]] = {role: {} for role in _ROLES}
    passes: dict[Role, dict[type, type | None]] = {role: {} for role in _ROLES}
    rebuild: dict[Role, Callable[..., Any]] = {}
    use_cache, called, shortcut, prepared = None, None, None, []
    for name in parts:
        changes = _changes(name)
        assert changes is not None
        if changes.prepare:
            prepared.append(changes.prepare)
        for role in _ROLES:
            options[role] |= changes.options.get(role, {})
            passes[role] |= changes.passes.get(role, {})
        rebuild |= changes.rebuild
        use_cache = changes.use_cache or use_cache
        called, shortcut = changes.called or called, changes.shortcut or shortcut
    for role in _ROLES:
        short = partial(shortcut, called) if shortcut and called and role == "separate" else None
        options[role] |= _pipeline(role, passes[role], short)
    return Internals(parts, options, rebuild, use_cache, tuple(prepared))


def _pipeline(
    role: Role,
    replaced: Mapping[type, type | None],
    shortcut: Callable[[Any, Any], Any] | None = None,
) -> dict[str, Any]:
    """The option that makes numba's compiler go through other passes, or through none."""
    if not replaced and shortcut is None:
        return {}
    from numba.core.compiler import CompilerBase, DefaultPassBuilder
    from numba.core.compiler_machinery import PassManager

    class Compiler(CompilerBase):  # type: ignore[misc]
        def compile_extra(self, function: Any) -> Any:
            found = None if shortcut is None else shortcut(self.state, function)
            return super().compile_extra(function) if found is None else found

        def define_pipelines(self) -> list[Any]:
            passes = PassManager(f"foamprb_{role}")
            for step, description in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:
                instead = replaced.get(step, step)
                if instead is not None:
                    passes.add_pass(instead, description)
            passes.finalize()
            return [passes]

    return {"pipeline_class": Compiler}


def _need(owner: Any, *names: str) -> None:
    """Raise AttributeError if an object of numba's lacks something."""
    for name in names:
        getattr(owner, name)


def _tried(parts: tuple[str, ...]) -> tuple[str, ...]:
    """Those parts with which :mod:`foamprb.compile.trial` runs, and comes out right."""
    store = Store("trials")
    key = numba.__version__, version("llvmlite"), sys.version, parts
    found: tuple[str, ...] | None = store.load(key)
    if found is None:
        command = [sys.executable, "-m", "foamprb.compile.trial", *parts]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT, check=True)
        except (OSError, subprocess.SubprocessError):
            return ()
        found = tuple(done.stdout.split())
        store.save(key, found)
    return found
