"""Content of checkpoints, and checks whether a run may continue from one.

A run continues only with the physics of its start: the settings, the particles and the flow leave a
fingerprint in the checkpoint. What does not act on a particle may change: the end time, the write interval,
the number of threads. Nothing here depends on which process carries which particle.
"""

from __future__ import annotations

import logging
import math
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeAlias, TypedDict

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Snapshot
from foamprb.cloud.communicator import Rank
from foamprb.cloud.instants import PREFIX
from foamprb.cloud.measures import as_slice
from foamprb.cloud.state import VARIABLES, Particles
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.errors import InputError
from foamprb.flow.base import Flow
from foamprb.flow.timeline import Timeline
from foamprb.flow.traits import of_rows
from foamprb.results.checkpoint import (
    FUNCTIONS,
    PARTICLES,
    Checkpoint,
    Checkpoints,
    DamagedError,
    StoredCheckpoint,
)
from foamprb.results.folder import FATES, ResultsFolder
from foamprb.results.pvd import SnapshotFile, files_of, read_pvd, with_ending
from foamprb.results.reading import checked
from foamprb.settings.settings import Settings
from foamprb.settings.solution import MOST_STEPS, StartFrom

log = logging.getLogger("foamprb")

Sums: TypeAlias = list[list[float]]
Fingerprint: TypeAlias = dict[str, str | Sums]

# Settings without effect on the physics, and settings that the cloud's own fields represent.
_LEFT_OUT = ("case", "file", "name", "solution", "traction", "drag", "touching", "overrides")
_PARTICLES, _LIBS = "particles at the start", "libs/"
_MOST_NAMED = 6
_RELATIVE, _OF_LARGEST = 1e-9, 1e-13


class _Header(TypedDict):
    """Header of a checkpoint of a run."""

    step: int
    recovered: int
    reach: float
    stretch: int
    ended: bool
    series: list[tuple[float, str]]
    fingerprint: dict[str, str | Sums]
    times: list[float]


class _HeaderOfSome(_Header, total=False):
    """Header with the entries that only some have: in a transient flow, and of a run that was stopped."""

    around: list[Sums]
    stored: list[float]


def require_header(checkpoint: StoredCheckpoint) -> None:
    """Raise DamagedError if a checkpoint has not the header of a run."""
    try:
        step = checked(checkpoint.header, _HeaderOfSome, "its header")["step"]
        if not 0 <= step < MOST_STEPS:
            raise ValueError(f"its step is {step}")
    except ValueError as error:
        raise DamagedError(str(error)) from error


def fingerprint(settings: Settings, cloud: Cloud, n: int | None = None) -> Fingerprint:
    """Return texts and sums of arrays, by name, that determine the paths of a cloud before its first step.

    The sums are those of the first n particles, by default all.
    """
    texts: dict[str, Any] = {"foamprb": version("foamprb"), "solution/deltaT": cloud.dt}
    # All files of a run have the same arrays.
    texts |= {"solution/writeFields": f"({' '.join(settings.solution.writeFields)})"}
    texts |= {"solution/writePrecision": settings.solution.writePrecision}
    for field in fields(settings):
        if field.name not in _LEFT_OUT:
            texts |= _leaves(field.name, getattr(settings, field.name))
    models = dict(_leaves("models", cloud.models))
    # These the settings have by their names.
    texts |= {n: v for n, v in models.items() if not n.startswith(("models/forces", "models/surroundings"))}
    texts |= _leaves("limits", cloud.limits)
    for patch, interaction in zip(cloud.flow.patches, cloud.interactions, strict=True):
        texts |= {f"patch {patch.name}": interaction}
    marks: Fingerprint = {name: str(value) for name, value in texts.items()}
    marks[f"{_PARTICLES}/number of all"] = str(cloud.size + cloud.late)
    marks |= {f"{_PARTICLES}/{name}": sums for name, sums in _sums_of_particles(cloud, n).items()}
    for name, array in cloud.flow.traits().items():
        values = np.atleast_1d(array)
        integers = values.dtype.kind != "f"
        numbers = np.arange(len(values))
        marks |= {
            f"flow/{name}": _of_integers(values)
            if integers
            else _means(_totals(values, numbers), len(values))
        }
    return marks


