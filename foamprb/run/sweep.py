"""Study of a case: a run for each combination of values of some entries, with one flow for all."""

from __future__ import annotations

import logging
import math
import os
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np

from foamprb.errors import InputError, RunStopped, suggestion
from foamprb.flow.base import Flow
from foamprb.flow.read.source import FlowSource
from foamprb.results.folder import ResultsFolder
from foamprb.results.reading import read_bytes, reading
from foamprb.results.record import read_record
from foamprb.run.job import Job, prepare, time_of_fluid
from foamprb.run.loop import execute_until_signal
from foamprb.settings.settings import read_settings
from foamprb.settings.solution import StartFrom

log = logging.getLogger("foamprb")

_KEYS = ("case", "dict", "time", "region", "entries")
_RANGE = ("from", "to", "number", "spacing")
_SPACINGS = ("linear", "log")
_MOST_RUNS, _MOST_BYTES = 100_000, 16 << 20


@dataclass(frozen=True)
class Study:
    """Runs of one case whose settings differ in some entries.

    Parameters
    ----------
    file
        File of the study.
    case, dictionary, time, region
        As the options of ``foamprb run``.
    values
        Values of each entry, by its path: ``"solution/deltaT"``.
    """

    file: Path
    case: Path
    dictionary: Path | None
    time: str | None
    region: str
    values: Mapping[str, tuple[object, ...]]

    def __len__(self) -> int:
        return math.prod(map(len, self.values.values()))

    def overrides(self, number: int) -> dict[str, object]:
        """Return the values of the entries in a run, from 1 on; the last entry changes first."""
        overrides, left = {}, number - 1
        for path, values in reversed(list(self.values.items())):
            left, k = divmod(left, len(values))
            overrides[path] = values[k]
        return {path: overrides[path] for path in self.values}

    def folder(self, number: int) -> Path:
        """Return the folder of a run's results: beside the file, ``<name of the file>/<number>``."""
        digits = max(3, len(str(len(self))))
        return self.file.with_suffix("") / f"{number:0{digits}d}"

    @property
    def short_names(self) -> dict[str, str]:
        """For each entry the shortest end of its path that no other one has."""
        names = {}
        for path in self.values:
            words = path.split("/")
            ends = ("/".join(words[-k:]) for k in range(1, len(words) + 1))
            others = [f"/{other}" for other in self.values if other != path]
            names[path] = next(e for e in ends if not any(o.endswith(f"/{e}") for o in others) or e == path)
        return names

    def described(self, number: int) -> str:
        """Return the values of a run as text: ``shearModulus 10, deltaT 1e-05``."""
        names, values = self.short_names, self.overrides(number)
        return ", ".join(f"{names[path]} {_text(value)}" for path, value in values.items())


def read_study(path: Path) -> Study:
    """Read a study, in TOML.

    Paths in it are relative to the file. Each entry of ``entries`` is a list of values, or a range ``{ from =
    1, to = 100, number = 5, spacing = "log" }``.

    Raises
    ------
    InputError
        If the file cannot be read, or is not a study.
    """
    with reading(path, "is no study"):
        return _study(path, tomllib.loads(read_bytes(path, _MOST_BYTES).decode()))


def _study(path: Path, document: dict[str, Any]) -> Study:
    """Return the study of a document; see :func:`read_study`."""
    for key in document:
        if key not in _KEYS:
            raise InputError(f"{path}: {key} is not known. {suggestion(key, _KEYS)}")
    words = {key: document.get(key) for key in ("case", "dict", "time", "region")}
    for key, word in words.items():
        if word is not None and not isinstance(word, str):
            raise InputError(f'{path}: {key} is {word!r}. Allowed: a text in quotes, such as "a".')
    entries = document.get("entries")
    if not isinstance(entries, dict) or not entries:
        raise InputError(
            f'{path}: no entries. Needed: [entries], and in it "solution/deltaT" = [1e-5, 2e-5], for example.'
        )
    values: dict[str, tuple[object, ...]] = {}
    for name, value in _flat(entries):
        if name in values:
            raise InputError(f"{path}: entries has {name} twice, in quotes and as a table. Keep one.")
        values[name] = _values(path, name, value)
    study = Study(
        path,
        path.parent / (words["case"] or "."),
        None if words["dict"] is None else path.parent / words["dict"],
        words["time"],
        words["region"] or "",
        values,
    )
    if len(study) > _MOST_RUNS:
        raise InputError(f"{path}: {len(study)} combinations. Allowed: up to {_MOST_RUNS} runs.")
    return study


