"""Tables of measured bodies: where each was seen, its size, and the shape that was measured."""

from __future__ import annotations

import csv
import logging
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.errors import InputError, closest
from foamprb.run.rtdc import LEAST, Conditions, pixel_noise, read_rtdc

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_LENGTHS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
_AREAS = {f"{unit}{two}": factor**2 for unit, factor in _LENGTHS.items() for two in ("2", "^2")}
_RATES = {"1/s": 1.0, "rad/s": 1.0}
_ANGLES = {"rad": 1.0, "deg": math.pi / 180.0}
_NUMBERS = {"": 1.0, "1": 1.0, "%": 0.01}
_UNITS = {
    "x": _LENGTHS, "y": _LENGTHS, "z": _LENGTHS, "d": _LENGTHS, "a": _LENGTHS, "b": _LENGTHS, "area": _AREAS,
    "strain": _NUMBERS, "deformation": _NUMBERS, "angle": _ANGLES, "treading": _RATES,
}  # fmt: skip
"""Factors to SI units of each quantity, by unit."""
SHAPES = ("strain", "deformation", "angle", "treading")
"""Measured quantities that depend on the shape."""
_WITH_ERRORS = ("area", *SHAPES)
_HEAD = re.compile(r"\s*([^\[\]()]*?)\s*(?:[\[(]\s*(.*?)\s*[\])])?\s*")
_COMMA = re.compile(r"^(\s*[-+]?\d*),(\d*(?:[eE][-+]?\d+)?\s*)$")
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Measured:
    """Measured bodies.

    Parameters
    ----------
    file
        The table, for messages.
    columns
        Values in SI units by name, (n,): x, y, z (place), d (diameter at rest), area (of the outline),
        strain ((a − b)/√(ab) of its semi-axes), deformation (1 − 2√(πA)/P), angle (of its long axis with the
        normal of the plane) and treading (angular velocity of the surface); area and
        shapes with their standard errors, ``strainError``. NaN where a value is missing.
    ids
        Numbers or names of the bodies, (n,).
    groups
        Group of each body, (n,); None without groups.
    faults
        Why bodies are left out, (n,), empty for the others.
    conditions
        Those of the measurement, as far as its file has them.
    """

    file: str
    columns: Mapping[str, Floats]
    ids: NDArray[Any]
    groups: NDArray[Any] | None = None
    faults: NDArray[Any] | None = None
    conditions: Conditions | None = None

    @property
    def n(self) -> int:
        """Number of bodies."""
        return len(self.ids)

    @property
    def shapes(self) -> tuple[str, ...]:
        """Names of the measured quantities of the shape."""
        return tuple(name for name in SHAPES if name in self.columns)

    @property
    def size(self) -> str:
        """Name of the measured size, ``d`` or ``area``."""
        return "d" if "d" in self.columns else "area"

    @property
    def diameters(self) -> Floats:
        """Diameters at rest, or of circles of the measured areas, (n,), m."""
        return self.of("d") if self.size == "d" else 2.0 * np.sqrt(self.of("area") / np.pi)

    def of(self, name: str) -> Floats:
        """Return a column; NaN if there is none."""
        return self.columns.get(name, np.full(self.n, np.nan))

    def take(self, rows: slice) -> Measured:
        """Return some of the bodies."""
        columns = {name: column[rows] for name, column in self.columns.items()}
        groups, faults = (None if a is None else a[rows] for a in (self.groups, self.faults))
        return replace(self, columns=columns, ids=self.ids[rows], groups=groups, faults=faults)

    def with_errors(self, error: float) -> Measured:
        """Return the bodies with a standard error of the shapes without one, in their SI units."""
        errors = {f"{name}Error": np.full(self.n, error) for name in self.shapes}
        return replace(self, columns={**errors, **self.columns})


