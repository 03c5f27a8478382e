"""Settings of a cloud: ``constant/softCloudProperties``, read with the files beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, TypeVar

from foamprb.body.drag import DRAGS
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.forces import FORCES, Force
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.dispersion import DISPERSIONS
from foamprb.cloud.surroundings.fates import Fates
from foamprb.cloud.surroundings.registry import SURROUNDINGS
from foamprb.cloud.tracker import SHAPES
from foamprb.cloudfunctions.base import CloudFunction
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Choice, Meaning, NoEffect, Only, Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.overrides import override
from foamprb.dictionary.schema import Instead, read_entries, read_entry, read_model
from foamprb.dictionary.tree import CaseFile, Dictionary, unquoted
from foamprb.dictionary.values import Files
from foamprb.errors import InputError
from foamprb.results.folder import fault_of_function, fault_of_word
from foamprb.settings.fluid import ConstantProperties, Fluid, of_region, read_fluid, read_gravity
from foamprb.settings.injections import InjectionSettings, read_injections
from foamprb.settings.libs import load_libs, require_inside
from foamprb.settings.patches import INTERACTION_MODELS, Rule, Touching, read_patch_interaction
from foamprb.settings.solution import Solution, read_solution

_DICTIONARY = "softCloudProperties"


@dataclass(frozen=True, kw_only=True)
class EllipsoidDrag:
    """``subModels/particleForces/ellipsoidDrag``."""

    type: Annotated[
        str,
        Choice(DRAGS),
        Meaning(
            "[law of drag](models/drag.md)",
            values={
                "oberbeck": "exact drag of an ellipsoid",
                "brennerProlate": "the paper's, of a prolate spheroid of the longest and the shortest axis",
            },
        ),
    ] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class ParticleForces:
    """``subModels/particleForces``, without the entries of the registries of forces and surroundings."""

    ellipsoidDrag: Annotated[EllipsoidDrag, Meaning("drag; `ellipsoidDrag;` alone is enough")]

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the drag that replaces OpenFOAM's laws for spheres."""
        why = "which for a rigid sphere is Stokes' drag"
        return Instead("ellipsoidDrag", why) if word.endswith("Drag") else None


_DILUTE = Only("none", "the suspension is dilute, particles do not meet")
_NO_MODEL = NoEffect("there is no such model")


@dataclass(frozen=True, kw_only=True)
class SubModels:
    """``subModels``, without the coefficients of the patch interaction and dispersion models."""

    particleForces: Annotated[Dictionary, Meaning("[forces](#particleforces); `ellipsoidDrag;` at least")]
    injectionModels: Annotated[
        Dictionary, Meaning("[dictionaries](#injectionmodels), one for each model, any number")
    ]
    patchInteractionModel: Annotated[
        str,
        Choice(INTERACTION_MODELS),
        Meaning(
            "[interaction with patches](#patch-interaction), with the `…Coeffs` of the model",
            values={
                "localInteraction": "an interaction for each patch",
                "rebound": "particles bounce off every patch",
                "standardWallInteraction": "one interaction for all walls; particles leave elsewhere",
            },
        ),
    ]
    tractionModel: Annotated[
        str,
        Choice(TRACTIONS),
        Meaning(
            "[traction](models/traction.md) on the surface",
            values={
                "roscoe": "on a surface that moves with the deforming body",
                "jeffery": "as on a rigid ellipsoid; wrong for soft ones",
            },
        ),
    ] = "roscoe"
    shapeModel: Annotated[
        str,
        Choice(SHAPES),
        Meaning(
            "modes of the shape: an ellipsoid, or also the [quadratic mode](models/quadratic.md)",
            values={
                "affine": "a sphere becomes an ellipsoid",
                "quadratic": "the curvature of the flow bends the ellipsoid, to a bullet for example",
            },
        ),
    ] = "affine"
    dispersionModel: Annotated[
        str,
        Choice(("none", *DISPERSIONS)),
        Meaning(
            "[dispersion by eddies](models/turbulent-dispersion.md) of a flow that is a mean; the `…Coeffs` "
            "of the model are optional",
            values={
                "none": "no eddies",
                "stochasticDispersionRAS": "particles pass through one random eddy after another",
                "gradientDispersionRAS": "as OpenFOAM's: eddy velocities down the gradient of k",
            },
        ),
    ] = "none"
    fates: Annotated[
        Fates | None,
        Meaning("[limits](models/fates.md) at which bodies rupture or are released", default="none"),
    ] = None
    heatTransferModel: Annotated[str, Only("none", "particles have no temperature")] = "none"
    surfaceFilmModel: Annotated[str, Only("none", "there is no film on the walls")] = "none"
    collisionModel: Annotated[str, _DILUTE] = "none"
    stochasticCollisionModel: Annotated[str, _DILUTE] = "none"
    packingModel: Annotated[str, _DILUTE] = "none"
    dampingModel: Annotated[str, _DILUTE] = "none"
    isotropyModel: Annotated[str, _DILUTE] = "none"
    radiation: Annotated[bool, Only(False, "particles have no temperature")] = False
    pairCollisionCoeffs: Annotated[None, _NO_MODEL] = None
    explicitCoeffs: Annotated[None, _NO_MODEL] = None
    implicitCoeffs: Annotated[None, _NO_MODEL] = None
    relaxationCoeffs: Annotated[None, _NO_MODEL] = None
    stochasticCoeffs: Annotated[None, _NO_MODEL] = None


