"""Bodies of a run over its times: position, shape, presence and values, ready to be drawn."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.results.folder import TOUCHED
from foamprb.view.results import NEEDED, Run, Table
from foamprb.view.surfaces import MODE, unfolded

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Mask = NDArray[np.bool_]

LARGEST_STRETCH = 128.0
"""Bodies with a larger component of F belong to failed particles and are not drawn."""

_MOST_VALUES = 4_000_000
"""Values that decide the limits of colours, at most."""
_QUANTILES = (0.05, 0.5, 0.95)
_JUMP = 10.0
"""Ratio of the distance between two times to that at the larger velocity above which a body has jumped."""
SHAPE_ARRAYS = frozenset({"glyph", MODE, "deformationGradient", "orientation", "origId", "active"})
"""Point arrays that hold the shape or the number of the body, or repeat another array."""

_LABELS = {
    "taylorDeformation": "Taylor deformation (a − c)/(a + c)",
    "U": "velocity",
    "d": "diameter at rest",
    "rho": "density",
    "semiAxes": "semi-axis",
    "J": "volume ratio J",
    "reason": "reason of failure",
    "injector": "injection model",
}
MAGNITUDE = "magnitude"
_COMPONENTS = {
    "semiAxes": ("a", "b", "c"),
    3: (MAGNITUDE, "x", "y", "z"),
    6: ("xx", "yy", "zz", "xy", "yz", "xz"),
}

FATE_COLUMNS = {
    "t0": ("time of release", "s"),
    "t1": ("time of the end", "s"),
    "Ca": ("capillary number of the solid", ""),
}
"""Columns of ``fates.csv`` that become arrays: label and unit."""

UNNAMED = 255
"""Code without a name, such as the patch of a body that has met no patch."""


class Quantity(NamedTuple):
    """Array of the bodies over the times, to colour by."""

    name: str
    label: str
    """Name in words, without the unit."""
    unit: str
    """Empty for a number."""
    parts: tuple[str, ...]
    """Names of the components; of a vector after ``magnitude``."""
    values: Singles
    """Components, (m, n, k) over m times; (1, n, k) if they never change; NaN where unknown."""

    def channel(self, part: str) -> Singles:
        """Return one of the parts, (m, n) or (1, n)."""
        if part == MAGNITUDE:
            return np.asarray(np.linalg.norm(self.values, axis=2))
        components = [name for name in self.parts if name != MAGNITUDE]
        return self.values[:, :, components.index(part)]


class Codes(NamedTuple):
    """Property of the bodies over the times that has names, such as the status."""

    name: str
    label: str
    meanings: tuple[str, ...]
    codes: NDArray[np.uint8]
    """(m, n), or (1, n) if they never change; :data:`UNNAMED` without a meaning."""


@dataclass(frozen=True)
class Bodies:
    """n bodies at m times.

    Body i at time t is the unit sphere under ``radius[i] * F[t, i]``, moved to ``x[t, i]``. With a quadratic
    mode a point X of the sphere moves by ``radius[i] * B YY`` more; Y is X turned by the rotation of F.

    Parameters
    ----------
    times
        (m,), s.
    ids
        Numbers of the particles, (n,), rising.
    radius
        Radius at rest, (n,), m.
    x
        Positions, (m, n, 3), m.
    F
        Shape, (m, n, 3, 3).
    present
        Whether a body exists, (m, n). Where it does not, x and F are taken from the nearest time at which it
        does.
    status
        Status of the particles.
    fields, codes
        Arrays by name.
    B
        Quadratic mode, (m, n, 7), so reduced that no surface folds; None if no body has one.
    """

    times: Floats
    ids: NDArray[np.int64]
    radius: Floats
    x: Floats
    F: Singles
    present: Mask
    status: Codes
    fields: dict[str, Quantity]
    codes: dict[str, Codes]
    B: Singles | None = None

    @property
    def shown(self) -> Mask:
        """Bodies in the flow or on a wall, (m, n)."""
        return self.present & _inside(self.status.codes, self.status.meanings)

    def jumped(self, t: int) -> Mask:
        """Return whether bodies moved much farther before time t than their velocities carry them, (n,).

        They passed through a coupled patch.
        """
        far = np.linalg.norm(self.x[t] - self.x[t - 1], axis=1)
        if "U" not in self.fields:
            return np.zeros(len(far), dtype=bool)
        speed = np.broadcast_to(self.fields["U"].channel(MAGNITUDE), self.present.shape)
        fastest = np.maximum(speed[t - 1], speed[t])
        return np.asarray(far > _JUMP * fastest * (self.times[t] - self.times[t - 1]))


def colourable(run: Run) -> tuple[str, ...]:
    """Return the names of the point arrays to colour by, in the order of the files."""
    return tuple(name for name in run.components if name not in SHAPE_ARRAYS)


def require_array(run: Run, text: str) -> tuple[str, str]:
    """Split ``name`` or ``name:component`` into an array and one of its components.

    Allowed are the :func:`colourable` arrays, ``fate`` and the columns of ``fates.csv``.

    Returns
    -------
    Name and component; by default the magnitude, or the first component.
    """
    name, _, part = text.partition(":")
    names = (*colourable(run), "fate", *(FATE_COLUMNS if run.has_fates else ()))
    if name not in names:
        raise InputError(f"-colour {text}: no such array. {suggestion(name, names)}")
    parts = ("",) if name in run.names else components_of(name, run.components.get(name, 1))
    if part and part not in parts:
        allowed = suggestion(part, (p for p in parts if p)) if parts != ("",) else "It has no components."
        raise InputError(f"-colour {text}: no such component of {name}. {allowed}")
    return name, part or parts[0]


def components_of(name: str, k: int) -> tuple[str, ...]:
    """Return the names of the parts of an array with k components."""
    if k == 1:
        return ("",)
    return _COMPONENTS.get(name) or _COMPONENTS.get(k) or tuple(str(i) for i in range(k))


def label_of(name: str) -> str:
    """Return the name of an array in words: ``shearRate`` → "shear rate"."""
    return _LABELS.get(name) or re.sub(r"(?<=[a-z0-9])([A-Z])", lambda m: f" {m[1].lower()}", name)


def gather(
    run: Run, frames: Sequence[int], most: int | None = None, arrays: Collection[str] | None = None
) -> Bodies:
    """Read the bodies of some of the times, one after the other.

    Parameters
    ----------
    run
        Results of a cloud.
    frames
        Indices of the times, rising.
    most
        Largest number of bodies; if there are more, a selection that is evenly spread over their numbers.
    arrays
        Names of the :func:`colourable` arrays to read; by default all of them.
    """
    names = [name for name in colourable(run) if arrays is None or name in arrays]
    ids = _numbers_of_all(run, frames)
    if most is not None and len(ids) > most:
        ids = ids[np.arange(most) * len(ids) // most]
    m, n = len(frames), len(ids)
    coded = [name for name in names if name in run.names]
    valued = {name: run.components[name] for name in names if name not in coded}
    x, F, radius = np.zeros((m, n, 3)), np.zeros((m, n, 3, 3), dtype=np.float32), np.zeros(n)
    present, status = np.zeros((m, n), dtype=bool), np.full((m, n), UNNAMED, dtype=np.uint8)
    codes = {name: np.full((m, n), UNNAMED, dtype=np.uint8) for name in coded}
    values = {name: np.full((m, n, k), np.nan, dtype=np.float32) for name, k in valued.items()}
    B = np.zeros((m, n, 7), dtype=np.float32) if MODE in run.components else None
    needed = (*NEEDED, MODE) if B is not None else NEEDED
    collected: list[NDArray[Any]] = [x, F, *codes.values(), *values.values()]
    collected += [B] if B is not None else []
    met = np.zeros(n, dtype=bool)
    for t, frame in enumerate(frames):
        cloud = run.cloud(
            frame, dict.fromkeys((*needed, *names)), lambda arrays: _selected(arrays["origId"], ids)
        )
        points, columns, d = cloud.points, cloud.arrays, cloud.arrays["d"].astype(np.float64)
        places = np.searchsorted(ids, columns["origId"])
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            # glyph holds the columns of R F, one after the other.
            shape = columns["glyph"].reshape(-1, 3, 3).swapaxes(1, 2) / (0.5 * d[:, None, None])
            sound = np.isfinite(points).all(axis=1) & (np.abs(shape) <= LARGEST_STRETCH).all(axis=(1, 2))
        sound &= d > 0.0
        status[t, places] = _known(columns["status"], run.names.get("status", ()))
        if t:
            for array in collected:
                array[t] = array[t - 1]
        places = places[sound]
        present[t, places] = True
        x[t, places], F[t, places] = points[sound], shape[sound]
        if B is not None:
            B[t, places] = unfolded(F[t, places], columns[MODE][sound])
        for name, array in codes.items():
            array[t, places] = _known(columns[name][sound], run.names[name])
        for name, array in values.items():
            with np.errstate(over="ignore", invalid="ignore"):
                numbers = columns[name][sound].reshape(-1, valued[name]).astype(np.float32)
            numbers[~np.isfinite(numbers)] = np.nan
            array[t, places] = numbers
        first = places[~met[places]]
        radius[first] = 0.5 * d[sound][~met[places]]
        met[first] = True
        # Before its release a body is where it will be released.
        for array in collected if t else ():
            array[:t, first] = array[t, first]
    return Bodies(
        times=run.times[np.array(frames)],
        ids=ids,
        radius=radius,
        x=x,
        F=F,
        present=present,
        status=Codes("status", label_of("status"), run.names.get("status", ()), status),
        fields={name: _quantity(run, name, array) for name, array in values.items()},
        codes={
            name: Codes(name, label_of(name), run.names[name], _once(array)) for name, array in codes.items()
        },
        B=B if B is not None and B.any() else None,
    )


class Survey(NamedTuple):
    """Bodies at all m times, and an array of them in its unit."""

    shown: NDArray[np.int64]
    """Number of bodies in the flow or on a wall, (m,)."""
    values: Singles | None
    """Finite values at them, (v,), those of some of very many; None if it is no number of the clouds."""
    quantiles: Floats
    """Values that 5, 50 and 95 % of the moving bodies do not exceed, (m, 3), NaN without any."""


def survey(run: Run, name: str, part: str) -> Survey:
    """Return the numbers of bodies at all times and the values of an array, which are read once."""
    valued = name in run.components and name not in run.names
    stride = 1 + len(run.entries) * len(run.cloud(-1, ("origId",)).points) // _MOST_VALUES
    counts: list[int] = []
    collected, meanings = [np.zeros(0, dtype=np.float32)], run.names.get("status", ())
    quantiles = np.full((len(run.entries), 3), np.nan)

    def shown(arrays: Table) -> NDArray[np.int64]:
        return np.flatnonzero(_inside(arrays["status"], meanings))

    for frame in range(len(run.entries)):
        arrays = run.cloud(frame, ("status", *([name] if valued else ())), shown).arrays
        counts.append(len(arrays["status"]))
        if valued:
            values = arrays[name].astype(np.float32)
            channel = _quantity(run, name, values.reshape(1, -1, run.components[name])).channel(part)[0]
            moving = channel[_inside(arrays["status"], meanings, ("active",))]
            quantiles[frame] = np.quantile(moving, _QUANTILES) if len(moving) else np.nan
            collected.append(channel[::stride][np.isfinite(channel[::stride])])
    return Survey(np.array(counts), np.concatenate(collected) if valued else None, quantiles)


def stuck_at_end(run: Run) -> int:
    """Return the number of bodies on walls at the last written time."""
    status, meanings = run.cloud(-1, ("status",)).arrays["status"], run.names.get("status", ())
    return int(_inside(status, meanings, ("stuck",)).sum())


def _inside(
    codes: NDArray[np.generic], meanings: Sequence[str], words: Sequence[str] = ("active", "stuck")
) -> Mask:
    """Return whether bodies are in the flow or on a wall, or in another state."""
    return np.isin(codes, [k for k, name in enumerate(meanings) if name in words])


def _numbers_of_all(run: Run, frames: Sequence[int]) -> NDArray[np.int64]:
    """Return the numbers of the particles at some times, rising; InputError if a file has one twice."""
    ids = np.zeros(0, dtype=np.int64)
    for frame in frames:
        numbers = run.cloud(frame, ("origId",)).arrays["origId"].astype(np.int64)
        if np.array_equal(numbers, ids):
            continue
        if len(unique := np.unique(numbers)) < len(numbers):
            file = run.folder / run.entries[frame].file
            raise InputError(f"{file}: a particle is in it twice. Run the particles again: foamprb run.")
        ids = np.union1d(ids, unique)
    return ids


def _selected(numbers: NDArray[np.int64], ids: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the rows of a file with chosen bodies, whose numbers rise."""
    places = np.minimum(np.searchsorted(ids, numbers), max(len(ids) - 1, 0))
    return np.flatnonzero(ids[places] == numbers) if len(ids) else np.zeros(0, dtype=np.int64)


