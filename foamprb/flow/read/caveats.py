"""What a case says of its flow that particles will not feel: a warning for each, and what it means."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from foamprb.dictionary.dimensions import DENSITY, MASS_FLUX, VOLUME_FLUX
from foamprb.dictionary.files import existing, read_bytes
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.tree import Dictionary, Stream
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.field import Kind, read_field

_FLUX = Kind("surfaceScalarField", "scalar", (VOLUME_FLUX, MASS_FLUX), "a flux")
_RHO = Kind("volScalarField", "scalar", (DENSITY,), "a density")
_OFF = frozenset({"no", "off", "false", "n", "f", "none"})
_STATIC = "staticFvMesh"
_ZERO = re.compile(rb"internalField\s+uniform\s+0(?:\.0*)?\s*;")
_VARIES = re.compile(rb"internalField\s+nonuniform")
_HEAD = 1 << 16
LEAST_LOSS = 1e-3
"""Share of the flux by which inflow and outflow must differ for a warning."""
ROUND_OFF = 1e-9
"""Share of the flux of the largest velocity through the whole boundary by which they must differ, too."""


def caveats_of_case(
    case: Path,
    folder: Path,
    region: str,
    *,
    moving: bool = True,
    turbulent: bool = False,
    relative: bool = False,
) -> list[Caveat]:
    """Warnings from the dictionaries of a case, and from what lies in a time directory beside the velocity.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    folder
        The time directory, or the region's part of it.
    moving
        Whether the flow is read at one time only, so that a mesh that moves stands still.
    turbulent
        Whether a model of its eddies acts, so that they need no warning.
    relative
        Whether particles in rotating zones are seen from the rotors, likewise.
    """
    found = [*_rotating(case, region, relative), *_porous(case, region)]
    found += () if turbulent else _turbulent(folder)
    found += [*_compressible(folder, case), *_phases(folder)]
    return [*found, *(_moving(case, region, folder) if moving else ())]


def caveat_of_flux(
    mesh: Mesh,
    patches: Sequence[PatchInfo],
    cells: Floats,
    boundary: Floats,
    case: Path,
    folder: Path,
    velocity: str,
) -> list[Caveat]:
    """A warning if more fluid enters through the boundary than leaves, or less.

    Parameters
    ----------
    mesh, patches
        The mesh, and its patches as the case lists them.
    cells
        (n_cells, 3) velocity at the cells, m/s: what is small against it may be round-off of a closed domain.
    boundary
        (n_boundary, 3) velocity at the boundary faces, m/s, for want of ``phi``.
    case, folder
        The case, and the time directory where ``phi`` may be.
    velocity
        Name of the velocity; ``phi`` is the flux of ``U`` only.
    """
    phi = _flux(folder, case, patches) if velocity == "U" else None
    if phi is None and _varies(folder, case):
        # Without phi nothing tells how much mass goes through.
        return []
    source, unit = (phi[1], phi[2]) if phi else ("U on the patches", "m3/s")
    flux = phi[0] if phi else np.einsum("ni,ni->n", boundary, mesh.boundary_areas)
    outflow, inflow = float(flux[flux > 0.0].sum()), float(-flux[flux < 0.0].sum())
    area = float(np.linalg.norm(mesh.boundary_areas, axis=1).sum())
    round_off = ROUND_OFF * area * float(np.linalg.norm(cells, axis=1).max(initial=0.0))
    if abs(outflow - inflow) <= max(LEAST_LOSS * max(outflow, inflow), round_off):
        return []
    return [
        Caveat(
            f"the flow does not conserve {'mass' if unit == 'kg/s' else 'volume'}: {inflow:.6g} {unit} enter "
            f"and {outflow:.6g} {unit} leave (from {source}). Has the solver converged at this time? "
            "Particles follow a flow that loses or makes fluid."
        )
    ]


def _rotating(case: Path, region: str, relative: bool) -> Iterator[Caveat]:
    zones = _zones(case, region, "MRFProperties", ("constant",), lambda _: True)
    if zones and not relative:
        yield Caveat(
            f"the flow has rotating zones (MRFProperties: {zones}), but particles move in them with the "
            "absolute velocity: they meet the blades only where the mesh has them, as if these stood still."
        )
    if _zones(case, region, "SRFProperties", ("constant",), lambda _: True) is not None:
        yield Caveat(
            "the flow is that of a rotating frame (SRFProperties), but rotating frames are not modelled: "
            "centrifugal and Coriolis forces on particles are left out."
        )


def _porous(case: Path, region: str) -> Iterator[Caveat]:
    zones = [
        _zones(
            case, region, "fvOptions", ("constant", "system"), lambda entry: "orosity" in _word(entry, "type")
        ),
        _zones(case, region, "porosityProperties", ("constant",), lambda _: True),
    ]
    if any(zones):
        yield Caveat(
            f"the flow has porous zones ({', '.join(filter(None, zones))}): particles go through with the "
            "superficial velocity, and the pores neither catch nor deform them."
        )


def _turbulent(folder: Path) -> Iterator[Caveat]:
    name = "nut" if existing(folder / "nut") is not None else "k"
    if is_not_zero(folder / name):
        yield Caveat(
            f"the flow is the mean or the resolved part of a turbulent one (there is {name}): particles "
            "follow and feel that part alone, without dispersion by the eddies and without their stresses. "
            "subModels/dispersionModel stochasticDispersionRAS adds the dispersion, from k and epsilon or "
            "omega."
        )


def is_not_zero(path: Path) -> bool:
    """Whether there is a field that is not zero everywhere."""
    found = existing(path)
    return found is not None and not _ZERO.search(read_bytes(found, _HEAD))


def _compressible(folder: Path, case: Path) -> Iterator[Caveat]:
    values = _density(folder, case)
    if values is not None and _spread(values):
        yield Caveat(
            f"the fluid's density is from {values.min():.4g} to {values.max():.4g} kg/m3 (there is rho), but "
            "to particles it is constant, rhoInf, and so is the viscosity."
        )


def _phases(folder: Path) -> Iterator[Caveat]:
    paths = sorted(path for path in folder.glob("alpha.*") if path.is_file() and ".orig" not in path.name)
    names = [path.name.removesuffix(".gz") for path in paths if _VARIES.search(read_bytes(path, _HEAD))]
    if names:
        yield Caveat(
            f"the flow has several phases ({', '.join(names)}), but to particles the fluid is one, with "
            "rhoInf and one viscosity everywhere: they cross interfaces as if there were none."
        )


def _moving(case: Path, region: str, folder: Path) -> Iterator[Caveat]:
    try:
        root = _dictionary(case, region, "dynamicMeshDict", ("constant",))
        kind = "" if root is None else _word(root, "dynamicFvMesh") or "dynamicMeshDict"
    except InputError:
        kind = "dynamicMeshDict"
    if kind in ("", _STATIC):
        kind = "points at this time" if existing(folder / "polyMesh/points") is not None else ""
    if kind:
        yield Caveat(
            f"the mesh moves ({kind}), but is read at one time: it stands still, and particles meet its "
            "walls where they are at this time."
        )


def _zones(
    case: Path, region: str, name: str, folders: Sequence[str], meant: Callable[[Dictionary], bool]
) -> str | None:
    """Names of those entries of a dictionary that are meant and not switched off; None if there is no file.

    A dictionary that cannot be read may have any.
    """
    try:
        root = _dictionary(case, region, name, folders)
    except InputError:
        return "which cannot be read"
    if root is None:
        return None
    entries = [entry for entry in root.entries.values() if isinstance(entry, Dictionary)]
    return ", ".join(e.key for e in entries if _word(e, "active") not in _OFF and meant(e))


def _dictionary(case: Path, region: str, name: str, folders: Sequence[str]) -> Dictionary | None:
    """The dictionary of a name, of the region or else of the case; None if there is none."""
    for path in (case / folder / part / name for part in dict.fromkeys((region, "")) for folder in folders):
        if existing(path) is not None:
            return read_dictionary(path, case)
    return None


def _word(dictionary: Dictionary, key: str) -> str:
    entry = dictionary.entries.get(key)
    return entry.text if isinstance(entry, Stream) else ""


def _flux(folder: Path, case: Path, patches: Sequence[PatchInfo]) -> tuple[Floats, str, str] | None:
    """Flux out of the boundary faces (n,), its name and its unit; None if ``phi`` does not give it."""
    if existing(folder / "phi") is None:
        return None
    try:
        phi = read_field(folder / "phi", _FLUX, case)
    except InputError:
        return None
    values = []
    for patch in patches:
        entry = phi.of(patch)
        found = entry.fields.get("value") if entry else None
        if found is None or len(found) not in (1, patch.faces):
            if patch.faces and patch.type != "empty":
                return None
            found = np.zeros((1, 1))
        values.append(np.broadcast_to(found, (patch.faces, 1))[:, 0])
    unit = "kg/s" if phi.dimensions == MASS_FLUX else "m3/s"
    return np.concatenate([np.empty(0), *values]), "phi", unit


def _density(folder: Path, case: Path) -> Floats | None:
    """Density at the cells, kg/m³, if the time has it."""
    try:
        return None if existing(folder / "rho") is None else read_field(folder / "rho", _RHO, case).cells
    except InputError:
        return None


def _spread(values: Floats) -> bool:
    return bool(np.ptp(values) > 1e-6 * np.abs(values).max(initial=0.0)) if len(values) else False


def _varies(folder: Path, case: Path) -> bool:
    values = _density(folder, case)
    return values is not None and _spread(values)
