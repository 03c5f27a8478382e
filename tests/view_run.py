"""Results of a run without a run: bodies that move, turn and stretch in the unit cube of ``foam_writer``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from foam_writer import write_case
from numpy.typing import NDArray

from foamprb.body.quadratic import bullet_amplitude
from foamprb.cloud.measures import quaternion
from foamprb.cloud.state import Status
from foamprb.results.folder import ResultsFolder
from foamprb.results.pvd import Series
from foamprb.results.tables import write_table
from foamprb.results.vtk import PointCloud

STATUS_NAMES = tuple(status.name.lower() for status in Status)
INJECTORS = ("soft", "stiff")
PATCHES = ("floor", "sides", "lid")
UNITS = {"U": "m/s", "d": "m", "age": "s", "taylorDeformation": "1", "shearRate": "1/s", "semiAxes": "m"}


class Motion(NamedTuple):
    """n bodies at m times."""

    times: NDArray[np.float64]
    x: NDArray[np.float64]
    F: NDArray[np.float64]
    radius: NDArray[np.float64]


def motion(n: int, m: int, seed: int = 0, tumbling: float = 0.7) -> Motion:
    """Smooth paths in the unit cube; bodies turn by so many radians from time to time, about any axis."""
    random = np.random.default_rng(seed)
    times = 0.1 * np.arange(m)
    t = np.linspace(0.0, 1.0, m)[:, None, None]
    phase, rate = random.uniform(0.0, 6.3, (n, 3)), random.uniform(1.0, 5.0, (n, 3))
    x = 0.5 + random.uniform(0.1, 0.38, (n, 3)) * np.sin(rate * t + phase)
    frames = np.linalg.qr(random.standard_normal((n, 3, 3)))[0]
    frames[:, 0] *= np.sign(np.linalg.det(frames))[:, None]
    angle = random.uniform(0.0, 6.3, n) + tumbling * random.uniform(0.5, 1.5, n) * np.arange(m)[:, None]
    turn = np.zeros((m, n, 3, 3))
    turn[..., 0, 0] = turn[..., 1, 1] = np.cos(angle)
    turn[..., 1, 0] = np.sin(angle)
    turn[..., 0, 1] = -turn[..., 1, 0]
    turn[..., 2, 2] = 1.0
    stretch = 1.0 + random.uniform(0.1, 0.8, n) * (1.0 - np.exp(-3.0 * t[:, :, 0]))
    U = np.zeros((m, n, 3, 3))
    U[..., 0, 0], U[..., 1, 1], U[..., 2, 2] = stretch, 1.0 / stretch, 1.0
    F = frames @ U @ turn @ frames.swapaxes(-1, -2)
    return Motion(times, x, F, random.uniform(0.01, 0.02, n))


def modes(n: int, m: int, amplitude: float) -> NDArray[np.float64]:
    """Return quadratic modes of any direction with the amplitude of a bullet, (m, n, 7)."""
    B = np.random.default_rng(1).standard_normal((m, n, 7))
    return amplitude * B / bullet_amplitude(tuple(np.moveaxis(B, -1, 0)))[..., None]


def clouds(moved: Motion, first: int = 0, B: NDArray[np.float64] | None = None) -> list[PointCloud]:
    """As files: a third is released later, body 1 sticks to the floor and body 2 leaves through the lid."""
    m, n = moved.x.shape[:2]
    result = []
    ids = first + np.arange(n)
    for k, time in enumerate(moved.times):
        here = np.flatnonzero((np.arange(n) % 3 > 0) | (k > m // 3))
        F = moved.F[k, here]
        stretch = np.linalg.svd(F, compute_uv=False)
        status = np.full(n, Status.ACTIVE, dtype=np.int8)
        patch = np.full(n, -1, dtype=np.int32)
        if k > m // 2:
            status[1:2], patch[1:2] = Status.STUCK, 0
            status[2:3], patch[2:3] = Status.ESCAPED, 2
        U = np.gradient(moved.x, 0.1, axis=0)[k, here] if m > 1 else np.zeros((len(here), 3))
        result.append(
            PointCloud(
                float(time),
                moved.x[k, here],
                {
                    "U": U,
                    "d": 2.0 * moved.radius[here],
                    "origId": ids[here].astype(np.int64),
                    "deformationGradient": F.reshape(-1, 9),
                    "glyph": (moved.radius[here, None, None] * F).swapaxes(1, 2).reshape(-1, 9),
                    "semiAxes": stretch * moved.radius[here, None],
                    "taylorDeformation": (stretch[:, 0] - stretch[:, 2]) / (stretch[:, 0] + stretch[:, 2]),
                    "shearRate": np.linalg.norm(U, axis=1),
                    "age": np.full(len(here), time),
                    "status": status[here],
                    "patch": patch[here],
                    "injector": (ids[here] % 2).astype(np.int32),
                    **({} if B is None else {"quadraticShape": B[k, here]}),
                },
                UNITS,
                {"status": STATUS_NAMES, "patch": PATCHES, "injector": INJECTORS},
            )
        )
    return result


def with_orientation(cloud: PointCloud) -> PointCloud:
    """The same cloud, with the array of the bodies' frames."""
    G = cloud.arrays["glyph"].reshape(-1, 3, 3).transpose(0, 2, 1)
    axes = np.linalg.svd(G)[0]
    axes[:, :, 2] *= np.sign(np.linalg.det(axes))[:, None]
    q = np.stack(quaternion(tuple(axes.transpose(0, 2, 1).reshape(-1, 9).T)), axis=1)
    return replace(cloud, arrays={**cloud.arrays, "orientation": q})


def write_run(
    case: Path, moved: Motion, mesh: bool = True, fates: bool = False, B: NDArray[np.float64] | None = None
) -> Path:
    """Write a case with such results; return the folder of the results."""
    if mesh:
        write_case(case, perturbation=0.0)
    folder = case / "postProcessing" / "softCloud"
    folder.mkdir(parents=True, exist_ok=True)
    series = Series(ResultsFolder(folder, "softCloud"))
    for cloud in clouds(moved, B=B):
        series.append(cloud)
    if fates:
        n = len(moved.radius)
        names = ["active", "stuck", "escaped", *["active"] * n][:n]
        write_table(
            folder / "fates.csv",
            {
                "id": np.arange(n),
                "Ca": np.linspace(0.1, 1.0, n),
                "t0": np.zeros(n),
                "t1": np.full(n, moved.times[-1]),
                **{f"{'xyz'[c]}1": moved.x[-1, :, c] * (c < 2) for c in range(3)},
                "fate": names,
                "patch": ["", "floor", "lid", *[""] * n][:n],
            },
        )
    return folder
