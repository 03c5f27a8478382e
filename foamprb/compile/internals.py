"""Compilation of linked functions with numba internals.

numba makes machine code of each function. Here inlined functions stay LLVM IR, which is linked into their
callers before these are optimised. All others are called by name: the machine code of a caller serves for any
function of a name, with the key of this one in place of another. Stages that can be traced
(:mod:`foamprb.compile.trace`) skip the passes of numba. Compiled code is kept on disk
(:mod:`foamprb.compile.cache`).

Nothing of this is documented by numba: :mod:`foamprb.compile.link` imports the module only for a tested
version. Plain numba compiles more slowly and keeps no code; results differ by round-off at most.
Public llvmlite makes machine code of LLVM code, but documented numba gives that of a function only after its
own, slower compilation to machine code. Its documented inlining rejects calls with ``*args``.
"""

from __future__ import annotations

import copy
import gc
import hashlib
import inspect
import logging
import pickle
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from llvmlite import binding, ir  # type: ignore[import-untyped]
from numba import _dynfunc, config, types
from numba.core.bytecode import FunctionIdentity
from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
from numba.core.compiler import CompilerBase, CompileResult, DefaultPassBuilder, compile_result
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.funcdesc import PythonFunctionDescriptor
from numba.core.ir import Return
from numba.core.lowering import Environment
from numba.core.runtime import rtsys
from numba.core.serialize import dumps
from numba.core.typed_passes import NativeLowering
from numba.core.types.functions import BaseFunction
from numba.core.typing import signature

from foamprb.compile.cache import Store
from foamprb.compile.part import Keys, Part
from foamprb.compile.processor import processor
from foamprb.compile.record_type import RecordType, read_item
from foamprb.compile.trace import TRACED, Code, Numbers, Path, UntraceableError, trace

if TYPE_CHECKING:
    from numba.core.base import BaseContext
    from numba.core.codegen import CodeLibrary
    from numba.core.compiler import StateDict
    from numba.core.funcdesc import FunctionDescriptor
    from numba.core.typing.templates import Signature

__all__ = ["Role", "pipeline", "use_cache", "widen_indices"]

log = logging.getLogger("foamprb")

Role: TypeAlias = Literal["entry", "lanes", "scalar", "inlined"]
"""Python calls an entry; compiled code calls, by name, functions of all lanes and scalar ones; an inlined one
is a part of its callers."""

Function: TypeAlias = Callable[..., Any]
Called: TypeAlias = tuple[str, tuple[types.Type, ...], types.Type, str]
"""Key and types of a function that compiled code calls, and the end of its name."""

_NAMED = "code_"
"""Start of the names of functions that callers find by a name."""
_WIDE = '"prefer-vector-width"="512"'
"""LLVM attribute: use registers of 512 bits where the processor has them."""
_ALIGNED = '"stackrealign"'
"""LLVM attribute: spilled registers lie on whole cache lines."""


class _Codegen(JITCPUCodegen):  # type: ignore[misc]
    """Code generator for :func:`~foamprb.compile.processor.processor`."""

    def _get_host_cpu_name(self) -> str:
        return processor().name

    def _get_host_cpu_features(self) -> str:
        return processor().features


@cache
def _codegen() -> _Codegen:
    """Return the code generator of this process; functions of others keep that of numba."""
    return _Codegen("foamprb")


_helpers: dict[Any, Any] = {}
"""Functions that numba compiles for its own ones."""


def _target(context: BaseContext) -> BaseContext:
    """Return a copy of numba's context with the code generator of this module."""
    target = context.subtarget(_internal_codegen=_codegen())
    target.cached_internal_func = _helpers
    return target


class _Inlined(JITCodeLibrary):  # type: ignore[misc]
    """LLVM IR that is linked into its callers before these are optimised."""

    def _optimize_functions(self, module: binding.ModuleRef) -> None:
        """Simplify functions as numba does, but unroll no loop around calls that are inlined later."""
        module.data_layout = self._codegen._data_layout
        tuning = binding.create_pipeline_tuning_options(speed_level=config.OPT)
        tuning.loop_unrolling = False
        builder = binding.create_pass_builder(self._codegen._tm, tuning)
        passes = builder.getFunctionPassManager()
        for function in module.functions:
            passes.run(function, builder)

    def finalize(self) -> None:
        self._finish()

    def _finish(self) -> None:
        """Allow copies of the functions in several linked modules; unused ones are removed."""
        self._finalize_dynamic_globals()
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == binding.Linkage.external:
                function.linkage = "linkonce_odr"
        self._finalized = True

    def _get_module_for_linking(self) -> binding.ModuleRef:
        return self._final_module


