"""Walks of many points through a flow."""

from __future__ import annotations

import numpy as np

from foamprb.compile.link import link
from foamprb.flow.walk import walk


def follow(flow, hosts, start, end, ends, fractions):
    for i in range(start.shape[0]):
        host, fraction, patch, triangle = walk(
            flow, hosts[i], (start[i, 0], start[i, 1], start[i, 2]), (end[i, 0], end[i, 1], end[i, 2])
        )
        ends[i, 0], ends[i, 1], ends[i, 2], fractions[i] = host, patch, triangle, fraction


def walked(flow, hosts, start, end):
    """Return hosts, fractions of the way, patches and triangles at the ends, each (n,)."""
    ends, fractions = np.empty((len(start), 3), dtype=np.int32), np.empty(len(start))
    link(follow)(flow.arrays(), hosts, start, end, ends, fractions)
    return ends[:, 0], fractions, ends[:, 1], ends[:, 2]
