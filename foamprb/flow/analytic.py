"""Flows in closed form with the interface of a flow on a mesh, for tests, validation and first steps.

The kernels are described in :mod:`foamprb.flow.kernels`.
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
from foamprb.flow import channels
from foamprb.flow import posts as arrays_of_posts
from foamprb.flow.base import Floats, Ints, Patch, PatchFaces, Tetrahedra
from foamprb.flow.jumps import NO_JUMPS
from foamprb.flow.nodes import NO_VALUES, Ends, Function, NodeValues, ends_over
from foamprb.flow.sampling import sample_with

__all__ = [
    "AnalyticFlow",
    "FunctionFlow",
    "duct",
    "extension",
    "function",
    "linear",
    "pipe",
    "posts",
    "rotation",
    "shear",
    "shear_over_wall",
    "slit",
]

_ZERO: Vector = (0.0, 0.0, 0.0)


def __dir__() -> list[str]:
    """Return the public names alone."""
    return __all__


class LinearArrays(NamedTuple):
    """u = u0 + l·x, everywhere."""

    u0: Floats
    l: Floats


def sample_linear(flow: LinearArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, m/s, its gradient ∂u_i/∂x_j, 1/s, and ∂u/∂t = 0, m/s²."""
    g = flow.l
    L = (g[0], g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[8])
    u = (
        flow.u0[0] + L[0] * x[0] + L[1] * x[1] + L[2] * x[2],
        flow.u0[1] + L[3] * x[0] + L[4] * x[1] + L[5] * x[2],
        flow.u0[2] + L[6] * x[0] + L[7] * x[1] + L[8] * x[2],
    )
    return u, L, _ZERO


def curvature_linear(flow: Any, host: int, x: Vector, t: float) -> Curvature:
    """Return zeros: there are no second derivatives."""
    return _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO


def gap_free(flow: Any, host: int, x: Vector, F: Tensor, R: float, mode: Any = ()) -> tuple[float, int, int]:
    """Return infinity: there are no walls."""
    return math.inf, -1, -1


def everywhere(points: Floats) -> NDArray[np.bool_]:
    """Return True for each point of shape (n, 3)."""
    return np.ones(len(points), dtype=bool)


_UNBOUNDED: dict[str, Callable[..., Any]] = {"gap": gap_free}


class AnalyticFlow:
    """Flow in closed form.

    Parameters
    ----------
    parameters
        Named tuple that the kernels read.
    kernels
        Functions ``sample``, ``gap``, and others of :mod:`foamprb.flow.kernels`.
    patches
        Boundaries, if any.
    inside
        Returns a mask of the points of shape (n, 3) in the flow.
    width
        Shortest distance between walls, m.
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
        self.bounds = (np.full(3, -math.inf), np.full(3, math.inf))

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is defined at all times."""
        return math.inf

    def arrays(
        self,
        reach: float,  # noqa: ARG002
        touchable: Sequence[int],  # noqa: ARG002
        sight: float = 0.0,  # noqa: ARG002
        seen: Sequence[int] = (),  # noqa: ARG002
    ) -> Any:
        """Return the parameters; walls are exact at any ``reach``."""
        return self._parameters

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """No-op: there are no large arrays."""

    def at_some_nodes(self) -> NodeValues:
        """Return no rows: there are no nodes."""
        return NO_VALUES

    def ends_at_nodes(self, function: Function) -> Ends:
        """Return no ends: there are no nodes."""
        return ends_over(NO_VALUES, function)

    def gradient_jumps(self) -> NDArray[np.int64]:
        """Return no faces: there are no cells."""
        return NO_JUMPS

    def roughness(self) -> float:
        """Return 0: the flow is exact."""
        return 0.0

    def traits(self) -> Mapping[str, ArrayLike]:
        """Return the parameters by name."""
        names: Mapping[str, ArrayLike] = self._parameters._asdict()
        return names

    def locate(self, points: Floats, t: ArrayLike | None = None) -> Ints:  # noqa: ARG002
        """Return host 0 for each point of shape (n, 3) in the flow, −1 outside."""
        inside = self._inside(points)
        return np.where(inside, 0, -1).astype(np.int32)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:  # noqa: ARG002
        """Return velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) at t, s."""
        u, gradient, _ = self.kernels["sample"](self._parameters, 0, tuple(points.T), t)
        zeros = np.zeros(len(points))
        return (
            np.stack([c + zeros for c in u], axis=1),
            np.stack([c + zeros for c in gradient], axis=1).reshape(-1, 3, 3),
        )

    def times_within(self, start: float, end: float) -> Sequence[float]:  # noqa: ARG002
        """Return no times: the flow is steady."""
        return ()

    def patch_faces(self, name: str, t: float) -> PatchFaces:  # noqa: ARG002
        """Raise InputError: there are no faces."""
        raise InputError(f"patch {name}: a flow in closed form has no faces to inject from.")

    def cell_zone(self, name: str | None, t: float | None = None) -> Tetrahedra:  # noqa: ARG002
        """Raise InputError: there are no cells."""
        what = "all cells" if name is None else f"cellZone {name}"
        raise InputError(f"{what}: a flow in closed form has no cells to inject into.")

    def cell_size(self, hosts: Ints) -> Floats:
        """Return infinity: there are no cells."""
        return np.full(np.shape(hosts), np.inf)

    def cell_size_at(self, patches: Sequence[int]) -> float:  # noqa: ARG002
        """Return 0: there are no cells."""
        return 0.0


