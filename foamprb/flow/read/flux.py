"""Fluxes through the faces of a case's mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from foamprb.dictionary.dimensions import MASS_FLUX, VOLUME_FLUX
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.boundary import CaseMesh, PatchInfo
from foamprb.flow.read.field import DENSITY_FIELD, FoamField, Kind

_FLUX = Kind("surfaceScalarField", "scalar", (VOLUME_FLUX, MASS_FLUX), "a flux")
_STRANGE = 0.5
"""Difference between flux and velocity above which they belong to different flows; root mean squares."""


def flux_of(velocity: str) -> str:
    """Return the name of the flux of a velocity: ``phi`` of ``U`` and ``Urel``, ``phiMean`` of ``UMean``."""
    return "phi" if velocity in ("U", "Urel") else f"phi{velocity.removeprefix('U')}"


def volume_flux(
    read: Callable[[str, Kind], FoamField], whole: CaseMesh, velocity: str, cells: Floats
) -> tuple[Floats | None, bool]:
    """Return the flux of volume out of the owner of each face, m³/s, and whether the flow keeps its volume.

    Parameters
    ----------
    read
        Reads a field at the time.
    whole
        The mesh.
    velocity, cells
        Name of the velocity, and its values at the cells (n_cells, 3), m/s.

    Returns
    -------
    phi, solenoidal
        (n_faces,), or None if there is none that fits the velocity; False if the density varies.
    """
    mesh, rho = whole.mesh, density(read)
    solenoidal = not varies(rho)
    try:
        phi = read(flux_of(velocity), _FLUX)
    except InputError:
        return None, solenoidal
    boundary = boundary_values_of(phi, whole.patches)
    if boundary is None or len(phi.cells) not in (1, mesh.n_internal):
        return None, solenoidal
    flux = np.concatenate([np.broadcast_to(phi.cells, (mesh.n_internal, 1))[:, 0], boundary])
    if phi.dimensions == MASS_FLUX:
        if len(rho) not in (1, mesh.n_cells):
            return None, solenoidal
        flux = flux / _at_faces(mesh, np.broadcast_to(rho, (mesh.n_cells, 1)))[:, 0]
    expected = np.einsum("fi,fi->f", _at_faces(mesh, cells)[: mesh.n_internal], internal_areas(mesh))
    error = flux[: mesh.n_internal] - expected
    fits = np.isfinite(flux).all() and np.sum(error**2) <= _STRANGE**2 * np.sum(expected**2)
    return (flux if fits else None), solenoidal


def internal_areas(mesh: Mesh) -> Floats:
    """Return the area vectors of the faces between cells, out of their owner, (n_internal, 3), m²."""
    areas = np.zeros((mesh.n_internal, 3))
    starts = mesh.face_start[: mesh.n_internal]
    sizes = np.diff(mesh.face_start)[: mesh.n_internal]
    base = mesh.points[mesh.face_points[starts]]
    for k in range(1, int(sizes.max(initial=2)) - 1):
        more = np.flatnonzero(sizes > k + 1)
        at = starts[more] + k
        a, b = (mesh.points[mesh.face_points[at + i]] - base[more] for i in (0, 1))
        areas[more] += 0.5 * np.cross(a, b)
    return areas


def _at_faces(mesh: Mesh, cells: Floats) -> Floats:
    """Return the mean of the values (n_cells, m) beside each face; that of the cell on the boundary."""
    faces = cells[mesh.owner].copy()
    faces[: mesh.n_internal] += cells[mesh.neighbour]
    faces[: mesh.n_internal] *= 0.5
    return faces


def boundary_flux(
    read: Callable[[str, Kind], FoamField], patches: Sequence[PatchInfo]
) -> tuple[Floats, str, str] | None:
    """Return ``phi`` out of the boundary faces (n,), its name and its unit; None if it is missing."""
    try:
        phi = read("phi", _FLUX)
    except InputError:
        return None
    values = boundary_values_of(phi, patches)
    return None if values is None else (values, "phi", "kg/s" if phi.dimensions == MASS_FLUX else "m3/s")


def boundary_values_of(phi: FoamField, patches: Sequence[PatchInfo]) -> Floats | None:
    """Return the values of a flux at the boundary faces (n,), or None if a patch has none."""
    values = []
    for patch in patches:
        entry = phi.of(patch)
        found = entry.fields.get("value") if entry else None
        if found is None or len(found) not in (1, patch.faces):
            if patch.faces and patch.type != "empty":
                return None
            found = np.zeros((1, 1))
        values.append(np.broadcast_to(found, (patch.faces, 1))[:, 0])
    return np.concatenate([np.empty(0), *values])


def density(read: Callable[[str, Kind], FoamField]) -> Floats:
    """Return the density at the cells, kg/m³, or no values."""
    try:
        return read("rho", DENSITY_FIELD).cells
    except InputError:
        return np.empty((0, 1))


def varies(values: Floats) -> bool:
    """Return True if the values differ by more than round-off."""
    return bool(np.ptp(values) > 1e-6 * np.abs(values).max(initial=0.0)) if len(values) else False
