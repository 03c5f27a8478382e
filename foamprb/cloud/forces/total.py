"""The forces that a cloud has chosen, added up into one function that the stages of every integrator call.

The names ``pushes`` and ``slips`` are bound to those functions (:func:`compose`) when the loop is compiled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any

from foamprb.body.tensor import Scalar, Vector, scale_vector
from foamprb.cloud.block import Medium
from foamprb.cloud.forces.base import Force, Inputs, displaced, inputs_of
from foamprb.cloud.forces.gravity import Gravity

__all__ = ["DEFAULT", "acceleration", "bound", "coefficients", "compose", "slip_acceleration"]


# Not the constants 0 and 1. Which sums of a stage the compiler contracts depends on what it loads: without
# these loads, last bits of the shape would depend on whether one of the forces reads them.


def no_push(inputs: Inputs, _coefficients: Any) -> tuple[Vector, Scalar]:
    """No force, and the inertia of the particle alone."""
    return scale_vector(0.0, inputs.Du_Dt), 1.0 + 0.0 * displaced(inputs)


def no_slip(inputs: Inputs, _coefficients: Any) -> Vector:
    """Nothing for the drag to balance."""
    return scale_vector(0.0, inputs.Du_Dt)


def acceleration(block: Any, i: int, medium: Medium, J: Scalar) -> tuple[Vector, Scalar]:
    """Acceleration of lane i by every force but drag, m/s², and the inertia over the particle's mass.

    m (1 + Σ C) dv/dt = Σ f + f_D with the forces f and the inertia m C that each adds.
    """
    push, inertia = pushes(inputs_of(block, i, medium, J), medium.coefficients)
    return scale_vector(1.0 / inertia, push), inertia


def slip_acceleration(block: Any, i: int, medium: Medium) -> Vector:
    """What the drag of lane i balances when its acceleration is the fluid's and its volume constant, m/s².

    It gives the slip to first order in the particle's inertia.
    """
    return slips(inputs_of(block, i, medium, 1.0), medium.coefficients)


def compose(forces: Sequence[Force]) -> dict[str, Callable[..., Any]]:
    """The functions of these forces together, by the names to which they are bound."""
    push: Callable[..., Any] = no_push
    slip: Callable[..., Any] = no_slip
    for force in forces:
        kind = type(force)
        push = bound(_and_push, others=push, force=kind.push)
        if kind.slip is None:
            slip = bound(_and_push_as_slip, others=slip, force=kind.push)
        else:
            slip = bound(_and_slip, others=slip, force=kind.slip)
    return {"pushes": push, "slips": slip}


def coefficients(forces: Sequence[Force]) -> tuple[Any, ...]:
    """The coefficients of these forces as the functions of :func:`compose` read them: ((…, 1st), 2nd)."""
    nested: tuple[Any, ...] = ()
    for force in forces:
        nested = nested, force.coefficients
    return nested


def _and_push(inputs: Inputs, coefficients: Any) -> tuple[Vector, Scalar]:
    a, m = others(inputs, coefficients[0])
    b, n = force(inputs, *coefficients[1])
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2]), m + n


def _and_slip(inputs: Inputs, coefficients: Any) -> Vector:
    a = others(inputs, coefficients[0])
    b = force(inputs, *coefficients[1])
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _and_push_as_slip(inputs: Inputs, coefficients: Any) -> Vector:
    a = others(inputs, coefficients[0])
    b, _ = force(inputs, *coefficients[1])
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


others: Any = no_push
force: Any = no_push


def bound(function: Any, **names: Callable[..., Any]) -> Callable[..., Any]:
    """The same function with other functions behind some of the names that it calls."""
    return FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)


DEFAULT: tuple[Force, ...] = (Gravity(),)
"""The forces of a cloud that chooses none, and of the plain text."""

_default = compose(DEFAULT)
pushes: Callable[[Inputs, Any], tuple[Vector, Scalar]] = _default["pushes"]
slips: Callable[[Inputs, Any], Vector] = _default["slips"]
