"""Entries of the settings at the ends of their ranges and beyond: one message, or a run of finite numbers."""

from __future__ import annotations

import copy
import math
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from foam_writer import put_scalar
from hypothesis import given, settings
from hypothesis import strategies as st
from limits import ended_in_time
from pipe_case import copy_of_pipe, time_folder
from settings_reference import SECTIONS, entries_of

from foamprb import execute, prepare
from foamprb.cloud.state import Particles, Status
from foamprb.dictionary.constraints import Axes, Bounds, Constant, Each, Pairs, Vector3
from foamprb.dictionary.schema import hints_of, members, rule_of
from foamprb.dictionary.values import Density, DynamicViscosity, Viscosity
from foamprb.errors import InputError, RunStopped
from foamprb.settings.injections import parameters
from foamprb.settings.settings import read_settings

SOLID = {"type": "neoHooke", "Ca": 0.5, "referenceShearRate": 900}
SIZES = {"type": "fixedValue", "fixedValueDistribution": {"value": 5e-6}}
INJECTION = {"type": "manualInjection", "positionsFile": "softCloudPositions", "sizeDistribution": SIZES}
WALL = {"wall": {"type": "stick"}, '"(inlet|outlet)"': {"type": "escape"}}
CASE: dict[str, Any] = {
    "solution": {"deltaT": 2e-5, "endTime": 8e-4},
    "constantProperties": {"rho0": 2560, "rhoInf": 1.208, "solid": SOLID},
    "subModels": {
        "particleForces": {"ellipsoidDrag": {}, "gravity": ""},
        "injectionModels": {"a": INJECTION},
        "patchInteractionModel": "localInteraction",
        "localInteractionCoeffs": {"patches": [WALL]},
    },
}
"""Two bodies in a pipe of 4.2 mm along x, one of them about to touch its wall; 40 steps."""
POSITIONS = "((0 -0.00165 0) (0 -0.0020968 0))"

SHEAR, OIL = {"type": "neoHooke", "shearModulus": 1.0}, {"surfaceTension": 1e-3, "viscosity": 1e-3}
CAPSULE = {"type": "capsule", "surfaceShearModulus": 1e-5, "surfacePoissonsRatio": 0.5}
VESICLE = {"type": "capsule", "law": "fluid", "excessArea": 0.5}
SKALAK = {"type": "capsule", "surfaceShearModulus": 1e-5, "law": "Skalak", "C": 1}
SOLIDS: dict[str, dict[str, Any]] = {
    "poissonsRatio": SHEAR, "bulkModulus": SHEAR, "shearModulus": SHEAR, "viscosity": SHEAR,
    "surfaceTension": SHEAR,
    "youngsModulus": {"type": "neoHooke", "youngsModulus": 1, "poissonsRatio": 0.4},
    "surfaceShearModulus": CAPSULE, "surfacePoissonsRatio": CAPSULE,
    "viscosityRatio": CAPSULE, "C": SKALAK,
    "excessArea": VESICLE, "bendingModulus": VESICLE,
    "mooneyRatio": {"type": "mooneyRivlin", "shearModulus": 1, "mooneyRatio": 0.5},
    "stretchLimit": {"type": "gent", "shearModulus": 1, "stretchLimit": 50},
}  # fmt: skip
"""The solid in which an entry is changed."""
CENTRE, ALONG = (0.05, 0, 0), (1, 0, 0)
OTHERS: dict[str, dict[str, Any]] = {
    "ellipsoid": {"axisRatios": (2, 1, 1)},
    "general": {"distribution": ((1e-6, 1), (2e-6, 2))},
    "normal": {"minValue": 1e-6, "maxValue": 3e-6, "expectation": 2e-6, "variance": 1e-6},
    "RosinRammler": {"minValue": 1e-6, "maxValue": 3e-6, "d": 1e-6, "n": 2},
    "uniform": {"minValue": 1e-6, "maxValue": 3e-6},
    "ductLift": {"shape": "pipe", "origin": CENTRE, "direction": ALONG, "size": 2.1e-3, "shearRate": 900},
    "rectangularDuctLift": {"origin": CENTRE, "axis": ALONG, "direction": (0, 0, 1), "size": 2.1e-3,
                            "aspectRatio": 1, "shearRate": 900},
    "virtualMass": {"Cvm": 0.5},
    "BrownianMotion": {"T": 300},
    "swimming": {"speed": 1e-5},
    "boxInjection": {"min": (0.01, -1e-3, -1e-3), "max": (0.02, 1e-3, 1e-3), "number": 3},
    "cellZoneInjection": {"numberDensity": 2e6, "selectionMode": "all"},
    "coneInjection": {"positionAxis": ((CENTRE, ALONG),), "duration": 1e-4, "parcelsPerInjector": 3,
                      "Umag": 0.1, "thetaInner": 0, "thetaOuter": 20},
    "lineInjection": {"start": (0.05, -1e-3, 0), "end": (0.05, 1e-3, 0), "number": 3},
    "manualInjection": {"positionsFile": "softCloudPositions"},
    "patchFlowRateInjection": {"patch": "inlet", "parcelConcentration": 3e9, "duration": 1e-4},
    "patchInjection": {"patch": "inlet", "parcelsPerSecond": 3e4, "duration": 1e-4},
    "sphereInjection": {"origin": CENTRE, "radius": 1e-3, "number": 3},
    "adhere": {"kOn": 1e4, "kOff": 1, "xb": 1e-10, "T": 300},
    "deformabilityCytometry": {"origin": (1e-5, 0, 0), "normal": ALONG, "view": (0, 0, 1),
                               "channel": {"type": "tube", "radius": 2.1e-3}},
    "haemolysis": {"constants": "own", "A": 1e-5, "alpha": 2, "beta": 0.7, "stress": "morphology"},
    "particleCollector": {"mode": "plane", "origin": (1e-5, 0, 0), "normal": ALONG},
    "particleTracks": {"trackInterval": 1, "maxSamples": 3},
    "patchPostProcessing": {"patches": ("wall",)},
}  # fmt: skip
"""Entries that a model requires, beside the changed one."""


