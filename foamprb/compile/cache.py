"""Compiled code on disk, for numba: under a key made of the code itself, wherever its source lies.

Numba's own cache goes by the path of a function's file, so that another installation of the same source
compiles anew, and it stops a program that cannot write there or cannot read what it finds.
"""

from __future__ import annotations

import pickle
from contextlib import suppress
from pathlib import Path
from typing import Any

from numba.core.caching import CompileResultCacheImpl, FunctionCache, _CacheLocator

__all__ = ["keep"]

# A type of an argument may have gone, or be one that cannot be imported.
_GONE = (OSError, AttributeError, ImportError)
# What unpickling damaged bytes comes to.
_DAMAGED = (pickle.PickleError, EOFError, IndexError, KeyError, ValueError)
_UNREADABLE = (*_GONE, *_DAMAGED)


class _Cache(FunctionCache):  # type: ignore[misc]
    """The compiled code of one function. Where it cannot be kept it is compiled in each process."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        with suppress(*_UNREADABLE):
            return super().load_overload(sig, target_context)
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        with suppress(*_UNREADABLE):
            super().save_overload(sig, data)


def keep(dispatcher: Any, folder: Path, key: str, kind: type[CompileResultCacheImpl]) -> None:
    """Let a dispatcher keep its code in a folder of its own; ``key`` changes with the code.

    A folder that cannot be made costs the compilation anew in each run, nothing else.
    """

    class Locator(_CacheLocator):  # type: ignore[misc]
        @classmethod
        def from_function(cls, py_func: Any, py_file: str) -> Locator:  # noqa: ARG003
            return cls()

        def get_cache_path(self) -> str:
            return str(folder)

        def get_source_stamp(self) -> str:
            return key

        def get_disambiguator(self) -> str:
            return ""

    class Impl(kind):  # type: ignore[misc]
        _locator_classes = (Locator,)

    class Cache(_Cache):
        _impl_class = Impl

    with suppress(OSError, RuntimeError):
        folder.mkdir(parents=True, exist_ok=True)
    dispatcher._cache = Cache(dispatcher.py_func)
