"""Viscosity and density of the fluid of a case, from the dictionaries of OpenFOAM's solvers and ``rho``."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Annotated, Any, NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Scalar
from foamprb.body.viscosity import LAWS
from foamprb.dictionary.constraints import Choice, Positive
from foamprb.dictionary.dimensions import DYNAMIC_VISCOSITY, KINEMATIC_VISCOSITY
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entry
from foamprb.dictionary.tree import CaseFile, Dictionary, DictionaryList, Stream
from foamprb.dictionary.values import Density, DynamicViscosity, Viscosity
from foamprb.errors import InputError
from foamprb.flow.read.case import find_dictionary, find_files, word_of
from foamprb.flow.read.cell_values import cell_values, has_field, solution_times
from foamprb.flow.read.field import DENSITY_FIELD, PRESSURE_FIELD, TEMPERATURE_FIELD, Kind
from foamprb.flow.read.times import pick_time

Law: TypeAlias = Callable[[Scalar], Scalar]
"""Dynamic viscosity, Pa s, by temperature, K."""

_NU = Kind("volScalarField", "scalar", (KINEMATIC_VISCOSITY,), "a kinematic viscosity")
_MU = Kind("volScalarField", "scalar", (DYNAMIC_VISCOSITY,), "a dynamic viscosity")
FRACTION_FIELD = Kind("volScalarField", "scalar", ((0,) * 7,), "the volume fraction of a phase")
_MEAN_KINDS = {"rho": DENSITY_FIELD, "p": PRESSURE_FIELD, "T": TEMPERATURE_FIELD}
_GAS_CONSTANT = 8314.46
"""J/(kmol K)."""
_MIXTURE_FILE = "thermophysicalProperties"
_PHASE_FILES = (_MIXTURE_FILE, "physicalProperties")
"""Dictionaries of phases, before the names of these: ``physicalProperties.air``."""
_CONSTANT = ("Newtonian", "constant")
_CONSTANT_TRANSPORT = ("const", "constTransport")
_GENERALISED, _WITHOUT_K = "generalisedNewtonian", "generalizedNewtonian"
"""Models of ``laminar``; in one of them powerLaw has ν₀ in the place of k."""
FILES = ("transportProperties", "physicalProperties", _MIXTURE_FILE)
"""Dictionaries of the fluid, in ``constant`` or a region's part of it."""
_VISCOSITIES: dict[str, tuple[Any, ...]] = {
    "nu": (Viscosity,),
    "mu": (DynamicViscosity,),
    "nul": (Viscosity,),
    "mul": (DynamicViscosity, Viscosity),
}
"""Entries of a Newtonian fluid, in the order in which they count, and what they may be.

``mul`` of liquidFilmFoam is kinematic by its dimensions.
"""
_DENSITIES = ("rhoInf", "rho", "rhol")
_FLUID = {
    *_VISCOSITIES,
    "transportModel",
    "viscosityModel",
    "NewtonianCoeffs",
    "thermoType",
    "mixture",
    "phases",
}
"""Entries that make a dictionary that of a fluid."""


Values = TypeVar("Values", float, NDArray[np.float64])


class RateLaw(NamedTuple):
    """Viscosity by the shear rate."""

    model: str
    """OpenFOAM's name, a key of :data:`foamprb.body.viscosity.LAWS`."""
    coefficients: Mapping[str, float]
    """By OpenFOAM's names, of the kinematic viscosity."""

    def __call__(self, rate: float) -> float:
        """Return the kinematic viscosity, m²/s, at a shear rate, 1/s."""
        return float(LAWS[self.model].law(rate, *self.coefficients.values()))


class ViscosityField(NamedTuple):
    """Field of a time directory that is a viscosity or gives it."""

    name: str
    kind: Kind
    mean: float
    """Mean viscosity over the cells, m²/s if ``kinematic``, else Pa s."""
    law: Law | None = None
    """Viscosity, Pa s, by the field's values; None for the values themselves."""

    @property
    def kinematic(self) -> bool:
        """Whether it is a kinematic viscosity."""
        return self.kind is _NU


class CaseViscosity(NamedTuple):
    """Viscosity: kinematic, m²/s, or dynamic, Pa s, or one that varies; the others are None."""

    nu: float | None
    mu: float | None
    temperature: float | None = None
    """Temperature, K, if the viscosity is that at one."""
    law: RateLaw | None = None
    field: ViscosityField | None = None
    origin: str = ""
    """What gives a viscosity that varies, for the log."""