class Place(NamedTuple):
    """An entry in a case."""

    name: str
    case: dict[str, Any]
    path: tuple[Any, ...]
    kind: Any
    rule: Bounds | Each | None

    def text(self, value: str) -> str:
        """Return the settings with a value of the entry."""
        case = copy.deepcopy(self.case)
        where = case
        for key in self.path[:-1]:
            where = where.setdefault(key, {}) if isinstance(where, dict) else where[key]
        where[self.path[-1]] = value
        return "".join(f"{key} {text_of(part)}\n" for key, part in case.items())


def text_of(value: Any) -> str:
    if isinstance(value, Mapping):
        return f"{{ {' '.join(f'{key} {text_of(part)}' for key, part in value.items())} }}"
    return f"{word_of(value)};"


def word_of(value: Any) -> str:
    if isinstance(value, list):
        return f"( {text_of(value[0])[1:-1]} )"
    return f"({' '.join(map(word_of, value))})" if isinstance(value, tuple) else str(value)


def places() -> Iterator[Place]:
    """Yield all entries that are numbers, each in a case with the entries that it needs."""
    for section, (_, schemas, models) in SECTIONS.items():
        for text in entries_of(section):
            name = text.name
            schema: Any = models.get(text.model)
            if schema is None and name in parameters():
                hint = parameters()[name]
            else:
                prefix = max((p for p in schemas if name.startswith(p)), key=len) if schema is None else ""
                hint, schema = None, schema or schemas[prefix]
                for part in name.removeprefix(prefix).strip("/").split("/"):
                    hint = hints_of(schema)[part]
                    schema = members(hint)[0]
            if (kind := members(hint)[0]) in VALUES:
                case, path = case_of(section, text.model, name)
                yield Place(text.path, case, path, kind, rule_of(hint))