class _Entry(_Inlined):
    """Machine code, linked with inlined functions before its optimisation."""

    def finalize(self) -> None:
        inlined: dict[CodeLibrary, None] = {}
        _collect(self, inlined)
        # Callers first: a function to which nothing refers yet is left out.
        for library in reversed(inlined):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._optimize_final_module()
        self._final_module.verify()
        self._finish()

    def _finish(self) -> None:
        """Make the code callable.

        Raises
        ------
        RuntimeError
            If it calls a function that is nowhere: the process would crash.
        """
        called = [function.name for function in self._final_module.functions if function.is_declaration]
        absent = [name for name in called if _is_absent(name)]
        if absent:
            raise RuntimeError(f"{self.name} calls {', '.join(absent)}, which is not compiled")
        # Another loop may hold a function of the same name that calls other functions.
        for function in self.get_defined_functions():
            if function.linkage == binding.Linkage.linkonce_odr:
                function.linkage = "internal"
        self._finalize_final_module()

    def serialize_using_object_code(self) -> Any:
        """Return the machine code; of the IR, which no function inlines, only the names."""
        names = [function.name for function in self.get_defined_functions()]
        text = "".join(f'define void @"{name}"() {{ ret void }}\n' for name in names)
        return self.name, "object", (self._get_compiled_object(), binding.parse_assembly(text).as_bitcode())


class _Scalar(_Entry):
    """Machine code that others find by its name."""


class _Lanes(_Scalar):
    """The same, with wide registers."""

    def add_ir_module(self, ir_module: binding.ModuleRef) -> None:
        for function in ir_module.functions:
            # llvmlite rejects attributes of this kind.
            set.add(function.attributes, _WIDE)
            set.add(function.attributes, _ALIGNED)
        super().add_ir_module(ir_module)


class _Traced(_Lanes):
    """Machine code of a traced stage, which needs few passes."""

    def finalize(self) -> None:
        passes = binding.create_new_module_pass_manager()
        passes.add_always_inliner_pass()
        passes.add_instruction_combine_pass()
        passes.add_dead_code_elimination_pass()
        passes.add_global_dead_code_eliminate_pass()
        passes.run(self._final_module, self._codegen._pass_builder())
        self._final_module.verify()
        self._finish()


def _collect(library: CodeLibrary, inlined: dict[CodeLibrary, None]) -> None:
    """Collect the inlined libraries that a library refers to, directly or not, each after its own."""
    for other in library._linking_libraries:
        if other not in inlined and not isinstance(other, _Scalar):
            if isinstance(other, _Inlined):
                _collect(other, inlined)
            inlined[other] = None


def _is_absent(name: str) -> bool:
    """Return True for the name of a function with machine code of its own that this process lacks."""
    return name.startswith(_NAMED) and not _codegen()._engine.is_symbol_defined(name)


def _name_by_key(qualified: str, kinds: Sequence[types.Type]) -> str:
    """Return the name of a function for arguments of some types in machine code.

    Of ``qualified`` only the key at the end counts, in whose place a caller's code may have another.
    """
    kind = hashlib.sha256(repr(tuple(kinds)).encode()).hexdigest()[:16]
    return f"{_NAMED}{qualified.rpartition('_')[2]}_{kind}"


def _kind_in(compiled: CompileResult) -> str:
    """Return the last part of a name by key, which depends on the types of the arguments."""
    return str(compiled.fndesc.mangled_name).rpartition("_")[2]


def _context(target: BaseContext, named: str = "") -> BaseContext:
    """Return a copy of a context for functions that Python does not call.

    ``named`` is the qualified name, with its key, of a function that is found by a name.
    """
    context = copy.copy(target)
    context.get_executable = _without_executable
    if named:

        def mangler(name: str, kinds: Sequence[types.Type], **more: object) -> str:
            is_named = name.endswith(named) and not name.startswith(".NumbaEnv")
            return _name_by_key(named, kinds) if is_named else target.mangler(name, kinds, **more)

        context.mangler = mangler
    return context


