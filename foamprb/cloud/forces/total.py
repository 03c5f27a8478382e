"""The forces that a cloud has chosen, added up into one function that the stages of every integrator call.

The name ``pushes`` is bound to that function (:func:`compose`) when the loop is compiled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any

from foamprb.body.tensor import Scalar, Vector, scale_vector
from foamprb.cloud.block import Medium
from foamprb.cloud.forces.base import Force, Inputs, displaced, inputs_of
from foamprb.cloud.forces.gravity import Gravity

__all__ = ["DEFAULT", "acceleration", "bound", "coefficients", "compose", "pushes_on"]


# Not the constants 0 and 1. Which sums of a stage the compiler contracts depends on what it loads: without
# these loads, last bits of the shape would depend on whether one of the forces reads them.


def no_push(inputs: Inputs, _coefficients: Any) -> tuple[Vector, Scalar]:
    """No force, and the inertia of the particle alone."""
    return scale_vector(0.0, inputs.Du_Dt), 1.0 + 0.0 * displaced(inputs)


def acceleration(block: Any, i: int, medium: Medium, J: Scalar) -> tuple[Vector, Scalar]:
    """Acceleration of lane i by every force but drag, m/s², and the inertia over the particle's mass.

    m (1 + Σ C) dv/dt = Σ f + f_D with the forces f and the inertia m C that each adds.
    """
    push, inertia = pushes(inputs_of(block, i, medium, J), medium.coefficients)
    return scale_vector(1.0 / inertia, push), inertia


def pushes_on(block: Any, i: int, medium: Medium, J: Scalar, Du_Dt: Vector) -> tuple[Vector, Vector, Scalar]:
    """Forces on lane i, m/s², in a fluid that is not accelerated and in one with Du/Dt; what resists them.

    The arguments of :func:`foamprb.body.slip.balanced_slip`.
    """
    inputs = inputs_of(block, i, medium, J)
    moved = Inputs(inputs.J, inputs.rho, Du_Dt, inputs.medium)
    push, inertia = pushes(moved, medium.coefficients)
    still = Inputs(inputs.J, inputs.rho, scale_vector(0.0, inputs.Du_Dt), inputs.medium)
    steady, _ = pushes(still, medium.coefficients)
    return steady, push, inertia


def compose(forces: Sequence[Force]) -> dict[str, Callable[..., Any]]:
    """The function of these forces together, by the name to which it is bound."""
    push: Callable[..., Any] = no_push
    for force in forces:
        push = bound(_and_push, others=push, force=type(force).push)
    return {"pushes": push}


def coefficients(forces: Sequence[Force]) -> tuple[Any, ...]:
    """The coefficients of these forces as the function of :func:`compose` reads them: ((…, 1st), 2nd)."""
    nested: tuple[Any, ...] = ()
    for force in forces:
        nested = nested, force.coefficients
    return nested


def _and_push(inputs: Inputs, coefficients: Any) -> tuple[Vector, Scalar]:
    a, m = others(inputs, coefficients[0])
    b, n = force(inputs, *coefficients[1])
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2]), m + n


others: Any = no_push
force: Any = no_push


def bound(function: Any, **names: Callable[..., Any]) -> Callable[..., Any]:
    """The same function with other functions behind some of the names that it calls."""
    return FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)


DEFAULT: tuple[Force, ...] = (Gravity(),)
"""The forces of a cloud that chooses none, and of the plain text."""

_default = compose(DEFAULT)
pushes: Callable[[Inputs, Any], tuple[Vector, Scalar]] = _default["pushes"]
