"""Why particles failed, in words: what happened, and what it means with the models of the cloud."""

from __future__ import annotations

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.limits import Limits
from foamprb.cloud.state import REASONS, Reason
from foamprb.cloud.tracker import Models

__all__ = ["explain"]


def explain(reason: Reason | int, models: Models, limits: Limits) -> str:
    """Return the end of a sentence on a particle that failed.

    Parameters
    ----------
    reason, models, limits
        Of the particle, and of its cloud.
    """
    reason = Reason(reason)
    scheme = INTEGRATORS[models.integrator]
    hint = ""
    if reason == Reason.STRETCHED:
        hint = f"maxStretch is {limits.maxStretch:g}; it has no steady shape there"
    elif reason == Reason.TOO_LARGE:
        hint = f"maxSize is {limits.maxSize:g}; no gradient is uniform over such a body"
    elif reason == Reason.CELLS_TOO_MANY:
        hint = f"maxCells is {limits.maxCells:g}"
    elif reason == Reason.WALLS_TOO_MANY:
        hint = "no gradient is uniform over such a body"
    elif reason == Reason.SUB_STEPS:
        hint = f"maxSubSteps is {limits.maxSubSteps:g}"
    elif reason == Reason.VOLUME_RATIO and models.material == "saintVenantKirchhoff":
        hint = "a Saint Venant-Kirchhoff solid gives way when it is compressed"
    elif reason == Reason.VOLUME_RATIO and scheme.adaptive:
        hint = "the solid is too soft to keep its volume"
    elif not scheme.adaptive and reason in (
        Reason.VOLUME_RATIO, Reason.NOT_FINITE, Reason.NOT_CONVERGED,
    ):  # fmt: skip
        hint = "Δt beyond stability?"
    return f"{REASONS[reason]} ({hint})" if hint else REASONS[reason]
