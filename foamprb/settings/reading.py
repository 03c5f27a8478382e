"""How the settings follow from the files of a case: ``constant/softCloudProperties``, and those beside it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from foamprb.cloud.forces import FORCES, Force
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.dispersion import DISPERSIONS
from foamprb.cloud.surroundings.registry import SURROUNDINGS
from foamprb.cloudfunctions.base import CloudFunction
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Choice
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.schema import read_entries, read_entry, selected
from foamprb.dictionary.tree import Dictionary, Source, unquoted
from foamprb.dictionary.values import Files
from foamprb.errors import InputError
from foamprb.results.folder import fault_of_function
from foamprb.results.names import fault_of_word
from foamprb.settings import entries
from foamprb.settings.fluid import of_region, read_fluid, read_gravity
from foamprb.settings.injections import read_injections
from foamprb.settings.libs import load_libs
from foamprb.settings.patches import coefficient_names, read_patch_interaction
from foamprb.settings.settings import Fluid, Settings
from foamprb.settings.solution import read_solution

__all__ = ["read_settings"]

_DICTIONARY = "softCloudProperties"
_TO_BEGIN = (
    f"To begin: foamprb init writes constant/{_DICTIONARY} from what the case says; or name another "
    "dictionary with -dict."
)


def read_settings(
    case: Path, dictionary: Path | None = None, region: str = "", time: float | str = "latestTime"
) -> Settings:
    """Read and validate the settings of a cloud.

    Parameters
    ----------
    case
        The case; if the cloud does not give them, ν comes from its ``constant/transportProperties``,
        ``physicalProperties`` or ``thermophysicalProperties``, ρ_f from there or from the field ``rho``; and,
        if ``gravity`` is among the particle forces, g from its ``constant/g``.
    dictionary
        The cloud's dictionary, relative to the case; ``constant/softCloudProperties`` by default.
    region
        Region of the mesh: its files in ``constant/REGION`` go before those in ``constant``.
    time
        Time of the flow, at which the field ``rho`` is read.

    Raises
    ------
    InputError
        If there are mistakes, all of them: the file, the line, the entry's path, what was found and what is
        allowed. Of a file that is no dictionary, the first fault of its grammar.
    """
    if region and (fault := fault_of_word(region)):
        raise InputError(f"'{region}' is no name of a region: {fault}.")
    file = case / (dictionary or of_region(case, region, _DICTIONARY))
    name = file.stem.removesuffix("Properties") or file.stem
    if fault := fault_of_word(name):
        raise InputError(f"{file}: its name gives the cloud the name '{name}', which is none: {fault}.")
    if not file.exists() and case.is_dir():
        raise InputError(f"{Source(file, case)}: No such file or directory (case {case}). {_TO_BEGIN}")
    root = read_dictionary(file, case)
    if "libs" in root.entries:
        # First: the entries that follow may name solids that these files add.
        load_libs(read_entry(root, "libs", Files))
    mistakes = Mistakes()
    with mistakes:
        read_entries(entries.CloudProperties, root)
    with mistakes:
        solution = read_solution(_section(root, "solution"), case)
    # Without a fluid, and if their model is not known, the particles are still checked.
    fluid = Fluid(math.nan, math.nan)
    with mistakes:
        fluid = read_fluid(case, region, _section(root, "constantProperties"), time)
    with mistakes:
        sub_models = _section(root, "subModels")
        with mistakes:
            models = read_entries(entries.SubModels, sub_models, also=(*coefficient_names(), *_COEFFICIENTS))
        with mistakes:
            dispersion = _dispersion(sub_models)
        with mistakes:
            drag, forces, surroundings = _forces(_section(sub_models, "particleForces"))
            gravity = read_gravity(case, region) if "gravity" in forces else (0.0, 0.0, 0.0)
        with mistakes:
            patches, touching = read_patch_interaction(sub_models)
        with mistakes:
            injections = read_injections(
                _section(sub_models, "injectionModels"), _section(root, "constantProperties"), fluid
            )
    with mistakes:
        functions = (
            _functions(_section(root, "cloudFunctions"), name) if "cloudFunctions" in root.entries else {}
        )
    mistakes.raise_any()
    return Settings(
        case=case,
        file=file,
        name=name,
        solution=solution,
        fluid=fluid,
        gravity=gravity,
        traction=models.tractionModel,
        drag=drag.type,
        injections=injections,
        interaction=models.patchInteractionModel,
        touching=touching,
        patches=patches,
        functions=functions,
        forces=forces,
        surroundings=surroundings,
        dispersion=dispersion,
        region=region,
    )


def _section(dictionary: Dictionary, key: str) -> Dictionary:
    """Return a dictionary that a schema requires in another."""
    if key not in dictionary.entries:
        raise ReportedError(f"{key} is missing")
    return dictionary.entries[key].dictionary()


def _forces(
    dictionary: Dictionary,
) -> tuple[entries.EllipsoidDrag, dict[str, Force], dict[str, Surrounding]]:
    """Read ``particleForces { ellipsoidDrag { … } gravity; wallLift { … } … }``: drag, and others by name."""
    mistakes = Mistakes()
    with mistakes:
        drag = read_entries(entries.ParticleForces, dictionary, also=(*FORCES, *SURROUNDINGS)).ellipsoidDrag
    forces: dict[str, Force] = {}
    for name, kind in FORCES.items():
        with mistakes:
            if name in dictionary.entries:
                forces[name] = read_entry(dictionary, name, kind)
    surroundings: dict[str, Surrounding] = {}
    for name, model in SURROUNDINGS.items():
        with mistakes:
            if name in dictionary.entries:
                surroundings[name] = read_entry(dictionary, name, model)
    mistakes.raise_any()
    return drag, forces, surroundings


_COEFFICIENTS = {f"{name}Coeffs": name for name in DISPERSIONS}


def _dispersion(sub_models: Dictionary) -> dict[str, Surrounding]:
    """Read the ``dispersionModel`` of ``subModels`` with its coefficients, if any; nothing of none."""
    mistakes = Mistakes()
    found: dict[str, Surrounding] = {}
    chosen = "none"
    with mistakes:
        if "dispersionModel" in sub_models.entries:
            rule = Annotated[str, Choice(("none", *DISPERSIONS))]
            chosen = read_entry(sub_models, "dispersionModel", rule)
    for coefficients, name in _COEFFICIENTS.items():
        with mistakes:
            model = DISPERSIONS[name]()
            if coefficients in sub_models.entries:
                model = read_entry(sub_models, coefficients, DISPERSIONS[name])
            if name == chosen:
                found[name] = model
    mistakes.raise_any()
    return found


def _functions(dictionary: Dictionary, cloud: str) -> dict[str, CloudFunction]:
    """Read ``cloudFunctions { name { type …; … } … }``."""
    functions: dict[str, CloudFunction] = {}
    mistakes = Mistakes()
    for entry in dictionary.entries.values():
        with mistakes:
            name, own = unquoted(entry.key), entry.dictionary()
            if fault := fault_of_function(name, cloud):
                raise entry.mistake(f"is no name of a folder, which the results need: {fault}.")
            functions[name] = read_entries(selected(FUNCTIONS, own), own, also=("type",))
    mistakes.raise_any()
    return functions
