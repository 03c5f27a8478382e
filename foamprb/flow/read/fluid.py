"""Viscosity and density of the fluid of a case, from the dictionaries of OpenFOAM's solvers and ``rho``."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

from foamprb.dictionary.constraints import Positive
from foamprb.dictionary.files import existing
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entry
from foamprb.dictionary.tree import Dictionary, DictionaryList, Stream
from foamprb.dictionary.values import Density, DynamicViscosity, Viscosity
from foamprb.errors import InputError
from foamprb.flow.read.case import available_times, find_dictionary, find_file, word_of
from foamprb.flow.read.field import DENSITY_FIELD, Kind, read_field
from foamprb.flow.read.times import pick_time

_PRESSURE_FIELD = Kind("volScalarField", "scalar", ((1, -1, -2, 0, 0, 0, 0),), "a pressure")
_TEMPERATURE_FIELD = Kind("volScalarField", "scalar", ((0, 0, 0, 1, 0, 0, 0),), "a temperature")
_GAS_CONSTANT = 8314.46
"""J/(kmol K)."""
_MIXTURE_FILE = "thermophysicalProperties"
FILES = ("transportProperties", "physicalProperties", _MIXTURE_FILE)
"""Dictionaries of the fluid, in ``constant`` or a region's part of it; the first that is there counts."""


class CaseViscosity(NamedTuple):
    """Viscosity: kinematic, m²/s, or dynamic, Pa s; the other is None."""

    nu: float | None
    mu: float | None
    temperature: float | None = None
    """Temperature, K, if the viscosity depends on it."""


def fluid_file(case: Path, region: str) -> Path | None:
    """Return the dictionary of the fluid, of the region or else of the case; None if there is none."""
    return find_file(case, region, *FILES)


def read_viscosity(file: Path, case: Path, temperature: float | None = None) -> CaseViscosity:
    """Read the viscosity of a Newtonian fluid.

    Parameters
    ----------
    file
        Dictionary of the fluid; see :func:`fluid_file`.
    case
        The case, for the messages.
    temperature
        Temperature of the fluid, K, if the user states it.

    Raises
    ------
    InputError
        The viscosity is missing or of another kind; or it depends on a temperature that is not stated.
    """
    root = read_dictionary(file, case)
    if "thermoType" in root.entries or "mixture" in root.entries:
        return _of_mixture(root, temperature)
    mistakes = Mistakes()
    with mistakes:
        for key, model in (("transportModel", "Newtonian"), ("viscosityModel", "constant")):
            if key in root.entries:
                read_entry(root, key, Literal[model])
    with mistakes:
        coefficients = root.entries.get("NewtonianCoeffs", root).dictionary()
        if "nu" not in coefficients.entries:
            raise coefficients.missing(
                "nu", f"Allowed: {Positive.text}, m2/s; or nu or mu in constantProperties of the cloud."
            )
        nu = read_entry(coefficients, "nu", Annotated[Viscosity, Positive])
    mistakes.raise_any()
    return CaseViscosity(float(nu), None)


def _of_mixture(root: Dictionary, temperature: float | None) -> CaseViscosity:
    """Return the viscosity of a ``pureMixture``, constant or by Sutherland's law or a polynomial."""
    law = _transport(root)
    transport = _at(root, "mixture/transport")
    if law in ("const", "constTransport"):
        return CaseViscosity(None, float(read_entry(transport, "mu", Annotated[DynamicViscosity, Positive])))
    if law not in _LAWS:
        raise root.mistake(
            f"thermoType: the viscosity of transport {law or '(none)'} is not read. Add nu, m2/s, or mu, "
            "Pa s, to constantProperties of the cloud."
        )
    if temperature is None:
        raise root.mistake(
            f"thermoType: with transport {law} the viscosity depends on the temperature. Add TInf, K, to "
            "constantProperties of the cloud; or nu, m2/s, or mu, Pa s."
        )
    mu = _LAWS[law](transport, temperature)
    if not 0.0 < mu < math.inf:
        raise transport.mistake(f"gives a viscosity of {mu:g} Pa s at {temperature:g} K.")
    return CaseViscosity(None, mu, temperature)


def _sutherland(transport: Dictionary, T: float) -> float:
    """Return μ = A_s √T/(1 + T_s/T)."""
    As, Ts = (float(read_entry(transport, key, Annotated[float, Positive])) for key in ("As", "Ts"))
    return As * math.sqrt(T) / (1.0 + Ts / T)


