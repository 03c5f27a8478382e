"""The results of a run in the files of other programs: ``foamprb export``."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from foamprb.cloud.state import Status
from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.source import Source, read_flow
from foamprb.results.foam import remove_lagrangian, write_lagrangian
from foamprb.results.ovito import write_dump
from foamprb.results.vtk import PointCloud
from foamprb.results.vtkhdf import write_vtkhdf
from foamprb.view.results import Results, open_results

__all__ = ["KINDS", "export"]


class _Export(NamedTuple):
    """What is exported, and where to."""

    results: Results
    case: Path
    source: Source
    time: str
    """Of the flow."""
    target: Path


def export(kind: str, case: Path, cloud: str | None, source: Source, time: str, output: Path | None) -> Path:
    """Write the results of a run for another program, those of a run that has not ended as far as they go.

    Parameters
    ----------
    kind
        One of :data:`KINDS`.
    case, cloud
        As of :func:`foamprb.view.results.open_results`.
    source, time
        Where the flow is, of which OpenFOAM's files name the cells.
    output
        The file or folder; by default beside the results.

    Returns
    -------
    What was written.

    Raises
    ------
    InputError
        If there is no run, its files are damaged, or the flow cannot be read.
    OSError
        If a file cannot be written.
    """
    results = open_results(case, cloud)
    write, default = KINDS[kind]
    target = output or results.folder / default.format(results.name)
    write(_Export(results, case, source, time, target))
    return target


def _cloud(results: Results, index: int) -> PointCloud:
    found = results.snapshot(index)
    return PointCloud(found.time, found.points, found.arrays, results.units, results.names)


def _vtkhdf(e: _Export) -> None:
    times = [entry.time for entry in e.results.entries]
    write_vtkhdf(e.target, times, lambda index: _cloud(e.results, index))


def _ovito(e: _Export) -> None:
    write_dump(e.target, (_cloud(e.results, index) for index in range(len(e.results.entries))))


def _openfoam(e: _Export) -> None:
    """Write ``<time>/lagrangian/<cloud>`` of all times, with what OpenFOAM knows as still there."""
    flow = read_flow(e.case, e.time, e.source)
    if e.target.resolve() != e.case.resolve():
        _make_case(e)
    # A run before may have had other times.
    remove_lagrangian(e.target, e.results.name)
    for index in range(len(e.results.entries)):
        cloud = _cloud(e.results, index)
        here = np.isin(cloud.arrays["status"], (Status.ACTIVE, Status.STUCK))
        points = cloud.points[here]
        arrays = {name: array[here] for name, array in cloud.arrays.items()}
        folder = e.target / f"{cloud.time:.12g}" / "lagrangian" / e.results.name
        write_lagrangian(folder, points, _cells(flow, points), arrays)


def _cells(flow: MeshFlow, points: NDArray[np.float64]) -> NDArray[np.int64]:
    """The cells that hold points; for one outside, by round-off, that whose boundary face is nearest."""
    hosts = flow.locate(points)
    cells = np.asarray(flow.cell_of(hosts), dtype=np.int64)
    outside = np.flatnonzero(hosts < 0)
    if len(outside):
        mesh = flow.mesh
        nearest = cKDTree(mesh.boundary_centres).query(points[outside])[1]
        cells[outside] = mesh.owner[mesh.n_internal :][nearest]
    return cells


def _make_case(e: _Export) -> None:
    """Let OpenFOAM's programs take a folder for a case: with the mesh and the dictionaries of the case."""
    e.target.mkdir(parents=True, exist_ok=True)
    # By such a file ParaView knows a case.
    (e.target / f"{e.results.name}.foam").touch()
    for name in ("constant", "system"):
        link, folder = e.target / name, (e.case / name).resolve()
        if not folder.is_dir():
            raise InputError(f"{e.case}: no folder {name}; OpenFOAM's files go into a case of OpenFOAM.")
        if not link.exists():
            link.unlink(missing_ok=True)
            link.symlink_to(os.path.relpath(folder, e.target.resolve()))


KINDS: dict[str, tuple[Callable[[_Export], None], str]] = {
    "openfoam": (_openfoam, "openfoam"),
    "vtkhdf": (_vtkhdf, "{}.vtkhdf"),
    "ovito": (_ovito, "{}.dump"),
}
"""What writes each kind, and what is then beside the results."""
