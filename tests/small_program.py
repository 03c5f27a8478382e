"""A small program for tests of the compiler: an entry, a separate and an inlined function, a stage."""

from __future__ import annotations

import math
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.tensor import select
from foamprb.compile.link import link, separate, slot, traced

LANES = 10


def renamed(function, **names):
    """Return a copy of a function that reads other values behind some of its global names."""
    return FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)


class Numbers(NamedTuple):
    """An array and a number, as the arrays of a flow are passed."""

    values: Any
    scale: float


def example():
    return Numbers(np.linspace(-1.0, 2.0, 50), 0.75)


def inner(x, y):
    return select(x > y, math.sqrt(x * x + y * y) / (3.0 + x), x - 2 * y)


def swapped(pair):
    return pair[1], inner(pair[0], pair[1])


@separate
def middle(numbers, i):
    """Separate function."""
    a, b = swapped((numbers.values[i], numbers.scale))
    numbers.values[i] = np.exp(-a) + b
    return float(a * b if i % 3 else np.cbrt(b))


def around(numbers, i):
    """Inlined caller of a separate function."""
    return float(middle(numbers, i) + inner(numbers.values[i], 0.5))


@slot
@traced
def stage(values, numbers):
    for i in range(LANES):
        x, y = values[i], values[LANES + i]
        values[3 * LANES + i] += select(x > numbers.scale, np.sqrt(abs(y)), x) / np.maximum(y, 0.5)


@traced
def another_stage(values, numbers):
    for i in range(LANES):
        values[3 * LANES + i] -= 2.0 * values[i] + numbers.scale


def outer(numbers):
    """Entry."""
    total = 0.0
    for i in range(numbers.values.shape[0]):
        total += around(numbers, i)
    stage(numbers.values, numbers)
    return total


@choice
def formula(x):
    """Stands for one of a test."""


@slot
@traced
def formed(values):
    for i in range(LANES):
        values[i] = formula(values[i]) + 1.0


@separate
def calling(values):
    """Separate caller of a stage."""
    formed(values)


def calls_once(values):
    """Entry that calls a stage through another function."""
    calling(values)


def calls_again(values):
    """Another one."""
    calling(values)
    calling(values)


one = other = calling


def twice(values):
    """Entry that calls two stages."""
    one(values)
    other(values)


def linked():
    return link(outer)