def case_of(section: str, model: str, name: str) -> tuple[dict[str, Any], tuple[Any, ...]]:
    """Return a case with the dictionary of an entry, and the path of the entry."""
    case = copy.deepcopy(CASE)
    models = case["subModels"]
    a, other, path = (
        models["injectionModels"]["a"],
        copy.deepcopy(OTHERS.get(model, {})),
        tuple(name.split("/")),
    )
    where: tuple[Any, ...] = (section,)
    match section:
        case "solid":
            case["constantProperties"]["solid"] = dict(SOLIDS.get(name, SOLID))
            where = ("constantProperties", "solid")
        case "shape":
            case["constantProperties"]["shape"] = {"type": model, **other}
            where = ("constantProperties", "shape")
        case "distributions":
            a["sizeDistribution"] = {"type": model, f"{model}Distribution": other}
            where = ("subModels", "injectionModels", "a", "sizeDistribution", f"{model}Distribution")
        case "dispersion":
            models["dispersionModel"] = path[0].removesuffix("Coeffs")
            where = ("subModels",)
        case "subModels" | "particleForces" | "patchInteraction":
            if path[0] == "particleForces":
                models["particleForces"][path[1]] = copy.deepcopy(OTHERS.get(path[1], {}))
            if path[0].endswith("Coeffs"):
                models["patchInteractionModel"] = path[0].removesuffix("Coeffs")
            where = ("subModels",)
        case "injectionModels" | "injections":
            if model:
                models["injectionModels"]["a"] = {"type": model, "sizeDistribution": SIZES, **other}
            where = ("subModels", "injectionModels", "a")
        case "interactions":
            patches = {**WALL, "wall": {"type": model, **other}}
            models["localInteractionCoeffs"]["patches"] = [patches]
            where = ("subModels", "localInteractionCoeffs", "patches", 0, "wall")
        case "cloudFunctions":
            case["cloudFunctions"] = {"f": {"type": model, **other}}
            if path[-1] == "width":
                case["cloudFunctions"]["f"]["channel"] = {"type": "square"}
            where = ("cloudFunctions", "f")
    return case, (*where, *path)


SIZES_OF_NUMBERS = [10.0**k for k in (-30, -12, -6, -2, 0, 2, 6, 12, 30)]


def numbers(rule: Any) -> list[str]:
    bounds = rule if isinstance(rule, Bounds) else Bounds(-math.inf, math.inf, True, True, "")
    ends = [x for x in (bounds.lower, bounds.upper) if math.isfinite(x)]
    near = [float(np.nextafter(x, side)) for x in ends for side in (-math.inf, math.inf)]
    negative = SIZES_OF_NUMBERS if bounds.lower < 0.0 else (1e-30, 1.0, 1e30)
    values = [0.0, *ends, *near, *SIZES_OF_NUMBERS, *(-x for x in negative)]
    return [*dict.fromkeys(repr(x) for x in values), "nan", "inf", "1e-31", "1e31", "1e400", "x", "(1 2)"]


def integers(rule: Any) -> list[str]:
    bounds = rule if isinstance(rule, Bounds) else Bounds(-math.inf, math.inf, True, True, "")
    ends = [int(x) for x in (bounds.lower, bounds.upper) if math.isfinite(x)]
    values = [
        0,
        *(x + d for x in ends for d in (-1, 0, 1)),
        1000,
        10**6,
        10**9,
        2**31,
        2**32,
        2**53,
        10**18 - 1,
        10**18,
        -5,
    ]
    return [*dict.fromkeys(map(str, values)), "1.5", "1e3", "x"]


def vectors(_: Any) -> list[str]:
    sizes = ("0", "1e-30", "1e-15", "1", "1e15", "1e30", "-1e30")
    return [f"({x} {y} {z})" for s in sizes for x, y, z in ((s, s, s), (s, 0, 0), (1, s, 1))] + [
        "(nan 0 0)",
        "(1 2)",
        "1",
    ]


def pairs(_: Any) -> list[str]:
    texts = [
        "()",
        "((0 0))",
        "((1 1))",
        "((0 0) (1 1))",
        "((-1 1) (1 1))",
        "((1 1) (1 1))",
        "((1e-30 1) (1e30 1))",
    ]
    texts += ["((0 1e30) (0.5 -1e30) (1 1e30))", "((0 1e-30) (1 1e-30))", "((1e-6 1e30) (2e-6 1e-30))"]
    return [*texts, "((1e-6 0) (2e-6 1) (3e-6 0))", "((1 2 3))", "(1 2)", "((0.1 1) (0.1000000000000001 1))"]


def axes(_: Any) -> list[str]:
    return ["()", "((0.05 0 0))", *(f"(((0.05 0 0) {vector}))" for vector in vectors(None))]


