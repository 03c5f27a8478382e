"""Kinds of patches, by OpenFOAM's types of patches and conditions of the velocity."""

from __future__ import annotations

from enum import Enum


class PatchKind(Enum):
    """Meaning of a patch to particles and to the fluxes of the flow."""

    OPENING = "opening"
    WALL = "wall"
    MIRROR = "mirror"
    """The flow is mirrored, or has no component across it."""
    PASSABLE = "coupled, passable"
    """Particles continue at the neighbour."""
    COUPLED = "coupled, not passable"
    """The flow continues elsewhere, but particles cannot follow it."""
    FACELESS = "without faces"


_TYPES = {
    PatchKind.OPENING: "patch internal mapped mappedInternal mappedPatch",
    PatchKind.WALL: "wall mappedWall mappedExtrudedWall mappedVariableThicknessWall regionCoupledWall",
    PatchKind.MIRROR: "empty symmetry symmetryPlane wedge",
    PatchKind.COUPLED: "cyclic cyclicACMI cyclicAMI cyclicGgi cyclicPeriodicAMI cyclicRepeatAMI cyclicSlip "
    "ggi jumpCyclic mixingPlane nonuniformTransformCyclic oldCyclic overlapGgi overset processor "
    "processorCyclic regionCouple regionCoupledAMI",
    PatchKind.FACELESS: "nonConformalCyclic nonConformalError nonConformalProcessorCyclic",
}
KINDS = {name: kind for kind, names in _TYPES.items() for name in names.split()}
"""Kinds by types of OpenFOAM and foam-extend; a coupled patch is passable if its mesh couples it."""
_OF_REGIONS = {"regionCouple", "regionCoupledAMI"}
VALUELESS = (
    frozenset(name for name, kind in KINDS.items() if kind in (PatchKind.MIRROR, PatchKind.COUPLED))
    - _OF_REGIONS
)
"""Types of patches whose boundary values add nothing to the values of the cells."""
CONSTRAINTS = VALUELESS | {"nonConformalCyclic", "nonConformalProcessorCyclic"}
"""Types of patches on which every field has the same type as the patch."""
_CLOSED = (
    "JohnsonJacksonParticleSlip MRFnoSlip SRFWallVelocity filmPyrolysisVelocityCoupled maxwellSlipU "
    "movingWallVelocity noSlip partialSlip rotatingWallVelocity slip translatingWallVelocity"
)
WALL_CONDITIONS = frozenset(_CLOSED.split())
"""Conditions of the velocity through which nothing flows."""
VALUE_CONDITIONS = frozenset({"calculated", "fixedValue"})
"""Conditions through which nothing flows where their values have no component across the patch."""


def kind_of_type(name: str) -> PatchKind:
    """Return the kind of a type of patches; OpenFOAM treats an unknown type as a plain ``patch``."""
    unknown = PatchKind.COUPLED if name.startswith(("cyclic", "processor")) else PatchKind.OPENING
    return KINDS.get(name, unknown)
