"""Bodies of a run over its times: position, shape, presence and values, ready to be drawn."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.view.results import NEEDED, Run, Table

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Mask = NDArray[np.bool_]

LARGEST_STRETCH = 128.0
"""Bodies with a larger component of F belong to failed particles and are not drawn."""

SHAPE_ARRAYS = frozenset({"glyph", "deformationGradient", "orientation", "origId", "active"})
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
        own = [name for name in self.parts if name != MAGNITUDE]
        return self.values[:, :, own.index(part)]


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

    Body i at time t is the unit sphere under ``radius[i] * F[t, i]``, moved to ``x[t, i]``.

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

    @property
    def shown(self) -> Mask:
        """Bodies in the flow or on a wall, (m, n)."""
        inside = [k for k, name in enumerate(self.status.meanings) if name in ("active", "stuck")]
        return self.present & np.isin(self.status.codes, inside)

    def at(self, frames: NDArray[np.int64]) -> Bodies:
        """Return the same bodies at some of the times."""

        def some(values: NDArray[Any]) -> NDArray[Any]:
            return values if len(values) == 1 else values[frames]

        return replace(
            self,
            times=self.times[frames],
            x=self.x[frames],
            F=self.F[frames],
            present=self.present[frames],
            status=self.status._replace(codes=some(self.status.codes)),
            fields={name: field._replace(values=some(field.values)) for name, field in self.fields.items()},
            codes={name: codes._replace(codes=some(codes.codes)) for name, codes in self.codes.items()},
        )


def colourable(run: Run) -> tuple[str, ...]:
    """Return the names of the point arrays to colour by, in the order of the files."""
    return tuple(name for name in run.components if name not in SHAPE_ARRAYS)


def require_array(run: Run, text: str) -> tuple[str, str]:
    """Split ``name`` or ``name:component`` into an array and one of its components.

    Allowed are the :func:`colourable` arrays, ``fate`` and the columns of ``fates.csv``.

    Returns
    -------
    Name and component; by default the magnitude, or the first component.

    Raises
    ------
    InputError
        If there is no such array or component; the message suggests one.
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


