"""Study of a case: runs whose values of some entries are combined or drawn, with one flow for all."""

from __future__ import annotations

import logging
import math
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution
from foamprb.dictionary.grammar import parse_dictionary
from foamprb.dictionary.overrides import override
from foamprb.dictionary.schema import read_entries
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

_KEYS = ("case", "dict", "time", "region", "design", "entries")
_RANGE = ("from", "to", "number", "spacing")
_SPACINGS = ("linear", "log")
_DESIGN = ("type", "number", "seed")
_DESIGNS = ("latinHypercube", "sobol")
_MOST_RUNS, _MOST_BYTES = 100_000, 16 << 20

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Study:
    """Runs of one case whose settings differ in some entries.

    Parameters
    ----------
    file
        File of the study.
    case, dictionary, time, region
        As the options of ``foamprb run``.
    paths
        Paths of the entries: ``"solution/deltaT"``.
    rows
        Values of the entries in each run.
    """

    file: Path
    case: Path
    dictionary: Path | None
    time: str | None
    region: str
    paths: tuple[str, ...]
    rows: Sequence[tuple[object, ...]]

    def __len__(self) -> int:
        return len(self.rows)

    def overrides(self, number: int) -> dict[str, object]:
        """Return the values of the entries in a run, from 1 on."""
        return dict(zip(self.paths, self.rows[number - 1], strict=True))

    def folder(self, number: int) -> Path:
        """Return the folder of a run's results: beside the file, ``<name of the file>/<number>``."""
        # A study with more runs finds these.
        return self.file.with_suffix("") / f"{number:03d}"

    @property
    def short_names(self) -> dict[str, str]:
        """For each entry the shortest end of its path that no other one has."""
        names = {}
        for path in self.paths:
            words = path.split("/")
            ends = ("/".join(words[-k:]) for k in range(1, len(words) + 1))
            others = [f"/{other}" for other in self.paths if other != path]
            names[path] = next(e for e in ends if not any(o.endswith(f"/{e}") for o in others) or e == path)
        return names

    def described(self, number: int) -> str:
        """Return the values of a run as text: ``shearModulus 10, deltaT 1e-05``."""
        names, values = self.short_names, self.overrides(number)
        return ", ".join(f"{names[path]} {_text(value)}" for path, value in values.items())


def read_study(path: Path) -> Study:
    """Read a study, in TOML.

    Paths in it are relative to the file. Without a design, each entry of ``entries`` is a list of values, or
    a range ``{ from = 1, to = 100, number = 5, spacing = "log" }``, and the runs are all combinations. With
    one, entries have distributions from which the runs are drawn.

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
    values: dict[str, object] = {}
    for name, value in _flat(entries):
        if name in values:
            raise InputError(f"{path}: entries has {name} twice, in quotes and as a table. Keep one.")
        values[name] = value
    rows: Sequence[tuple[object, ...]]
    if "design" in document:
        rows = _drawn(path, document["design"], values)
    else:
        lists = [_values(path, name, value) for name, value in values.items()]
        _require_few(path, math.prod(map(len, lists)), "combinations")
        # The last entry changes first.
        rows = list(product(*lists))
    return Study(
        path,
        path.parent / (words["case"] or "."),
        None if words["dict"] is None else path.parent / words["dict"],
        words["time"],
        words["region"] or "",
        tuple(values),
        rows,
    )


def _require_few(path: Path, n: int, what: str) -> None:
    if n > _MOST_RUNS:
        raise InputError(f"{path}: {n} {what}. Allowed: up to {_MOST_RUNS} runs.")


def _flat(entries: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the entries by their paths; tables of TOML are dictionaries of the settings."""
    for key, value in entries.items():
        table = isinstance(value, dict) and not isinstance(value.get("distribution"), str)
        if table and not set(value) <= set(_RANGE):
            yield from _flat(value, f"{above}{key}/")
        else:
            yield f"{above}{key}", value


def _values(path: Path, name: str, value: object) -> tuple[object, ...]:
    """Return the values of an entry that is combined with the others."""
    where = f"{path}: {name}"
    if isinstance(value, list):
        if not value:
            raise InputError(f"{where} has no values.")
        return tuple(value)
    if not isinstance(value, dict):
        return (value,)
    if "distribution" in value:
        raise InputError(f"{where} has a distribution. Needed: [design], with the number of the runs.")
    low, high, log_spacing = _range(where, value)
    number = value.get("number")
    if not _is_count(number, 2):
        raise InputError(f"{where}: number is {number!r}. Allowed: an integer from 2 to {_MOST_RUNS}.")
    if not log_spacing:
        return tuple(np.linspace(low, high, number).tolist())
    return tuple(float(f"{x:.12g}") for x in np.geomspace(low, high, number).tolist())


def _range(where: str, value: Mapping[str, Any]) -> tuple[float, float, bool]:
    """Return the ends of a range, and whether its spacing is logarithmic."""
    low, high, spacing = value.get("from"), value.get("to"), value.get("spacing", "linear")
    if spacing not in _SPACINGS:
        raise InputError(f"{where}: spacing is {spacing!r}. {suggestion(str(spacing), _SPACINGS)}")
    if not (_is_number(low) and _is_number(high)):
        raise InputError(f"{where}: a range needs from and to, two numbers; there is {value}.")
    if spacing == "log" and min(low, high) <= 0.0:
        raise InputError(f"{where}: a range with the spacing log needs from and to above 0.")
    return low, high, spacing == "log"


