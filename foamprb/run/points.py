"""Points of the fluid that start where and when the bodies do: fates that the fluid alone would give."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, Status, concatenate, spheres
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import STATUS_NAMES
from foamprb.results.tables import Rows, rows_of
from foamprb.run.job import Job

_SIZE = 1e-4
"""Radius of a point over that of the smallest body."""
_FLUID, _SOLID = 1e-3, 1e5
"""Viscosity, Pa s, and shear modulus, Pa: a point stays round."""


def points_of(job: Job) -> Cloud:
    """Return a cloud of points at the places and times of release of the bodies, which have not moved.

    Points have no inertia, follow the fluid and its eddies, feel no other force, and meet the same patches.
    This process advances all of them.
    """
    cloud = job.cloud
    starts, models = concatenate(cloud.map_by_id(_starts_of)), cloud.models
    starts.R[:] = _SIZE * starts.R.min(initial=np.inf)
    frames = [model for model in models.surroundings if isinstance(model, RotatingFrames)]
    return Cloud(
        starts,
        cloud.flow,
        Medium(_FLUID, job.settings.fluid.rho, (0.0, 0.0, 0.0)),
        cloud.interactions,
        cloud.dt,
        Models(
            touching=models.touching, integrator="stokes", tolerance=models.tolerance,
            surroundings=(*frames, *job.settings.dispersion.values()), stride=models.stride,
            roughness_share=models.roughness_share,
        ),
        cloud.threads,
        start=cloud.start,
        # The same lists of walls serve both clouds.
        reach=cloud.reach,
        decoupled=cloud.decoupled,
        end=cloud.end,
    )  # fmt: skip


def _starts_of(p: Particles) -> Particles:
    points = spheres(p.x0, d=2.0 * p.R, rho=1.0, mu=_SOLID, t0=p.t0)
    return points._replace(host=p.host.copy())


def rows_of_points(p: Particles, patches: tuple[str, ...]) -> Rows:
    """Return rows of ``tracers``, of the points that were released."""
    p = p.take(np.flatnonzero(p.status != Status.PENDING))
    names = np.array((*patches, ""), dtype=object)
    return rows_of(
        {
            "id": p.number, "t1": p.t, "x1": p.x[:, 0], "y1": p.x[:, 1], "z1": p.x[:, 2],
            "fate": np.array(STATUS_NAMES, dtype=object)[p.status], "patch": names[p.patch],
        }
    )  # fmt: skip
