"""Injection models, and what the particles are that they inject: from dictionaries to settings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, get_type_hints

from foamprb.body.material import MATERIALS
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution, Scaled, scaled
from foamprb.cloud.injection.models import INJECTIONS
from foamprb.cloud.injection.shapes import SHAPES, Shape, Sphere
from foamprb.dictionary.schema import allowed, names_of, read_entries, read_entry, refuse_unknown, selected
from foamprb.dictionary.tree import DICTIONARY_TEXT, Dictionary, Entry
from foamprb.settings import entries
from foamprb.settings.settings import Fluid, InjectionSettings, Solid

__all__ = ["read_injections"]


def read_injections(
    models: Dictionary, constant: entries.ConstantProperties, where: Entry, fluid: Fluid
) -> tuple[InjectionSettings, ...]:
    """Read ``injectionModels { name { type …; … } … }``.

    Parameters
    ----------
    models
        The dictionary.
    constant
        The cloud's ``constantProperties``, which an injection model's own entries replace.
    where
        The same as an entry of the file, for messages.
    fluid
        The fluid to which a capillary number refers.
    """
    found = [entry for entry in models.entries.values() if isinstance(entry, Dictionary) or not entry.used]
    if not found:
        raise models.mistake("is empty: no particle would ever appear.")
    return tuple(_injection(entry.dictionary(), constant, where, fluid) for entry in found)


def _injection(
    dictionary: Dictionary, constant: entries.ConstantProperties, where: Entry, fluid: Fluid
) -> InjectionSettings:
    model = selected(INJECTIONS, dictionary)
    common = read_entries(entries.InjectionModel, dictionary, also=names_of(model))
    solids = [solid for solid in (constant.solid, common.solid) if solid is not None]
    return InjectionSettings(
        name=dictionary.key,
        model=read_entries(model, dictionary, also=names_of(entries.InjectionModel)),
        rho=_quantity(constant.rho0 if common.rho0 is None else common.rho0),
        solid=_solid(solids, fluid, where=solids[-1] if solids else where),
        size=_distribution(common.sizeDistribution),
        shape=_shape(common.shape or constant.shape),
    )


def _shape(dictionary: Dictionary | None) -> Shape:
    """Read ``shape { type ellipsoid; … }``; without it particles are spheres."""
    if dictionary is None:
        return Sphere()
    return read_entries(selected(SHAPES, dictionary), dictionary, also=("type",))


def _quantity(found: float | Dictionary) -> float | Distribution:
    """Return a positive number, or a distribution of such numbers."""
    return _distribution(found) if isinstance(found, Dictionary) else found


def _distribution(dictionary: Dictionary) -> Distribution:
    """Read ``{ type name; nameDistribution { … } }``, a distribution of positive numbers."""
    kind = selected(DISTRIBUTIONS, dictionary)
    coefficients = f"{read_entry(dictionary, 'type', str)}Distribution"
    refuse_unknown(dictionary, ("type", coefficients))
    if coefficients not in dictionary.entries:
        raise dictionary.missing(coefficients, f"Allowed: {DICTIONARY_TEXT}.")
    found = dictionary.entries[coefficients].dictionary()
    distribution = read_entries(kind, found)
    if not distribution.limits[0] > 0.0:
        raise found.mistake(f"begins at {distribution.limits[0]:g}. Allowed: values > 0.")
    return distribution


def _solid(dictionaries: Sequence[Dictionary], fluid: Fluid, where: Entry) -> Solid:
    """Combine the cloud's solid with an injection model's, whose entries replace the cloud's.

    Parameters
    ----------
    dictionaries
        The cloud's ``solid`` and the injection model's, as far as they exist.
    fluid
        The fluid to which a capillary number refers.
    where
        The dictionary that a message about a missing entry names.
    """
    combined: dict[str, Any] = {}
    parameters = entries.parameters()
    for dictionary in dictionaries:
        read = vars(read_entries(entries.Solid, dictionary, also=parameters))
        own = {key: value for key, value in read.items() if value is not None}
        own |= {
            name: read_entry(dictionary, name, hint)
            for name, hint in parameters.items()
            if name in dictionary.entries
        }
        stiffness = [key for key in entries.STIFFNESS if key in own]
        if len(stiffness) > 1:
            raise dictionary.mistake(
                f"gives {' and '.join(stiffness)}. Allowed: one of {', '.join(entries.STIFFNESS)}."
            )
        if stiffness:
            combined = {key: value for key, value in combined.items() if key not in entries.STIFFNESS}
        combined |= own
    if not combined.keys() & set(entries.STIFFNESS):
        raise where.mistake(f"gives no stiffness. Allowed: one of {', '.join(entries.STIFFNESS)}.")
    hints = get_type_hints(entries.Solid, include_extras=True)
    for key in ("type", "poissonsRatio", *(["referenceShearRate"] if "Ca" in combined else [])):
        if key not in combined:
            raise where.missing(key, allowed(hints[key]))
    parameter = MATERIALS[combined["type"]].parameter
    for name, hint in parameters.items():
        if parameter is not None and name == parameter.entry and name not in combined:
            raise where.missing(name, allowed(hint))
        if name in combined and (parameter is None or name != parameter.entry):
            raise where.mistake(f"gives {name}, which the solid {combined['type']} does not have.")
    return Solid(
        type=combined["type"],
        shear_modulus=_shear_modulus(combined, fluid),
        poissons_ratio=combined["poissonsRatio"],
        reference_shear_rate=combined.get("referenceShearRate"),
        parameter=combined[parameter.entry] if parameter else 0.0,
        viscosity=_quantity(combined.get("viscosity", 0.0)),
        surface_tension=_quantity(combined.get("surfaceTension", 0.0)),
    )


def _shear_modulus(solid: Mapping[str, Any], fluid: Fluid) -> float | Distribution:
    """Return μ_s, Pa, of a solid that gives one of ``STIFFNESS``; Ca = μ_f γ̇/μ_s."""
    if "Ca" in solid:
        return _scaled(_quantity(solid["Ca"]), fluid.mu * solid["referenceShearRate"], power=-1)
    if "youngsModulus" in solid:
        return _scaled(_quantity(solid["youngsModulus"]), 0.5 / (1.0 + solid["poissonsRatio"]))
    return _quantity(solid["shearModulus"])


def _scaled(quantity: float | Distribution, factor: float, power: int = 1) -> float | Distribution:
    """Return ``factor`` times a power of a quantity, distributed or not."""
    if isinstance(quantity, float):
        return float(scaled(quantity, factor, power))
    return Scaled(quantity, factor, power)
