"""k and ε, or k and ω, of a case's turbulence model at the nodes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from foamprb.body.turbulence import dissipation
from foamprb.dictionary.dimensions import DISSIPATION, RATE, SPECIFIC_ENERGY
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.case import MissingFieldError
from foamprb.flow.read.checks import at_cells
from foamprb.flow.read.field import FoamField, Kind
from foamprb.flow.reconstruct import Reconstruction

K_FIELD = Kind("volScalarField", "scalar", (SPECIFIC_ENERGY,), "the turbulent kinetic energy")
_EPSILON = Kind("volScalarField", "scalar", (DISSIPATION,), "the dissipation of turbulent kinetic energy")
_OMEGA = Kind("volScalarField", "scalar", (RATE,), "the specific dissipation rate")
_LEAST = 1e-150


def read_turbulence(
    read: Callable[[str, Kind], FoamField],
    folder: Path,
    whole: CaseMesh,
    reconstruct: Reconstruction,
) -> Floats:
    """Read k and ε, or k and ω with ε = β* k ω, and reconstruct them.

    Parameters
    ----------
    read
        Reads the field of a name and a kind.
    folder
        Folder of the time, for messages.
    whole, reconstruct
        Mesh of the case, and its reconstruction.

    Returns
    -------
    (n_nodes, 8): k (m²/s²), ε (m²/s³), ∇k and ∇(k²/3ε).
    """
    try:
        k_field = read("k", K_FIELD)
    except MissingFieldError as missing:
        raise InputError(f"{folder}/k: no such field. {_WANTED}") from missing
    k, at_patches = values_of(k_field, whole)
    try:
        epsilon, _ = values_of(read("epsilon", _EPSILON), whole)
    except MissingFieldError:
        try:
            omega, _ = values_of(read("omega", _OMEGA), whole)
        except MissingFieldError as missing:
            raise InputError(f"{folder}/epsilon: no such field, and no omega. {_WANTED}") from missing
        epsilon = dissipation(k, omega)
    # Values of a wall function for ε or ω are not values of the flow; those of the cells are used.
    owner = whole.mesh.owner[whole.mesh.n_internal :]
    wall = epsilon[owner]
    cells = np.stack([k, epsilon, _diffusivity(k, epsilon)], axis=1)
    boundary = np.stack([at_patches, wall, _diffusivity(at_patches, wall)], axis=1)
    values, slopes = reconstruct.scalars(cells, boundary)
    return np.concatenate([values[:, :2], slopes[:, 0], slopes[:, 2]], axis=1)


_WANTED = "The dispersionModel needs k and epsilon, or k and omega, at the time of the flow."


def _diffusivity(k: Floats, epsilon: Floats) -> Floats:
    """Return k²/3ε, m²/s, of eddies of variance 2k/3 and life k/ε."""
    diffusivity: Floats = k * k / (3.0 * epsilon + _LEAST)
    return diffusivity


def values_of(field: FoamField, whole: CaseMesh) -> tuple[Floats, Floats]:
    """Return values at cells (n_cells,) and boundary faces (n_boundary,), there of the cell if not given.

    Those of cells must not be negative; at faces 0 replaces a negative one.
    """
    cells, boundary = given_values(field, whole)
    if cells.min() < 0.0:
        cell = int(cells.argmin())
        raise InputError(
            f"{field.path}: the value at cell {cell} is {cells[cell, 0]:g}. Allowed: none below 0."
        )
    return cells[:, 0], np.maximum(boundary[:, 0], 0.0)


def given_values(field: FoamField, whole: CaseMesh) -> tuple[Floats, Floats]:
    """Return values at cells (n_cells, components) and boundary faces, there of the cell if not given."""
    mesh = whole.mesh
    cells = at_cells(field, mesh)
    boundary = cells[mesh.owner[mesh.n_internal :]]
    for index, patch in enumerate(whole.patches):
        entry = field.of(patch)
        own = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
        values = entry.fields.get("value") if entry else None
        if values is not None and len(values) in (1, patch.faces) and np.isfinite(values).all():
            boundary[own] = values
        elif entry and entry.type == "noSlip":
            boundary[own] = 0.0
    return cells, boundary
