"""A small program that shows with which parts of :mod:`foamprb.compile.internals` compiled code is right.

It is run with versions of numba that foamprb does not know::

    python -m foamprb.compile.trial cache inlining
"""

from __future__ import annotations

import math
import os
import sys
import tempfile
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from foamprb.body.tensor import select
from foamprb.compile import link as linking
from foamprb.compile.internals import PARTS, SWITCH


class Numbers(NamedTuple):
    """As a flow's arrays and a particle's state are."""

    values: Any
    scale: float


def inner(x: Any, y: Any) -> Any:
    """Inlined wherever it is called."""
    return select(x > y, math.sqrt(x * x + y * y) / (3.0 + x), x - 2 * y)


def swapped(pair: tuple[float, float]) -> tuple[float, float]:
    """A tuple."""
    return pair[1], inner(pair[0], pair[1])


def middle(numbers: Numbers, i: int) -> float:
    """Compiled by itself, and called."""
    a, b = swapped((numbers.values[i], numbers.scale))
    numbers.values[i] = np.exp(-a) + b
    return float(a * b if i % 3 else np.cbrt(b))


def around(numbers: Numbers, i: int) -> float:
    """Inlined, and calls what is not."""
    return float(middle(numbers, i) + inner(numbers.values[i], 0.5))


LANES = 10


def stage(values: Any, numbers: Numbers) -> None:
    """Goes through lanes side by side."""
    for i in range(LANES):
        x, y = values[i], values[LANES + i]
        values[3 * LANES + i] += select(x > numbers.scale, np.sqrt(abs(y)), x) / np.maximum(y, 0.5)


def outer(numbers: Numbers) -> float:
    """What Python calls."""
    total = 0.0
    for i in range(numbers.values.shape[0]):
        total += around(numbers, i)
    stage(numbers.values, numbers)
    return total


def is_right() -> bool:
    """Whether the program does the same plain, compiled, and as the next process finds it in the cache."""
    plain = Numbers(np.linspace(-1.0, 2.0, 50), 0.75)
    total = outer(plain)
    for _ in range(2):
        numbers = Numbers(np.linspace(-1.0, 2.0, 50), 0.75)
        linking._parts.clear()
        found = linking.link(outer, separate=(middle, stage))(numbers)
        if not math.isclose(found, total, rel_tol=1e-13):
            return False
        if not np.allclose(numbers.values, plain.values, rtol=1e-13, atol=0.0):
            return False
    return True


def works(parts: Sequence[str]) -> bool:
    """Whether the program is right with some parts alone.

    It runs in a process of its own: wrong machine code can end one.
    """
    number = os.fork()
    if number == 0:
        status = 1
        try:
            os.environ[SWITCH] = ",".join(name for name in PARTS if name not in parts) or "0"
            status = 0 if is_right() else 1
        finally:
            os._exit(status)
    return os.waitpid(number, 0)[1] == 0


def main(parts: Sequence[str]) -> None:
    """Print those parts that work, and work together."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["FOAMPRB_CACHE_DIR"] = folder
        found = parts
        if not works(found):
            found = [name for name in parts if works((name,))]
            found = found if works(found) else ()
    print(*found)


if __name__ == "__main__":
    main(sys.argv[1:])
