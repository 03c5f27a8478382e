"""Shapes of bodies along given histories of velocity gradients, as a simulation of turbulence yields them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.tracker import Models, available_threads
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.history import history

_BYTES = 2**30
"""Of the histories that are computed together."""


def along_history(
    times: ArrayLike,
    gradients: ArrayLike,
    particles: Particles,
    medium: Medium,
    models: Models | None = None,
    every: int = 1,
    threads: int | None = None,
) -> Floats:
    """Return the deformation gradients F of bodies that feel given velocity gradients.

    Parameters
    ----------
    times
        (m,), s, at equal distances.
    gradients
        (n, m, 3, 3), ∂u_i/∂x_j that each body feels at these times, 1/s; also a :class:`numpy.memmap`, of
        which a part is read at a time. Between two times they are linear, so that a smooth history is
        followed to second order of their distance. Steps span several times where the tolerance allows it and
        the gradient hardly bends.
    particles
        (n,) bodies, in their states at the first time; they are left as they are.
    medium
        The fluid.
    models
        By default those of :class:`~foamprb.cloud.tracker.Models`.
    every
        Return every so many times only; there steps end.
    threads
        By default all.

    Returns
    -------
    (n, 1 + (m − 1)//every, 3, 3), from the first time on; NaN from where a body fails.

    Raises
    ------
    InputError
        If the shapes do not go together, ``every`` is below 1, or as :func:`foamprb.flow.history.history`.

    Examples
    --------
    In a simple shear whose rate falls to zero a soft sphere is stretched, and returns:

    >>> import numpy as np, foamprb
    >>> t = np.linspace(0.0, 1.0, 201)
    >>> l = np.zeros((1, 201, 3, 3))
    >>> l[0, :, 0, 1] = np.where(t <= 0.5, 100.0, 0.0)
    >>> p = foamprb.spheres([[0.0, 0.0, 0.0]], d=1e-5, rho=1000.0, mu=1.0, poissons_ratio=0.4999)
    >>> F = foamprb.along_history(t, l, p, foamprb.Medium(1e-3, 1000.0, (0.0, 0.0, 0.0)), every=100)
    >>> a, _, c = np.moveaxis(np.linalg.svd(F, compute_uv=False), -1, 0)
    >>> ((a - c) / (a + c)).round(3) + 0.0
    array([[0.   , 0.124, 0.   ]])
    """
    models, t, l = models or Models(), np.asarray(times, dtype=float), np.asanyarray(gradients)
    n, m = particles.size, t.size
    if every < 1:
        raise InputError(f"every is {every}. Allowed: an integer >= 1.")
    if l.shape != (n, m, 3, 3):
        raise InputError(f"gradients have the shape {l.shape}. Allowed: ({n}, {m}, 3, 3).")
    found = np.empty((n, 1 + (m - 1) // every, 9))
    together = max(1, _BYTES // (72 * max(m, 1)))
    for first in range(0, n, together):
        some = np.arange(first, min(first + together, n))
        flow, p = history(t, l[some[0] : some[-1] + 1]), particles.take(some)
        # Each has the history of its number, wherever it was before.
        p.host[:], p.t0[:], p.t[:] = -1, t[0], t[0]
        dt = (t[-1] - t[0]) / (m - 1)
        chosen = replace(models, stride=every)
        cloud = Cloud(p, flow, medium, (), dt, chosen, threads or available_threads(), start=float(t[0]))
        found[some, 0] = p.F
        for k in range(1, found.shape[1]):
            cloud.advance(every)
            found[some, k] = np.where(p.status[:, None] == Status.FAILED, np.nan, p.F)
    return found.reshape(n, -1, 3, 3)