def with_other_end(
    marks: Fingerprint, settings: Settings, cloud: Cloud, checkpoint: StoredCheckpoint
) -> Fingerprint:
    """Return the fingerprint of a cloud as a run with the end of a checkpoint's has it.

    A run stores the particles that appear before its end. Of a longer run, the particles are those of the
    checkpoint, which need no comparison.
    """
    n = stored_particles(checkpoint)
    if n < cloud.size:
        return fingerprint(settings, cloud, n)
    before = checkpoint.header["fingerprint"].items() if n > cloud.size else ()
    return marks | {k: v for k, v in before if k.startswith(_PARTICLES) and not isinstance(v, str)}


def stored_particles(checkpoint: StoredCheckpoint) -> int:
    """Return the number of particles in a checkpoint."""
    return checkpoint.layout[f"{PARTICLES}number"][0][0]


def _sums_of_particles(cloud: Cloud, n: int | None = None) -> dict[str, Sums]:
    """Return the fingerprint of each array of the first n particles, by default all."""
    n = cloud.size if n is None else n
    totals = cloud.map_ranks(_totals_of, n)
    sums: dict[str, Sums] = {name: _means(np.sum([t[name] for t in totals], axis=0), n) for name in totals[0]}
    checksums = dict.fromkeys(_INTEGERS, 0)
    for arrays in cloud.map_by_id(_integers_of, n):
        checksums = {name: zlib.crc32(array.tobytes(), checksums[name]) for name, array in arrays.items()}
    sums |= {name: [[float(n), float(value)]] for name, value in checksums.items()}
    return {name: sums[name] for name in Particles._fields}


_INTEGERS = tuple(name for name, variable in VARIABLES.items() if not variable.dtype.startswith("f"))


def _totals_of(p: Particles, n: int) -> dict[str, NDArray[np.float64]]:
    """Return the sums of the arrays of numbers that are no integers, see :func:`_totals`."""
    p = p.take(as_slice(np.flatnonzero(p.number < n)))
    return {name: _totals(a, p.number) for name, a in p._asdict().items() if name not in _INTEGERS}


def _integers_of(p: Particles, n: int) -> dict[str, NDArray[Any]]:
    return {name: getattr(p, name)[p.number < n] for name in _INTEGERS}


def checkpoint_of(
    cloud: Cloud | Snapshot,
    functions: Mapping[str, NDArray[Any]],
    entries: Sequence[SnapshotFile],
    marks: Fingerprint,
    parts: Sequence[tuple[int, str]] = (),
    around: Sequence[Sums] = (),
    stored: Sequence[float] = (),
    ended: bool = False,
) -> Checkpoint:
    """Return the checkpoint of a run, without the particles if several processes hold them.

    Parameters
    ----------
    cloud
        The cloud at a write time, or where the run stops.
    functions
        What its cloud functions remember.
    entries
        The snapshots that are written.
    marks
        The run's :func:`fingerprint`.
    parts
        Numbers and checksums of the parts with the particles of several processes.
    around
        :func:`sums_around` at its time.
    stored
        Times, s, at which some particles have stored their state, in the arrays of ``functions``.
    ended
        Whether the run ends there, and a longer one may have no end of steps there.
    """
    header = {
        "step": cloud.step,
        "recovered": cloud.recovered,
        "reach": cloud.reach,
        "stretch": cloud.stretch_steps,
        "ended": ended,
        "series": _stems(entries),
        "fingerprint": marks,
        "times": _times_until(cloud.flow, cloud.time),
        **({"around": list(around)} if around else {}),
        "parts": list(parts),
        **({"stored": list(stored)} if stored else {}),
    }
    return Checkpoint(cloud.time, header, _arrays_of(cloud.particles, functions))


