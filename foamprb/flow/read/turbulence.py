"""k and ε of a case's turbulence model at the nodes, or k and ω."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from foamprb.body.turbulence import dissipation
from foamprb.dictionary.dimensions import DISSIPATION, RATE, SPECIFIC_ENERGY
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.case import MissingFieldError
from foamprb.flow.read.caveats import is_not_zero
from foamprb.flow.read.checks import require_numbers
from foamprb.flow.read.field import Field, Kind
from foamprb.flow.reconstruct import Reconstruction

__all__ = ["read_turbulence", "turbulence_fields"]

_K = Kind("volScalarField", "scalar", (SPECIFIC_ENERGY,), "the turbulent kinetic energy")
_EPSILON = Kind("volScalarField", "scalar", (DISSIPATION,), "the dissipation of turbulent kinetic energy")
_OMEGA = Kind("volScalarField", "scalar", (RATE,), "the specific dissipation rate")
_LEAST = 1e-150


def read_turbulence(
    read: Callable[[str, Kind], Field],
    folder: Path,
    patches: tuple[PatchInfo, ...],
    mesh: Mesh,
    reconstruct: Reconstruction,
) -> Floats:
    """Read k and ε, or k and ω with ε = β* k ω, and reconstruct them.

    Parameters
    ----------
    read
        Gives the field of a name and a kind.
    folder
        Of the time, for the messages.
    patches, mesh, reconstruct
        Of the case.

    Returns
    -------
    (n_nodes, 8): k (m²/s²), ε (m²/s³), ∇k and ∇(k²/3ε).

    Raises
    ------
    InputError
        A field is missing, broken, has other dimensions, or is negative somewhere.
    """
    try:
        k_field = read("k", _K)
    except MissingFieldError as missing:
        raise InputError(f"{folder}/k: no such field. {_WANTED}") from missing
    k, at_patches = _values(k_field, patches, mesh)
    try:
        epsilon, _ = _values(read("epsilon", _EPSILON), patches, mesh)
    except MissingFieldError:
        try:
            omega, _ = _values(read("omega", _OMEGA), patches, mesh)
        except MissingFieldError as missing:
            raise InputError(f"{folder}/epsilon: no such field, and no omega. {_WANTED}") from missing
        epsilon = dissipation(k, omega)
    # What a wall function says of ε or ω at the wall is no value of the flow: that of the cell counts.
    owner = mesh.owner[mesh.n_internal :]
    wall = epsilon[owner]
    cells = np.stack([k, epsilon, _diffusivity(k, epsilon)], axis=1)
    boundary = np.stack([at_patches, wall, _diffusivity(at_patches, wall)], axis=1)
    values, slopes = reconstruct.scalars(cells, boundary)
    return np.concatenate([values[:, :2], slopes[:, 0], slopes[:, 2]], axis=1)


def turbulence_fields(folder: Path) -> tuple[str, ...]:
    """Names of the fields of a time directory from which :func:`read_turbulence` has k and ε; () without."""
    found = (("k", second) for second in ("epsilon", "omega") if is_not_zero(folder / second))
    return next(found, ()) if is_not_zero(folder / "k") else ()


_WANTED = "The dispersionModel needs k and epsilon, or k and omega, at the time of the flow."


def _diffusivity(k: Floats, epsilon: Floats) -> Floats:
    """k²/3ε, m²/s, of eddies of variance 2k/3 and life k/ε."""
    diffusivity: Floats = k * k / (3.0 * epsilon + _LEAST)
    return diffusivity


def _values(field: Field, patches: tuple[PatchInfo, ...], mesh: Mesh) -> tuple[Floats, Floats]:
    """Values at the cells (n_cells,) and the boundary faces (n_boundary,), there of the cell if not given."""
    if len(field.cells) not in (1, mesh.n_cells):
        raise InputError(
            f"{field.path}: internalField has {len(field.cells)} values, but there are {mesh.n_cells} cells."
        )
    cells = np.ascontiguousarray(np.broadcast_to(field.cells[:, 0], mesh.n_cells))
    require_numbers(cells[:, None], field.path, "value", "at cell")
    if cells.min() < 0.0:
        cell = int(cells.argmin())
        raise InputError(f"{field.path}: the value at cell {cell} is {cells[cell]:g}. Allowed: none below 0.")
    boundary = cells[mesh.owner[mesh.n_internal :]].copy()
    for index, patch in enumerate(patches):
        entry = field.of(patch)
        found = entry.fields.get("value") if entry else None
        if found is not None and len(found) in (1, patch.faces) and np.isfinite(found).all():
            boundary[mesh.patch_start[index] : mesh.patch_start[index + 1]] = np.maximum(found[:, 0], 0.0)
    return cells, boundary