@dataclass(frozen=True, kw_only=True)
class CloudProperties:
    """The whole file, whose dictionaries have schemas of their own."""

    solution: Annotated[Dictionary, Meaning("[time](#solution) and schemes")]
    constantProperties: Annotated[Dictionary, Meaning("[fluid and particles](#constantproperties)")]
    subModels: Annotated[Dictionary, Meaning("[models](#submodels)")]
    cloudFunctions: Annotated[
        Dictionary | None, Meaning("[data recorded during the run](#cloudfunctions)", default="none")
    ] = None
    libs: Annotated[
        Files | None,
        Meaning(
            "Python files of the case that add [models](own-models.md); others with `-outsideLibs`",
            "",
            "none",
        ),
    ] = None


@dataclass(frozen=True)
class Settings:
    """The settings of a run; gravity in m/s2, zero if it is not among the forces."""

    case: Path
    file: Path
    name: str
    solution: Solution
    fluid: Fluid
    gravity: Vector3
    traction: str
    drag: str
    injections: tuple[InjectionSettings, ...]
    interaction: str
    touching: Touching
    patches: tuple[Rule, ...]
    functions: Mapping[str, CloudFunction]
    forces: Mapping[str, Force]
    surroundings: Mapping[str, Surrounding]
    dispersion: Mapping[str, Surrounding] = field(default_factory=dict)
    """The dispersionModel by its name; empty without one."""
    fates: Mapping[str, Surrounding] = field(default_factory=dict)
    """The fates by limits, by the name of their entry; empty without any."""
    shape: str = "affine"
    region: str = ""
    overrides: Mapping[str, str] = field(default_factory=dict)
    """Texts that replace entries of the file, by path."""
    libs: Mapping[str, str] = field(default_factory=dict)
    """SHA-256 of each Python file of ``libs``, by its name."""