def _arrays_of(p: Particles, memory: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Return the arrays of a checkpoint: particles, and data of cloud functions."""
    return {f"{PARTICLES}{name}": array for name, array in p._asdict().items()} | {
        f"{FUNCTIONS}{name}": array for name, array in memory.items()
    }


def require_choice(folder: ResultsFolder, start_from: StartFrom | None) -> None:
    """Raise InputError if the user must decide whether an unfinished run continues."""
    unfinished = Checkpoints(folder.checkpoints).files()
    if start_from is None and unfinished and not folder.table(FATES).exists():
        raise InputError(
            f"{folder.path}: an unfinished run has come to t = {max(unfinished):g} s. To continue it: "
            "-resume, or startFrom latestTime; to start over in its place: -overwrite, or startFrom "
            "startTime."
        )


def refuse_changes(checkpoint: StoredCheckpoint, marks: Fingerprint, where: str) -> None:
    """Raise InputError if a run began with other physics.

    Parameters
    ----------
    checkpoint
        One of the run.
    marks
        Fingerprint of the cloud that continues from it.
    where
        What the message begins with.
    """
    changed = changes(checkpoint.header["fingerprint"], marks)
    if changed:
        more = f", and {len(changed) - _MOST_NAMED} more" if len(changed) > _MOST_NAMED else ""
        of_times = any("memoryRates" in change for change in changed)
        cause = "The relaxation times of a powerLaw follow from deltaT and endTime. " if of_times else ""
        raise InputError(
            f"{where}, as the run began with something else: {'; '.join(changed[:_MOST_NAMED])}{more}. "
            f"{cause}Undo the change, or start over: -overwrite, or startFrom startTime."
        )


def refuse_other_times(checkpoint: StoredCheckpoint, flow: Flow, where: str) -> None:
    """Raise InputError if the flow until a checkpoint has other times than in the run, or other fields there.

    The fields are compared at the times around the checkpoint. A solver may have written later times, and
    removed earlier ones.

    Parameters
    ----------
    checkpoint, where
        See :func:`refuse_changes`.
    flow
        Flow of the cloud that continues from it.
    """
    then = checkpoint.header.get("times")
    change = flow.change_until(checkpoint.time, then) if then and isinstance(flow, Timeline) else ""
    before: list[Sums] = checkpoint.header.get("around", [])
    now = sums_around(flow, checkpoint.time) if before and not change else before
    if not all(map(_agree, before, now)):
        change = f"the flow around t = {checkpoint.time:.12g} s has changed"
    if change:
        raise InputError(
            f"{where}: {change}. Restore the times of the run, or start over: -overwrite, or startFrom "
            "startTime."
        )


def sums_around(flow: Flow, t: float) -> list[Sums]:
    """Return sums over the fields at the times of a flow around t, s, one by one; none if it is steady."""
    series: Any = flow
    return [[[1.0], *sums] for sums in series.sums_around(t).tolist()] if isinstance(flow, Timeline) else []


def _times_until(flow: Flow, t: float) -> tuple[float, ...]:
    """Return the times that a run has gone through at time t, s; none if the flow repeats itself."""
    return flow.times_until(t) if isinstance(flow, Timeline) and flow.period is None else ()


def restore(
    cloud: Cloud, functions: CloudFunctions, checkpoint: StoredCheckpoint, with_rates: bool, where: str
) -> None:
    """Put a cloud that has not been advanced, and its functions, into the state that a checkpoint holds.

    Parameters
    ----------
    with_rates
        See :meth:`foamprb.cloud.cloud.Cloud.store_at`.
    where
        What a message begins with.

    Raises
    ------
    InputError
        If the checkpoint has other arrays, or is that of a run with other cloud functions.
    """
    header, n = checkpoint.header, stored_particles(checkpoint)
    layout = {
        f"{PARTICLES}{name}": ((n, *array.shape[1:]), array.dtype)
        for name, array in cloud.comm.rank.particles._asdict().items()
    }
    if {name: shape for name, shape in checkpoint.layout.items() if name.startswith(PARTICLES)} != layout:
        raise InputError(
            f"{where}: the checkpoint has other arrays of particles than this version of foamprb writes. "
            "Start over: -overwrite, or startFrom startTime."
        )
    stored = [name.removeprefix(FUNCTIONS) for name in checkpoint.layout if name.startswith(FUNCTIONS)]
    of_functions = [name for name in stored if not name.startswith(PREFIX)]
    functions.restore(of_functions, lambda name: checkpoint.read(f"{FUNCTIONS}{name}"))
    cloud.store_at(header.get("stored", ()), with_rates)
    cloud.comm.call(_restore_rank, checkpoint.path)
    cloud.step, cloud.recovered, cloud.reach = header["step"], header["recovered"], header["reach"]
    if cloud.tracker.stride is None:
        cloud.tracker.stretch_steps = header["stretch"]


def _restore_rank(rank: Rank, file: Path) -> None:
    """Read the particles of a rank, and the arrays of cloud functions, from a checkpoint.

    Particles that it lacks stay at their start.
    """
    stored, first = StoredCheckpoint(file), int(rank.firsts[rank.number])
    for name, array in rank.particles._asdict().items():
        stored.read_into(array, f"{PARTICLES}{name}", first)
    for name, array in rank.share.memory.items():
        stored.read_into(array, f"{FUNCTIONS}{name}", first)


def snapshots_until(checkpoint: StoredCheckpoint, pvd: Path, where: str) -> tuple[SnapshotFile, ...]:
    """Return the snapshots that a run had written when it wrote a checkpoint, if all are there.

    Parameters
    ----------
    pvd
        The list of the run's snapshots. If it is missing or damaged, the checkpoint tells them as well.
    where
        What a message begins with.
    """
    expected = checkpoint.header["series"]
    try:
        listed = read_pvd(pvd) if pvd.exists() else None
    except InputError as error:
        log.warning("%s It is rebuilt from the checkpoint.", error)
        listed = None
    if listed is None:
        entries = tuple(SnapshotFile(time, _existing(pvd.parent / stem).name) for time, stem in expected)
    else:
        entries = tuple(entry for entry in listed if entry.time <= checkpoint.time)
    fault = f"{pvd.name} lists other times" if _stems(entries) != expected else ""
    files = [file for entry in entries for file in files_of(pvd.parent / entry.file)]
    missing = [file.relative_to(pvd.parent) for file in files if not file.exists()]
    fault = f"{missing[0]} is missing" if missing else fault
    if fault:
        raise InputError(
            f"{where}: the results there are not those of the checkpoint ({fault}). Put them back, or start "
            "over: -overwrite, or startFrom startTime."
        )
    return entries


def _existing(stem: Path) -> Path:
    """Return the file of a snapshot, preferably the file that lists the pieces of several processes."""
    pieces = with_ending(stem, ".pvtp")
    return pieces if pieces.exists() else with_ending(stem, ".vtp")


def _stems(entries: Sequence[SnapshotFile]) -> list[list[float | str]]:
    """Return times and files without their endings, which depend on how many processes wrote them."""
    return list(map(_stem, entries))


@cache
def _stem(entry: SnapshotFile) -> list[float | str]:
    return [entry.time, entry.file.rpartition(".")[0]]


def _leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Give the values in nested dataclasses by their paths; for a file its name, wherever it lies."""
    if is_dataclass(value):
        for field in fields(value):
            if field.compare:
                yield from _leaves(f"{name}/{field.name}", getattr(value, field.name))
    elif isinstance(value, Mapping):
        for key, item in value.items():
            # A model without entries is more than none.
            yield f"{name}/{key}", type(item).__name__
            yield from _leaves(f"{name}/{key}", item)
    elif isinstance(value, tuple) and any(is_dataclass(item) for item in value):
        for i, item in enumerate(value):
            yield from _leaves(f"{name}/{getattr(item, 'name', i)}", item)
    else:
        yield name, value.name if isinstance(value, Path) else value


def _of_integers(values: NDArray[np.generic]) -> Sums:
    """Return a fingerprint of an array of integers: their number and a checksum."""
    return [[float(values.size), float(zlib.crc32(np.ascontiguousarray(values).data))]]


def _means(totals: NDArray[np.float64], n: int) -> Sums:
    """Return a fingerprint of an array of n rows from its :func:`_totals`: the size, and means of columns.

    The last bits of a flow may depend on the processor on which it was reconstructed.
    """
    return [[float(n * totals.shape[1])], *(totals / max(n, 1)).tolist()]


def _totals(values: NDArray[np.float64], numbers: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return :func:`~foamprb.flow.traits.of_rows` of an array (n, …) whose rows have these numbers."""
    return of_rows(values.reshape(len(values), math.prod(values.shape[1:])), numbers)


def changes(old: Mapping[str, str | Sums], new: Mapping[str, str | Sums]) -> list[str]:
    """Return in words how a fingerprint differs from an old one."""
    changed = []
    for name in dict.fromkeys((*old, *new)):
        before, now = old.get(name, "absent"), new.get(name, "absent")
        if isinstance(before, str) and isinstance(now, str):
            if before != now:
                is_changed = name.startswith(_LIBS) and "absent" not in (before, now)
                changed.append(f"{name} has changed" if is_changed else f"{name} was {before}, is {now}")
        elif isinstance(before, str) or isinstance(now, str) or not _agree(before, now):
            changed.append(f"{name} has changed")
    # Other settings mean other particles: that they differ needs no word then.
    return [text for text in changed if not text.startswith(_PARTICLES)] or changed


def _agree(old: Sums, new: Sums) -> bool:
    if old[0] != new[0] or [len(row) for row in old] != [len(row) for row in new]:
        return False
    before, now = np.array(old[1:]), np.array(new[1:])
    if not before.size:
        return True
    allowed = _RELATIVE * before[0] + _OF_LARGEST * before[0].max()
    return bool(np.all(np.abs(now - before) <= allowed))