def fluid_file(case: Path, region: str) -> Path | None:
    """Return the dictionary of the fluid, of the region or else of the case; None if there is none.

    It is the first of :data:`FILES` with an entry about a fluid, or else the first one. If ``p`` is in Pa, a
    ``thermoType`` goes before a viscosity that the solver does not read.
    """
    files = tuple(find_files(case, region, *FILES))
    if not files and len(of_phases := _files_of_phases(case, region)) == 1:
        return next(iter(of_phases.values()))
    first = None
    for file in files:
        try:
            entries = read_dictionary(file, case).entries
        except InputError:
            return first or file
        if first is None and _FLUID & entries.keys():
            first = file
            if "phases" in entries:
                break
        elif first is not None and file.parent == first.parent and "thermoType" in entries:
            return file if _is_compressible(case, region) else first
    return first or (files[0] if files else None)


def _is_compressible(case: Path, region: str) -> bool:
    """Return True if the pressure at the latest time is in Pa."""
    times = solution_times(case, region)
    if not times or not has_field(case, region, times[-1], "p"):
        return False
    with suppress(InputError):
        return bool(cell_values(case, region, times[-1], "p", PRESSURE_FIELD).size)
    return False


def read_viscosity(
    file: Path,
    case: Path,
    temperature: float | None = None,
    region: str = "",
    time: float | str | None = None,
    transient: bool = False,
) -> CaseViscosity:
    """Read the viscosity of a fluid.

    Parameters
    ----------
    file
        Dictionary of the fluid; see :func:`fluid_file`.
    case, region
        The case, and a region of its mesh.
    temperature
        Temperature of the fluid, K, if the user states it.
    time
        Time of a viscosity that is a field; None if it may not be one.
    transient
        Whether all times are read, so that a field must be there at all of them.

    Raises
    ------
    InputError
        The viscosity is missing or of another kind; or it depends on a temperature that is not known.
    """
    root = read_dictionary(file, case, warn=True)
    here = _Fields(case, region, time, transient)
    generalised = _generalised(case, region)
    if "thermoType" in root.entries or "mixture" in root.entries:
        if generalised is not None:
            raise generalised.mistake(
                "selects a viscosity by the shear rate, which is not read for a compressible fluid. Add nu, "
                "m2/s, or mu, Pa s, to constantProperties of the cloud."
            )
        return _of_mixture(root, temperature, here)
    key = "viscosityModel" if generalised or "transportModel" not in root.entries else "transportModel"
    model = word_of(generalised or root, key, "constant")
    if model in _CONSTANT:
        return _newtonian(root)
    field = here.viscosity(_NU, "nu", f"{_WITHOUT_K}:nu", f"{_GENERALISED}:nu")
    if field is not None:
        return CaseViscosity(None, None, field=field, origin=f"{model}, the field {field.name}")
    if generalised is not None:
        law = _generalised_law(generalised, _newtonian(root).nu or math.nan)
        return CaseViscosity(None, None, law=law, origin=f"{model} of {generalised.source}")
    if model not in LAWS:
        allowed = ", ".join((*_CONSTANT, *LAWS))
        raise root.entries[key].mistake(
            f"is '{model}'. Allowed: {allowed}; or a field nu at the time; or nu, m2/s, or mu, Pa s, in "
            "constantProperties of the cloud."
        )
    return CaseViscosity(None, None, law=_law_of(root, model, {}), origin=f"{model} of {root.source}")


def describe_viscosity(case: Path, region: str, fields: Collection[str]) -> list[str]:
    """Return lines of text about the viscosity of the fluid of a case; none if the case has no dictionary.

    ``fields`` are the names of the fields at the last time. None is read.
    """
    file = fluid_file(case, region)
    if file is None:
        return []
    try:
        if phases := phases_of(case, region):
            return [f"phases {', '.join(phases)}: see {file.name}"]
        viscosity = read_viscosity(file, case, None, region)
    except InputError:
        with suppress(InputError):
            if law := _transport(read_dictionary(file, case)):
                local = ", at the local T" if "T" in fields else ""
                return [f"{law} of {file.name}{local}"]
        return [f"{file.name} has none that is read"]
    if viscosity.law is None:
        return [f"nu {viscosity.nu:g} m2/s" if viscosity.nu is not None else f"mu {viscosity.mu:g} Pa s"]
    numbers = ", ".join(f"{name} {value:g}" for name, value in viscosity.law.coefficients.items())
    written = ["the written field nu takes its place"] if "nu" in fields else []
    return [f"{viscosity.origin}: {numbers}", *written]


