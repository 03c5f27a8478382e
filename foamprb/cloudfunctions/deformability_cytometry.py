"""Outlines of passing particles, as in the images of a deformability cytometer."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.material import MATERIALS
from foamprb.body.quadratic import (
    bullet_amplitude,
    outline_parts,
    tube_amplitude,
    tube_deformation,
    tube_velocity,
    turned,
)
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloudfunctions.base import Memory, ObservedCloud, columns, names_of, table
from foamprb.cloudfunctions.crossings import PlaneFunction, unit
from foamprb.dictionary.constraints import Meaning, Positive, Vector3
from foamprb.errors import InputError
from foamprb.results.tables import Column, write_table

Floats = NDArray[np.float64]

log = logging.getLogger(__name__)

_NEAR_AXIS = 0.2
"""Largest distance from the axis, in radii of a body."""
LARGEST_RATIO = 0.7
"""Largest radius of a body, in radii of the tube."""
TUBE_OF_SQUARE = 0.547
"""Radius of the tube that acts as a square channel, in widths of this (Mietke et al. 2015)."""


class Outline(NamedTuple):
    """Shadows of bodies on a plane: ellipses, and the second order of their quadratic modes."""

    area: Floats
    """(n,), m²."""
    perimeter: Floats
    """(n,), m."""
    deformation: Floats
    """1 − 2 √(πA)/P, (n,): 0 for a circle (Mietke et al. 2015)."""
    semi_axes: Floats
    """Of the ellipse, (n, 2), the longer one first, m."""
    shift: Floats
    """Centre of the area less the centre of the body, (n, 3), m."""
    bullet_amplitude: Floats
    """ε of a body r = a (1 + ε P₃) with as large a quadratic mode, (n,)."""


def outline(p: Particles, view: Floats, confinement: Floats | float = 0.0) -> Outline:
    """Return the shadows of bodies, by the affine and the quadratic mode of their shapes.

    Parameters
    ----------
    p
        The bodies; those without a quadratic mode have ellipses.
    view
        Unit vector of the viewing direction, (3,).
    confinement
        R of each body over the radius of the tube on whose axis it is, (n,); 0 without walls.

    The shadow of {x: x·C⁻¹x ≤ 1} with C = R² F Fᵀ on the plane with the basis P is the ellipse of P C Pᵀ. The
    contributions of the quadratic mode are added; to second order the modes do not act on each other.
    """
    from scipy.special import ellipe

    other = np.eye(3)[int(np.argmin(np.abs(view)))]
    first = np.cross(view, other)
    first /= np.linalg.norm(first)
    axes = np.stack([first, np.cross(view, first), view])
    F, basis = p.F.reshape(-1, 3, 3), axes[:2]
    C = p.R[:, None, None] ** 2 * F @ F.transpose(0, 2, 1)
    squares = np.linalg.eigvalsh(np.einsum("ai,nij,bj->nab", basis, C, basis))[:, ::-1]
    a, b = np.sqrt(squares).T
    ellipse, around = np.pi * a * b, 4.0 * a * ellipe(1.0 - squares[:, 1] / squares[:, 0])
    by_ellipse = 1.0 - 2.0 * np.sqrt(np.pi * ellipse) / around
    mode = outline_parts(turned(tuple(p.B.T), tuple(axes.ravel())))
    amplitude = tube_amplitude(confinement)
    area = ellipse + np.pi * (amplitude * p.R) ** 2 * mode.area
    deformation = by_ellipse + tube_deformation(confinement) ** 2 * mode.deformation
    return Outline(
        area=area,
        perimeter=around * ((1.0 - by_ellipse) / (1.0 - deformation)) * np.sqrt(area / ellipse),
        deformation=deformation,
        semi_axes=np.stack([a, b], axis=1),
        shift=(amplitude * p.R * np.stack(mode.centre)).T @ basis,
        bullet_amplitude=amplitude * bullet_amplitude(tuple(p.B.T)),
    )


@dataclass(frozen=True)
class Channel:
    """Channel whose walls deform bodies on its axis: ``channel { type square; width 20e-6; }``."""

    type: Annotated[
        Literal["tube", "square"], Meaning("cross-section; a square acts as a tube of 0.547 of its width")
    ]
    radius: Annotated[float | None, Positive, Meaning("of the tube", "m", "with `tube` required")] = None
    width: Annotated[float | None, Positive, Meaning("of the square", "m", "with `square` required")] = None

    def __post_init__(self) -> None:
        sizes = {"radius": self.radius, "width": self.width}
        needed, other = ("radius", "width") if self.type == "tube" else ("width", "radius")
        if sizes[needed] is None or sizes[other] is not None:
            raise InputError(f"has type {self.type}, which needs {needed}, and not {other}")

    @property
    def tube_radius(self) -> float:
        """Radius of the tube that acts as the channel, m."""
        return self.radius if self.radius is not None else TUBE_OF_SQUARE * (self.width or 0.0)


@dataclass(frozen=True)
class DeformabilityCytometry(PlaneFunction):
    """Outline in a camera of each particle that crosses a plane: ``cytometry.csv``.

    Area A and perimeter P of the shadow along ``view``, the semi-axes of its ellipse and the deformation
    1 − 2√(πA)/P, at the place and time of the crossing, which are computed as by ``particleCollector``. With
    the shape model ``quadratic`` they contain the second mode. The displacement of the shadow's centre, and
    the amplitude of the bullet, are added.
    """

    origin: Annotated[Vector3, Meaning("a point of the plane", "m")]
    normal: Annotated[Vector3, Meaning("its normal, of any length", "1")]
    view: Annotated[Vector3, Meaning("viewing direction of the camera, of any length", "1")]
    channel: Annotated[
        Channel | None,
        Meaning(
            "its walls act on bodies near the axis, which goes through `origin` along `normal`; needs "
            "`shapeModel quadratic`",
            default="no walls",
        ),
    ] = None

    arrays: ClassVar = {**PlaneFunction.arrays, "warned": table}

    def __post_init__(self) -> None:
        super().__post_init__()
        if not any(self.view):
            raise InputError("has a view (0 0 0)")

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return an empty table; raise InputError for a channel without bodies on which it could act."""
        if self.channel is None:
            return super().initial(cloud)
        models = cloud.cloud.models
        if not models.has_quadratic:
            raise InputError("a channel needs subModels/shapeModel quadratic")
        if MATERIALS[models.material].liquid:
            raise InputError("a channel needs solids: its effect on drops is not known")
        return {**super().initial(cloud), "warned": np.zeros(1)}

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the table of all crossings."""
        p, t, x, sense = self.crossings(memory, cloud)
        confinement = self.confinement(p.R, x)
        seen = outline(p, unit(self.view), confinement)
        more: dict[str, Column] = {}
        if cloud.cloud.models.has_quadratic:
            more = {**columns(("shiftx", "shifty", "shiftz"), seen.shift),
                    "bulletAmplitude": seen.bullet_amplitude}  # fmt: skip
        if self.channel is not None:
            acts = confinement > 0.0
            more |= {"channel": acts.astype(np.int64), "speed": self._speed(p, confinement, cloud.cloud)}
            self._warn(memory, acts, folder.name)
        write_table(
            folder / "cytometry.csv",
            {"id": p.number, "injector": names_of(cloud.names["injector"], p.injector), "t": t,
             **columns("xyz", x), "direction": sense.astype(np.int64), "area": seen.area,
             "perimeter": seen.perimeter, **columns("ab", seen.semi_axes), "deformation": seen.deformation,
             **more},
        )  # fmt: skip

    def confinement(self, R: Floats, x: Floats) -> Floats:
        """Return R, (n,), of bodies at x, (n, 3), over the radius of the tube; 0 where it does not act."""
        if self.channel is None:
            return np.zeros(len(R))
        away = np.linalg.norm(np.cross(x - self.origin, unit(self.normal)), axis=1)
        ratio = R / self.channel.tube_radius
        return np.where((away <= _NEAR_AXIS * R) & (ratio <= LARGEST_RATIO), ratio, 0.0)

    def _speed(self, p: Particles, confinement: Floats, cloud: Cloud) -> Floats:
        """Return the speeds of bodies, (n,), m/s, which walls reduce."""
        # Faxén's correction is the first term of the law.
        corrected = any(isinstance(model, FaxenCorrection) for model in cloud.models.surroundings)
        before = 1.0 - 2.0 / 3.0 * confinement**2 if corrected else 1.0
        return np.asarray(np.linalg.norm(p.v, axis=1) * tube_velocity(confinement) / before)

    def _warn(self, memory: Memory, acts: NDArray[np.bool_], name: str) -> None:
        """Warn, once in a run, of bodies without the effect of the channel."""
        if acts.all() or memory["warned"][0]:
            return
        memory["warned"] = np.ones(1)
        log.warning(
            "cloudFunctions/%s: %d of %d crossings so far are more than %g radii of the body from the axis, "
            "or of bodies larger than %g of the channel. The channel does not act on them; their column "
            "channel in cytometry.csv is 0.",
            name, np.count_nonzero(~acts), len(acts), _NEAR_AXIS, LARGEST_RATIO,
        )  # fmt: skip
