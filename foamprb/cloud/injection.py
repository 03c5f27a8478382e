"""Where and when particles appear: OpenFOAM's injection models, with its entries."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Particles, empty
from foamprb.entries import NonNegative, Positive, Vector3
from foamprb.errors import InputError
from foamprb.flow.base import Flow

Floats = NDArray[np.float64]
log = logging.getLogger("foamprb")


class Places(NamedTuple):
    """Where and when particles appear."""

    x: Floats
    """(n, 3), m."""
    hosts: NDArray[np.int32]
    """(n,), the pieces of the flow that hold them; −1 outside the flow."""
    t: Floats
    """(n,), s."""


@dataclass(frozen=True)
class FixedValue:
    """Every particle has the same diameter, m."""

    value: Annotated[float, Positive]

    def sample(self, n: int, random: np.random.Generator) -> Floats:  # noqa: ARG002
        """N diameters, m."""
        return np.full(n, self.value)


SIZE_DISTRIBUTIONS: dict[str, type[FixedValue]] = {"fixedValue": FixedValue}


@dataclass(frozen=True)
class ManualInjection:
    """Particles at the positions that a file lists, all at the time ``SOI``."""

    positionsFile: Path
    U0: Vector3 | None = None
    SOI: Annotated[float, NonNegative] = 0.0
    ignoreOutOfBounds: bool = False

    def places(
        self,
        flow: Flow,
        random: np.random.Generator,  # noqa: ARG002
        read: Callable[[Path], Floats],
    ) -> Places:
        """Positions of the file, those outside the flow left out if the user said so.

        Raises
        ------
        InputError
            If positions lie outside the flow: how many, and the first of them.
        """
        x = read(self.positionsFile)
        hosts = flow.locate(x)
        outside = hosts < 0
        if outside.any() and not self.ignoreOutOfBounds:
            first = ", ".join("({:g} {:g} {:g})".format(*row) for row in x[outside][:3])
            more = ", ..." if outside.sum() > 3 else ""
            raise InputError(
                f"{self.positionsFile}: {outside.sum()} of {len(x)} positions lie outside the mesh: "
                f"{first}{more}. Move them inside, or set ignoreOutOfBounds true to leave them out."
            )
        if outside.any():
            log.warning("%s: %d of %d positions lie outside the mesh and are left out.",
                        self.positionsFile, outside.sum(), len(x))  # fmt: skip
        return Places(x[~outside], hosts[~outside], np.full(np.count_nonzero(~outside), self.SOI))


@dataclass(frozen=True)
class PatchInjection:
    """Particles spread over a patch, uniform in flux, from ``SOI`` on for ``duration``."""

    patch: str
    parcelsPerSecond: Annotated[float, Positive]
    duration: Annotated[float, Positive]
    U0: Vector3 | None = None
    SOI: Annotated[float, NonNegative] = 0.0

    def places(
        self,
        flow: Flow,
        random: np.random.Generator,
        read: Callable[[Path], Floats],  # noqa: ARG002
    ) -> Places:
        """Random places on the patch, as many per area as fluid enters there, at even intervals in time.

        Raises
        ------
        InputError
            If no fluid enters through the patch, or nothing is injected.
        """
        n = round(self.parcelsPerSecond * self.duration)
        if n == 0:
            raise InputError(
                f"patchInjection on {self.patch}: parcelsPerSecond {self.parcelsPerSecond:g} times "
                f"duration {self.duration:g} s gives no particle."
            )
        faces = flow.patch_faces(self.patch)
        inflow = np.maximum(np.einsum("tvi,ti->tv", faces.velocity, faces.normals), 0.0)
        flux = inflow.mean(axis=1) * faces.areas
        if not flux.sum() > 0.0:
            raise InputError(f"patchInjection on {self.patch}: no fluid enters through this patch.")
        chosen = random.choice(len(flux), size=n, p=flux / flux.sum())
        x = _in_triangles(faces.vertices[chosen], inflow[chosen], random)
        return Places(x, faces.hosts[chosen], self.SOI + np.arange(n) / self.parcelsPerSecond)


def _in_triangles(vertices: Floats, density: Floats, random: np.random.Generator) -> Floats:
    """One random point in each triangle (n, 3, 3), with a linear density given at its vertices (n, 3)."""
    weights = np.empty(density.shape)
    open_rows = np.arange(len(density))
    while len(open_rows):
        w = random.dirichlet((1.0, 1.0, 1.0), len(open_rows))
        at = np.einsum("nv,nv->n", w, density[open_rows])
        accepted = random.random(len(open_rows)) * density[open_rows].max(axis=1) <= at
        weights[open_rows[accepted]] = w[accepted]
        open_rows = open_rows[~accepted]
    points: Floats = np.einsum("nv,nvi->ni", weights, vertices)
    return points


def release(
    model: Injection,
    flow: Flow,
    size: FixedValue,
    random: np.random.Generator,
    read: Callable[[Path], Floats],
) -> Particles:
    """Pending spheres at rest where an injection model puts them; density and stiffness are left at zero.

    Parameters
    ----------
    model, flow
        The injection model, and the flow into which it injects.
    size
        Distribution of diameters.
    random
        Source of every random number that is used.
    read
        Reads a file of positions, (n, 3), m.

    Raises
    ------
    InputError
        As the model's ``places``.
    """
    places = model.places(flow, random, read)
    n = len(places.t)
    p = empty(n)
    p.x[:] = p.x0[:] = places.x
    p.host[:] = places.hosts
    p.t0[:] = p.t[:] = places.t
    p.R[:] = 0.5 * size.sample(n, random)
    p.v[:] = flow.sample(places.x, places.hosts, model.SOI)[0] if model.U0 is None else model.U0
    return p


Injection = ManualInjection | PatchInjection

INJECTIONS: dict[str, type[Injection]] = {
    "manualInjection": ManualInjection,
    "patchInjection": PatchInjection,
}