def _newtonian(root: Dictionary) -> CaseViscosity:
    """Return the viscosity of a Newtonian fluid."""
    coefficients = root.entries.get("NewtonianCoeffs", root).dictionary()
    if not any(key in coefficients.entries for key in _VISCOSITIES):
        # OpenFOAM v1912 reads nu beside them.
        coefficients = root
    key = next((key for key in _VISCOSITIES if key in coefficients.entries), None)
    if key is None:
        phases = "; or solution { mixture true; }" if "phases" in root.entries else ""
        raise coefficients.missing(
            "nu", f"Allowed: {Positive.text}, m2/s; or nu or mu in constantProperties of the cloud{phases}."
        )
    *others, kind = _VISCOSITIES[key]
    for other in others:
        with suppress(InputError):
            return CaseViscosity(None, float(read_entry(coefficients, key, Annotated[other, Positive])))
    value = float(read_entry(coefficients, key, Annotated[kind, Positive]))
    return CaseViscosity(value, None) if kind is Viscosity else CaseViscosity(None, value)


def _law_of(dictionary: Dictionary, model: str, given: Mapping[str, float]) -> RateLaw:
    """Return the law of a model, with coefficients from ``…Coeffs`` or beside it, if they are not given."""
    own = dictionary.entries.get(f"{model}Coeffs", dictionary).dictionary()
    coefficients, mistakes = dict[str, float](), Mistakes()
    for name, default in LAWS[model].kinematic_names().items():
        with mistakes:
            if name in given:
                coefficients[name] = given[name]
            elif name in own.entries:
                number = _number(own, name)
                if number is None or not math.isfinite(number):
                    raise own.entries[name].mistake(f"is {own.entries[name]}. Allowed: a number.")
                coefficients[name] = number
            elif default is not None:
                coefficients[name] = default
            else:
                raise own.missing(name, f"Allowed: a number, a coefficient of {model}.")
    mistakes.raise_any()
    return RateLaw(model, coefficients)


def _generalised(case: Path, region: str) -> Dictionary | None:
    """Return the ``laminar`` dictionary of a generalised Newtonian fluid, of newer versions of OpenFOAM."""
    root = find_dictionary(case, region, "momentumTransport", "turbulenceProperties")
    laminar = root.entries.get("laminar") if root is not None else None
    if not isinstance(laminar, Dictionary) or root is None or word_of(root, "simulationType") != "laminar":
        return None
    model = word_of(laminar, "model") or word_of(laminar, "laminarModel")
    return laminar if model in (_GENERALISED, _WITHOUT_K) else None


def _generalised_law(laminar: Dictionary, nu0: float) -> RateLaw:
    """Return the law of a ``laminar`` dictionary, of which ν₀ is that of the fluid's dictionary."""
    model: str = read_entry(laminar, "viscosityModel", Annotated[str, Choice(tuple(LAWS))])
    own = laminar.entries.get(f"{model}Coeffs", laminar).dictionary()
    given = {"nu0": nu0}
    if stress := _number(own, "tauStar"):
        given["m" if model == "CrossPowerLaw" else "k"] = nu0 / stress
    # In some versions ν₀ takes the place of k.
    if model == "powerLaw" and ("k" not in own.entries or word_of(laminar, "model") == _WITHOUT_K):
        given["k"] = nu0
    return _law_of(
        laminar, model, {name: given[name] for name in LAWS[model].kinematic_names() if name in given}
    )


class _Fields(NamedTuple):
    """Fields of a case at the times of a run."""

    case: Path
    region: str
    time: float | str | None
    transient: bool

    def viscosity(self, kind: Kind, *names: str, law: Law | None = None) -> ViscosityField | None:
        """Return the first of some fields that is there; None if there is none."""
        if self.time is None:
            return None
        times = solution_times(self.case, self.region)
        if not times:
            return None
        chosen = times if self.transient else (times[pick_time(self.case, times, self.time)],)
        for name in names:
            if all(has_field(self.case, self.region, time, name) for time in chosen):
                values = cell_values(self.case, self.region, chosen[-1], name, kind)
                return ViscosityField(name, kind, float((values if law is None else law(values)).mean()), law)
        return None