def _flat(entries: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the entries by their paths; tables of TOML are dictionaries of the settings."""
    for key, value in entries.items():
        if isinstance(value, dict) and not set(value) <= set(_RANGE):
            yield from _flat(value, f"{above}{key}/")
        else:
            yield f"{above}{key}", value


def _values(path: Path, name: str, value: object) -> tuple[object, ...]:
    where = f"{path}: {name}"
    if isinstance(value, list):
        if not value:
            raise InputError(f"{where} has no values.")
        return tuple(value)
    if not isinstance(value, dict):
        return (value,)
    spacing, number = value.get("spacing", "linear"), value.get("number")
    low, high = value.get("from"), value.get("to")
    if spacing not in _SPACINGS:
        raise InputError(f"{where}: spacing is {spacing!r}. {suggestion(str(spacing), _SPACINGS)}")
    if not (_is_number(low) and _is_number(high)):
        raise InputError(f"{where}: a range needs from and to, two numbers; there is {value}.")
    if not isinstance(number, int) or isinstance(number, bool) or not 2 <= number <= _MOST_RUNS:
        raise InputError(f"{where}: number is {number!r}. Allowed: an integer from 2 to {_MOST_RUNS}.")
    if spacing == "linear":
        return tuple(np.linspace(low, high, number).tolist())
    if min(low, high) <= 0.0:
        raise InputError(f"{where}: a range with the spacing log needs from and to above 0.")
    return tuple(float(f"{x:.12g}") for x in np.geomspace(low, high, number).tolist())


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _text(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    return f"({' '.join(map(_text, value))})" if isinstance(value, list) else str(value)


def execute_run(
    study: Study,
    number: int,
    flows: dict[FlowSource, Flow],
    start_from: StartFrom = "latestTime",
    threads: int | None = None,
    outside_libs: bool = False,
) -> Job:
    """Execute a run of a study, or continue it; its log is the file ``log.foamprb`` in its folder.

    Parameters
    ----------
    study, number
        The study, and the number of the run, from 1 on.
    flows
        Flows that earlier runs have read, see :func:`foamprb.run.job.prepare`.
    start_from
        ``"startTime"`` to start over.
    threads, outside_libs
        See :func:`foamprb.run.job.prepare`.

    Raises
    ------
    InputError, RunStopped
        If the run cannot start or has to end early; or if its folder holds a run with other values.
    RunInterrupted
        If a signal stopped it.
    """
    folder, overrides = study.folder(number), study.overrides(number)
    source = FlowSource(region=study.region)
    folder.mkdir(parents=True, exist_ok=True)
    with _logged_to(folder / "log.foamprb"):
        try:
            job = prepare(
                study.case, study.time, study.dictionary, threads, source, precompile=True,
                outside_libs=outside_libs, output=folder, overrides=overrides, flows=flows,
            )  # fmt: skip
            if start_from == "latestTime":
                _require_same(job.folder, job)
            execute_until_signal(job, start_from)
        except (InputError, RunStopped) as error:
            log.error("%s", error)
            raise
    return job


def require_entries(study: Study, outside_libs: bool = False) -> None:
    """Check the settings of the first and the last run; a misspelt entry is wrong in both.

    Raises
    ------
    InputError
        If both are wrong: the mistakes of the first.
    """
    numbers, faults = {1, len(study)}, []
    with _logged_to(Path(os.devnull)):
        for number in sorted(numbers):
            of_run = study.overrides(number)
            try:
                read_settings(
                    study.case,
                    study.dictionary,
                    study.region,
                    time_of_fluid(study.time),
                    outside_libs,
                    of_run,
                )
            except InputError as fault:
                faults.append(fault)
    if len(faults) == len(numbers):
        raise faults[0]


def _require_same(folder: ResultsFolder, job: Job) -> None:
    """Refuse to continue a run whose entries had other values."""
    try:
        before = read_record(folder.record).get("settings", {}).get("overrides")
    except InputError:
        # It is written again.
        return
    if before is not None and before != job.settings.overrides:
        raise InputError(
            f"{folder.path}: a run with other values of the entries is here ({before}). "
            "-overwrite replaces it; or give the study another name."
        )


@contextmanager
def _logged_to(path: Path) -> Iterator[None]:
    """Redirect the log to a file."""
    handlers = log.handlers[:]
    handler = logging.FileHandler(path, mode="a", encoding="utf-8")
    log.handlers[:] = [handler]
    try:
        yield
    finally:
        log.handlers[:] = handlers
        handler.close()
