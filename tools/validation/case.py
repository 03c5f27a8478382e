"""Result of a validation case: rows of a table, figures as data, and remarks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

Kind = Literal["equations", "own", "others", "measured"]
"""Of a reference: the same equations by another method, a result of ours by other means, theory or a
computation that others printed, or a measurement."""


class Row(NamedTuple):
    """One number of ours beside its reference."""

    quantity: str
    ours: float | None
    reference: float | None
    source: str
    """Of the reference."""
    allowed: float | None = None
    """Largest allowed difference; None for a row for information only."""
    relative: bool = False
    """Whether differences are relative to the reference."""
    note: str = ""
    kind: Kind = "equations"
    """Of the reference."""
    reference_error: float | None = None
    """Half of the width of the reference's error bar, in its unit."""
    quartiles: tuple[float, float] | None = None
    """Of the population of which the reference is the median."""
    our_error: float | None = None
    """Largest numerical error of ours, in its unit."""

    @property
    def difference(self) -> float | None:
        """Return |ours − reference|, or that over |reference|."""
        if self.ours is None or self.reference is None:
            return None
        return abs(self.ours - self.reference) / (abs(self.reference) if self.relative else 1.0)

    @property
    def verifies(self) -> bool:
        """Return whether the row must pass: a model may miss what others found, the code may not."""
        return self.kind in ("equations", "own")

    @property
    def passed(self) -> bool | None:
        """Return whether the difference is allowed; None for a row for information only."""
        if self.allowed is None:
            return None
        # A number that is not finite must fail.
        return self.difference is not None and bool(self.difference <= self.allowed)


class Curve(NamedTuple):
    """A curve of ours, or points of a reference."""

    x: Floats
    """(n,)."""
    y: Floats
    """(n,)."""
    label: str
    kind: Literal["ours", "reference", "guide"] = "ours"
    """A line, markers, or a thin grey line."""
    colour: int = 0
    """Number of the colour, shared by a curve and its reference."""


class Panel(NamedTuple):
    """One pair of axes."""

    xlabel: str
    ylabel: str
    curves: list[Curve]
    scale: Literal["linear", "log", "equal"] = "linear"


class Figure(NamedTuple):
    """Panels side by side, written as ``name.png``."""

    name: str
    caption: str
    panels: list[Panel]


class Outcome(NamedTuple):
    """All that a case found."""

    rows: list[Row]
    figures: list[Figure]
    remarks: list[str]
    """Paragraphs on where the paper and foamprb differ, and why."""


class Case(NamedTuple):
    """A validation case; its title is the first line of the function's docstring."""

    section: str
    """Of the paper, or where else it comes from."""
    run: Callable[[bool], Outcome]
    """Computes the case; with True the quick form of it."""

    @property
    def title(self) -> str:
        """Return the title of the case."""
        return (self.run.__doc__ or "").partition("\n")[0].rstrip(".")


def compared(
    x: Floats, ours: Floats, reference: Floats, labels: tuple[str, str], colour: int = 0, every: int = 1
) -> list[Curve]:
    """Return a curve of ours beside every so many points of its reference, each (n,)."""
    mark = Curve(x[::every], reference[::every], labels[1], "reference", colour)
    return [Curve(x, ours, labels[0], colour=colour), mark]


def worst(
    quantity: str,
    ours: Floats,
    reference: Floats,
    source: str,
    allowed: float,
    scale: float = 1.0,
    note: str = "",
) -> Row:
    """Return the row of the largest difference between two curves (n,), both divided by ``scale``."""
    miss = np.abs(np.asarray(ours) - reference)
    k = int(np.argmax(np.where(np.isfinite(miss), miss, np.inf)))
    return Row(quantity, float(ours[k] / scale), float(reference[k] / scale), source, allowed, note=note)


def worst_of_each(
    quantity: str, names: Sequence[str], ours: Floats, reference: Floats, source: str, most: Sequence[float]
) -> list[Row]:
    """Return a row as of :func:`worst` for each named column of curves (n, m); ``{}`` stands for its name."""
    columns = zip(names, ours.T, reference.T, most, strict=False)
    return [worst(quantity.format(name), a, b, source, allowed) for name, a, b, allowed in columns]