def _of_mixture(root: Dictionary, temperature: float | None, here: _Fields | None = None) -> CaseViscosity:
    """Return the viscosity of a ``pureMixture``, constant or by Sutherland's law or a polynomial."""
    law = _transport(root)
    unread = _not_read(root, law)
    if unread or "mixture" not in root.entries:
        field = here.viscosity(_MU, "mu", "thermo:mu") if here else None
        if field is not None:
            return CaseViscosity(
                None, None, field=field, origin=f"{law or 'mixture'}, the field {field.name}"
            )
    if unread:
        raise root.mistake(
            f"thermoType: {unread}. Write the field thermo:mu at the time of the flow; or add "
            "nu, m2/s, or mu, Pa s, to constantProperties of the cloud."
        )
    transport = _at(root, "mixture/transport")
    if law in _CONSTANT_TRANSPORT:
        if _number(transport, "mu") == 0.0:
            raise transport.entries["mu"].mistake(
                "is 0, of an inviscid flow. Add nu, m2/s, or mu, Pa s, to constantProperties of the cloud."
            )
        return CaseViscosity(None, float(read_entry(transport, "mu", Annotated[DynamicViscosity, Positive])))
    by_temperature = _LAWS[law](transport)
    if temperature is None:
        field = here.viscosity(TEMPERATURE_FIELD, "T", law=by_temperature) if here else None
        if field is not None:
            return CaseViscosity(None, None, field=field, origin=f"{law} at the local T")
        raise root.mistake(
            f"thermoType: with transport {law} the viscosity depends on the temperature. Add TInf, K, to "
            "constantProperties of the cloud; or nu, m2/s, or mu, Pa s."
        )
    mu = float(by_temperature(temperature))
    if not 0.0 < mu < math.inf:
        raise transport.mistake(f"gives a viscosity of {mu:g} Pa s at {temperature:g} K.")
    return CaseViscosity(None, mu, temperature)


def _not_read(root: Dictionary, law: str) -> str:
    """Return why the viscosity of a mixture is not in its dictionary; empty if it is."""
    kind, mixture = root.entries.get("thermoType"), root.entries.get("mixture")
    if isinstance(kind, Dictionary) and word_of(kind, "properties") == "liquid":
        names = ", ".join(mixture.entries) if isinstance(mixture, Dictionary) else "the liquid"
        return f"the properties of {names} are in OpenFOAM's code, not in the case"
    if mixture is None and isinstance(kind, Dictionary) and "mixture" in kind.entries:
        return f"the species of a {word_of(kind, 'mixture')} are not read"
    known = (*_LAWS, *_CONSTANT_TRANSPORT)
    return "" if law in known else f"the viscosity of transport {law or '(none)'} is not read"


def _sutherland(transport: Dictionary) -> Law:
    """Return μ(T) = A_s √T/(1 + T_s/T)."""
    As, Ts = (float(read_entry(transport, key, Annotated[float, Positive])) for key in ("As", "Ts"))
    return partial(_sutherlands_law, As, Ts)


def _sutherlands_law(As: float, Ts: float, T: Scalar) -> Scalar:
    return As * np.sqrt(T) / (1.0 + Ts / T)


def _polynomial(transport: Dictionary) -> Law:
    """Return μ(T) = Σ c_k T^k."""
    return partial(_sum_of_powers, _coefficients(transport, "muCoeffs<") or (math.nan,))


def _coefficients(dictionary: Dictionary, start: str) -> tuple[float, ...]:
    """Return the numbers of the first entry whose key begins so; none without such an entry."""
    entries = [entry for key, entry in dictionary.entries.items() if key.startswith(start)]
    numbers = re.findall(r"[^\s()]+", entries[0].text) if entries and isinstance(entries[0], Stream) else []
    try:
        return tuple(float(c) for c in numbers)
    except ValueError:
        raise entries[0].mistake(f"is {entries[0]}. Allowed: a list of numbers.") from None


def _sum_of_powers(coefficients: tuple[float, ...], T: Scalar) -> Scalar:
    return sum(c * T**k for k, c in enumerate(coefficients))


_LAWS: dict[str, Callable[[Dictionary], Law]] = {
    "sutherland": _sutherland,
    "polynomial": _polynomial,
}


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
    """Read the density, kg/m³, if the dictionary of the fluid has a constant one; else return None.

    It is ``rhoInf``, ``rho``, ``rhol``, or that of the ``continuousPhase``; or that of a mixture with
    ``rhoConst`` or ``Boussinesq``.
    """
    root = read_dictionary(file, case)
    continuous = word_of(root, "continuousPhase") or word_of(root, "continuousPhaseName")
    for key in (*_DENSITIES, f"rho.{continuous}"):
        if key in root.entries:
            return float(read_entry(root, key, Annotated[Density, Positive]))
    try:
        state = _at(root, "mixture/equationOfState")
    except InputError:
        return None
    kind = root.entries.get("thermoType")
    boussinesq = isinstance(kind, Dictionary) and word_of(kind, "equationOfState") == "Boussinesq"
    key = "rho0" if boussinesq else "rho"
    return float(read_entry(state, key, Annotated[Density, Positive])) if key in state.entries else None


