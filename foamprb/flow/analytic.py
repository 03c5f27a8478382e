"""Flows in closed form, behind the same interface as a mesh: for tests, validation and first steps.

A flow gives the particle loop a tuple of numbers (:meth:`arrays`) and plain functions of it
(:attr:`kernels`): ``sample``, ``walk``, ``gap``, ``normal``, ``recover`` and perhaps others; see
:mod:`foamprb.flow.walk` for what each returns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.faxen import Curvature, curvature_of
from foamprb.body.tensor import Tensor, Vector, add, scale
from foamprb.errors import InputError
from foamprb.flow.base import NO_PLANES, Floats, Ints, Patch, PatchFaces, Planes, Tetrahedra, Turbulence
from foamprb.flow.pipes import (
    PipeArrays,
    WomersleyArrays,
    curvature_pipe,
    curvature_womersley,
    gap_pipe,
    normal_pipe,
    planes_of_pipe,
    sample_pipe,
    sample_womersley,
    walk_pipe,
)
from foamprb.flow.sampling import sample_with
from foamprb.flow.slits import (
    SlitArrays,
    curvature_slit,
    gap_slit,
    normal_slit,
    planes_of_slit,
    sample_slit,
    walk_slit,
)

_FREE = -1


class LinearArrays(NamedTuple):
    """u = u0 + l·x, everywhere."""

    u0: Floats
    l: Floats


def sample_linear(flow: LinearArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, its gradient ∂u_i/∂x_j, 1/s, and ∂u/∂t = 0, m/s²."""
    g = flow.l
    L = (g[0], g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[8])
    u = (
        flow.u0[0] + L[0] * x[0] + L[1] * x[1] + L[2] * x[2],
        flow.u0[1] + L[3] * x[0] + L[4] * x[1] + L[5] * x[2],
        flow.u0[2] + L[6] * x[0] + L[7] * x[1] + L[8] * x[2],
    )
    return u, L, (0.0, 0.0, 0.0)


def curvature_linear(flow: Any, host: int, x: Vector, t: float) -> Curvature:
    """No second derivative."""
    nothing = (0.0, 0.0, 0.0)
    return nothing, nothing, nothing, nothing, nothing, nothing


