"""The compiled loop over particles: lanes of a block step side by side.

Particles do not act on each other, so a block of :data:`LANES` of them is carried through many steps while
it stays in the processor's cache. Within a step, the flow's sampling and walking go particle by particle;
the mathematics of the body goes stage by stage over the lanes of the block, each stage one plain loop that
the compiler turns into vector instructions. All lanes are computed alike, whatever their number and order,
which makes the result independent of both and of the number of threads.

The names by which the models are called (``traction``, ``drag``, ``sample``, ``walk`` and so on) are bound to
those that were chosen when the loop is compiled (:func:`foamprb.compile.link.link`), and ``track`` to the
integrator's loop over steps.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Medium, Scratch
from foamprb.cloud.integrators.paper import track_block as track
from foamprb.cloud.layout import LANES
from foamprb.cloud.motion import PatchTable
from foamprb.cloud.state import Particles

MOST_MEMBERS = LANES
"""As many particles an integrator's loop takes at once; bound with it."""


def track_share(
    flow: Any,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    rows: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    start: float,
    scratch: Scratch,
    options: tuple[float, ...],
) -> int:
    """Carry a thread's share of the particles, of which there are ``rows``.

    Parameters
    ----------
    options
        What the integrator's loop wants beside what :func:`track_block` does; the rest is as there.

    Returns
    -------
    The number of walks that failed and were mended by the tree.
    """
    recovered = 0
    for begin in range(0, len(rows), MOST_MEMBERS):
        members = rows[begin : begin + MOST_MEMBERS]
        recovered += track(flow, patches, medium, p, members, step, steps, dt, start, scratch, *options)
    return recovered