def _polynomial(transport: Dictionary, T: float) -> float:
    """Return μ = Σ c_k T^k."""
    entries = [entry for key, entry in transport.entries.items() if key.startswith("muCoeffs<")]
    numbers = re.findall(r"[^\s()]+", entries[0].text) if entries and isinstance(entries[0], Stream) else []
    try:
        return sum(float(c) * T**k for k, c in enumerate(numbers)) if numbers else math.nan
    except ValueError:
        raise entries[0].mistake(f"is {entries[0]}. Allowed: a list of numbers.") from None


_LAWS: dict[str, Any] = {"sutherland": _sutherland, "polynomial": _polynomial}


def _transport(root: Dictionary) -> str:
    """Return the transport model: of ``thermoType { transport … }``, or within a name of older versions."""
    kind = root.entries.get("thermoType")
    if isinstance(kind, Dictionary):
        return word_of(kind, "transport")
    words = re.findall(r"(\w+)Transport\b", kind.text) if isinstance(kind, Stream) else []
    return words[0] if words else ""


def _at(root: Dictionary, path: str) -> Dictionary:
    for key in path.split("/"):
        if key not in root.entries:
            raise root.missing(key, "Allowed: a dictionary { … }, as a pureMixture has it.")
        root = root.entries[key].dictionary()
    return root


def read_density(file: Path, case: Path) -> float | None:
    """Read the density, kg/m³: ``rhoInf`` or ``rho``, or that of ``rhoConst``; None if there is none.

    Raises
    ------
    InputError
        The entry is not a density.
    """
    root = read_dictionary(file, case)
    for key in ("rhoInf", "rho"):
        if key in root.entries:
            return float(read_entry(root, key, Annotated[Density, Positive]))
    try:
        state = _at(root, "mixture/equationOfState")
    except InputError:
        return None
    return float(read_entry(state, "rho", Annotated[Density, Positive])) if "rho" in state.entries else None


def mean_density(case: Path, region: str, time: float | str) -> tuple[float, str] | None:
    """Return the mean of ``rho`` over the cells, kg/m³, and the time's name; None if there is no such field.

    Raises
    ------
    InputError
        The field is broken, or there is no such time.
    """
    return _mean(case, region, time, "rho", DENSITY_FIELD)


def mean_temperature(
    case: Path, region: str, time: float | str, field: str = "T"
) -> tuple[float, str] | None:
    """Return the mean of ``T`` over the cells, K, and the time's name; see :func:`mean_density`."""
    return _mean(case, region, time, field, _TEMPERATURE_FIELD)


def mean_pressure(case: Path, region: str, time: float | str) -> tuple[float, str] | None:
    """Return the mean of ``p`` over the cells, Pa, and the time's name; see :func:`mean_density`."""
    return _mean(case, region, time, "p", _PRESSURE_FIELD)


def is_gas(root: Dictionary) -> bool:
    """Return whether ``thermoType`` is that of a gas."""
    kind = root.entries.get("thermoType")
    if not isinstance(kind, Dictionary):
        return False
    return word_of(kind, "equationOfState").endswith("Gas") or word_of(kind, "transport") == "sutherland"


def density_of_state(root: Dictionary, p: float, T: float) -> float | None:
    """Return the density by the ``equationOfState`` of a ``pureMixture``, kg/m³; None if it is not known.

    Parameters
    ----------
    root
        The dictionary of the mixture.
    p, T
        Pressure, Pa, and temperature, K.
    """
    kind, mixture = root.entries.get("thermoType"), root.entries.get("mixture")
    if not isinstance(kind, Dictionary) or not isinstance(mixture, Dictionary):
        return None
    parts = [mixture.entries.get(name) for name in ("equationOfState", "specie")]
    state, specie = (part if isinstance(part, Dictionary) else mixture for part in parts)
    rho0, R, W = _number(state, "rho0"), _number(state, "R"), _number(specie, "molWeight")
    match word_of(kind, "equationOfState"):
        case "rhoConst":
            return _number(state, "rho")
        case "Boussinesq":
            return rho0
        case "perfectFluid" if rho0 and R:
            return rho0 + p / (R * T)
        case "perfectGas" if W:
            return p * W / (_GAS_CONSTANT * T)
        case "incompressiblePerfectGas" if W and (reference := _number(state, "pRef")):
            return reference * W / (_GAS_CONSTANT * T)
    return None


def _mean(case: Path, region: str, time: float | str, field: str, kind: Kind) -> tuple[float, str] | None:
    names = available_times(case) if case.is_dir() else ()
    if not names:
        return None
    name = names[pick_time(case, names, time)]
    path = case / name / region / field
    if existing(path) is None:
        return None
    mean = float(read_field(path, kind, case).cells.mean())
    return (mean, name) if 0.0 < mean < math.inf else None