def find_density(case: Path, region: str, file: Path | None, time: float | str) -> tuple[float, str] | None:
    """Return the density of the fluid, kg/m³, and its source; None if the case has none.

    It is that of :func:`read_density`, else the mean of the field ``rho``, else by the equation of state.

    Parameters
    ----------
    case, region, file
        The case, a region of its mesh, and the dictionary of the fluid.
    time
        Time of the fields.
    """
    if file is not None and (density := read_density(file, case)) is not None:
        return density, str(CaseFile(file, case))
    if (field := mean_field(case, region, time, "rho")) is not None:
        return field[0], f"the field rho at time {field[1]}, its mean"
    barotropic = find_dictionary(case, region, "thermodynamicProperties")
    if barotropic is not None and "rho0" in barotropic.entries:
        rho0 = float(read_entry(barotropic, "rho0", Annotated[Density, Positive]))
        return rho0, f"{barotropic.source}, rho0"
    if file is None:
        return None
    p, T = _state(case, region, time)
    of_state = density_of_state(read_dictionary(file, case), p, T)
    if of_state is None or not math.isfinite(of_state):
        return None
    return of_state, f"equationOfState at the mean p and T ({p:.4g} Pa, {T:.4g} K)"


def _state(case: Path, region: str, time: float | str, *temperatures: str) -> tuple[float, float]:
    """Return the means of p, Pa, and T, K, or of the first of other temperatures; NaN if unknown."""
    means = [math.nan, math.nan]
    for index, names in enumerate((("p",), (*temperatures, "T"))):
        # That of an incompressible solver is kinematic.
        with suppress(InputError):
            means[index] = (mean_field(case, region, time, *names) or (math.nan,))[0]
    return means[0], means[1]


def mean_field(
    case: Path, region: str, time: float | str, name: str, *others: str
) -> tuple[float, str] | None:
    """Return the mean of ``rho``, ``p`` or ``T`` over the cells, SI, and the time's name.

    Returns None if there is no such field. Of several names, such as ``T.air`` and ``T``, the first counts.
    """
    times = solution_times(case, region)
    if not times:
        return None
    at = times[pick_time(case, times, time)]
    for field in (name, *others):
        if has_field(case, region, at, field):
            mean = float(cell_values(case, region, at, field, _MEAN_KINDS[field.split(".")[0]]).mean())
            return (mean, at) if 0.0 < mean < math.inf else None
    return None


def density_of_state(root: Dictionary, p: Values, T: Values) -> Values | float | None:
    """Return the density, kg/m³, of a ``pureMixture`` at p, Pa, and T, K; None if it is not known."""
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
        case "icoPolynomial" if rho := _coefficients(state, "rhoCoeffs<"):
            return _sum_of_powers(rho, T)  # type: ignore[no-any-return]
        case "rPolynomial" if len(c := _coefficients(state, "C")) == 5:
            return 1.0 / (c[0] + c[1] * T + c[2] * T * T - (c[3] + c[4] * T) * p)
        case "incompressiblePerfectGas" if W and (reference := _number(state, "pRef")):
            return reference * W / (_GAS_CONSTANT * T)
    return None


def apparent_viscosity(fluid: Dictionary, rate: float, T: float) -> tuple[str, float] | None:
    """Return the model of a fluid and its viscosity, m²/s, at a rate, 1/s, and T, K; None if unknown."""
    model = word_of(fluid, "transportModel") or word_of(fluid, "viscosityModel")
    name = model.removeprefix("Arrhenius")
    own = fluid.entries.get(f"{model}Coeffs", fluid)
    if not isinstance(own, Dictionary):
        return None
    try:
        nu = _number(own, "nu") if name in _CONSTANT else _law_of(own, name, {})(rate)
    except (InputError, KeyError):
        return None
    if name != model:
        alpha, reference = (_number(own, key) for key in ("alpha", "Talpha"))
        nu = (
            None
            if nu is None or alpha is None or reference is None
            else nu * math.exp(-alpha * (T - reference))
        )
    return (model, float(nu)) if nu is not None and 0.0 < nu < math.inf else None