def read_all(files: Sequence[Path], by: str | None = None, error: float | None = None) -> Measured:
    """Read tables of bodies that were measured under the same conditions, see :func:`read_measured`.

    ``by`` may also be ``file``.

    Raises
    ------
    InputError
        If one cannot be read, or their columns or conditions differ.
    """
    tables = [read_measured(file, None if by == "file" else by, error) for file in files]
    if len(tables) == 1 and by != "file":
        return tables[0]
    first = tables[0]
    for other in tables[1:]:
        if other.columns.keys() != first.columns.keys() or not _alike(first.conditions, other.conditions):
            raise InputError(
                f"{other.file} has other columns or conditions than {first.file}. Fit each alone."
            )
    groups = [np.full(table.n, Path(table.file).stem) for table in tables]
    if by != "file":
        groups = [table.groups for table in tables if table.groups is not None]
    return Measured(
        ", ".join(table.file for table in tables),
        {name: np.concatenate([table.columns[name] for table in tables]) for name in first.columns},
        np.concatenate([[f"{Path(table.file).stem}/{k}" for k in table.ids] for table in tables]),
        np.concatenate(groups) if groups else None,
        np.concatenate([np.full(t.n, "", dtype=object) if t.faults is None else t.faults for t in tables]),
        first.conditions,
    )


def _alike(a: Conditions | None, b: Conditions | None) -> bool:
    """Return whether conditions agree within 1 %."""
    if a is None or b is None:
        return a is b
    return bool(np.allclose(a[:3], b[:3], rtol=0.01, equal_nan=True))


def read_measured(
    table: PathLike[str] | str | Mapping[str, ArrayLike], by: str | None = None, error: float | None = None
) -> Measured:
    """Read a table of measured bodies.

    Parameters
    ----------
    table
        A ``.csv`` file whose heads have units, ``d [um]``, with commas, semicolons or tabs between cells;
        decimals may have commas beside the latter two. A file of dclab, ``.rtdc`` or ``.tsv``; the
        ``_evaluated.csv`` of shear flow deformation cytometry; or arrays in SI units by the names of
        :class:`Measured`.
    by
        Column by which bodies are grouped; of an ``.rtdc`` file, ``sample``.
    error
        Standard error, in SI units, of the shapes without one; by default, of files with a size of pixels,
        that of outlines through these.

    Raises
    ------
    InputError
        If the file cannot be read; if a unit is missing or unknown, a column that is needed is missing, or a
        cell is no number.
    """
    if error is not None and not 0.0 < error < math.inf:
        raise InputError(f"-error {error:g}: a number > 0 is needed.")
    if isinstance(table, Mapping):
        columns = {name: np.asarray(values) for name, values in table.items()}
        return _finish(_checked("measured", columns, by), error)
    path = Path(table)
    if not path.is_file():
        raise InputError(f"{path}: no such file. Needed: a table of measured bodies.")
    return _finish(_of_rtdc(path, by, error) if path.suffix == ".rtdc" else _read_text(path, by), error)


def _finish(measured: Measured, error: float | None) -> Measured:
    """Return bodies with errors, and with the fault of a deformation alone that is too small."""
    faults = np.full(measured.n, "", dtype=object) if measured.faults is None else measured.faults
    if measured.shapes == ("deformation",):
        faults[measured.of("deformation") < LEAST] = f"its deformation is below {LEAST:g}"
    measured = replace(measured, faults=faults)
    return measured if error is None else measured.with_errors(error)


