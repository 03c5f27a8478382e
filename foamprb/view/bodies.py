"""All bodies of a run over its times: place, shape, presence and values, ready to be drawn."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.results.vtk import PointCloud
from foamprb.view.results import NEEDED, Run, Table

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Mask = NDArray[np.bool_]

LARGEST_STRETCH = 128.0
"""Bodies with a larger component of F are not drawn: they are those of failed particles."""

SHAPE_ARRAYS = frozenset({"glyph", "deformationGradient", "orientation", "origId", "active"})
"""Point arrays that are the shape itself, the number of the body or what another one says."""

_LABELS = {
    "taylorDeformation": "Taylor deformation (a − c)/(a + c)",
    "U": "velocity",
    "d": "diameter at rest",
    "rho": "density",
    "age": "age",
    "semiAxes": "semi-axis",
    "stresslet": "stresslet",
    "J": "volume ratio J",
    "angularVelocity": "angular velocity",
    "shearRate": "shear rate",
    "capillaryNumber": "capillary number",
    "status": "status",
    "reason": "reason of failure",
    "patch": "patch",
    "injector": "injection model",
}
MAGNITUDE = "magnitude"
_COMPONENTS = {
    "semiAxes": ("a", "b", "c"),
    3: (MAGNITUDE, "x", "y", "z"),
    6: ("xx", "yy", "zz", "xy", "yz", "xz"),
}

TOLD = {
    "t0": ("time of release", "s"),
    "t1": ("time of the end", "s"),
    "Ca": ("capillary number of the solid", ""),
}
"""Columns of ``fates.csv`` that become arrays: label and unit."""

UNNAMED = 255
"""Code of what has no name, such as the patch of a body that has met none."""


class Field(NamedTuple):
    """An array of the bodies over the times, as one can colour by it."""

    name: str
    label: str
    """For a person, without the unit."""
    unit: str
    """Empty for a number."""
    parts: tuple[str, ...]
    """Names of what can be shown of it: of the components, after ``magnitude`` where that has a meaning."""
    values: Singles
    """Components, (m, n, k) over m times; (1, n, k) of what never changes; NaN where it is unknown."""

    def channel(self, part: str) -> Singles:
        """One of its parts, (m, n) or (1, n)."""
        if part == MAGNITUDE:
            return np.asarray(np.linalg.norm(self.values, axis=2))
        own = [name for name in self.parts if name != MAGNITUDE]
        return self.values[:, :, own.index(part)]


class Codes(NamedTuple):
    """A property of the bodies over the times that has names, such as the status."""

    name: str
    label: str
    meanings: tuple[str, ...]
    codes: NDArray[np.uint8]
    """(m, n), or (1, n) of what never changes; :data:`UNNAMED` without a meaning."""


@dataclass(frozen=True)
class Bodies:
    """n bodies at m times.

    The body i at time t is the unit sphere under ``radius[i] * F[t, i]``, moved to ``x[t, i]``.

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
        Which bodies there are, (m, n); where there is none, x and F are those of the nearest time at which
        there is.
    status
        The particles' status.
    fields, codes
        Arrays by name.
    """

    times: Floats
    ids: NDArray[np.int64]
    radius: Floats
    x: Floats
    F: Singles
    present: Mask
    status: Codes
    fields: dict[str, Field]
    codes: dict[str, Codes]

    @property
    def shown(self) -> Mask:
        """Bodies that are in the flow or on a wall, (m, n)."""
        inside = [k for k, name in enumerate(self.status.meanings) if name in ("active", "stuck")]
        return self.present & np.isin(self.status.codes, inside)

    def at(self, frames: NDArray[np.int64]) -> Bodies:
        """The same bodies at some of the times only."""

        def some(values: NDArray[Any]) -> NDArray[Any]:
            return values if len(values) == 1 else values[frames]

        return Bodies(
            self.times[frames],
            self.ids,
            self.radius,
            self.x[frames],
            self.F[frames],
            self.present[frames],
            self.status._replace(codes=some(self.status.codes)),
            {name: field._replace(values=some(field.values)) for name, field in self.fields.items()},
            {name: codes._replace(codes=some(codes.codes)) for name, codes in self.codes.items()},
        )


def offered(run: Run) -> tuple[str, ...]:
    """Names of the arrays by which bodies can be coloured, in the order of the files."""
    return tuple(name for name in run.components if name not in SHAPE_ARRAYS)


def require_array(run: Run, text: str) -> tuple[str, str]:
    """Split ``name`` or ``name:component`` into an array and one of its components.

    Besides the arrays that are :func:`offered` there are ``fate``, and what ``fates.csv`` tells.

    Returns
    -------
    Name and component; by default the magnitude, or the first component.

    Raises
    ------
    InputError
        If there is no such array or component; the message says what was probably meant.
    """
    name, _, part = text.partition(":")
    names = (*offered(run), "fate", *(TOLD if run.has_fates else ()))
    if name not in names:
        raise InputError(f"-colour {text}: no such array. {suggestion(name, names)}")
    parts = ("",) if name in run.names else components_of(name, run.components.get(name, 1))
    if part and part not in parts:
        allowed = suggestion(part, (p for p in parts if p)) if parts != ("",) else "It has no components."
        raise InputError(f"-colour {text}: no such component of {name}. {allowed}")
    return name, part or parts[0]


def components_of(name: str, k: int) -> tuple[str, ...]:
    """Names of what can be shown of an array with k components."""
    if k == 1:
        return ("",)
    return _COMPONENTS.get(name) or _COMPONENTS.get(k) or tuple(str(i) for i in range(k))


def label_of(name: str) -> str:
    """What a person calls an array: ``shearRate`` → "shear rate"."""
    return _LABELS.get(name) or re.sub(r"(?<=[a-z0-9])([A-Z])", lambda m: f" {m[1].lower()}", name)


def gather(
    run: Run,
    frames: Sequence[int],
    arrays: Sequence[str] | None = None,
    most: int | None = None,
) -> Bodies:
    """Read the bodies of some of the times.

    Parameters
    ----------
    run
        Its results.
    frames
        Indices of the times, rising.
    arrays
        Which of the arrays that are :func:`offered`; all by default.
    most
        Most bodies; of more, that many are taken, evenly spread over their numbers.

    Raises
    ------
    InputError
        If a file is damaged, or a particle is in it twice.
    """
    chosen = offered(run) if arrays is None else tuple(arrays)
    wanted = tuple(dict.fromkeys((*NEEDED, *chosen)))
    snapshots = [run.cloud(k, wanted) for k in frames]
    all_ids = np.unique(np.concatenate([s.arrays["origId"] for s in snapshots]).astype(np.int64))
    if most is not None and len(all_ids) > most:
        all_ids = all_ids[np.arange(most) * len(all_ids) // most]
    rows, places = zip(*(_rows(run, k, s, all_ids) for k, s in zip(frames, snapshots, strict=True)),
                       strict=True)  # fmt: skip
    m, n = len(frames), len(all_ids)

    def table(name: str, k: int, dtype: type = np.float32) -> NDArray[Any]:
        values: NDArray[Any] = np.full((m, n, k), np.nan, dtype=dtype)
        for t, snapshot in enumerate(snapshots):
            found = snapshot.points if name == "" else snapshot.arrays[name]
            with np.errstate(over="ignore", invalid="ignore"):
                values[t, places[t]] = found.reshape(len(found), k)[rows[t]]
        return values

    present = np.zeros((m, n), dtype=bool)
    for t, place in enumerate(places):
        present[t, place] = True
    x = table("", 3, np.float64)
    d = table("d", 1, np.float64)[:, :, 0]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # The columns of R F, one after the other.
        F = table("glyph", 9).reshape(m, n, 3, 3).swapaxes(2, 3) / (0.5 * d[:, :, None, None])
        sound = np.isfinite(x).all(axis=2) & (np.abs(F) <= LARGEST_STRETCH).all(axis=(2, 3)) & (d > 0.0)
    present &= sound
    source = _nearest_present(present)
    column = np.arange(n)
    radius = np.nan_to_num(0.5 * d[source, column][0])
    meanings = run.names.get("status", ())
    status = Codes("status", label_of("status"), meanings, _codes(table("status", 1, np.float64), meanings))
    fields: dict[str, Field] = {}
    codes: dict[str, Codes] = {}
    for name in chosen:
        if name in run.names:
            values = _codes(table(name, 1, np.float64), run.names[name])
            codes[name] = Codes(name, label_of(name), run.names[name], _constant(values, present))
        else:
            unit = run.units.get(name, "")
            fields[name] = _field(name, "" if unit == "1" else unit, table(name, run.components[name]),
                                  present)  # fmt: skip
    times = np.array([snapshot.time for snapshot in snapshots])
    shape = np.nan_to_num(F[source, column]).astype(np.float32)
    place = np.nan_to_num(x[source, column])
    return Bodies(times, all_ids, radius, place, shape, present, status, fields, codes)


def told(bodies: Bodies, fates: Table) -> dict[str, Field]:
    """What ``fates.csv`` tells of each body, as arrays that never change."""
    ids = fates["id"]
    place = np.minimum(np.searchsorted(ids, bodies.ids), max(len(ids) - 1, 0))
    found = ids[place] == bodies.ids if len(ids) else np.zeros(len(bodies.ids), dtype=bool)
    columns = {}
    for name, (label, unit) in TOLD.items():
        values = np.full(len(bodies.ids), np.nan, dtype=np.float32)
        values[found] = fates[name][place[found]]
        columns[name] = Field(name, label, unit, ("",), values[None, :, None])
    return columns


def fates_of(bodies: Bodies, run: Run, fates: Table | None) -> Codes:
    """What became of the bodies, (1, n): "active", "stuck on wall", "escaped through outlet", ….

    It is read off the last of the bodies' times, unless ``fates.csv`` tells.
    """
    statuses = run.names.get("status", ())
    patches = run.names.get("patch", ())
    patch_codes = bodies.codes.get("patch")
    words = []
    if fates is not None:
        columns = (fates[name].tolist() for name in ("id", "fate", "patch"))
        by_id = {number: (fate, patch) for number, fate, patch in zip(*columns, strict=True)}
        words = [_fate(*by_id.get(body, ("unknown", ""))) for body in bodies.ids.tolist()]
    else:
        last = bodies.status.codes[-1]
        met = patch_codes.codes[-1] if patch_codes else np.full(len(last), UNNAMED)
        for status, patch in zip(last.tolist(), met.tolist(), strict=True):
            words.append(_fate(statuses[status] if status < len(statuses) else "unknown",
                               patches[patch] if patch < len(patches) else ""))  # fmt: skip
    meanings = tuple(sorted(set(words), key=lambda word: (_ORDER.get(word.split()[0], 9), word)))
    index = {word: k for k, word in enumerate(meanings)}
    return Codes("fate", "fate", meanings, np.array([[index[word] for word in words]], dtype=np.uint8))


_ORDER = {"active": 0, "stuck": 1, "escaped": 2, "failed": 3}
_JOINED = {"stuck": "stuck on", "escaped": "escaped through"}


def _fate(status: str, patch: str) -> str:
    return f"{_JOINED[status]} {patch}" if patch and status in _JOINED else status


def _rows(
    run: Run, index: int, cloud: PointCloud, ids: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows of a snapshot that are among the bodies, and their places there."""
    own = cloud.arrays["origId"].astype(np.int64)
    if len(np.unique(own)) < len(own):
        file = run.folder / run.entries[index].file
        raise InputError(f"{file}: a particle is in it twice. Run the particles anew: foamprb run.")
    places = np.minimum(np.searchsorted(ids, own), len(ids) - 1) if len(ids) else np.zeros(0, dtype=np.int64)
    rows = np.flatnonzero(ids[places] == own) if len(ids) else np.zeros(0, dtype=np.int64)
    return rows, places[rows]


