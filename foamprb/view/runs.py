"""Results of several runs, as of a study."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.folder import ResultsFolder
from foamprb.view.results import Run, Table, frame_of, open_run
from foamprb.view.sensitivity import design_of, index_table


@dataclass(frozen=True, repr=False)
class Runs(Mapping[str, Run]):
    """Results of several runs, by the names of their folders.

    Parameters
    ----------
    runs
        The runs.
    paths
        Their cases or folders of results.
    """

    runs: Mapping[str, Run]
    paths: Mapping[str, Path]

    def __repr__(self) -> str:
        return f"<{len(self.runs)} runs: {', '.join(self.runs)}>"

    def __getitem__(self, name: str) -> Run:
        return self.runs[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.runs)

    def __len__(self) -> int:
        return len(self.runs)

    @property
    def entries(self) -> dict[str, dict[str, str]]:
        """Entries of the settings that were replaced in each run, by path, as texts without semicolons."""
        return {
            name: {
                path: _plain(text.strip().removesuffix(";"))
                for path, text in run.record.get("settings", {}).get("overrides", {}).items()
            }
            for name, run in self.runs.items()
        }

    @property
    def numbers(self) -> dict[str, int | None]:
        """Number of each run in its study, by the names of its folders; None without one."""
        return {
            name: next((int(part) for part in reversed(path.parts) if part.isdecimal()), None)
            for name, path in self.paths.items()
        }

    def indices(self) -> Table:
        """Return the indices of Sobol of a study with such a design.

        Columns: ``result`` (the share of a fate and patch, the median residence time or D), ``entry`` (its
        path), ``first`` and ``total``, each with the ends of its interval of 95 %, ``firstLow``, ….

        Raises
        ------
        InputError
            If the runs are none of a Sobol design, or too few of it have ended.
        """
        ended = {name: fates for name, run in self.runs.items() if (fates := run.fates())}
        design = design_of(self.numbers, self.entries, ended)
        if design is None:
            raise InputError(
                f"no Sobol design among the {len(ended)} runs that have ended. Needed: foamprb sweep, with "
                '[design] type = "sobol".'
            )
        return index_table(design, ended)

    def table(self, name: str = "fates") -> Table:
        """Return the rows of a table of all runs, with the columns ``run`` and one for each replaced entry.

        Runs without this table are left out, and columns that some of the others lack.

        Raises
        ------
        InputError
            If no run has such a table, or one is damaged.
        """
        tables = {key: run.table(name) for key, run in self.runs.items() if name in run.tables}
        if not tables:
            raise InputError(f"no table '{name}' in any of the runs {', '.join(self.runs)}.")
        sizes = {key: len(next(iter(table.values()))) for key, table in tables.items()}
        entries = self.entries
        paths = dict.fromkeys(path for key in tables for path in entries[key])

        def repeated(words: Mapping[str, str]) -> NDArray[Any]:
            return np.repeat(np.array([_number(words[key]) for key in tables]), list(sizes.values()))

        columns = {"run": np.repeat(np.array(list(tables)), list(sizes.values()))}
        columns |= {path: repeated({key: entries[key].get(path, "") for key in tables}) for path in paths}
        for column in next(iter(tables.values())):
            if all(column in table for table in tables.values()):
                columns[column] = np.concatenate([table[column] for table in tables.values()])
        return columns

    def frame(self, name: str = "fates") -> Any:
        """Return :meth:`table` as a data frame of pandas; InputError without pandas."""
        return frame_of(self.table(name))


def open_runs(*patterns: os.PathLike[str] | str, if_any: bool = False) -> Runs:
    """Open the results of several runs.

    Parameters
    ----------
    patterns
        Cases, folders of results as of ``foamprb run -output``, or folders of one cloud in these. ``*`` is
        any name, unless a folder has it in its own. A match without results is left out.
    if_any
        Whether folders without results are left out, too.

    Raises
    ------
    InputError
        If a folder that is named has no results, or none is found.
    """
    paths = {}
    for pattern in [os.fspath(pattern) for pattern in patterns]:
        several = glob.has_magic(pattern) and not Path(pattern).is_dir()
        matches = sorted(glob.glob(pattern)) if several else [pattern]  # noqa: PTH207
        for path in map(Path, matches):
            if path.suffix == ".html" and path.is_file():
                # The page of a study, which the shell finds among its runs.
                continue
            try:
                paths[path] = _open(path)
            except InputError:
                if not (several or if_any):
                    raise
    if not paths:
        raise InputError(f"{' '.join(map(str, patterns))}: no results there. foamprb run writes them.")
    top = os.path.commonpath([path.resolve().parent for path in paths])
    names = {path: os.path.relpath(path.resolve(), top) for path in paths}
    return Runs(
        {names[path]: run for path, run in paths.items()}, {name: path for path, name in names.items()}
    )


def results_at(path: Path) -> Path | None:
    """Return the folder of results for :func:`~foamprb.view.results.open_run`; None if it is in a case."""
    if (path / "postProcessing").is_dir():
        return None
    return path.parent if _is_of_cloud(path) else path


def _open(path: Path) -> Run:
    return open_run(path, path.name if _is_of_cloud(path) else None, results=results_at(path))


def _is_of_cloud(path: Path) -> bool:
    """Return whether a folder has the results of one cloud."""
    return ResultsFolder(path, path.name).pvd.is_file()


def _plain(text: str) -> str:
    """Return a number without digits that it does not need."""
    number = _number(text)
    return f"{number:.6g}" if isinstance(number, float) else text


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