def _read_text(path: Path, by: str | None) -> Measured:
    """Read a table of text; see :func:`read_measured`."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    if path.suffix == ".tsv":
        return _of_tsv(path, *_split_tsv(path, lines))
    separator = max(",;\t", key=lines[0].count) if lines else ","
    rows = [row for row in csv.reader(lines, delimiter=separator) if any(cell.strip() for cell in row)]
    if separator != ",":
        # A decimal comma.
        rows[1:] = [[_COMMA.sub(r"\1.\2", cell) for cell in row] for row in rows[1:]]
    if len(rows) < 2:
        raise InputError(f"{path}: no rows. Needed: a line of heads and a line for each body.")
    if {"long_axis", "short_axis", "radial_position"} <= {*rows[0]}:
        return _of_evaluation(path, rows)
    heads, factors = [], []
    for head in rows[0]:
        name, factor = ("by", 1.0) if head.strip() == by else _factor(path, head)
        heads.append(name)
        factors.append(factor)
    if twice := next((name for name in heads if name and heads.count(name) > 1), ""):
        raise InputError(f"{path}: two columns {twice}. Needed: one.")
    return _checked(str(path), _numbers(path, heads, rows[1:], 2, factors), by)


def _factor(path: Path, head: str) -> tuple[str, float]:
    """Return name and factor to SI units of a column by its head; no name if it is not used."""
    match = _HEAD.fullmatch(head)
    name, unit = (match[1], match[2]) if match else (head.strip(), None)
    quantity = name.removesuffix("Error")
    if name == "id":
        return name, 1.0
    if quantity not in (_WITH_ERRORS if name.endswith("Error") else _UNITS):
        meant = closest(name, [*_UNITS, *(f"{q}Error" for q in _WITH_ERRORS)])
        if meant and meant.lower() == name.lower():
            raise InputError(f"{path}: a column {name}. Did you mean '{meant}'?")
        hint = f" Is it '{meant}'?" if meant else ""
        log.info("%s: the column '%s' is not used.%s", path, head.strip(), hint)
        return "", 1.0
    allowed = _UNITS[quantity]
    text = (unit or "").replace("µ", "u").replace("μ", "u").replace("²", "2").replace("°", "deg")
    if text not in allowed:
        shown = ", ".join(f"[{unit}]" for unit in allowed if unit)
        state = f"has the unit [{unit}]" if unit else "has no unit"
        raise InputError(f"{path}: the column {name} {state}. Allowed: {shown}.")
    return name, allowed[text]


def _numbers(
    path: Path, heads: Sequence[str], rows: Sequence[Sequence[str]], first: int, factors: Sequence[float]
) -> dict[str, NDArray[Any]]:
    """Return the columns with a name; ``first`` is the line of the first row."""
    columns: dict[str, NDArray[Any]] = {}
    for line, row in enumerate(rows, first):
        if len(row) != len(heads):
            raise InputError(f"{path}: line {line} has {len(row)} cells, the heads are {len(heads)}.")
    for k, (name, factor) in enumerate(zip(heads, factors, strict=True)):
        cells = [row[k].strip() for row in rows]
        if name in ("id", "by"):
            columns[name] = np.array(cells)
        elif name:
            values = np.empty(len(cells))
            for i, cell in enumerate(cells):
                try:
                    values[i] = factor * float(cell or "nan")
                except ValueError:
                    raise InputError(
                        f"{path}: line {first + i}: {name} is '{cell}'. Needed: a number."
                    ) from None
            columns[name] = values
    return columns


def _checked(file: str, columns: dict[str, NDArray[Any]], by: str | None = None) -> Measured:
    """Return measured bodies, with size and strain by the semi-axes a and b if these are measured."""
    sizes = {len(column) for column in columns.values()}
    if len(sizes) > 1:
        raise InputError(f"{file}: columns of different lengths, {', '.join(map(str, sorted(sizes)))}.")
    n = next(iter(sizes), 0)
    ids = columns.pop("id", np.arange(n))
    groups = columns.pop("by", columns.pop(by, None) if by else None)
    if by and groups is None:
        raise InputError(f"{file}: no column {by}, by which bodies are grouped (-by).")
    values = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    if {"a", "b"} <= values.keys():
        a, b = values.pop("a"), values.pop("b")
        product = np.where((a > 0.0) & (b > 0.0), a * b, np.nan)
        values.setdefault("strain", np.abs(a - b) / np.sqrt(product))
        values.setdefault("area", np.pi * product)
    if "angle" in values:
        values["angle"] = _acute(file, values["angle"])
    measured = Measured(file, values, ids, None if groups is None else groups.astype(str))
    if n == 0 or not ({"d", "area"} & values.keys()):
        raise InputError(
            f"{file}: no size of the bodies. Needed: a column d [um], area [um2], or a [um] and b [um]."
        )
    if not measured.shapes:
        raise InputError(f"{file}: no measured shape. Needed: a column {', '.join(SHAPES)}, or a and b.")
    for name, column in values.items():
        wrong = column <= 0.0 if name in ("d", "area") or name.endswith("Error") else np.isinf(column)
        if wrong.any():
            raise InputError(
                f"{file}: {name} of body {ids[np.argmax(wrong)]} is {column[np.argmax(wrong)]:g}"
                f"{f', and of {wrong.sum() - 1} others' if wrong.sum() > 1 else ''}. Needed: a number"
                f"{' > 0' if (column <= 0.0).any() else ''}."
            )
    return measured


def _acute(file: str, angle: Floats) -> Floats:
    """Return the angles of lines, without a sign, from 0 to π/2.

    Raises
    ------
    InputError
        If they are probably degrees.
    """
    if (largest := float(np.nanmax(np.abs(angle), initial=0.0))) > _TURN:
        raise InputError(f"{file}: an angle of {largest:g} rad. Allowed: up to 2π; or degrees, angle [deg].")
    return np.asarray(np.abs((angle + 0.5 * np.pi) % np.pi - 0.5 * np.pi))


# ---------------------------------------------------------------------------------------------------------
# Files of devices


def _of_rtdc(path: Path, by: str | None, error: float | None) -> Measured:
    """Return the events of a file of dclab, with the errors by pixels if no other is given."""
    if by not in (None, "sample"):
        raise InputError(f"{path}: -by {by}. Allowed of files .rtdc: sample, or file.")
    events = read_rtdc(path)
    columns = {"area": events.area, "deformation": events.deformation}
    if not math.isfinite(events.pixel):
        _log_pixels(path)
    elif error is None:
        noise = pixel_noise(events.area, events.pixel)
        columns |= dict(zip(("deformationError", "areaError"), noise, strict=True))
    measured = _checked(str(path), columns)
    groups = np.full(measured.n, events.sample) if by else None
    return replace(measured, groups=groups, conditions=events.conditions)


def _log_pixels(path: Path) -> None:
    log.warning(
        "%s: no size of pixels, whose effect remains in the deformations; moduli are too small.", path
    )


def _split_tsv(path: Path, lines: Sequence[str]) -> tuple[list[str], NDArray[Any]]:
    """Return names and values of a table that dclab exported; the last line but one of the heads has them."""
    heads = [line for line in lines if line.startswith("#")]
    if len(heads) < 2:
        raise InputError(f"{path}: not a table of dclab. Needed: its two lines of heads, beginning with #.")
    names = heads[-2].removeprefix("#").strip().split("\t")
    rows = [line.split("\t") for line in lines if line.strip() and not line.startswith("#")]
    columns = _numbers(path, names, rows, len(heads) + 1, [1.0] * len(names))
    return names, np.array([columns[name] for name in names])


def _of_tsv(path: Path, names: Sequence[str], values: NDArray[np.generic]) -> Measured:
    columns = dict(zip(names, values, strict=True))
    if missing := [name for name in ("area_um", "deform") if name not in columns]:
        raise InputError(f"{path}: no feature {missing[0]}. Needed: area_um and deform.")
    _log_pixels(path)
    return _checked(str(path), {"area": 1e-12 * columns["area_um"], "deformation": columns["deform"]})


def _of_evaluation(path: Path, rows: Sequence[Sequence[str]]) -> Measured:
    """Return the cells of an evaluation of shear flow deformation cytometry: means of all frames of a cell.

    The axes are whole ones, µm; the second line has units.
    """
    wanted = ("radial_position", "long_axis", "short_axis", "angle", "cell_id")
    heads = [name if name in wanted else "" for name in rows[0]]
    if missing := [name for name in wanted[:4] if name not in heads]:
        raise InputError(f"{path}: no column {missing[0]}, which the evaluation of the device writes.")
    columns = _numbers(path, heads, rows[2:], 3, [1.0] * len(heads))
    cells, index = np.unique(columns.get("cell_id", np.arange(len(rows) - 2)), return_inverse=True)
    frames = np.bincount(index)

    def mean(values: NDArray[np.generic]) -> Floats:
        return np.bincount(index, values) / frames

    a, b = mean(0.5e-6 * columns["long_axis"]), mean(0.5e-6 * columns["short_axis"])
    angle = mean(_acute(str(path), np.radians(columns["angle"])))
    y = mean(1e-6 * columns["radial_position"])
    return _checked(str(path), {"id": cells.astype(np.int64), "y": y, "a": a, "b": b, "angle": angle})