def _nearest_present(present: Mask) -> NDArray[np.int64]:
    """For each time and body the index of when it was last present, or first if it was not yet, (m, n)."""
    m, n = present.shape
    last = np.maximum.accumulate(np.where(present, np.arange(m)[:, None], -1), axis=0)
    first: NDArray[np.int64] = np.argmax(present, axis=0) if m else np.zeros(n, dtype=np.int64)
    return np.where(last < 0, first, last)


def _codes(values: Floats, meanings: Sequence[str]) -> NDArray[np.uint8]:
    values = values[:, :, 0]
    known = (values >= 0) & (values < min(len(meanings), UNNAMED))
    return np.where(known, values, UNNAMED).astype(np.uint8)


def _constant(values: NDArray[np.uint8], present: Mask) -> NDArray[np.uint8]:
    """The same codes once, if they never change while a body is there; else with nothing where it is not."""
    held = values[_nearest_present(present), np.arange(values.shape[1])]
    return held[:1] if len(held) and (held == held[0]).all() else held


def _field(name: str, unit: str, values: Singles, present: Mask) -> Field:
    parts = components_of(name, values.shape[2])
    held = values[_nearest_present(present), np.arange(values.shape[1])]
    held[~np.isfinite(held)] = np.nan
    same = np.array_equal(held, np.broadcast_to(held[:1], held.shape), equal_nan=True)
    return Field(name, label_of(name), unit, parts, held[:1] if same else held)
