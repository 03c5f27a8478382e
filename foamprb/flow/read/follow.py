"""Times of a case whose solver is running: those that are written completely.

OpenFOAM makes the folder of a time first and then writes one field after another. A time is therefore
complete when the folder of the next one exists. The last time of the solver is complete when its files no
longer change.
"""

from __future__ import annotations

import hashlib
import math
import time as clock
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import xxhash

from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.schema import read_entry
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError
from foamprb.flow.read.case import available_times, is_only_decomposed, processor_folders, word_of
from foamprb.flow.read.processors import Processors
from foamprb.flow.read.times import names_in

_CONTROL = Path("system/controlDict")
_QUIET = 10.0
"""Seconds without a change after which the last time, and any time of collated files, is complete."""
_ROUNDED = 1e-9
"""Relative error of a time in ``controlDict`` or in the name of a folder."""
_CLOSE = 1e-6
"""Share of a write interval by which a time may lie before a multiple of it."""


class FollowedCase:
    """Complete times of a case whose solver is running.

    Parameters
    ----------
    case
        The case of the solver.
    selection
        Range of times ``a:b``, ``a:`` or ``:b``; None for all.
    region
        Region of the mesh.
    decomposed
        Read the processor folders even if there is a flow beside them.

    Raises
    ------
    InputError
        ``selection`` is not a range; ``system/controlDict`` is missing, or its ``purgeWrite`` is not 0.
    """

    def __init__(
        self, case: Path, selection: str | None = None, region: str = "", decomposed: bool = False
    ) -> None:
        self.case = case
        self.times: list[str] = []
        """Names of the complete times that are selected."""
        self.ended = False
        """Whether the solver has ended, and all its times are complete."""
        self.decomposed = decomposed
        """Whether the times are in processor folders."""
        self._selection, self._region = selection, region
        names_in(case, ("0",), selection)
        self._control_time = -1
        self._control = self._read_control()
        if _number(self._control, "purgeWrite", 0.0) > 0.0:
            raise self._control.entries["purgeWrite"].mistake(
                "lets the solver remove times that the run has yet to read. Allowed with -follow: 0."
            )
        self._roots: list[Path] = []
        self._listed: set[str] = set()
        """All times of earlier looks."""
        self._stamps: dict[str, dict[str, _Stamp]] = {}
        """States of the files of each complete time."""
        self._seen: tuple[object, float] = (), 0.0

    def require_unchanged(self, names: Iterable[str]) -> None:
        """Raise InputError if the solver has written complete times again."""
        for name in names:
            then = self._stamps[name]
            self._stamps[name] = now = self._stamp(name)
            if any(now[file].checksum != then[file].checksum for file in now.keys() & then.keys()):
                raise InputError(self._returned(f"the time {name} was written again"))

    def look(self) -> None:
        """Find the times that are complete by now.

        Raises
        ------
        InputError
            The solver has gone back to an earlier time.
        """
        self._roots = self._roots or self._find_roots()
        if not self._roots:
            return
        written = _common_times(self._roots)
        selected = self._selected(written)
        self._refuse_return(selected)
        ended = self._has_ended(written, self._roots[0])
        for name in selected:
            if self.times and float(name) <= float(self.times[-1]):
                continue
            if name == written[-1] and not ended:
                break
            # The threads of collated files lag behind the solver.
            lagging = name == written[-1] or self._roots[0].name.startswith("processors")
            if lagging and not self._is_settled(name):
                break
            self._stamps[name] = self._stamp(name)
            self.times.append(name)
        _, _, end = (self._selection or "").partition(":")
        past = bool(written) and not names_in(self.case, written[-1:], f":{end}")
        self.ended = (ended or past) and self.times[-1:] == list(selected[-1:])

    def _find_roots(self) -> list[Path]:
        """Return the folders that hold the times; none until the solver has written to one of two places."""
        processors = processor_folders(self.case)
        if self.decomposed or (processors and is_only_decomposed(self.case, self._region)):
            self.decomposed = True
            return Processors(self.case).folders if processors else []
        times = available_times(self.case)
        # A case with one time may yet be decomposed.
        here = len(times) > 1 or (not processors and self._has_ended(times, self.case))
        return [self.case] if here else []

    def _selected(self, names: Sequence[str]) -> tuple[str, ...]:
        return names_in(self.case, names, self._selection)

    def _refuse_return(self, selected: Sequence[str]) -> None:
        """Raise InputError if the solver has gone back to an earlier time since the last look."""
        self.require_unchanged(self.times[-1:])
        new = [name for name in selected if name not in self._listed]
        later = [name for name in self._listed if new and float(name) > float(new[0])]
        if later:
            raise InputError(self._returned(f"the time {new[0]} was written after {max(later, key=float)}"))
        self._listed |= {*selected}

    def _returned(self, what: str) -> str:
        return (
            f"{self.case}: {what}. The solver has gone back to an earlier time, and the run may have used "
            "later ones. Remove times that the solver does not write again. Then continue with -resume, "
            "which compares the flow at the last checkpoint, or start over: -overwrite."
        )

    def _has_ended(self, written: Sequence[str], root: Path) -> bool:
        """Return whether ``controlDict`` lets the solver write no time after the last one in a folder."""
        if not written:
            return False
        control, last = self._read_control(), float(written[-1])
        stop = word_of(control, "stopAt", "endTime")
        if stop == "noWriteNow":
            return True
        if stop in ("writeNow", "nextWrite"):
            return (root / written[-1]).stat().st_mtime_ns > self._control_time
        end, (interval, by_index) = _number(control, "endTime", math.inf), self._interval()
        tolerance, following = 0.5 * _number(control, "deltaT", 0.0), last
        if not by_index and interval < math.inf:
            following += interval
            if len(written) < 2 or abs(following - 2.0 * last + float(written[-2])) > tolerance:
                # The interval was changed, or the solver restarted: it may write at multiples.
                following = min(following, (math.floor(last / interval + _CLOSE) + 1) * interval)
        return following - tolerance > end * (1.0 + _ROUNDED) or last >= end * (1.0 - _ROUNDED)

    def _interval(self) -> tuple[float, bool]:
        """Return the write interval, s, infinite if unknown; in steps, with True, if their length varies."""
        control = self._control
        interval = _number(control, "writeInterval", math.inf)
        kind = word_of(control, "writeControl", "timeStep")
        if kind == "timeStep":
            if word_of(control, "adjustTimeStep", "no") in ("yes", "on", "true", "y", "t"):
                return interval, True
            return interval * _number(control, "deltaT", math.inf), False
        return (interval if kind in ("runTime", "adjustable", "adjustableRunTime") else math.inf), False

    def _is_settled(self, name: str) -> bool:
        """Return whether the files of a time have not changed for a while."""
        folders = [root / name / self._region for root in self._roots]
        try:
            files = [path for folder in folders for path in sorted(folder.iterdir())]
            state = [(str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in files]
        except FileNotFoundError:
            # The solver has not come to the region, or renames a file.
            return False
        if state != self._seen[0]:
            age = max(0.0, clock.time() - 1e-9 * max((changed for *_, changed in state), default=0.0))
            self._seen = state, clock.monotonic() - age
        return clock.monotonic() - self._seen[1] >= _QUIET

    def _stamp(self, name: str) -> dict[str, _Stamp]:
        """Return the state of a time: when its first file was written, or the checksums of its files."""
        folder = self._roots[0] / name
        try:
            written = (folder / "uniform/time").stat().st_mtime_ns
        except OSError:
            # Another program may write files again that do not change, and add further ones.
            return _stamps_of(folder / self._region, self._stamps.get(name, {}))
        return {"uniform/time": _Stamp((0, written), str(written))}

    def _read_control(self) -> Dictionary:
        """Return ``system/controlDict``; the one of before while it is being changed."""
        path = self.case / _CONTROL
        try:
            changed = path.stat().st_mtime_ns
            if changed != self._control_time:
                self._control, self._control_time = read_dictionary(path, self.case), changed
        except (OSError, InputError):
            if self._control_time < 0:
                raise InputError(f"{path}: -follow needs this file, which cannot be read.") from None
        return self._control


def _common_times(folders: Iterable[Path]) -> tuple[str, ...]:
    """Return the times that all folders have, rising."""
    first, *others = [available_times(folder) if folder.is_dir() else () for folder in folders]
    return tuple(name for name in first if all(name in names for names in others))


class _Stamp(NamedTuple):
    """State of a file."""

    written: tuple[int, int]
    """Size, and time of the last change, ns."""
    checksum: str


def _stamps_of(folder: Path, before: Mapping[str, _Stamp]) -> dict[str, _Stamp]:
    """Return the states of the files in a folder; only files that were written since are read again."""
    stamps = {}
    # A file may be renamed meanwhile.
    with suppress(OSError):
        for file in sorted(folder.iterdir()):
            if file.is_file():
                status, then = file.stat(), before.get(file.name)
                written = status.st_size, status.st_mtime_ns
                if then is not None and then.written == written:
                    stamps[file.name] = then
                else:
                    with file.open("rb") as stream:
                        digest = hashlib.file_digest(stream, xxhash.xxh3_128)
                    stamps[file.name] = _Stamp(written, digest.hexdigest())
    return stamps


def _number(dictionary: Dictionary, key: str, default: float) -> float:
    """Return the number of an entry; the default if it is missing or no number."""
    with suppress(InputError):
        return float(read_entry(dictionary, key, float)) if key in dictionary.entries else default
    return default