def _without_executable(library: CodeLibrary, fndesc: FunctionDescriptor, env: Environment) -> object:
    """Return a dummy for the Python function that numba expects of each compilation."""
    library._ensure_finalized()
    name = fndesc.qualname.split(".")[-1]
    return _dynfunc.make_function(fndesc.lookup_module(), name, "", 0, env, (library,))


_LIBRARIES: dict[Role, type[_Inlined]] = {
    "entry": _Entry,
    "lanes": _Lanes,
    "scalar": _Scalar,
    "inlined": _Inlined,
}


class _Passes(PassManager):  # type: ignore[misc]
    """Passes between which numba does not analyse the lifetimes of variables: the last ones do so anew."""

    _ENFORCING = False


def _widen_return(state: StateDict) -> None:
    """Give a function that returns a constant the type of one that does not.

    Callers are compiled once for all functions behind a slot.
    """
    state.return_type = wide = types.unliteral(state.return_type)
    for block in state.func_ir.blocks.values():
        if isinstance(block.terminator, Return):
            name = block.terminator.value.name
            del state.typemap[name]
            state.typemap[name] = wide


def _lowering(role: Role) -> type:
    """Return numba's last pass, which writes into the library of a role."""

    @register_pass(mutates_CFG=True, analysis_only=False)
    class Lowering(NativeLowering):  # type: ignore[misc]
        _name = f"lowering_of_{role}"

        def run_pass(self, state: StateDict) -> bool:
            _widen_return(state)
            before, name = state.targetctx, state.func_id.func_qualname
            target = _target(before)
            state.library = _LIBRARIES[role](target.codegen(), name)
            if role != "inlined":
                state.library.enable_object_caching()
            state.targetctx = (
                target if role == "entry" else _context(target, "" if role == "inlined" else name)
            )
            try:
                return bool(super().run_pass(state))
            finally:
                state.targetctx = before

    return Lowering


def pipeline(role: Role) -> dict[str, type]:
    """Return the option of ``numba.njit`` with which a function of a role is compiled."""
    return {"pipeline_class": _COMPILERS[role]}


def _compiler(role: Role) -> type:
    lowering = _lowering(role)

    class Compiler(CompilerBase):  # type: ignore[misc]
        def compile_extra(self, function: Function) -> CompileResult:
            with _rare_collection(), _resolved_operators():
                if hasattr(function, TRACED):
                    try:
                        return _traced(self.state, function)
                    except UntraceableError as reason:
                        name = function.__qualname__.rpartition("_")[0]
                        log.warning("The stage %s compiles slowly, as it cannot be traced: %s", name, reason)
                return super().compile_extra(function)

        def define_pipelines(self) -> list[PassManager]:
            passes = _Passes(f"foamprb_{role}")
            for step, description in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:
                passes.add_pass(lowering if step is NativeLowering else step, description)
            passes.finalize()
            return [passes]

    return Compiler


_COMPILERS = {role: _compiler(role) for role in _LIBRARIES}
_NEW_OBJECTS = 20_000
"""Objects after which garbage is collected during a compilation; Python's 700 cost a tenth of its time."""


