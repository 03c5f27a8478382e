"""Injection models, and what the particles are that they inject: from dictionaries to settings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, get_type_hints

from foamprb.body.material import MATERIALS
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution, Scaled, scaled
from foamprb.cloud.injection.models import INJECTIONS
from foamprb.cloud.injection.shapes import SHAPES, Shape, Sphere
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.schema import allowed, names_of, read_entries, read_entry, refuse_unknown, selected
from foamprb.dictionary.tree import DICTIONARY_TEXT, Dictionary, unquoted
from foamprb.results.names import fault_of_word
from foamprb.settings import entries
from foamprb.settings.settings import Fluid, InjectionSettings, Solid

__all__ = ["read_injections"]


def read_injections(models: Dictionary, constant: Dictionary, fluid: Fluid) -> tuple[InjectionSettings, ...]:
    """Read ``injectionModels { name { type …; … } … }``.

    Parameters
    ----------
    models
        The dictionary.
    constant
        The cloud's ``constantProperties``, which an injection model's own entries replace.
    fluid
        The fluid to which a capillary number refers.

    Raises
    ------
    InputError
        If there are mistakes, all of them.
    """
    found = [entry for entry in models.entries.values() if isinstance(entry, Dictionary) or not entry.used]
    if not found:
        raise models.mistake("is empty: no particle would ever appear.")
    mistakes, injections = Mistakes(), []
    for entry in found:
        with mistakes:
            injections.append(_injection(entry.dictionary(), constant, fluid))
    mistakes.raise_any()
    return tuple(injections)


def _injection(dictionary: Dictionary, constant: Dictionary, fluid: Fluid) -> InjectionSettings:
    mistakes = Mistakes()
    name = unquoted(dictionary.key)
    if fault := fault_of_word(name):
        mistakes.add(dictionary.mistake(f"is no name of an injection model: {fault}."))
    own = {key for model in INJECTIONS.values() for key in names_of(model)}
    with mistakes:
        kind = selected(INJECTIONS, dictionary)
        own = set(names_of(kind))
        with mistakes:
            model = read_entries(kind, dictionary, also=names_of(entries.InjectionModel))
    with mistakes:
        read_entries(entries.InjectionModel, dictionary, also=own)
    hints = get_type_hints(entries.InjectionModel, include_extras=True)
    # The cloud's, which the injection model's own replaces.
    places = {key: dictionary if key in dictionary.entries else constant for key in ("rho0", "shape")}
    with mistakes:
        if "rho0" not in places["rho0"].entries:
            raise ReportedError("rho0 is missing")
        rho = _quantity(read_entry(places["rho0"], "rho0", hints["rho0"]))
    with mistakes:
        shape = _shape(places["shape"])
    with mistakes:
        size = None
        if "sizeDistribution" in dictionary.entries or "positionsFile" not in own:
            size = _distribution(read_entry(dictionary, "sizeDistribution", Dictionary))
    with mistakes:
        solid = _solid(
            [place for place in (constant, dictionary) if "solid" in place.entries], constant, fluid
        )
    mistakes.raise_any()
    return InjectionSettings(name=name, model=model, rho=rho, solid=solid, size=size, shape=shape)


def _shape(place: Dictionary) -> Shape:
    """Read ``shape { type ellipsoid; … }`` of a dictionary; without it particles are spheres."""
    if "shape" not in place.entries:
        return Sphere()
    dictionary = place.entries["shape"].dictionary()
    return read_entries(selected(SHAPES, dictionary), dictionary, also=("type",))


def _quantity(found: float | Dictionary) -> float | Distribution:
    """Return a positive number, or a distribution of such numbers."""
    return _distribution(found) if isinstance(found, Dictionary) else found


def _distribution(dictionary: Dictionary) -> Distribution:
    """Read ``{ type name; nameDistribution { … } }``, a distribution of positive numbers."""
    kind = selected(DISTRIBUTIONS, dictionary)
    coefficients = f"{read_entry(dictionary, 'type', str)}Distribution"
    mistakes = Mistakes()
    with mistakes:
        refuse_unknown(dictionary, ("type", coefficients))
    with mistakes:
        found: Dictionary = read_entry(dictionary, coefficients, Dictionary)
        distribution = read_entries(kind, found)
        if not distribution.limits[0] > 0.0:
            raise found.mistake(f"begins at {distribution.limits[0]:g}. Allowed: values > 0.")
    mistakes.raise_any()
    return distribution


def _solid(places: Sequence[Dictionary], constant: Dictionary, fluid: Fluid) -> Solid:
    """Combine the cloud's solid with an injection model's, whose entries replace the cloud's.

    Parameters
    ----------
    places
        ``constantProperties`` and the injection model, as far as they have a ``solid``.
    constant
        ``constantProperties``.
    fluid
        The fluid to which a capillary number refers.
    """
    if not places:
        raise constant.missing(
            "solid",
            f"Allowed: {DICTIONARY_TEXT} with type and one of {', '.join(entries.STIFFNESS)}, "
            "here or in every injection model.",
        )
    mistakes = Mistakes()
    combined: dict[str, Any] = {}
    for place in places:
        with mistakes:
            own = _solid_entries(place.entries["solid"].dictionary())
            for one_of in (entries.STIFFNESS, entries.COMPRESSIBILITY):
                if own.keys() & set(one_of):
                    combined = {key: value for key, value in combined.items() if key not in one_of}
            combined |= own
    # Only what is there can tell what else is needed.
    mistakes.raise_any()
    where = places[-1].entries["solid"].dictionary()
    hints = get_type_hints(entries.Solid, include_extras=True)
    stiffness = combined.keys() & set(entries.STIFFNESS)
    if not stiffness:
        mistakes.add(where.mistake(f"gives no stiffness. Allowed: one of {', '.join(entries.STIFFNESS)}."))
    needed = {"Ca": "referenceShearRate", "youngsModulus": "poissonsRatio"}
    for key in ("type", *(needed[key] for key in stiffness if key in needed)):
        if key not in combined:
            mistakes.add(where.missing(key, allowed(hints[key])))
    parameters = entries.parameters()
    parameter = MATERIALS[combined["type"]].parameter if "type" in combined else None
    for name, hint in parameters.items() if "type" in combined else ():
        if parameter is not None and name == parameter.entry and name not in combined:
            mistakes.add(where.missing(name, allowed(hint)))
        if name in combined and (parameter is None or name != parameter.entry):
            mistakes.add(where.mistake(f"gives {name}, which the solid {combined['type']} does not have."))
    quantities: dict[str, float | Distribution] = {}
    for key in ("viscosity", "surfaceTension", *stiffness):
        with mistakes:
            quantities[key] = _quantity(combined.get(key, 0.0))
    mistakes.raise_any()
    return Solid(
        type=combined["type"],
        shear_modulus=_shear_modulus(combined | quantities, fluid),
        poissons_ratio=combined.get("poissonsRatio"),
        bulk_modulus=combined.get("bulkModulus"),
        reference_shear_rate=combined.get("referenceShearRate"),
        parameter=combined[parameter.entry] if parameter else 0.0,
        viscosity=quantities["viscosity"],
        surface_tension=quantities["surfaceTension"],
    )


def _solid_entries(dictionary: Dictionary) -> dict[str, Any]:
    """Read the entries of one ``solid``, as far as it has them; of the stiffness only one."""
    parameters = entries.parameters()
    mistakes = Mistakes()
    with mistakes:
        read = vars(read_entries(entries.Solid, dictionary, also=parameters))
    found = {}
    for name, hint in parameters.items():
        with mistakes:
            if name in dictionary.entries:
                found[name] = read_entry(dictionary, name, hint)
    for one_of in (entries.STIFFNESS, entries.COMPRESSIBILITY):
        given = [key for key in one_of if key in dictionary.entries]
        if len(given) > 1:
            mistakes.add(
                dictionary.mistake(f"gives {' and '.join(given)}. Allowed: one of {', '.join(one_of)}.")
            )
    mistakes.raise_any()
    return found | {key: value for key, value in read.items() if value is not None}


def _shear_modulus(solid: Mapping[str, Any], fluid: Fluid) -> float | Distribution:
    """Return μ_s, Pa, of a solid that gives one of ``STIFFNESS``; Ca = μ_f γ̇/μ_s."""
    if "Ca" in solid:
        return _scaled(solid["Ca"], fluid.mu * solid["referenceShearRate"], power=-1)
    if "youngsModulus" in solid:
        return _scaled(solid["youngsModulus"], 0.5 / (1.0 + solid["poissonsRatio"]))
    modulus: float | Distribution = solid["shearModulus"]
    return modulus


def _scaled(quantity: float | Distribution, factor: float, power: int = 1) -> float | Distribution:
    """Return ``factor`` times a power of a quantity, distributed or not."""
    if isinstance(quantity, float):
        return float(scaled(quantity, factor, power))
    return Scaled(quantity, factor, power)