def read_settings(
    case: Path,
    dictionary: Path | None = None,
    region: str = "",
    time: float | str = "latestTime",
    outside_libs: bool = False,
    overrides: Mapping[str, object] | None = None,
) -> Settings:
    """Read and validate the settings of a cloud.

    Parameters
    ----------
    case
        The case. Where the cloud's dictionary does not give them, ν is read from
        ``constant/transportProperties``, ``physicalProperties`` or ``thermophysicalProperties``, ρ_f from
        there or from the field ``rho``, and g, if ``gravity`` is among the forces, from ``constant/g``.
    dictionary
        The cloud's dictionary, relative to the case; ``constant/softCloudProperties`` by default.
    region
        Region of the mesh: its files in ``constant/REGION`` go before the files in ``constant``.
    time
        Time of the flow, at which fields of the fluid are read.
    outside_libs
        Whether Python files of ``libs`` may lie outside the case.
    overrides
        Values that replace entries of the dictionary or are added to it, by path; see :func:`override`.

    Raises
    ------
    InputError
        If there are mistakes, all of them, each with the file, the line, the entry's path, the value and the
        allowed values. If a file is not a dictionary, its first syntax error.
    """
    if region and (fault := fault_of_word(region)):
        raise InputError(f"'{region}' is not a valid name of a region: {fault}.")
    file = case / (dictionary or of_region(case, region, _DICTIONARY))
    name = file.stem.removesuffix("Properties") or file.stem
    if fault := fault_of_word(name):
        raise InputError(f"{file}: the file name yields an invalid cloud name, '{name}': {fault}.")
    if not file.exists() and case.is_dir():
        raise InputError(
            f"{CaseFile(file, case)}: No such file or directory (case {case}). Write one: foamprb init"
            f"{f' -region {region}' if region else ''} writes {_DICTIONARY} for a case; or name another file "
            "with -dict."
        )
    root = read_dictionary(file, case, warn=True)
    texts = override(root, overrides or {})
    # Other entries may name solids from these files.
    files = read_entry(root, "libs", Files) if "libs" in root.entries else ()
    if not outside_libs:
        require_inside(files, case)
    libs = dict(zip((_name_of(file, case) for file in files), load_libs(files), strict=True))
    mistakes = Mistakes()
    with mistakes:
        read_entries(CloudProperties, root)
    solution: Any = None
    with mistakes:
        solution = read_solution(_section(root, "solution"), case)
    # Particles are also checked if the fluid is unknown.
    fluid, properties = Fluid(math.nan, math.nan), None
    with mistakes:
        constant = _section(root, "constantProperties")
        with mistakes:
            properties = read_entries(ConstantProperties, constant)
        transient, mixture = (solution.transient, solution.mixture) if solution else (False, False)
        fluid = read_fluid(case, region, constant, properties, time, transient, mixture)
    with mistakes:
        sub_models = _section(root, "subModels")
        with mistakes:
            coefficients = [f"{model}Coeffs" for model in (*INTERACTION_MODELS, *DISPERSIONS)]
            models = read_entries(SubModels, sub_models, also=coefficients)
        with mistakes:
            dispersion = _dispersion(sub_models)
        with mistakes:
            particle_forces = _section(sub_models, "particleForces")
            with mistakes:
                also = (*FORCES, *SURROUNDINGS)
                drag = read_entries(ParticleForces, particle_forces, also).ellipsoidDrag.type
            forces = _chosen(FORCES, particle_forces, mistakes)
            surroundings = _chosen(SURROUNDINGS, particle_forces, mistakes)
            gravity = read_gravity(case, region) if "gravity" in forces else (0.0, 0.0, 0.0)
        with mistakes:
            patches, touching = read_patch_interaction(sub_models)
        with mistakes:
            injection_models = _section(sub_models, "injectionModels")
            injections = read_injections(
                injection_models, _section(root, "constantProperties"), properties, fluid
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
        drag=drag,
        injections=injections,
        interaction=models.patchInteractionModel,
        touching=touching,
        patches=patches,
        functions=functions,
        forces=forces,
        surroundings=surroundings,
        dispersion=dispersion,
        fates={"fates": models.fates} if models.fates else {},
        shape=models.shapeModel,
        region=region,
        overrides=texts,
        libs=libs,
    )


def _name_of(file: Path, case: Path) -> str:
    """Return the name of a file as an entry gives it."""
    constant = case / "constant"
    return str(file.relative_to(constant) if file.is_relative_to(constant) else file)


def _section(dictionary: Dictionary, key: str) -> Dictionary:
    """Return a dictionary that a schema requires in another."""
    if key not in dictionary.entries:
        raise ReportedError(f"{key} is missing")
    return dictionary.entries[key].dictionary()


T = TypeVar("T")


def _chosen(registry: Mapping[str, type[T]], dictionary: Dictionary, mistakes: Mistakes) -> dict[str, T]:
    """Read the models of a registry whose names are entries of a dictionary, in the registry's order."""
    values: dict[str, Any] = {}
    for name, kind in registry.items():
        with mistakes:
            if name in dictionary.entries:
                values[name] = read_entry(dictionary, name, kind)
    return values


def _dispersion(sub_models: Dictionary) -> dict[str, Surrounding]:
    """Read the ``dispersionModel`` of ``subModels`` with its coefficients; empty if there is none."""
    mistakes = Mistakes()
    selected, models = "none", {}
    with mistakes:
        if "dispersionModel" in sub_models.entries:
            rule = Annotated[str, Choice(("none", *DISPERSIONS))]
            selected = read_entry(sub_models, "dispersionModel", rule)
    for name, model in DISPERSIONS.items():
        with mistakes:
            has_coefficients = f"{name}Coeffs" in sub_models.entries
            models[name] = read_entry(sub_models, f"{name}Coeffs", model) if has_coefficients else model()
    mistakes.raise_any()
    return {name: model for name, model in models.items() if name == selected}


def _functions(dictionary: Dictionary, cloud: str) -> dict[str, CloudFunction]:
    """Read ``cloudFunctions { name { type …; … } … }``."""
    functions: dict[str, CloudFunction] = {}
    mistakes = Mistakes()
    for entry in dictionary.entries.values():
        with mistakes:
            name, entries = unquoted(entry.key), entry.dictionary()
            if fault := fault_of_function(name, cloud):
                raise entry.mistake(f"is not a valid name of a folder for results: {fault}.")
            functions[name] = read_model(FUNCTIONS, entries)
    mistakes.raise_any()
    return functions