def phases_of(case: Path, region: str) -> dict[str, Dictionary]:
    """Return the dictionaries of the phases of a case with several, by name.

    They are in the order of the case, or, of a solver with ``phaseProperties``, in that of the alphabet.
    """
    file = fluid_file(case, region)
    entries = {} if file is None else read_dictionary(file, case).entries
    listed = entries.get("phases")
    if isinstance(listed, DictionaryList):
        return {phase.key: phase for phase in listed.items}
    # Beside a mixture of the case, such files are alternatives to it.
    names = [] if "thermoType" in entries else sorted(_files_of_phases(case, region))
    if isinstance(listed, Stream):
        names = re.findall(r"[\w.]+", listed.text)
    own = {key: find_dictionary(case, region, *(f"{name}.{key}" for name in _PHASE_FILES)) for key in names}
    phases = {key: own[key] or entries.get(key) for key in names}
    return {
        key: phase for key, phase in phases.items() if isinstance(phase, Dictionary) and not _is_solid(phase)
    }


def _files_of_phases(case: Path, region: str) -> dict[str, Path]:
    """Return the dictionaries of phases by the names of these."""
    files = (file for name in _PHASE_FILES for file in (case / "constant" / region).glob(f"{name}.*"))
    return {file.name.partition(".")[2].removesuffix(".gz"): file for file in files}


def _is_solid(phase: Dictionary) -> bool:
    kind = phase.entries.get("thermoType")
    return isinstance(kind, Dictionary) and "Solid" in word_of(kind, "type")


def phase_values(
    case: Path, region: str, name: str, phase: Dictionary, rate: float, time: float | str
) -> tuple[float | None, float | None]:
    """Return the viscosity of a phase, m²/s, and its density, kg/m³; None if the case does not have one.

    Parameters
    ----------
    case, region, time
        The case, a region of its mesh, and the time of p and T, whose means are used.
    name, phase
        The phase, and its dictionary.
    rate
        Shear rate, 1/s; NaN for a constant viscosity only.
    """
    p, T = _state(case, region, time, f"T.{name}")
    if "thermoType" not in phase.entries:
        law = apparent_viscosity(phase, rate, T)
        return (law[1] if law else _number(phase, "nu")) or None, _number(phase, "rho") or None
    rho = density_of_state(phase, p, T)
    if rho is None or not math.isfinite(rho):
        return None, None
    try:
        mu = _of_mixture(phase, T).mu
    except InputError:
        mu = None
    return (mu / rho if mu else None), rho


class Mixture(NamedTuple):
    """Two phases, and the field of the volume fraction of the first."""

    names: tuple[str, str]
    nu: tuple[float, float]
    """m²/s."""
    rho: tuple[float, float]
    """kg/m³."""
    field: ViscosityField


def read_mixture(case: Path, region: str, time: float | str, transient: bool = False) -> Mixture:
    """Read the phases of a case with two; see :func:`read_viscosity`.

    Raises
    ------
    InputError
        The case has other phases than two; or the viscosity or density of one is not constant; or the field
        of the fraction is missing at a time.
    """
    phases = phases_of(case, region)
    if len(phases) != 2:
        listed = ", ".join(phases) or "none"
        raise InputError(f"{case}: solution/mixture needs a case with two phases; the phases are: {listed}.")
    values = {}
    for name, phase in phases.items():
        nu, rho = phase_values(case, region, name, phase, math.nan, time)
        if nu is None or rho is None:
            what = "nu" if nu is None else "rho"
            raise phase.missing(
                what,
                f"solution/mixture needs a constant nu and rho of each phase; {name} has none that is read.",
            )
        values[name] = nu, rho
    for names in (tuple(values), tuple(reversed(values))):
        field = _Fields(case, region, time, transient).viscosity(FRACTION_FIELD, f"alpha.{names[0]}")
        if field is not None:
            (nu, rho), (other_nu, other_rho) = (values[name] for name in names)
            return Mixture((names[0], names[1]), (nu, other_nu), (rho, other_rho), field)
    fields = " or ".join(f"alpha.{name}" for name in values)
    raise InputError(f"{case}: solution/mixture needs the field {fields} at each time of the flow.")


def _number(dictionary: Dictionary, key: str) -> float | None:
    """Return the number at the end of an entry, behind a name and dimensions; None if there is none."""
    entry = dictionary.entries.get(key)
    try:
        return float(entry.tokens[-1]) if isinstance(entry, Stream) and entry.tokens else None
    except ValueError:
        return None
