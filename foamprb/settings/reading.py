"""How the settings follow from the files of a case: ``constant/softCloudProperties``, ν and g."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from foamprb.cloudfunctions.base import CloudFunction
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Positive, Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.schema import read_entries, read_entry, selected
from foamprb.dictionary.tree import Dictionary, unquoted
from foamprb.dictionary.values import Files, Viscosity
from foamprb.settings import entries
from foamprb.settings.injections import read_injections
from foamprb.settings.libs import load_libs
from foamprb.settings.patches import coefficient_names, read_patch_interaction
from foamprb.settings.settings import Fluid, Settings, Solution

__all__ = ["read_settings"]

_DICTIONARY = "softCloudProperties"
MULTIPLE_TOLERANCE = 1e-6
"""Relative error of a write interval that counts as a multiple of the step."""


def read_settings(case: Path, dictionary: Path | None = None, region: str = "") -> Settings:
    """Read and validate the settings of a cloud.

    Parameters
    ----------
    case
        The case; ν comes from its ``constant/transportProperties`` and, if ``gravity`` is among the
        particle forces, g from its ``constant/g``.
    dictionary
        The cloud's dictionary, relative to the case; ``constant/softCloudProperties`` by default.
    region
        Region of the mesh: its files in ``constant/REGION`` go before those in ``constant``.

    Raises
    ------
    InputError
        At the first mistake: the file, the line, the entry's path, what was found and what is allowed.
    """
    file = case / (dictionary or _of_region(case, region, _DICTIONARY))
    root = read_dictionary(file, case)
    if "libs" in root.entries:
        # First: the entries that follow may name solids that these files add.
        load_libs(read_entry(root, "libs", Files))
    cloud = read_entries(entries.CloudProperties, root)
    models = read_entries(entries.SubModels, cloud.subModels, also=coefficient_names())
    fluid = Fluid(rho=cloud.constantProperties.rhoInf, nu=_viscosity(case, region))
    patches, touching = read_patch_interaction(models.patchInteractionModel, cloud.subModels)
    forces = models.particleForces
    return Settings(
        case=case,
        file=file,
        name=file.stem.removesuffix("Properties") or file.stem,
        solution=_solution(cloud.solution, root),
        fluid=fluid,
        gravity=_gravity(case, region) if forces.gravity else (0.0, 0.0, 0.0),
        traction=models.tractionModel,
        drag=forces.ellipsoidDrag.type,
        injections=read_injections(
            models.injectionModels, cloud.constantProperties, root.at("constantProperties"), fluid
        ),
        interaction=models.patchInteractionModel,
        touching=touching,
        patches=patches,
        functions=_functions(cloud.cloudFunctions),
        pressure_gradient=forces.pressureGradient is not None,
        virtual_mass=forces.virtualMass.Cvm if forces.virtualMass else 0.0,
        region=region,
    )


def _of_region(case: Path, region: str, name: str) -> Path:
    """Return the path, relative to the case, of a region's file, or of the case's if the region has none."""
    own = Path("constant") / region / name
    return own if (case / own).is_file() else Path("constant") / name


def _solution(solution: entries.Solution, root: Dictionary) -> Solution:
    interval = solution.writeInterval
    if interval is not None:
        steps = max(round(interval / solution.deltaT), 1)
        if abs(steps * solution.deltaT - interval) > MULTIPLE_TOLERANCE * interval:
            raise root.at("solution/writeInterval").mistake(
                f"is {interval:g}. Allowed: a multiple of deltaT = {solution.deltaT:g}."
            )
    if solution.period is not None and not solution.transient:
        raise root.at("solution/period").mistake("needs a flow that changes in time: transient yes.")
    return Solution(
        deltaT=solution.deltaT,
        endTime=solution.endTime,
        writeInterval=solution.endTime if interval is None else interval,
        shape=solution.integrationSchemes.shape,
        tolerance=solution.integrationSchemes.tolerance,
        transient=solution.transient,
        period=solution.period,
        startFrom=solution.startFrom,
        maxFailedFraction=solution.maxFailedFraction,
    )


def _functions(dictionary: Dictionary | None) -> dict[str, CloudFunction]:
    """Read ``cloudFunctions { name { type …; … } … }``."""
    functions: dict[str, CloudFunction] = {}
    for entry in dictionary.entries.values() if dictionary else ():
        name, own = unquoted(entry.key), entry.dictionary()
        if Path(name).name != name:
            raise entry.mistake("is no name of a folder, which the results need.")
        functions[name] = read_entries(selected(FUNCTIONS, own), own, also=("type",))
    return functions


def _viscosity(case: Path, region: str) -> float:
    """Read ν, m2/s, with its name and dimensions or without."""
    root = read_dictionary(case / _of_region(case, region, "transportProperties"), case)
    if "transportModel" in root.entries:
        read_entry(root, "transportModel", Literal["Newtonian"])
    coefficients = root.entries.get("NewtonianCoeffs", root).dictionary()
    return float(read_entry(coefficients, "nu", Annotated[Viscosity, Positive]))


def _gravity(case: Path, region: str) -> Vector3:
    """Read g, m/s2."""
    root = read_dictionary(case / _of_region(case, region, "g"), case)
    g: Vector3 = read_entry(root, "value", Vector3)
    return g
