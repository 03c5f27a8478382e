"""Every validation case by name."""

from __future__ import annotations

from validation import (
    brownian,
    cost,
    device,
    dispersion,
    extension,
    faxen,
    forces,
    jeffery,
    order,
    pipe,
    rotating,
    rotation,
    settling,
    shear,
    strides,
    suspension,
    tension,
    tumbling,
    viscoelastic,
    walls,
)
from validation.case import Case

CASES: dict[str, Case] = {
    "rotation": Case("5.1, Fig. 4", rotation.spin_up),
    "extensionDevice": Case("5.2, Fig. 5", device.beads),
    "shear": Case("5.3, Figs. 6 and 7", shear.steady),
    "roscoe": Case("5.3, references", shear.formulas),
    "transient": Case("5.3, Fig. 8", shear.transient),
    "tankTreading": Case("5.3, Fig. 9", shear.tank_treading),
    "pipeRigid": Case("5.4, Figs. 11 and 12", pipe.rigid),
    "pipeSoft": Case("5.4, Figs. 13 and 14", pipe.soft),
    "pipeOpenFOAM": Case("5.4, Figs. 10 and 14", pipe.openfoam),
    "jeffery": Case("beyond the paper; shapes at rest", jeffery.orbits),
    "tumbling": Case("beyond the paper; shapes at rest", tumbling.regimes),
    "viscoelastic": Case("beyond the paper; Kelvin–Voigt solids", viscoelastic.steady),
    "suspension": Case("beyond the paper; stress of suspensions", suspension.stress),
    "surfaceTension": Case("beyond the paper; surface tension", tension.drops),
    "forces": Case("beyond the paper; forces on the barycentre", forces.forces),
    "faxen": Case("beyond the paper; curved flows", faxen.lag),
    "wallLift": Case("beyond the paper; walls", walls.lift),
    "wallMobility": Case("beyond the paper; walls", walls.mobility),
    "brownian": Case("beyond the paper; molecules", brownian.brownian),
    "dispersion": Case("beyond the paper; turbulence", dispersion.dispersion),
    "rotatingZones": Case("beyond the paper; rotating zones", rotating.frames),
    "cost": Case("Appendix F, Table F.1", cost.cost),
    "extension": Case("beyond the paper", extension.steady_extension),
    "settling": Case("beyond the paper", settling.settling),
    "order": Case("beyond the paper", order.order),
    "longSteps": Case("beyond the paper", strides.strides),
    "volume": Case("beyond the paper", extension.volume),
}
"""A case is one function and its line here."""