def gather(run: Run, frames: Sequence[int], most: int | None = None) -> Bodies:
    """Read the bodies of some of the times.

    Parameters
    ----------
    run
        Results of a cloud.
    frames
        Indices of the times, rising.
    most
        Largest number of bodies; if there are more, a selection that is evenly spread over their numbers.

    Raises
    ------
    InputError
        If a file is damaged or contains a particle twice.
    """
    names = colourable(run)
    clouds = [run.cloud(k, dict.fromkeys((*NEEDED, *names))) for k in frames]
    numbers = [cloud.arrays["origId"].astype(np.int64) for cloud in clouds]
    ids = np.unique(np.concatenate(numbers))
    if most is not None and len(ids) > most:
        ids = ids[np.arange(most) * len(ids) // most]
    m, n = len(frames), len(ids)
    rows = np.full((m, n), -1)
    for t, own in enumerate(numbers):
        if len(np.unique(own)) < len(own):
            file = run.folder / run.entries[frames[t]].file
            raise InputError(f"{file}: a particle is in it twice. Run the particles again: foamprb run.")
        place = np.searchsorted(ids, own)
        known = np.isin(own, ids)
        rows[t, place[known]] = np.flatnonzero(known)
    in_file = rows >= 0

    def table(arrays: Sequence[NDArray[Any]], k: int, dtype: type = np.float32) -> NDArray[Any]:
        """Return an array of k components of the bodies at all times, (m, n, k); NaN without a body."""
        values: NDArray[Any] = np.full((m, n, k), np.nan, dtype=dtype)
        for t, array in enumerate(arrays):
            with np.errstate(over="ignore", invalid="ignore"):
                values[t, in_file[t]] = array.reshape(len(array), k)[rows[t, in_file[t]]]
        return values

    def named(name: str, k: int, dtype: type = np.float32) -> NDArray[Any]:
        return table([cloud.arrays[name] for cloud in clouds], k, dtype)

    x = table([cloud.points for cloud in clouds], 3, np.float64)
    d = named("d", 1, np.float64)[:, :, 0]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # glyph holds the columns of R F, one after the other.
        F = named("glyph", 9).reshape(m, n, 3, 3).swapaxes(2, 3) / (0.5 * d[:, :, None, None])
        sound = np.isfinite(x).all(axis=2) & (np.abs(F) <= LARGEST_STRETCH).all(axis=(2, 3)) & (d > 0.0)
    present = in_file & sound
    nearest = _nearest_present(present), np.arange(n)
    meanings = run.names.get("status", ())
    status = Codes("status", label_of("status"), meanings, _known(named("status", 1, np.float64), meanings))
    fields: dict[str, Quantity] = {}
    codes: dict[str, Codes] = {}
    for name in names:
        if name in run.names:
            values = _known(named(name, 1, np.float64), run.names[name])
            codes[name] = Codes(name, label_of(name), run.names[name], _once(values[nearest]))
        else:
            unit, k = run.units.get(name, ""), run.components[name]
            held = named(name, k)[nearest]
            held[~np.isfinite(held)] = np.nan
            parts = components_of(name, k)
            fields[name] = Quantity(name, label_of(name), "" if unit == "1" else unit, parts, _once(held))
    return Bodies(
        times=np.array([cloud.time for cloud in clouds]),
        ids=ids,
        radius=np.nan_to_num(0.5 * d[nearest][0]),
        x=np.nan_to_num(x[nearest]),
        F=np.nan_to_num(F[nearest]).astype(np.float32),
        present=present,
        status=status,
        fields=fields,
        codes=codes,
    )


def fields_of_fates(bodies: Bodies, fates: Table) -> dict[str, Quantity]:
    """Return the :data:`FATE_COLUMNS` of ``fates.csv`` as arrays that never change."""
    ids = fates["id"]
    place = np.minimum(np.searchsorted(ids, bodies.ids), max(len(ids) - 1, 0))
    found = ids[place] == bodies.ids if len(ids) else np.zeros(len(bodies.ids), dtype=bool)
    columns = {}
    for name, (label, unit) in FATE_COLUMNS.items():
        values = np.full(len(bodies.ids), np.nan, dtype=np.float32)
        values[found] = fates[name][place[found]]
        columns[name] = Quantity(name, label, unit, ("",), values[None, :, None])
    return columns


def fates_of(bodies: Bodies, run: Run, fates: Table | None) -> Codes:
    """Return the fates of the bodies, (1, n): "active", "stuck on wall", "escaped through outlet", ….

    They are taken from ``fates.csv``, or without it from the last of the bodies' times.
    """
    if fates is not None:
        columns = (fates[name].tolist() for name in ("id", "fate", "patch"))
        by_id = {number: _fate(fate, patch) for number, fate, patch in zip(*columns, strict=True)}
        words = [by_id.get(body, "unknown") for body in bodies.ids.tolist()]
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


_ORDER = {"active": 0, "stuck": 1, "escaped": 2, "failed": 3}
_JOINED = {"stuck": "stuck on", "escaped": "escaped through"}


def _fate(status: str, patch: str) -> str:
    return f"{_JOINED[status]} {patch}" if patch and status in _JOINED else status


def _nearest_present(present: Mask) -> NDArray[np.int64]:
    """Return the time at which each body was last present, or is first if it has not been yet, (m, n)."""
    last = np.maximum.accumulate(np.where(present, np.arange(len(present))[:, None], -1), axis=0)
    return np.where(last < 0, np.argmax(present, axis=0), last)


def _known(values: Floats, meanings: Sequence[str]) -> NDArray[np.uint8]:
    """Return codes (m, n) from numbers (m, n, 1); :data:`UNNAMED` without a meaning."""
    values = values[:, :, 0]
    known = (values >= 0) & (values < min(len(meanings), UNNAMED))
    return np.where(known, values, UNNAMED).astype(np.uint8)


def _once(values: NDArray[Any]) -> NDArray[Any]:
    """Return values over the times, or only the first ones if they never change."""
    same = np.array_equal(values, np.broadcast_to(values[:1], values.shape), equal_nan=True)
    return values[:1] if same else values