def apparent_viscosity(fluid: Dictionary, rate: float, T: float) -> tuple[str, float] | None:
    """Return the selected model of a fluid and its viscosity, m²/s; None if unknown.

    Parameters
    ----------
    fluid
        The dictionary of the fluid.
    rate, T
        Shear rate, 1/s, and temperature, K.
    """
    model = word_of(fluid, "transportModel") or word_of(fluid, "viscosityModel")
    coefficients = fluid.entries.get(f"{model}Coeffs", fluid)
    law = model.removeprefix("Arrhenius")
    if not isinstance(coefficients, Dictionary) or law not in _APPARENT:
        return None
    names, formula = _APPARENT[law]
    values = [_number(coefficients, name) for name in names]
    try:
        nu = formula(max(rate, 1e-9), *values) if None not in values else math.nan
        if law != model:
            alpha, reference = (_number(coefficients, name) for name in ("alpha", "Talpha"))
            nu *= math.nan if alpha is None or reference is None else math.exp(-alpha * (T - reference))
    except (ArithmeticError, ValueError):
        return None
    return (model, float(nu)) if 0.0 < nu < math.inf else None


def phases_of(case: Path, region: str) -> dict[str, Dictionary]:
    """Return the dictionaries of the phases of a case with several, by name.

    They are in the order of the case, or, of a solver with ``phaseProperties``, in that of the alphabet.

    Raises
    ------
    InputError
        If a dictionary cannot be read.
    """
    file = fluid_file(case, region)
    entries = {} if file is None else read_dictionary(file, case).entries
    listed = entries.get("phases")
    if isinstance(listed, DictionaryList):
        return {phase.key: phase for phase in listed.items}
    files = (case / "constant" / region).glob(f"{_MIXTURE_FILE}.*")
    names = sorted(file.name.removeprefix(f"{_MIXTURE_FILE}.").removesuffix(".gz") for file in files)
    if isinstance(listed, Stream):
        names = re.findall(r"[\w.]+", listed.text)
    own = {key: find_dictionary(case, region, f"{_MIXTURE_FILE}.{key}") for key in names}
    phases = {key: own[key] or entries.get(key) for key in names}
    return {key: phase for key, phase in phases.items() if isinstance(phase, Dictionary)}


def phase_values(phase: Dictionary, rate: float, p: float, T: float) -> tuple[float | None, float | None]:
    """Return the viscosity of a phase, m²/s, and its density, kg/m³, if it has them.

    Parameters
    ----------
    phase
        Its dictionary.
    rate, p, T
        Shear rate, 1/s, pressure, Pa, and temperature, K.
    """
    if "mixture" in phase.entries:
        rho = density_of_state(phase, p, T)
        mu = _of_mixture(phase, T).mu
        return (mu / rho if mu and rho else None), rho
    found = apparent_viscosity(phase, rate, T)
    return (found[1] if found else _number(phase, "nu")), _number(phase, "rho")


def _number(dictionary: Dictionary, key: str) -> float | None:
    """Return the number at the end of an entry, behind a name and dimensions; None if there is none."""
    entry = dictionary.entries.get(key)
    try:
        return float(entry.tokens[-1]) if isinstance(entry, Stream) and entry.tokens else None
    except ValueError:
        return None


def _limited(nu: float, least: float, most: float) -> float:
    return max(least, min(most, nu))


_APPARENT: dict[str, tuple[tuple[str, ...], Callable[..., float]]] = {
    "Newtonian": (("nu",), lambda _r, nu: nu),
    "CrossPowerLaw": (
        ("nu0", "nuInf", "m", "n"),
        lambda r, nu0, inf, m, n: (nu0 - inf) / (1.0 + (m * r) ** n) + inf,
    ),
    "BirdCarreau": (
        ("nu0", "nuInf", "k", "n"),
        lambda r, nu0, inf, k, n: inf + (nu0 - inf) * (1.0 + (k * r) ** 2) ** (0.5 * (n - 1.0)),
    ),
    "powerLaw": (
        ("k", "n", "nuMin", "nuMax"),
        lambda r, k, n, least, most: _limited(k * r ** (n - 1.0), least, most),
    ),
    "HerschelBulkley": (
        ("nu0", "tau0", "k", "n"),
        lambda r, nu0, tau0, k, n: min(nu0, (tau0 + k * r**n) / r),
    ),
    "Casson": (
        ("m", "tau0", "nuMin", "nuMax"),
        lambda r, m, tau0, least, most: _limited((math.sqrt(tau0 / r) + math.sqrt(m)) ** 2, least, most),
    ),
}
"""OpenFOAM's models: their coefficients, and the viscosity at a shear rate."""
