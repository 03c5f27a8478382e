"""Stress of the particles as a field that OpenFOAM's solvers of laminar flow take."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.gradient import LeastSquaresGradient
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.field import Kind, read_field
from foamprb.flow.read.foamfile import FoamFile
from foamprb.results.foam import GENERIC, SYMMETRIC, PatchValues, write_field
from foamprb.view.results import Run

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_STRESS, _FRACTION = "sigmaParticles", "volumeFraction"
_KINEMATIC = (0, 2, -2, 0, 0, 0, 0)
_KINDS = {
    "sigma": Kind("volSymmTensorField", "symmTensor", (_KINEMATIC,), "a kinematic stress"),
    _STRESS: Kind("volSymmTensorField", "symmTensor", ((1, -1, -2, 0, 0, 0, 0),), "a stress"),
    _FRACTION: Kind("volScalarField", "scalar", ((0, 0, 0, 0, 0, 0, 0),), "a volume fraction"),
}


def write_stress(target: Path, run: Run, case: Path, mesh: Mesh, fraction: float | None) -> None:
    """Write the last ``sigmaParticles`` of a run as the field ``sigma`` of OpenFOAM's laminar model Maxwell.

    It is −σ/ρ, m²/s²: the model adds its divergence on the left of the momentum equation. If the file is
    there already, its change is logged.

    Parameters
    ----------
    target
        The file.
    run, case, mesh
        The run, its case, and the mesh of its flow.
    fraction
        Mean volume fraction of the particles in the mesh to which the stress is scaled; None for the
        fraction of the run.
    """
    if target.is_file() and FoamFile(target).kind != _KINDS["sigma"].name:
        raise InputError(f"{target}: a file of another kind, which is kept. Choose another name.")
    before = read_field(target, _KINDS["sigma"], case).cells if target.is_file() else np.empty((0, 6))
    folder = _latest(run)
    stress, share = (_cells(folder / name, case, mesh) for name in (_STRESS, _FRACTION))
    mean = float(share[:, 0] @ mesh.volumes / mesh.volumes.sum())
    if fraction is not None and mean <= 0.0:
        raise InputError(
            f"{folder / _FRACTION}: there are no particles, whose fraction could be {fraction:g}."
        )
    factor = 1.0 if fraction is None else fraction / mean
    rho = run.record.get("fluid", {}).get("rho")
    if rho is None or not rho > 0.0:
        raise InputError(f"{run.folder}: run.json has no density of the fluid, fluid/rho.")
    sigma = -factor / rho * stress[:, np.argsort(SYMMETRIC)]
    on_faces = _continued(mesh, sigma)
    patches = {
        patch.name: PatchValues("fixedValue", on_faces[mesh.patch_start[k] : mesh.patch_start[k + 1]])
        if patch.type in GENERIC
        else PatchValues(patch.type)
        for k, patch in enumerate(mesh.patches)
    }
    target.parent.mkdir(parents=True, exist_ok=True)
    write_field(target, _KINEMATIC, sigma, patches, "sigma")
    if len(before) == len(sigma):
        change = float(np.linalg.norm(before[:, np.argsort(SYMMETRIC)] - sigma) / np.linalg.norm(before))
        log.info("Change of the stress: %.3g %%", 100.0 * change)


def _latest(run: Run) -> Path:
    """Return the folder with the stress of the last time."""
    folders = {float(file.parent.name): file.parent for file in run.folder.glob(f"*/[0-9]*/{_STRESS}")}
    if not folders:
        raise InputError(
            f"{run.folder}: there is no {_STRESS}. It is written by cloudFunctions {{ fields {{ type "
            f"particleStatistics; {_STRESS} yes; }} }}."
        )
    return folders[max(folders)]


def _cells(path: Path, case: Path, mesh: Mesh) -> Floats:
    """Read the values of a field of the run at the cells."""
    values = read_field(path, _KINDS[path.name], case).cells
    if len(values) not in (1, mesh.n_cells):
        raise InputError(f"{path}: has {len(values)} cells, but the mesh of the flow has {mesh.n_cells}.")
    return np.broadcast_to(values, (mesh.n_cells, values.shape[1]))


def _continued(mesh: Mesh, values: Floats) -> Floats:
    """Return values (n_boundary, 6) at the boundary faces, continued linearly from the cells."""
    faces, numbers = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int32)
    gradients = np.empty((mesh.n_cells, 6, 3))
    LeastSquaresGradient.over_faces(mesh, mesh.centres, faces, numbers)(values, gradients)
    owner = mesh.owner[mesh.n_internal :]
    arms = mesh.boundary_centres - mesh.centres[owner]
    on_faces: Floats = values[owner] + np.einsum("fki,fi->fk", gradients[owner], arms)
    return on_faces
