"""Clouds to write, with an array of every kind."""

from __future__ import annotations

import numpy as np

from foamprb.results.vtk import Parts, PointCloud


def cloud(time: float = 0.1, n: int = 4) -> PointCloud:
    random = np.random.default_rng(1)
    return PointCloud(
        time,
        random.random((n, 3)),
        {
            "U": random.random((n, 3)),
            "d": np.full(n, 5e-6),
            "origId": np.arange(n, dtype=np.int32),
            "active": np.arange(n) % 2 == 0,
            "deformationGradient": random.random((n, 9)),
            "status": np.full(n, 2, dtype=np.int8),
            "patch": np.full(n, -1, dtype=np.int32),
            "count": np.arange(n, dtype=np.int64) + 2**40,
        },
        {"d": "m", "U": "m/s"},
        {"status": ("pending", "active", "stuck"), "patch": ("inlet", "outlet", "wall")},
    )


def in_parts(whole: PointCloud, sizes: tuple[int, ...]) -> Parts:
    """The same cloud, so many particles at a time."""
    ends = np.cumsum(sizes)
    rows = [slice(end - n, end) for end, n in zip(ends, sizes, strict=True)]
    snapshots = (
        PointCloud(
            whole.time,
            whole.points[part],
            {name: array[part] for name, array in whole.arrays.items()},
            whole.units,
            whole.names,
        )
        for part in rows
    )
    return Parts(whole.time, len(sizes), snapshots)
