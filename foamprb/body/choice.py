"""Formulas in whose place a model may put another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

CHOICE = "_choice"
"""Attribute of such formulas."""

F = TypeVar("F", bound=Callable[..., Any])


def choice(function: F) -> F:
    """Mark a formula that :func:`foamprb.compile.link.link` may replace; the function itself is the default.

    Others take the same arguments. What replaces it may call the default by another name only.
    """
    setattr(function, CHOICE, True)
    return function