def _quantity(run: Run, name: str, values: Singles) -> Quantity:
    unit = run.units.get(name, "")
    parts = components_of(name, run.components[name])
    return Quantity(name, label_of(name), "" if unit == "1" else unit, parts, _once(values))


def fields_of_fates(bodies: Bodies, fates: Table) -> dict[str, Quantity]:
    """Return the :data:`FATE_COLUMNS` of ``fates.csv`` as arrays that never change."""
    rows, there = _rows(bodies, fates)
    columns = {}
    for name, (label, unit) in FATE_COLUMNS.items():
        values = np.full(len(bodies.ids), np.nan, dtype=np.float32)
        values[there] = fates[name][rows]
        columns[name] = Quantity(name, label, unit, ("",), values[None, :, None])
    return columns


def _rows(bodies: Bodies, fates: Table) -> tuple[NDArray[np.int64], Mask]:
    """Return the rows of bodies in a table with rising numbers, and which bodies it has, (n,)."""
    there = np.isin(bodies.ids, fates["id"])
    return np.searchsorted(fates["id"], bodies.ids[there]), there


def fates_of(bodies: Bodies, run: Run, fates: Table | None) -> Codes:
    """Return the fates of the bodies, (1, n): "active", "stuck on wall", "escaped through outlet", ….

    Those that touched a wall at their release are "stuck on wall at release".

    They are taken from ``fates.csv``, or without it from the last of the bodies' times.
    """
    if fates is not None:
        rows, there = _rows(bodies, fates)
        columns = (fates[name][rows].tolist() for name in ("fate", "patch", TOUCHED))
        of_bodies = zip(*columns, strict=True)
        words = [_fate(*next(of_bodies)) if known else "unknown" for known in there.tolist()]
    else:
        statuses, patches = (dict(enumerate(run.names.get(name, ()))) for name in ("status", "patch"))
        last = bodies.status.codes[-1]
        met = bodies.codes["patch"].codes[-1] if "patch" in bodies.codes else np.full(len(last), UNNAMED)
        words = [
            _fate(statuses.get(status, "unknown"), patches.get(patch, ""))
            for status, patch in zip(last.tolist(), met.tolist(), strict=True)
        ]
    meanings = tuple(sorted(set(words), key=lambda word: (_ORDER.get(word.split()[0], 9), word)))
    codes = [meanings.index(word) for word in words]
    return Codes("fate", "fate", meanings, np.array([codes], dtype=np.uint8))


_ORDER = {"active": 0, "stuck": 1, "escaped": 2, "failed": 3, "ruptured": 4, "released": 5}
_JOINED = {"stuck": "stuck on", "escaped": "escaped through"}


def _fate(status: str, patch: str, touched: int = 0) -> str:
    words = f"{_JOINED[status]} {patch}" if patch and status in _JOINED else status
    return words + " at release" * bool(touched)


def _known(values: NDArray[Any], meanings: Sequence[str]) -> NDArray[np.uint8]:
    """Return codes from numbers; :data:`UNNAMED` without a meaning."""
    valid = (values >= 0) & (values < min(len(meanings), UNNAMED))
    return np.where(valid, values, UNNAMED).astype(np.uint8)


def _once(values: NDArray[np.generic]) -> NDArray[Any]:
    """Return values over the times, or only the first ones if they never change."""
    same = np.array_equal(values, np.broadcast_to(values[:1], values.shape), equal_nan=True)
    return values[:1] if same else values
