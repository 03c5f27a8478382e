"""How numba compiles those functions of a loop that only compiled code calls.

Numba optimises every function by itself, with all that is inlined into it, and makes machine code of it. Of a
function that is always inlined both are waste, and as functions are nested, much of it: half of all work for
LLVM. Such a function is left as LLVM's intermediate code here. A function that is to be called, and not
inlined, is marked so, or LLVM would make one huge function of a loop and all its stages; its machine code is
made as a part of the loop's.

The classes below go into numba's inner parts, which another version may name otherwise; the options are then
empty, and compilation takes longer.
"""

from __future__ import annotations

import copy
from typing import Any

from numba import _dynfunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.typed_passes import NativeLowering

__all__ = ["CALLED", "INLINED"]


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


def _not_executable(library: Any, fndesc: Any, env: Any) -> Any:
    """Stand-in for what Python would call, which numba wants of every function."""
    library._ensure_finalized()
    name = fndesc.qualname.split(".")[-1]
    return _dynfunc.make_function(fndesc.lookup_module(), name, "", 0, env, (library,))


def _lower(lowering: NativeLowering, state: Any, library: JITCodeLibrary) -> bool:
    """Numba's last pass, into a library of another kind and without machine code."""
    state.library = library
    context, state.targetctx = state.targetctx, copy.copy(state.targetctx)
    state.targetctx.get_executable = _not_executable
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


def _passes(compiler: Any, lowering: type[NativeLowering]) -> list[PassManager]:
    """Numba's passes, with another one in the place of the last."""
    passes = PassManager(lowering._name)
    for step, description in DefaultPassBuilder.define_nopython_pipeline(compiler.state).passes:
        passes.add_pass(lowering if step is NativeLowering else step, description)
    passes.finalize()
    return [passes]


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


INLINED, CALLED = _options(_CompilerOfInlined), _options(_CompilerOfCalled)
