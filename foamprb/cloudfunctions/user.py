"""Cloud functions of users: a row of numbers at each write time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from foamprb.cloud.forces import class_of_entries
from foamprb.cloudfunctions.base import CloudFunction, Memory, ObservedCloud, append, table
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.errors import InputError
from foamprb.results.tables import write_table


@dataclass(frozen=True)
class UserFunction(CloudFunction):
    """A cloud function that :func:`add_cloud_function` has added."""

    arrays: ClassVar = {"history": table}
    name: ClassVar[str]
    columns: ClassVar[tuple[str, ...]]
    evaluate: ClassVar[Callable[..., Sequence[float]]]

    def __reduce__(self) -> Any:
        """Return how another process, which has run the same file, restores it."""
        return _restored, (self.name, {field.name: getattr(self, field.name) for field in fields(self)})

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return an empty table; raise InputError if the function fails at the start."""
        self._row(cloud)
        return {"history": np.empty((0, 1 + len(self.columns)))}

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the table, with one more row."""
        history = append(memory, "history", (cloud.time, *self._row(cloud)))
        names = ("time", *self.columns)
        write_table(folder / f"{self.name}.csv", dict(zip(names, history.T, strict=True)))

    def _row(self, cloud: ObservedCloud) -> list[float]:
        entries = [getattr(self, field.name) for field in fields(self)]
        try:
            numbers = [float(number) for number in type(self).evaluate(cloud, *entries)]
            return [number for number, _ in zip(numbers, self.columns, strict=True)]
        except Exception as error:
            what = f"{self.name} must return {', '.join(self.columns)}"
            raise InputError(f"{what}: {type(error).__name__}: {error}.") from error


def _restored(name: str, values: Mapping[str, float]) -> CloudFunction:
    return FUNCTIONS[name](**values)


def add_cloud_function(
    name: str, evaluate: Callable[..., Sequence[float]], columns: Sequence[str]
) -> type[UserFunction]:
    """Add a cloud function, for selection by its name as a ``type`` in ``cloudFunctions``; return its class.

    Parameters
    ----------
    name
        A word.
    evaluate
        ``evaluate(cloud, *entries)`` returns a number for each column, from an
        :class:`~foamprb.extend.ObservedCloud`. It is called once before the start, and at each write time.
        Its last parameters are the entries of the dictionary, all numbers. It is not compiled.
    columns
        Names of the columns of its table, after ``time``.

    Raises
    ------
    ValueError
        If the name is taken, or the function is not plain.
    """
    if name in FUNCTIONS:
        raise ValueError(f"the cloud function {name} exists already")
    namespace = {"evaluate": staticmethod(evaluate), "name": name, "columns": tuple(columns)}
    kind = class_of_entries(f"cloud function {name}", evaluate, ("cloud",), UserFunction, namespace)
    FUNCTIONS[name] = kind
    return kind