def linear(gradient: ArrayLike, u0: ArrayLike = (0.0, 0.0, 0.0)) -> AnalyticFlow:
    """Return the flow u = u0 + l·x with a constant gradient l_ij = ∂u_i/∂x_j, 1/s, of shape (3, 3)."""
    g = np.ascontiguousarray(np.reshape(gradient, 9), dtype=float)
    kernels = {"sample": sample_linear, "curvature": curvature_linear, **_UNBOUNDED}
    return AnalyticFlow(LinearArrays(np.asarray(u0, dtype=float), g), kernels)


class FunctionArrays(NamedTuple):
    """Steps of the finite differences for a function's derivatives, m and s."""

    length: float
    time: float


def _steady(of_place: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function of place and time from one of the place."""

    def velocity(x: float, y: float, z: float, t: float) -> Any:
        return of_place(x, y, z)

    return velocity


def _sample_of(velocity: Callable[..., Any]) -> Callable[..., Any]:
    """Return the kernel ``sample`` of a velocity, with fourth-order central differences."""

    def at(x: float, y: float, z: float, t: float) -> Vector:
        a, b, c = velocity(x, y, z, t)
        return a + 0.0, b + 0.0, c + 0.0

    def sample(flow: FunctionArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
        h, k, (x0, x1, x2) = flow.length, flow.time, x
        p = _difference(
            at(x0 - 2.0 * h, x1, x2, t), at(x0 - h, x1, x2, t),
            at(x0 + h, x1, x2, t), at(x0 + 2.0 * h, x1, x2, t), h,
        )  # fmt: skip
        q = _difference(
            at(x0, x1 - 2.0 * h, x2, t), at(x0, x1 - h, x2, t),
            at(x0, x1 + h, x2, t), at(x0, x1 + 2.0 * h, x2, t), h,
        )  # fmt: skip
        r = _difference(
            at(x0, x1, x2 - 2.0 * h, t), at(x0, x1, x2 - h, t),
            at(x0, x1, x2 + h, t), at(x0, x1, x2 + 2.0 * h, t), h,
        )  # fmt: skip
        rate = _difference(
            at(x0, x1, x2, t - 2.0 * k), at(x0, x1, x2, t - k),
            at(x0, x1, x2, t + k), at(x0, x1, x2, t + 2.0 * k), k,
        )  # fmt: skip
        return at(x0, x1, x2, t), (p[0], q[0], r[0], p[1], q[1], r[1], p[2], q[2], r[2]), rate

    return sample


def _difference(a: Vector, b: Vector, c: Vector, d: Vector, h: float) -> Vector:
    """Return the derivative at 0 from values at −2h, −h, h and 2h."""
    s, w = 8.0 / (12.0 * h), 1.0 / (12.0 * h)
    return (
        s * (c[0] - b[0]) - w * (d[0] - a[0]),
        s * (c[1] - b[1]) - w * (d[1] - a[1]),
        s * (c[2] - b[2]) - w * (d[2] - a[2]),
    )


def _curvature_of(sample: Callable[..., Any]) -> Callable[..., Any]:
    """Return the kernel ``curvature``, from the gradient by fourth-order central differences."""

    def curvature(flow: FunctionArrays, host: int, x: Vector, t: float) -> Curvature:
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

    return curvature


def _derivative(a: Tensor, b: Tensor, c: Tensor, d: Tensor, h: float) -> Tensor:
    """Return the derivative of a tensor; see :func:`_difference`."""
    s, w = 8.0 / (12.0 * h), 1.0 / (12.0 * h)
    return add(scale(s, add(c, scale(-1.0, b))), scale(-w, add(d, scale(-1.0, a))))


class FunctionFlow(AnalyticFlow):
    """Flow given by a user's function; see :func:`function`."""

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Return velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) at t, s."""
        return sample_with(self.kernels["sample"], self._parameters, points, hosts, t)


def function(
    u: Callable[..., Any],
    length: float = 1e-3,
    time: float = 1e-3,
) -> AnalyticFlow:
    """Return the unbounded flow u(x, y, z) or u(x, y, z, t) of a plain Python function.

    The function is compiled into the particle loop, again for each new function. It may use numbers,
    ``math``, ``numpy``'s functions of numbers, and other plain functions.

    Parameters
    ----------
    u
        Returns the three components of the velocity, m/s, at a place, m, and perhaps a time, s.
    length, time
        Scales on which u changes, m and s. The derivatives are fourth-order central differences over a
        thousandth of them, accurate to 1e-8 if u changes on a tenth to a thousand times these scales.

    Raises
    ------
    TypeError
        u is not such a function.
    """
    sample = _sample_of(_of_place_and_time(u))
    kernels = {"sample": sample, "curvature": _curvature_of(sample), **_UNBOUNDED}
    return FunctionFlow(FunctionArrays(1e-3 * length, 1e-3 * time), kernels)


def _of_place_and_time(given: Any) -> Callable[..., Any]:
    """Return a user's function as one of x, y, z and t; TypeError if it is not plain or of another shape."""
    if not isinstance(given, FunctionType):
        raise TypeError(f"u is {given!r}, not a plain function (def or lambda).")
    captured = [*(cell.cell_contents for cell in given.__closure__ or ()), *(given.__defaults__ or ())]
    if not all(isinstance(value, int | float | tuple) for value in captured):
        raise TypeError(
            "u captures, or has as a default, a value other than numbers or tuples of numbers; other "
            "functions must be defined in the module."
        )
    count = given.__code__.co_argcount - len(given.__defaults__ or ())
    if count not in (3, 4):
        raise TypeError(f"u has {count} arguments, not (x, y, z) or (x, y, z, t).")
    found: Any = None
    with suppress(ArithmeticError, ValueError):
        value = given(*(0.1, 0.2, 0.3, 0.4)[:count])
        found = np.shape(value)
        sound = isinstance(value, tuple) and np.asarray(value).dtype.kind in "iuf"
        if found == (3,) and not sound:
            kind = "an array" if isinstance(value, np.ndarray) else f"{value!r}"
            raise TypeError(f"u returns {kind}. Return a tuple of three numbers.")
    if found not in (None, (3,)):
        raise TypeError(f"u returns something of shape {found}, not (3,).")
    return given if count == 4 else _steady(given)


