"""Functions of numpy that numba-cuda does not know on scalars, for code that runs on a CUDA device."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
from numba.cuda import types
from numba.cuda.extending import overload

__all__ = ["numpy_on_device"]

_OF_NUMBERS = ("sqrt", "exp", "log")
_OF_REALS = ("expm1", "log1p")


def _of_numbers(name: str) -> Callable[[Any], Any]:
    """A function of real or complex numbers."""
    of_real, of_complex = getattr(math, name), getattr(cmath, name)

    def on_complex(x: Any) -> Any:
        return of_complex(x)

    def on_real(x: Any) -> Any:
        return of_real(x)

    def function(x: Any) -> Any:
        return on_complex(x) if isinstance(x, complex) else on_real(x)

    @overload(function)  # type: ignore[untyped-decorator]
    def choose(x: Any) -> Callable[[Any], Any]:
        return on_complex if isinstance(x, types.Complex) else on_real

    return function


def _numpy_on_device() -> ModuleType:
    module = ModuleType("numpy")
    vars(module).update(vars(np))
    vars(module).update({name: _of_numbers(name) for name in _OF_NUMBERS})
    vars(module).update({name: getattr(math, name) for name in _OF_REALS})
    return module


numpy_on_device = _numpy_on_device()
"""Stands for numpy in device functions."""
