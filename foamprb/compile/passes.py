"""How numba compiles the functions of a loop.

Numba optimises every function by itself, with all that is inlined into it, and makes machine code of it. Of a
function that is always inlined both are waste, and as functions are nested, much of it: half of all work for
LLVM. Such a function is left as LLVM's intermediate code here. A function that is to be called, and not
inlined, is marked so, or LLVM would make one huge function of a loop and all its stages; its machine code is
made as a part of the loop's. What is kept of it on disk is intermediate code as well.

Numba finds out anew for each sum and product what type it has, and looks for closures and for operations on
whole arrays; the formulas have hardly another type than float and nothing of the latter.

The classes below go into numba's inner parts, which another version may name otherwise; the options are then
empty, and compilation takes longer.
"""

from __future__ import annotations

import copy
import operator
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import binding  # type: ignore[import-untyped]
from numba import _dynfunc, types
from numba.core.caching import CompileResultCacheImpl
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, CompileResult, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.typed_passes import NativeLowering, NopythonRewrites, NopythonTypeInference
from numba.core.untyped_passes import InlineClosureLikes

__all__ = ["CALLED", "ENTRY", "INLINED", "Kept", "KeptToCall"]


class _Inlined(JITCodeLibrary):  # type: ignore[misc]
    """Intermediate code that others link in."""

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


class _Called(JITCodeLibrary):  # type: ignore[misc]
    """Intermediate code that others link in and call, optimised."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def serialize_using_object_code(self) -> Any:
        """What numba keeps on disk: there is no machine code."""
        return self.serialize_using_bitcode()


class _Reading:
    """A code generator that reads what was kept of :class:`_Called`."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def unserialize_library(self, state: Any) -> Any:
        name, kind, code = state
        if kind != "bitcode":
            # Made where the options are empty.
            return self._codegen.unserialize_library(state)
        library = _Called(self._codegen, name)
        library._final_module = binding.parse_bitcode(code)
        library._finalize_final_module()
        return library


def _not_executable(library: Any, fndesc: Any, env: Any) -> Any:
    """Stand-in for what Python would call, which numba wants of every function."""
    library._ensure_finalized()
    name = fndesc.qualname.split(".")[-1]
    return _dynfunc.make_function(fndesc.lookup_module(), name, "", 0, env, (library,))


def _to_call(context: Any) -> Any:
    """Numba's context of a target, for a function that only compiled code calls."""
    context = copy.copy(context)
    context.get_executable = _not_executable
    return context


def _lower(lowering: NativeLowering, state: Any, library: JITCodeLibrary) -> bool:
    """Numba's last pass, into a library of another kind and without machine code."""
    state.library = library
    context, state.targetctx = state.targetctx, _to_call(state.targetctx)
    try:
        return bool(NativeLowering.run_pass(lowering, state))
    finally:
        state.targetctx = context


@register_pass(mutates_CFG=True, analysis_only=False)
class _LoweringOfInlined(NativeLowering):  # type: ignore[misc]
    _name = "lowering_of_inlined"

    def run_pass(self, state: Any) -> bool:
        return _lower(self, state, _Inlined(state.targetctx.codegen(), state.func_id.func_qualname))


@register_pass(mutates_CFG=True, analysis_only=False)
class _LoweringOfCalled(NativeLowering):  # type: ignore[misc]
    _name = "lowering_of_called"

    def run_pass(self, state: Any) -> bool:
        library = _Called(state.targetctx.codegen(), state.func_id.func_qualname)
        changed = _lower(self, state, library)
        library.get_function(state.cr.fndesc.mangled_name).add_function_attribute("noinline")
        return changed


_OPERATORS = frozenset(getattr(operator, name) for name in operator.__all__)
_known: dict[tuple[Any, ...], Any] = {}


@contextmanager
def _arithmetic_known(context: Any) -> Iterator[None]:
    """Let numba's context remember the types of results of operators between numbers."""
    if "resolve_function_type" in vars(context):
        yield
        return
    resolve = context.resolve_function_type

    def remembering(function: Any, arguments: Any, keywords: Any) -> Any:
        plain = not keywords and all(isinstance(argument, types.Number) for argument in arguments)
        if not plain or getattr(function, "typing_key", None) not in _OPERATORS:
            return resolve(function, arguments, keywords)
        key = function, *arguments
        if key not in _known:
            _known[key] = resolve(function, arguments, keywords)
        return _known[key]

    context.resolve_function_type = remembering
    try:
        yield
    finally:
        del context.resolve_function_type


@register_pass(mutates_CFG=True, analysis_only=False)
class _TypeInference(NopythonTypeInference):  # type: ignore[misc]
    _name = "type_inference_of_arithmetic"

    def run_pass(self, state: Any) -> bool:
        with _arithmetic_known(state.typingctx):
            return bool(NopythonTypeInference.run_pass(self, state))


_NEEDLESS = (InlineClosureLikes, NopythonRewrites)


def _passes(compiler: Any, lowering: type[NativeLowering]) -> list[PassManager]:
    """Numba's passes, with others in the place of some."""
    passes, replaced = PassManager(lowering._name), {NopythonTypeInference: _TypeInference}
    for step, description in DefaultPassBuilder.define_nopython_pipeline(compiler.state).passes:
        if step not in _NEEDLESS:
            passes.add_pass(lowering if step is NativeLowering else replaced.get(step, step), description)
    passes.finalize()
    return [passes]


class _CompilerOfEntries(CompilerBase):  # type: ignore[misc]
    def define_pipelines(self) -> list[PassManager]:
        return _passes(self, NativeLowering)


class _CompilerOfInlined(CompilerBase):  # type: ignore[misc]
    def define_pipelines(self) -> list[PassManager]:
        return _passes(self, _LoweringOfInlined)


class _CompilerOfCalled(CompilerBase):  # type: ignore[misc]
    def define_pipelines(self) -> list[PassManager]:
        return _passes(self, _LoweringOfCalled)


def _options(compiler: type[CompilerBase]) -> dict[str, Any]:
    """Options for ``numba.njit``, if what is replaced is there."""
    replaced = (
        "_optimize_functions",
        "_optimize_final_module",
        "_finalize_final_module",
        "_finalize_dynamic_globals",
    )
    as_expected = all(hasattr(JITCodeLibrary, name) for name in replaced)
    return {"pipeline_class": compiler} if as_expected else {}


Kept = CompileResultCacheImpl
"""How numba keeps the code of a function that Python calls."""


class KeptToCall(CompileResultCacheImpl):  # type: ignore[misc]
    """How the code of a function is kept that only compiled code calls."""

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        """What numba makes of what it finds on disk."""
        context, codegen = _to_call(target_context), target_context.codegen()
        context.codegen = lambda: _Reading(codegen)
        # The last are environments of interpreted code, to be put into machine code that is not there.
        return CompileResult._rebuild(context, *payload[:-1], ())


ENTRY = _options(_CompilerOfEntries)
INLINED, CALLED = _options(_CompilerOfInlined), _options(_CompilerOfCalled)