def _drawn(path: Path, design: object, entries: Mapping[str, object]) -> list[tuple[object, ...]]:
    """Return the values of a design, a row for each run.

    A Sobol design is the one of Saltelli et al., Comput. Phys. Commun. 181 (2010) 259: for each of ``number``
    rows a row a, the same with the value of each entry in turn from a row b, and b.
    """
    from scipy.stats import qmc

    where = f"{path}: design"
    if not isinstance(design, dict):
        raise InputError(f"{where} is {design!r}. Needed: a table with {', '.join(_DESIGN)}.")
    for key in design:
        if key not in _DESIGN:
            raise InputError(f"{where}: {key} is not known. {suggestion(key, _DESIGN)}")
    kind, number, seed = design.get("type"), design.get("number"), design.get("seed", 0)
    if kind not in _DESIGNS:
        raise InputError(f"{where}: type is {kind!r}. {suggestion(str(kind), _DESIGNS)}")
    if not _is_count(number, 2) or (kind == "sobol" and number & (number - 1)):
        power = ", a power of 2" if kind == "sobol" else ""
        raise InputError(f"{where}: number is {number!r}. Allowed: an integer from 2 to {_MOST_RUNS}{power}.")
    if not isinstance(seed, int) or isinstance(seed, bool) or seed < 0:
        raise InputError(f"{where}: seed is {seed!r}. Allowed: an integer >= 0.")
    samplers = [_sampler(f"{path}: {name}", value) for name, value in entries.items()]
    varied = [
        k
        for k, value in enumerate(entries.values())
        if isinstance(value, dict) or (isinstance(value, list) and len(value) > 1)
    ]
    d, random = len(varied), np.random.default_rng(seed)
    if not varied:
        raise InputError(f"{where}: no entry varies. Needed: a range, a distribution or a list of values.")
    if kind == "latinHypercube":
        shares = qmc.LatinHypercube(d, rng=random).random(number)
    else:
        _require_few(path, number * (d + 2), "runs of a Sobol design")
        both = qmc.Sobol(2 * d, rng=random).random(number)
        a, b = both[:, None, :d], both[:, None, d:]
        # Row a, then a with one value of b each, then b.
        of_b = np.concatenate([np.zeros((1, d)), np.eye(d), np.ones((1, d))]) > 0.0
        shares = np.where(of_b, b, a).reshape(-1, d)
    every = np.zeros((len(shares), len(entries)))
    every[:, varied] = shares
    columns = [sample(share) for sample, share in zip(samplers, every.T, strict=True)]
    return list(zip(*columns, strict=True))


def _sampler(where: str, value: object) -> Callable[[Floats], list[object]]:
    """Return the function that gives the values of an entry for shares from 0 to 1, its quantiles."""
    if isinstance(value, list):
        if not value:
            raise InputError(f"{where} has no values.")
        # All are equally likely.
        return lambda shares: [value[int(k)] for k in np.minimum(shares * len(value), len(value) - 1)]
    if not isinstance(value, dict):
        return lambda shares: [value] * len(shares)
    if "distribution" in value:
        return _rounded(_distribution(where, value).quantile)
    if "number" in value:
        raise InputError(f"{where}: a range with a number in a design, which draws the values. Omit number.")
    low, high, log_spacing = _range(where, value)
    if low == high:
        raise InputError(f"{where}: from and to are both {low:g}. Needed: two numbers, or one value alone.")
    if log_spacing:
        return _rounded(lambda shares: low * (high / low) ** shares)
    return _rounded(lambda shares: low + shares * (high - low))


def _rounded(quantile: Callable[[Floats], Floats]) -> Callable[[Floats], list[object]]:
    return lambda shares: [float(f"{x:.12g}") for x in quantile(shares).tolist()]


def _distribution(where: str, value: Mapping[str, object]) -> Distribution:
    """Return the distribution ``{ distribution = "normal", expectation = 1, … }``."""
    name = str(value["distribution"])
    if name not in DISTRIBUTIONS:
        raise InputError(f"{where}: distribution is {name!r}. {suggestion(name, DISTRIBUTIONS)}")
    entries = {key: item for key, item in value.items() if key != "distribution"}
    texts = override(parse_dictionary("", Path(where), Path()), entries)
    text = " ".join(f"{key} {words}" for key, words in texts.items())
    return read_entries(DISTRIBUTIONS[name], parse_dictionary(text, Path(where), Path()))


def _is_count(value: object, least: int) -> TypeGuard[int]:
    return isinstance(value, int) and not isinstance(value, bool) and least <= value <= _MOST_RUNS


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
    cache: Path | None = None,
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
    cache
        See :class:`~foamprb.flow.read.source.FlowSource`.

    Raises
    ------
    InputError, RunStopped
        If the run cannot start or has to end early; or if its folder holds a run with other values.
    RunInterrupted
        If a signal stopped it.
    """
    folder, overrides = study.folder(number), study.overrides(number)
    source = FlowSource(region=study.region, cache=cache)
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
    if path.exists() and not path.is_file() and path != Path(os.devnull):
        raise InputError(f"{path}: no regular file, so that the log of the run cannot be written. Remove it.")
    handlers = log.handlers[:]
    handler = logging.FileHandler(path, mode="a", encoding="utf-8")
    log.handlers[:] = [handler]
    try:
        yield
    finally:
        log.handlers[:] = handlers
        handler.close()