VALUES: dict[Any, Any] = {
    float: numbers, Constant: numbers, Viscosity: numbers, DynamicViscosity: numbers, Density: numbers,
    int: integers, Vector3: vectors, Pairs: pairs, Axes: axes,
}  # fmt: skip
PLACES = {place.name: place for place in places()}
"""By their names in the documentation."""
ALL = [(place.name, value) for place in PLACES.values() for value in VALUES[place.kind](place.rule)]
NIGHTLY = os.environ.get("HYPOTHESIS_PROFILE") == "nightly"
PLAIN = re.compile(
    r"solution/|constantProperties/(rho|nu|mu|solid/(Ca|shear|bulk|poisson|young|visc))|\(distrib|.*njection"
)
"""Entries that need no compiled loop but that of the base case."""
DRAWN = ALL if NIGHTLY else [(name, value) for name, value in ALL if PLAIN.match(name)]


@pytest.fixture(scope="module")
def pipe(tmp_path_factory: pytest.TempPathFactory) -> Path:
    case = copy_of_pipe(tmp_path_factory.mktemp("ranges"))
    header, _ = (case / "constant/softCloudPositions").read_text().split("}", 1)
    (case / "constant/softCloudPositions").write_text(f"{header}}}\n{POSITIONS}")
    put_scalar(time_folder(case), "k", "0 2 -2", 1e-4)
    put_scalar(time_folder(case), "epsilon", "0 2 -3", 0.05)
    return case


def run_with(pipe: Path, name: str, value: str) -> str:
    """Run the case with a value of an entry; return the message of a refusal, or nothing."""
    (pipe / "constant/softCloudProperties").write_text(PLACES[name].text(value))
    with ended_in_time(600):
        try:
            job = prepare(pipe, threads=1)
            counts = execute(job, "startTime")
        except (InputError, RunStopped) as error:
            return str(error) or "no message"
    assert job.cloud.time <= job.settings.solution.endTime * (1.0 + 1e-9)
    p = job.cloud.particles
    assert sum(counts.values()) == p.size + job.cloud.late
    sound = (p.status != Status.PENDING) & (p.status != Status.FAILED)
    for key, array in zip(Particles._fields, p, strict=True):
        if array.dtype.kind == "f" and key not in ("k", "largest", "curved"):
            assert np.isfinite(array[sound]).all(), key
    low, high = job.cloud.flow.bounds
    size = (high - low).max()
    assert (p.x[sound] > low - 1e-3 * size).all()
    assert (p.x[sound] < high + 1e-3 * size).all()
    J = np.linalg.det(p.F[sound].reshape(-1, 3, 3))
    assert ((J > 0.125) & (J < 8.0)).all()
    assert not re.search(r"\b(NaN|Infinity)\b", (job.folder.path / "run.json").read_text())
    return ""


def test_a_step_longer_than_the_run_ends_with_it(pipe):
    for step in ("2e-5", "1e+30"):
        assert run_with(pipe, "solution/deltaT", step) == ""
        assert ",stuck,wall," in (pipe / "postProcessing/softCloud/fates.csv").read_text()


def test_a_speed_beyond_single_precision_is_refused(pipe):
    """It was written as infinity."""
    name = "subModels/injectionModels/(name)/U0 (manualInjection)"
    assert "whose size is not from 1e-30 to 1e30" in run_with(pipe, name, "(1e39 0 0)")
    assert "2 of 2 particles have failed" in run_with(pipe, name, "(1e30 0 0)")


@pytest.mark.filterwarnings("ignore::foamprb.errors.FailedParticlesWarning")
@settings(max_examples=len(ALL) if NIGHTLY else 40)
@given(st.sampled_from(DRAWN))
def test_values_at_the_ends_of_a_range_run_or_are_refused(pipe, entry):
    run_with(pipe, *entry)


def test_values_beyond_a_range_are_refused_by_the_name_of_their_entry(pipe):
    for name, place in PLACES.items():
        if not isinstance(place.rule, Bounds):
            continue
        bounds, values = place.rule, ["1e31", "x"]
        values += [repr(bounds.lower - 1.0)] if math.isfinite(bounds.lower) else []
        values += [repr(bounds.upper + 1.0)] if math.isfinite(bounds.upper) else []
        for value in values:
            (pipe / "constant/softCloudProperties").write_text(place.text(value))
            with pytest.raises(InputError, match=f"/{name.split(' (')[0].split('/')[-1]} is '") as caught:
                read_settings(pipe)
            assert len(str(caught.value).splitlines()) == 1, (name, value)