def shear(rate: float) -> AnalyticFlow:
    """Return simple shear u₁ = γ̇ x₂ (Sect. 5.3)."""
    return linear([[0.0, rate, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])


def rotation(rate: float) -> AnalyticFlow:
    """Return pure rotation l₁₂ = −l₂₁ = γ̇/2 about the negative third axis (Sect. 5.1)."""
    return linear([[0.0, rate / 2, 0.0], [-rate / 2, 0.0, 0.0], [0.0, 0.0, 0.0]])


def extension(rate: float) -> AnalyticFlow:
    """Return uniaxial extension along the first axis, l = rate · diag(1, −½, −½)."""
    return linear(np.diag([rate, -rate / 2, -rate / 2]))


def shear_over_wall(rate: float) -> AnalyticFlow:
    """Return simple shear u₁ = γ̇ x₃, 1/s, over the wall x₃ = 0, the patch ``wall``."""
    return _between(channels.SlitArrays(math.inf, float(rate)), (Patch("wall", "wall"),))


def slit(height: float, mean_velocity: float) -> AnalyticFlow:
    """Return Poiseuille flow along x between walls at z = 0, the patch ``lower``, and z = height, ``upper``.

    Parameters
    ----------
    height, mean_velocity
        m and m/s; the shear rate at a wall is 6 U/height.

    Examples
    --------
    >>> flow = slit(30e-6, 0.05)
    >>> x = np.array([[0.0, 0.0, 15e-6]])
    >>> u, gradient = flow.sample(x, flow.locate(x), 0.0)
    >>> round(float(u[0, 0]), 3)
    0.075
    """
    arrays = channels.SlitArrays(float(height), 6.0 * mean_velocity / height)
    return _between(arrays, (Patch("lower", "wall"), Patch("upper", "wall")))


def _between(parameters: channels.SlitArrays, patches: tuple[Patch, ...]) -> AnalyticFlow:
    def inside(points: Floats) -> Any:
        return (points[:, 2] >= 0.0) & (points[:, 2] <= parameters.height)

    return AnalyticFlow(
        parameters,
        {
            "sample": channels.sample_slit,
            "curvature": channels.curvature_slit,
            "walk": channels.walk_slit,
            "gap": channels.gap_slit,
            "walls": channels.planes_of_slit,
            "normal": channels.normal_slit,
        },
        patches,
        inside,
        parameters.height,
    )


def duct(width: float, height: float, mean_velocity: float) -> AnalyticFlow:
    """Return Poiseuille flow along x in a rectangular duct, such as a channel of a chip.

    The walls are z = 0, the patch ``lower``, z = height, ``upper``, y = −width/2, ``left``, and y = width/2,
    ``right``. The velocity is a Fourier series of a hundred terms.

    Parameters
    ----------
    width, height, mean_velocity
        m, m and m/s.

    Examples
    --------
    >>> flow = duct(20e-6, 20e-6, 0.1)
    >>> x = np.array([[0.0, 0.0, 10e-6]])
    >>> u, gradient = flow.sample(x, flow.locate(x), 0.0)
    >>> round(float(u[0, 0]), 4)
    0.2096
    """
    if not (0.0 < width < math.inf and 0.0 < height < math.inf):
        raise InputError(f"duct: width {width:g} and height {height:g}: finite lengths above 0 are needed.")
    force = mean_velocity / channels.duct_mean(width, height)
    parameters = channels.DuctArrays(float(width), float(height), float(force))

    def inside(points: Floats) -> Any:
        return (np.array(channels.distances_in_duct(parameters, tuple(points.T))) >= 0.0).all(axis=0)

    return AnalyticFlow(
        parameters,
        {
            "sample": channels.sample_duct,
            "curvature": channels.curvature_duct,
            "walk": channels.walk_duct,
            "gap": channels.gap_duct,
            "walls": channels.planes_of_duct,
            "normal": channels.normal_duct,
        },
        tuple(Patch(name, "wall") for name in ("lower", "upper", "left", "right")),
        inside,
        min(parameters.width, parameters.height),
    )


def pipe(radius: float, mean_velocity: float, length: float = math.inf) -> AnalyticFlow:
    """Return Poiseuille flow in a pipe along x from x = 0, with patches wall, inlet and outlet.

    Parameters
    ----------
    radius, length
        m; a pipe of infinite length has no outlet.
    mean_velocity
        m/s; the wall shear rate is 4 U/radius.
    """
    parameters = channels.PipeArrays(float(radius), float(mean_velocity), float(length))

    def inside(points: Floats) -> Any:
        within = points[:, 1] ** 2 + points[:, 2] ** 2 <= parameters.radius**2
        return within & (points[:, 0] >= 0) & (points[:, 0] <= parameters.length)

    return AnalyticFlow(
        parameters,
        {
            "sample": channels.sample_pipe,
            "curvature": channels.curvature_pipe,
            "walk": channels.walk_pipe,
            "gap": channels.gap_pipe,
            "walls": channels.planes_of_pipe,
            "normal": channels.normal_pipe,
        },
        (Patch("wall", "wall"), Patch("inlet", "patch"), Patch("outlet", "patch")),
        inside,
        2.0 * parameters.radius,
    )


def posts(spacing: float, diameter: float, velocity: tuple[float, float], shift: float = 0.0) -> AnalyticFlow:
    """Return Stokes flow through an array of round posts along z, the patch ``posts``.

    The middles of posts are at x = n ``spacing`` and y = m ``spacing`` + n ``shift``, n and m integers.

    Parameters
    ----------
    spacing, diameter
        m; the diameter is a fifth to nine tenths of the spacing.
    velocity
        Along x and y, m/s, the mean over fluid and posts.
    shift
        Of each column of posts along y from the last one, m.

    Examples
    --------
    >>> flow = posts(20e-6, 10e-6, (1e-3, 0.0))
    >>> x = np.array([[0.0, 10e-6, 0.0]])
    >>> u, gradient = flow.sample(x, flow.locate(x), 0.0)
    >>> round(float(u[0, 0]), 5)
    0.00282
    """
    if not (0.0 < spacing < math.inf and 0.2 <= diameter / spacing <= 0.9):
        raise InputError(
            f"posts: spacing {spacing:g} and diameter {diameter:g}: a length above 0 and a diameter of "
            "0.2 to 0.9 of it are needed."
        )
    parameters = arrays_of_posts.through_posts(spacing, 0.5 * diameter, velocity, shift)

    def inside(points: Floats) -> Any:
        return np.hypot(*arrays_of_posts.from_post(parameters, tuple(points.T))) >= 0.5 * diameter

    return AnalyticFlow(
        parameters,
        {
            "sample": arrays_of_posts.sample_posts,
            "curvature": arrays_of_posts.curvature_posts,
            "walk": arrays_of_posts.walk_posts,
            "gap": arrays_of_posts.gap_posts,
            "walls": arrays_of_posts.planes_of_posts,
            "normal": arrays_of_posts.normal_posts,
        },
        (Patch("posts", "wall"),),
        inside,
        spacing - diameter,
    )