@contextmanager
def _rare_collection() -> Iterator[None]:
    """Collect garbage rarely."""
    before = gc.get_threshold()
    gc.set_threshold(max(before[0], _NEW_OBJECTS) if before[0] else 0, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


@contextmanager
def _resolved_operators() -> Iterator[None]:
    """Resolve an operator once for all functions, by the types of its operands.

    For each ``+`` numba tries all of its implementations, those for strings and sets included.
    """
    functions: Any = BaseFunction
    resolve = functions.get_call_type
    operands = types.Number | types.Boolean | types.Array | types.BaseTuple

    def resolve_once(function: Any, context: BaseContext, args: tuple[Any, ...], kws: dict[str, Any]) -> Any:
        if kws or not all(isinstance(arg, operands) for arg in args):
            return resolve(function, context, args, kws)
        resolved = vars(function).setdefault("_resolved", {})
        if args not in resolved:
            resolved[args] = resolve(function, context, args, kws)
        return resolved[args]

    functions.get_call_type = resolve_once
    try:
        yield
    finally:
        functions.get_call_type = resolve


def _traced(state: StateDict, function: Function) -> CompileResult:
    """Return the result of the compilation of a stage, made from its trace.

    Raises
    ------
    UntraceableError
        If it cannot be traced.
    """
    identity = FunctionIdentity.from_function(function)
    context = _context(_target(state.targetctx), identity.func_qualname)
    flags = " ".join(sorted(state.flags.fastmath.flags))

    def arguments(code: Code) -> list[object]:
        return [_symbols(kind, code, (k,)) for k, kind in enumerate(state.args)]

    code = trace(function, processor().register, flags, arguments)
    descriptor = PythonFunctionDescriptor(
        native=True,
        modname=identity.modname,
        qualname=identity.func_qualname,
        unique_name=identity.unique_name,
        doc="",
        typemap={},
        restype=types.none,
        calltypes={},
        args=tuple(inspect.signature(function).parameters),
        kws=(),
        mangler=context.mangler,
        argtypes=tuple(state.args),
        abi_tags=[state.flags.get_mangle_string()],
        uid=identity.unique_id,
    )
    library = _Traced(context.codegen(), identity.func_qualname)
    library.enable_object_caching()
    library.add_ir_module(_caller(context, library, descriptor, code))
    library.add_llvm_module(binding.parse_assembly(code.function(f"{identity.func_qualname}_lanes")))
    library.finalize()
    environment = Environment.from_fndesc(descriptor)
    entry_point = _without_executable(library, descriptor, environment)
    state.targetctx.insert_user_function(entry_point, descriptor, [library])
    return compile_result(
        typing_context=state.typingctx,
        target_context=state.targetctx,
        entry_point=entry_point,
        typing_error=None,
        type_annotation="",
        library=library,
        call_helper=None,
        signature=signature(types.none, *state.args),
        objectmode=False,
        lifted=(),
        fndesc=descriptor,
        environment=environment,
        metadata=state.metadata,
        reload_init=[],
    )


def _symbols(kind: types.Type, code: Code, path: Path) -> object:
    """Return the symbol of an argument of some type, found under ``path`` among the arguments."""
    if kind == types.Array(types.float64, 1, "C") and path == (0,):
        return code.block
    if kind == types.float64:
        return code.argument(path)
    if kind == types.Array(types.float64, 1, "C"):
        return Numbers(code, path)
    if isinstance(kind, RecordType):
        return SimpleNamespace(
            **{name: _symbols(item, code, (*path, name)) for name, item in kind.items.items()}
        )
    if isinstance(kind, types.BaseTuple):
        items = [_symbols(item, code, (*path, k)) for k, item in enumerate(kind)]
        return kind.instance_class(*items) if isinstance(kind, types.BaseNamedTuple) else tuple(items)
    return object()


def _caller(context: BaseContext, library: CodeLibrary, descriptor: FunctionDescriptor, code: Code) -> Any:
    """Return the LLVM module of a function with numba's signature that calls the traced one."""
    module = library.create_ir_module(descriptor.unique_name)
    outer = context.declare_function(module, descriptor)
    builder = ir.IRBuilder(outer.append_basic_block())
    arguments = context.call_conv.decode_arguments(builder, descriptor.argtypes, outer)
    block = context.make_array(descriptor.argtypes[0])(context, builder, arguments[0]).data
    numbers = [
        _number(context, builder, descriptor.argtypes, arguments, path, item) for path, item in code.arguments
    ]
    kind = ir.FunctionType(ir.VoidType(), [block.type, *(number.type for number in numbers)])
    builder.call(ir.Function(module, kind, f"{descriptor.qualname}_lanes"), [block, *numbers])
    context.call_conv.return_value(builder, context.get_dummy_value())
    return module


def _number(
    context: Any,
    builder: Any,
    kinds: Sequence[Any],
    arguments: Sequence[Any],
    path: tuple[Any, ...],
    item: int | None,
) -> ir.Value:
    """Return the number under a path among the arguments, or the item of the array there."""
    kind, value = kinds[path[0]], arguments[path[0]]
    for k in path[1:]:
        if isinstance(kind, RecordType):
            kind, value = kind.items[k], read_item(context, builder, kind, value, k)
        else:
            kind, value = kind[k], builder.extract_value(value, k)
    if item is None:
        return value
    data = context.make_array(kind)(context, builder, value).data
    return builder.load(builder.gep(data, [ir.Constant(ir.IntType(64), item)]))


class _Reader:
    """Code generator that reads the saved code of a function that Python does not call."""

    def __init__(self, codegen: JITCPUCodegen) -> None:
        self._codegen = codegen

    def create_library(self, name: str) -> CodeLibrary:
        """Return an empty library for machine code."""
        return _Scalar(self._codegen, name)

    def unserialize_library(self, state: StateDict) -> CodeLibrary:
        return _Scalar._unserialize(self, state)


class _Cache:
    """Cache of a dispatcher, as numba calls it before and after each compilation.

    The cache that numba has goes by a function's file, not by the code that it calls, and has no checksum.
    Keys in saved code do not depend on the functions that are found by a name; each process puts the keys of
    its own there. Code that is found calls these functions, which are then compiled or found as well.

    Parameters
    ----------
    store
        The function's files.
    keys
        Its keys.
    named
        Functions that its code may call by name.
    is_entry
        Whether Python calls it.
    allocates
        Whether it needs numba's runtime. Other saved code needs nothing of numba's functions, whose loading
        takes a third of a second; a compilation loads them.
    """

    def __init__(
        self, store: Store, keys: Keys, named: Mapping[str, Part], is_entry: bool, allocates: bool
    ) -> None:
        self._store, self._named, self._is_entry, self._allocates = store, dict(named), is_entry, allocates
        self._keys = [keys, *(part.keys for part in named.values())]
        self.cache_path = str(store.folder)

    def load_overload(self, signature: Signature, context: BaseContext) -> CompileResult | None:
        if self._allocates:
            rtsys.initialize(context)
        saved = self._store.load(signature)
        if saved is None:
            return None
        # It may name a module that is gone.
        with suppress(Exception):
            return self._rebuilt(_target(context), saved)
        return None

    def save_overload(self, signature: Signature, result: CompileResult) -> None:
        # Machine code that holds addresses serves one process only.
        if not result.library.has_dynamic_globals:
            state = dumps(result._reduce())
            for keys in self._keys:
                state = state.replace(keys.full.encode(), keys.outside.encode())
            self._store.save(signature, (self._called(result), state))

    def flush(self) -> None:
        self._store.flush()

    def _rebuilt(self, context: BaseContext, saved: tuple[list[Called], bytes]) -> CompileResult | None:
        called, state = saved
        for key, kinds, returned, kind in called:
            dispatcher = self._named[key].dispatcher
            dispatcher.compile(kinds)
            compiled = dispatcher.overloads[kinds]
            if (compiled.signature.return_type, _kind_in(compiled)) != (returned, kind):
                return None
        for keys in self._keys:
            state = state.replace(keys.outside.encode(), keys.full.encode())
        if self._is_entry:
            return CompileResult._rebuild(context, *pickle.loads(state))
        target, codegen = _context(context), context.codegen()
        target.codegen = lambda: _Reader(codegen)
        # Without the environments of interpreted code, which belong to entries.
        return CompileResult._rebuild(target, *pickle.loads(state)[:-1], ())

    def _called(self, result: CompileResult) -> list[Called]:
        """Return keys and types of the functions that compiled code calls, and the ends of their names."""
        declared = {f.name for f in result.library._final_module.functions if f.is_declaration}
        return [
            (key, kinds, compiled.signature.return_type, _kind_in(compiled))
            for key, part in self._named.items()
            for kinds, compiled in part.dispatcher.overloads.items()
            if compiled.fndesc.mangled_name in declared
        ]


def widen_indices(dispatcher: Any) -> None:
    """Compile a function for 64-bit integers where a caller has 32-bit ones, as for items of arrays."""
    template = dispatcher.get_call_template

    def of_wide(args: Sequence[types.Type], kws: dict[str, types.Type]) -> Any:
        return template([types.int64 if arg == types.int32 else arg for arg in args], kws)

    dispatcher.get_call_template = of_wide


def use_cache(dispatcher: Any, keys: Keys, named: Mapping[str, Part], is_entry: bool) -> Store:
    """Give the dispatcher of a function with machine code of its own a place in the cache.

    Parameters
    ----------
    keys
        Its keys.
    named
        Functions that it may call by name.
    is_entry
        Whether Python calls it.
    """
    store = Store(keys.outside, dumps)
    dispatcher._cache = _Cache(store, keys, named, is_entry, dispatcher.targetoptions["_nrt"])
    return store
