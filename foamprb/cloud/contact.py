"""The wall that a particle has met: its normal, for what is reported of impacts.

The names ``gap``, ``walk`` and ``normal`` are bound to the flow when the loop is compiled.
"""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.state import Particles
from foamprb.flow.analytic import gap_free as gap
from foamprb.flow.analytic import normal_free as normal
from foamprb.flow.analytic import walk_free as walk


def contact_normals(flow: Any, p: Particles, rows: NDArray[Any], normals: NDArray[Any]) -> None:
    """Find the normals, into the fluid, of the boundary on which the particles of some rows have ended.

    The nearest wall counts if it is of the patch that the particle stuck to, else what its path would cross
    within a radius; NaN where neither is found.
    """
    for i in range(len(rows)):
        k = rows[i]
        x: Vector = (p.x[k, 0], p.x[k, 1], p.x[k, 2])
        f = p.F[k]
        F: Tensor = (f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8])
        R = p.R[k]
        _, patch, triangle = gap(flow, p.host[k], x, F, R)
        if patch != p.patch[k]:
            vx, vy, vz = p.v[k, 0], p.v[k, 1], p.v[k, 2]
            c = R / (math.sqrt(vx * vx + vy * vy + vz * vz) + 1e-300)
            ahead = (x[0] + c * vx, x[1] + c * vy, x[2] + c * vz)
            _, _, patch, triangle = walk(flow, p.host[k], x, ahead)
        if patch == p.patch[k] and patch >= 0:
            n = normal(flow, triangle, x)
            normals[i, 0], normals[i, 1], normals[i, 2] = n[0], n[1], n[2]
        else:
            normals[i, 0] = normals[i, 1] = normals[i, 2] = math.nan