def walk_free(flow: Any, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Nothing is in the way."""
    return host, 1.0, _FREE, -1


def gap_free(flow: Any, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """No wall is near."""
    return math.inf, _FREE, -1


def walls_free(flow: Any, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """No wall is near."""
    return NO_PLANES


def turbulence_free(flow: Any, host: int, x: Vector, t: float) -> Turbulence:
    """The flow has no eddies."""
    return 0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def no_rotation(flow: Any, host: int) -> tuple[Vector, Vector]:
    """Nothing rotates: no angular velocity, and the origin."""
    return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def normal_free(flow: Any, triangle: int, x: Vector) -> Vector:
    """No wall has a normal."""
    return 0.0, 0.0, 0.0


def cross_free(flow: Any, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """No patch is coupled to another."""
    return 0, x, (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def recover_free(flow: Any, x: Vector) -> int:
    """The flow is everywhere."""
    return 0


def cell_volume_free(flow: Any, host: int) -> float:
    """There are no cells."""
    return math.inf


def everywhere(points: Floats) -> NDArray[np.bool_]:
    """True for each point of shape (n, 3)."""
    return np.ones(len(points), dtype=bool)


class AnalyticFlow:
    """A flow in closed form.

    Parameters
    ----------
    parameters
        The tuple that the kernels read.
    kernels
        The functions ``sample``, ``walk``, ``gap``, ``normal``, ``recover``.
    patches
        Boundaries, if any.
    inside
        Tells for points of shape (n, 3) which lie in the flow.
    width
        The shortest way between walls, m.
    """

    lists_walls = False

    def __init__(
        self,
        parameters: Any,
        kernels: dict[str, Callable[..., Any]],
        patches: Sequence[Patch] = (),
        inside: Callable[[Floats], NDArray[np.bool_]] = everywhere,
        width: float = math.inf,
    ) -> None:
        self._parameters = parameters
        self._inside = inside
        self.kernels = kernels
        self.patches = tuple(patches)
        self.width = width
        self.notes: tuple[str, ...] = ()
        self.span = (-math.inf, math.inf)

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is known at all times."""
        return math.inf

    def arrays(
        self,
        reach: float,  # noqa: ARG002
        touchable: Sequence[int],  # noqa: ARG002
        sight: float = 0.0,  # noqa: ARG002
        seen: Sequence[int] = (),  # noqa: ARG002
    ) -> Any:
        """Numbers that the kernels read; walls are exact, at any ``reach``."""
        return self._parameters

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """There is nothing large."""

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """Nothing: there are no nodes."""
        return "", np.empty((0, 3)), np.empty((0, 9))

    def turbulence_at_nodes(self) -> Floats:
        """Nothing: there are no nodes."""
        return np.empty((0, 8))

    def traits(self) -> Mapping[str, ArrayLike]:
        """The parameters, by name."""
        names: Mapping[str, ArrayLike] = self._parameters._asdict()
        return names

    def locate(self, points: Floats) -> Ints:
        """0 for each point of shape (n, 3) in the flow, −1 for one outside."""
        inside = self._inside(points)
        return np.where(inside, 0, -1).astype(np.int32)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:  # noqa: ARG002
        """Velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) at time t, s."""
        u, gradient, _ = self.kernels["sample"](self._parameters, 0, tuple(points.T), t)
        zeros = np.zeros(len(points))
        return (
            np.stack([c + zeros for c in u], axis=1),
            np.stack([c + zeros for c in gradient], axis=1).reshape(-1, 3, 3),
        )

    def patch_faces(self, name: str, t: float) -> PatchFaces:  # noqa: ARG002
        """Refuse: a flow in closed form has no faces.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(f"patch {name}: a flow in closed form has no faces to inject from.")

    def cell_zone(self, name: str | None) -> Tetrahedra:
        """Refuse: a flow in closed form has no cells.

        Raises
        ------
        InputError
            Always.
        """
        what = "all cells" if name is None else f"cellZone {name}"
        raise InputError(f"{what}: a flow in closed form has no cells to inject into.")

    def cell_size(self, hosts: Ints) -> Floats:
        """Infinite: there are no cells."""
        return np.full(np.shape(hosts), np.inf)


def linear(gradient: ArrayLike, u0: ArrayLike = (0.0, 0.0, 0.0)) -> AnalyticFlow:
    """u = u0 + l·x with a constant gradient l_ij = ∂u_i/∂x_j, 1/s, of shape (3, 3)."""
    g = np.ascontiguousarray(np.reshape(gradient, 9), dtype=float)
    kernels: dict[str, Callable[..., Any]] = {
        "sample": sample_linear,
        "curvature": curvature_linear,
        "walk": walk_free,
        "gap": gap_free,
        "normal": normal_free,
        "recover": recover_free,
    }
    return AnalyticFlow(LinearArrays(np.asarray(u0, dtype=float), g), kernels)


class FunctionArrays(NamedTuple):
    """Steps of the differences by which a function's derivatives are taken, m and s."""

    length: float
    time: float


def velocity(x: float, y: float, z: float, t: float) -> tuple[float, float, float]:
    """Stand for a user's function, which :func:`function` puts in its place."""
    raise NotImplementedError


def velocity_gradient(x: float, y: float, z: float, t: float) -> tuple[Vector, Vector, Vector]:
    """Stand for a user's gradient, as :func:`velocity` does for the velocity."""
    raise NotImplementedError


def steady(x: float, y: float, z: float, t: float) -> Any:
    """Call a function that knows no time."""
    return of_place(x, y, z)


def of_place(x: float, y: float, z: float) -> Any:
    """Stand for a user's function of the place alone."""
    raise NotImplementedError


def sample_function(flow: FunctionArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, its gradient as given, 1/s, and ∂u/∂t by differences, m/s²."""
    a, b, c = velocity_gradient(x[0], x[1], x[2], t)
    l = (a[0] + 0.0, a[1] + 0.0, a[2] + 0.0, b[0] + 0.0, b[1] + 0.0, b[2] + 0.0,
         c[0] + 0.0, c[1] + 0.0, c[2] + 0.0)  # fmt: skip
    return _velocity(x[0], x[1], x[2], t), l, _rate(flow, x, t)


def sample_differences(flow: FunctionArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, its gradient, 1/s, and ∂u/∂t, m/s², by central differences of the fourth order."""
    h, (x0, x1, x2) = flow.length, x
    p = _difference(
        _velocity(x0 - 2.0 * h, x1, x2, t), _velocity(x0 - h, x1, x2, t),
        _velocity(x0 + h, x1, x2, t), _velocity(x0 + 2.0 * h, x1, x2, t), h,
    )  # fmt: skip
    q = _difference(
        _velocity(x0, x1 - 2.0 * h, x2, t), _velocity(x0, x1 - h, x2, t),
        _velocity(x0, x1 + h, x2, t), _velocity(x0, x1 + 2.0 * h, x2, t), h,
    )  # fmt: skip
    r = _difference(
        _velocity(x0, x1, x2 - 2.0 * h, t), _velocity(x0, x1, x2 - h, t),
        _velocity(x0, x1, x2 + h, t), _velocity(x0, x1, x2 + 2.0 * h, t), h,
    )  # fmt: skip
    l = (p[0], q[0], r[0], p[1], q[1], r[1], p[2], q[2], r[2])
    return _velocity(x0, x1, x2, t), l, _rate(flow, x, t)


def _velocity(x: float, y: float, z: float, t: float) -> Vector:
    a, b, c = velocity(x, y, z, t)
    return a + 0.0, b + 0.0, c + 0.0


def _rate(flow: FunctionArrays, x: Vector, t: float) -> Vector:
    """∂u/∂t at the fixed point."""
    h = flow.time
    return _difference(
        _velocity(x[0], x[1], x[2], t - 2.0 * h), _velocity(x[0], x[1], x[2], t - h),
        _velocity(x[0], x[1], x[2], t + h), _velocity(x[0], x[1], x[2], t + 2.0 * h), h,
    )  # fmt: skip


def _difference(a: Vector, b: Vector, c: Vector, d: Vector, h: float) -> Vector:
    """Derivative at the middle of four values at −2h, −h, h and 2h."""
    s, w = 8.0 / (12.0 * h), 1.0 / (12.0 * h)
    return (
        s * (c[0] - b[0]) - w * (d[0] - a[0]),
        s * (c[1] - b[1]) - w * (d[1] - a[1]),
        s * (c[2] - b[2]) - w * (d[2] - a[2]),
    )


def sample(flow: FunctionArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Stand for the one of the two above that a flow has."""
    raise NotImplementedError


def curvature_by_differences(flow: FunctionArrays, host: int, x: Vector, t: float) -> Curvature:
    """Second derivatives, 1/(m s), from the gradient by central differences of the fourth order."""
    h, (x0, x1, x2) = flow.length, x
    p = _derivative(
        sample(flow, host, (x0 - 2.0 * h, x1, x2), t)[1], sample(flow, host, (x0 - h, x1, x2), t)[1],
        sample(flow, host, (x0 + h, x1, x2), t)[1], sample(flow, host, (x0 + 2.0 * h, x1, x2), t)[1], h,
    )  # fmt: skip
    q = _derivative(
        sample(flow, host, (x0, x1 - 2.0 * h, x2), t)[1], sample(flow, host, (x0, x1 - h, x2), t)[1],
        sample(flow, host, (x0, x1 + h, x2), t)[1], sample(flow, host, (x0, x1 + 2.0 * h, x2), t)[1], h,
    )  # fmt: skip
    r = _derivative(
        sample(flow, host, (x0, x1, x2 - 2.0 * h), t)[1], sample(flow, host, (x0, x1, x2 - h), t)[1],
        sample(flow, host, (x0, x1, x2 + h), t)[1], sample(flow, host, (x0, x1, x2 + 2.0 * h), t)[1], h,
    )  # fmt: skip
    return curvature_of(p, q, r)


def _derivative(a: Tensor, b: Tensor, c: Tensor, d: Tensor, h: float) -> Tensor:
    """As :func:`_difference`, of tensors."""
    s, w = 8.0 / (12.0 * h), 1.0 / (12.0 * h)
    return add(scale(s, add(c, scale(-1.0, b))), scale(-w, add(d, scale(-1.0, a))))


class FunctionFlow(AnalyticFlow):
    """A flow given by a function of the user's; see :func:`function`."""

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) at time t, s."""
        return sample_with(self.kernels["sample"], self._parameters, points, hosts, t)


def function(
    u: Callable[..., Any],
    gradient: Callable[..., Any] | None = None,
    length: float = 1e-3,
    time: float = 1e-3,
) -> AnalyticFlow:
    """Flow u(x, y, z) or u(x, y, z, t) from a plain Python function, without bounds.

    The function is compiled into the particle loop, which takes a while for each new function; it may use
    numbers, ``math``, ``numpy``'s functions of numbers, and other plain functions.

    Parameters
    ----------
    u
        Returns the three components of the velocity, m/s, at a place, m, and perhaps a time, s.
    gradient
        Of the same arguments, returns the three rows of ∂u_i/∂x_j, 1/s, each of three numbers. Without it the
        gradient is taken from u by central differences of the fourth order, and so is ∂u/∂t always.
    length, time
        Over which u changes, m and s. The differences are taken over a thousandth of it, which gives
        derivatives to 1e-8 where u changes over a tenth of it to a thousand times as much.

    Raises
    ------
    TypeError
        If u or the gradient is not such a function.
    """
    names: dict[str, Any] = {"velocity": _of_place_and_time(u, "u", (3,))}
    template = sample_differences
    if gradient is not None:
        names["velocity_gradient"] = _of_place_and_time(gradient, "gradient", (3, 3))
        template = sample_function
    names["_velocity"] = _with_names(_velocity, names)
    names["_rate"] = _with_names(_rate, names)
    kernels: dict[str, Callable[..., Any]] = {
        "sample": _with_names(template, names),
        "curvature": _with_names(curvature_by_differences, names | {"sample": _with_names(template, names)}),
        "walk": walk_free,
        "gap": gap_free,
        "normal": normal_free,
        "recover": recover_free,
    }
    return FunctionFlow(FunctionArrays(1e-3 * length, 1e-3 * time), kernels)


def _with_names(template: Callable[..., Any], names: Mapping[str, Any]) -> Callable[..., Any]:
    """The function with other functions in place of some of those that it calls."""
    assert isinstance(template, FunctionType)
    return FunctionType(template.__code__, {**template.__globals__, **names}, template.__name__)


def _of_place_and_time(given: Any, what: str, shape: tuple[int, ...]) -> Callable[..., Any]:
    """A user's function as one of x, y, z and t; TypeError if it is no plain function that gives numbers."""
    if not isinstance(given, FunctionType):
        raise TypeError(f"{what} is {given!r}, not a plain function (def or lambda).")
    captured = [*(cell.cell_contents for cell in given.__closure__ or ()), *(given.__defaults__ or ())]
    if not all(isinstance(value, int | float | tuple) for value in captured):
        raise TypeError(
            f"{what} captures or has as a default something else than numbers or tuples of numbers; other "
            "functions must be defined in the module."
        )
    count = given.__code__.co_argcount - len(given.__defaults__ or ())
    if count not in (3, 4):
        raise TypeError(f"{what} has {count} arguments, not (x, y, z) or (x, y, z, t).")
    found: Any = None
    with suppress(ArithmeticError, ValueError):
        found = np.shape(given(*(0.1, 0.2, 0.3, 0.4)[:count]))
    if found not in (None, shape):
        raise TypeError(f"{what} returns something of shape {found}, not {shape}.")
    return given if count == 4 else _with_names(steady, {"of_place": given})


def shear(rate: float) -> AnalyticFlow:
    """Simple shear u₁ = γ̇ x₂ (Sect. 5.3)."""
    return linear([[0.0, rate, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])


def rotation(rate: float) -> AnalyticFlow:
    """Pure rotation l₁₂ = −l₂₁ = γ̇/2 about the negative third axis (Sect. 5.1)."""
    return linear([[0.0, rate / 2, 0.0], [-rate / 2, 0.0, 0.0], [0.0, 0.0, 0.0]])


def extension(rate: float) -> AnalyticFlow:
    """Uniaxial extension along the first axis, l = rate · diag(1, −½, −½)."""
    return linear(np.diag([rate, -rate / 2, -rate / 2]))


def shear_over_wall(rate: float) -> AnalyticFlow:
    """Simple shear u₁ = γ̇ x₃, 1/s, over the wall x₃ = 0, the patch ``wall``."""
    return _between(SlitArrays(math.inf, float(rate)), (Patch("wall", "wall"),))


def slit(height: float, mean_velocity: float) -> AnalyticFlow:
    """Poiseuille flow along x between walls at z = 0, the patch ``lower``, and z = height, ``upper``.

    Parameters
    ----------
    height, mean_velocity
        m and m/s; the shear rate at a wall is 6 U/height.
    """
    arrays = SlitArrays(float(height), 6.0 * mean_velocity / height)
    return _between(arrays, (Patch("lower", "wall"), Patch("upper", "wall")))


def _between(parameters: SlitArrays, patches: tuple[Patch, ...]) -> AnalyticFlow:
    def inside(points: Floats) -> NDArray[np.bool_]:
        within: NDArray[np.bool_] = (points[:, 2] >= 0.0) & (points[:, 2] <= parameters.height)
        return within

    return AnalyticFlow(
        parameters,
        {
            "sample": sample_slit,
            "curvature": curvature_slit,
            "walk": walk_slit,
            "gap": gap_slit,
            "walls": planes_of_slit,
            "normal": normal_slit,
            "recover": recover_free,
        },
        patches,
        inside,
        parameters.height,
    )


def pipe(radius: float, mean_velocity: float, length: float = math.inf) -> AnalyticFlow:
    """Poiseuille flow in a pipe along x from x = 0, with patches wall, inlet and outlet.

    Parameters
    ----------
    radius, length
        m; an infinite length has no outlet to reach.
    mean_velocity
        m/s; the wall shear rate is 4 U/radius.
    """
    parameters = PipeArrays(float(radius), float(mean_velocity), float(length))
    return _in_pipe(parameters, sample_pipe, curvature_pipe)


_MOST_WOMERSLEY = 30.0


def womersley(
    radius: float,
    nu: float,
    period: float,
    amplitude: float,
    mean_velocity: float = 0.0,
    phase: float = 0.0,
    length: float = math.inf,
) -> AnalyticFlow:
    """Pulsatile flow in a pipe along x from x = 0, with patches wall, inlet and outlet.

    The pressure gradient −(∂p/∂x)/ρ is 8 ν U/a² + amplitude · cos(2π t/period + phase); the flow is that long
    after any start (Womersley, J. Physiol. 127, 553, 1955).

    Parameters
    ----------
    radius, length
        m; an infinite length has no outlet to reach.
    nu
        Kinematic viscosity, m²/s.
    period
        s.
    amplitude
        Of the pressure gradient over the density, m/s².
    mean_velocity
        Over section and time, U, m/s.
    phase
        rad.

    Raises
    ------
    ValueError
        If the Womersley number a √(ω/ν) exceeds 30, where the series of the Bessel function loses digits.
    """
    omega = 2.0 * math.pi / period
    alpha = radius * math.sqrt(omega / nu)
    if alpha > _MOST_WOMERSLEY:
        raise ValueError(f"Womersley number {alpha:.3g} > {_MOST_WOMERSLEY:g}")
    # J₀(i^{3/2} α s) = Σ (i α² s²/4)ᵏ/(k!)²
    terms = [1.0 + 0.0j]
    while abs(terms[-1]) > 1e-20 * max(map(abs, terms)):
        terms.append(terms[-1] * 0.25j * alpha**2 / len(terms) ** 2)
    profile = -np.array(terms) / sum(terms)
    profile[0] += 1.0
    parameters = WomersleyArrays(
        float(radius), float(mean_velocity), float(length), amplitude / omega, omega, float(phase),
        np.ascontiguousarray(profile.real), np.ascontiguousarray(profile.imag),
    )  # fmt: skip
    return _in_pipe(parameters, sample_womersley, curvature_womersley)


def _in_pipe(parameters: Any, sample: Callable[..., Any], curvature: Callable[..., Any]) -> AnalyticFlow:
    """A flow along x in a pipe whose radius and length are among the parameters."""

    def inside(points: Floats) -> NDArray[np.bool_]:
        r2: Floats = points[:, 1] ** 2 + points[:, 2] ** 2
        within: NDArray[np.bool_] = r2 <= parameters.radius**2
        within &= (points[:, 0] >= 0) & (points[:, 0] <= parameters.length)
        return within

    return AnalyticFlow(
        parameters,
        {
            "sample": sample,
            "curvature": curvature,
            "walk": walk_pipe,
            "gap": gap_pipe,
            "walls": planes_of_pipe,
            "normal": normal_pipe,
            "recover": recover_free,
        },
        (Patch("wall", "wall"), Patch("inlet", "patch"), Patch("outlet", "patch")),
        inside,
        2.0 * parameters.radius,
    )
