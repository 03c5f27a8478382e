"""Results of a run in the files of other programs: ``foamprb export``."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from foamprb.cloud.state import Status
from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.flows import read_flow
from foamprb.flow.read.source import FlowSource
from foamprb.results.atomic import refuse_other_kind
from foamprb.results.foam import remove_lagrangian, write_lagrangian
from foamprb.results.vtk import write_vtkhdf
from foamprb.view.results import Run, open_run
from foamprb.view.stress import write_stress

_TARGETS = {"openfoam": "openfoam", "vtkhdf": "{}.vtkhdf", "stress": "sigma"}
"""Default file or folder of each kind, beside the results."""


def export(
    kind: str,
    case: Path,
    cloud: str | None,
    source: FlowSource,
    time: str,
    output: Path | None,
    results: Path | None = None,
    fraction: float | None = None,
) -> Path:
    """Write the results of a run, finished or not, for another program.

    Parameters
    ----------
    kind
        ``openfoam``, ``vtkhdf`` or ``stress``.
    case, cloud, results
        See :func:`foamprb.view.results.open_run`.
    source, time
        Flow and its time, for the mesh of OpenFOAM's files.
    output
        File or folder; by default beside the results.
    fraction
        See :func:`foamprb.view.stress.write_stress`.
    """
    run = open_run(case, cloud, source.region, results)
    source = run.source(source)
    target = output or run.folder / _TARGETS[kind].format(run.name)
    if kind == "vtkhdf":
        refuse_other_kind(target, b"\x89HDF")
        write_vtkhdf(target, [entry.time for entry in run.entries], run.cloud)
    else:
        flow = read_flow(case, time, source)
        if kind == "stress":
            write_stress(target, run, case, flow.mesh, fraction)
            return target
        if target.resolve() != case.resolve():
            _link_case(target, case, run.name)
        _write_lagrangian(target, run, flow)
    return target


def _write_lagrangian(target: Path, run: Run, flow: MeshFlow) -> None:
    """Write ``<time>/lagrangian/<cloud>`` of all times, without escaped and failed particles."""
    # An earlier run may have had other times.
    remove_lagrangian(target, run.name)
    for time in run.times:
        for part in ("lagrangian", "uniform/lagrangian"):
            if (folder := target / f"{time:.12g}" / part / run.name).exists():
                raise InputError(
                    f"{folder}: not written by foamprb; it is kept. Use another -output, or remove it."
                )
    for index in range(len(run.entries)):
        cloud = run.cloud(index)
        inside = np.isin(cloud.arrays["status"], (Status.ACTIVE, Status.STUCK))
        points = cloud.points[inside]
        arrays = {name: array[inside] for name, array in cloud.arrays.items()}
        folder = target / f"{cloud.time:.12g}" / "lagrangian" / run.name
        write_lagrangian(folder, points, _cells(flow, points), arrays)


def _cells(flow: MeshFlow, points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the cells of points; the cell of the nearest boundary face for a point outside by round-off."""
    hosts = flow.locate(points)
    cells = np.asarray(flow.cell_of(hosts), dtype=np.int64)
    outside = np.flatnonzero(hosts < 0)
    if len(outside):
        mesh = flow.mesh
        nearest = cKDTree(mesh.boundary_centres).query(points[outside])[1]
        cells[outside] = mesh.owner[mesh.n_internal :][nearest]
    return cells


def _link_case(target: Path, case: Path, name: str) -> None:
    """Make a folder a case of OpenFOAM, with links to the mesh and the dictionaries of the original case."""
    target.mkdir(parents=True, exist_ok=True)
    # ParaView recognises a case by this file.
    (target / f"{name}.foam").touch()
    for part in ("constant", "system"):
        link, folder = target / part, (case / part).resolve()
        if not folder.is_dir():
            raise InputError(f"{case}: no folder {part}; OpenFOAM's files need a case of OpenFOAM.")
        if not link.exists():
            link.unlink(missing_ok=True)
            link.symlink_to(os.path.relpath(folder, target.resolve()))
