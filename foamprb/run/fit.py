"""Fit of the properties of measured bodies: Gauss–Newton steps for all bodies at once, in logarithms."""

from __future__ import annotations

import hashlib
import json
import logging
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.cloud.tracker import never
from foamprb.cloud.viscosity import VaryingViscosity, viscosity_at_rate
from foamprb.errors import InputError, RunInterrupted, suggestion
from foamprb.flow.read.source import FlowSource
from foamprb.results.atomic import only_writer, write_text
from foamprb.results.intervals import difference, quantile
from foamprb.results.reading import reading
from foamprb.results.tables import read_table, write_table
from foamprb.run.compilation import compile_run
from foamprb.run.device import UNKNOWNS, Bodies, Device, plane_of, spread, view_of
from foamprb.run.job import Job, prepare, time_of_fluid
from foamprb.run.least_squares import WIDEST, Solution, gauss_newton
from foamprb.run.lut import inflow, wall_rate
from foamprb.run.measured import Measured, read_measured
from foamprb.run.restart import Fingerprint, changes, fingerprint
from foamprb.settings.settings import Settings, read_settings

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_BATCH = 2048
"""Bodies fitted together; their results are then written."""
_USUAL = 0.02
"""Standard error of a quantity without one: relative, of an angle in rad. Only the proportions matter."""
_EXACT = 1e-3
"""Relative error of an area without one."""
_NEAR = 0.05
"""Distance from the measured place, in diameters, within which a body has to pass."""
_NORMAL = 1.959964
"""Half of the 95 % interval of the normal distribution, in standard errors."""
_UNLIKELY = 1e-4
"""Probability of a residual below which no properties explain a body."""
_CURVED = 1.0
"""Largest curvature number of an affine body: the shape by the curvature is 0.44 of that by the strain."""
_BULLET = 0.26
"""Largest amplitude of the quadratic mode, which is of first order; its deformation is 0.05."""
_WALLS = "it is away from the axis of the channel, or too large for it"
_BOUNDED = ("viscosity", "surfaceTension")
"""Unknowns that may be 0; the logarithms of the others are fitted."""
_OTHER_UNIT = 30.0
"""Factor between measured sizes and those of the case from which units are probably wrong."""
_LEVELS, _SIZES = 5, 12
"""Numbers of values and sizes of lines of equal modulus."""
_RESAMPLES, _AT_ONCE = 1000, 20
_TEXTS = ("id", "reason", "group")
_OTHER_DEVICE = 0.02
"""Largest relative difference of width, flow rate and viscosity between measurement and case."""


@dataclass(frozen=True)
class Fits:
    """Fitted properties.

    Parameters
    ----------
    table
        A row for each measured body: ``fits.csv``.
    population
        A row for each property, and group: ``population.csv``.
    differences
        Differences of the medians of two groups, a row for each property and pair: ``differences.csv``.
    lines
        Area, m², and deformation of bodies with a few values of the first property: ``lines.csv``. Empty
        without these quantities, or of bodies that pass at different places.
    unknown
        Names of the properties.
    shapes
        Names of the measured quantities.
    folder
        Folder of the tables.
    """

    table: Mapping[str, NDArray[Any]]
    population: Mapping[str, NDArray[Any]]
    differences: Mapping[str, NDArray[Any]]
    lines: Mapping[str, NDArray[Any]]
    unknown: tuple[str, ...]
    shapes: tuple[str, ...]
    folder: Path

    @property
    def fitted(self) -> NDArray[np.bool_]:
        """Whether a body has been fitted, (n,)."""
        return np.asarray(self.table["reason"] == "")

    @property
    def reasons(self) -> dict[str, int]:
        """Number of bodies that were not fitted, by the reason."""
        reasons, counts = np.unique(self.table["reason"][~self.fitted], return_counts=True)
        return dict(zip(reasons.tolist(), counts.tolist(), strict=True))


def fit(
    case: PathLike[str] | str,
    measured: PathLike[str] | str | Mapping[str, ArrayLike],
    unknown: Sequence[str] = ("shearModulus",),
    plane: str | None = None,
    view: str | None = None,
    *,
    time: float | str | None = None,
    dictionary: Path | None = None,
    threads: int | None = None,
    source: FlowSource | None = None,
    output: Path | str | None = None,
    overrides: Mapping[str, object] | None = None,
    by: str | None = None,
    error: float | None = None,
    force: bool = False,
) -> Fits:
    """Fit properties of measured bodies, with a case and its settings as the model.

    Parameters
    ----------
    case, time, dictionary, threads, source, output, overrides
        See :func:`foamprb.prepare`.
    measured
        Table of the bodies, see :func:`foamprb.run.measured.read_measured`.
    unknown
        ``shearModulus`` or ``youngsModulus``, ``viscosity``, ``surfaceTension``, or ``k`` and ``alpha`` of a
        power law, or ``surfaceShearModulus`` of a capsule, of each body.
    plane
        Where the bodies were seen, ``"x=0.01"`` or ``"(0.01 0 0) (1 0 0)"``; by default the plane of a cloud
        function.
    view
        Direction of the camera, ``"z"``; by default that of ``deformabilityCytometry``.
    by, error
        See :func:`foamprb.run.measured.read_measured`.
    force
        Whether the conditions of the case hold, where those of the table differ. Otherwise the viscosity is
        that of the table, and other differences are errors.

    Returns
    -------
    The results, which are also files in the folder ``fit`` beside those of a run.

    Raises
    ------
    InputError
        If the table or the case cannot be used.
    """
    table, region = read_measured(measured, by, error), (source or FlowSource()).region
    read = partial(read_settings, Path(case), dictionary, region, time_of_fluid(time))
    overrides = {**(overrides or {}), **({} if force else entries_of(table, read(overrides=overrides)))}
    job = prepare(case, time, dictionary, threads, source, output=output, overrides=overrides)
    return fit_job(job, table, unknown, plane, view, force=force)


def fit_job(
    job: Job,
    measured: Measured,
    unknown: Sequence[str],
    plane: str | None = None,
    view: str | None = None,
    overwrite: bool = False,
    stop: Callable[[], bool] = never,
    force: bool = False,
) -> Fits:
    """Fit properties of measured bodies; a fit of the same bodies that was stopped is continued.

    Parameters
    ----------
    job
        The case.
    measured, unknown, plane, view
        See :func:`fit`.
    overwrite
        Whether to start over.
    stop
        Called several times a second; True to stop.
    force
        Whether to fit bodies that were measured under other conditions than those of the case.

    Raises
    ------
    InputError
        If the table or the case cannot be used.
    RunInterrupted
        If ``stop`` returned True.
    """
    unknown = tuple(dict.fromkeys(unknown))
    for name in unknown:
        if name not in UNKNOWNS:
            raise InputError(f"-unknown '{name}'. {suggestion(name, UNKNOWNS)}")
    if {"shearModulus", "youngsModulus"} <= {*unknown}:
        raise InputError("-unknown: shearModulus and youngsModulus are one property. Needed: one of them.")
    if not unknown or len(measured.shapes) < len(unknown):
        raise InputError(
            f"{measured.file}: {len(measured.shapes)} measured quantities of the shape "
            f"({', '.join(measured.shapes)}) for {len(unknown)} unknown properties. Needed: at least as many."
        )
    plane_ = plane_of(plane, job)
    device = Device(job, plane_, view_of(view, job, plane_), stop)
    if (faults := _other_conditions(device, measured)) and not force:
        raise InputError(
            f"{measured.file}: {'; '.join(faults)}. Needed: a case of the same device; or -force, for the "
            "conditions of the case."
        )
    for name in unknown:
        device.require_property(name, f"-unknown '{name}'")
    device.warn_of_walls(
        measured.of("d") if measured.size == "d" else 2.0 * np.sqrt(measured.of("area") / np.pi)
    )
    if doubt := _doubt_of_size(measured, job):
        log.warning("%s: bodies that differ.%s", measured.file, doubt)
    compile_run(job.cloud, job.compilation)
    folder = job.folder.path / "fit"
    with only_writer(folder):
        return _fit(
            _Problem(device, measured, unknown),
            folder,
            _marks(job, measured, unknown, plane, view),
            overwrite,
        )


def _fit(problem: _Problem, folder: Path, marks: Fingerprint, overwrite: bool) -> Fits:
    """Fit the bodies that the tables of an earlier fit lack; write the tables."""
    measured, unknown = problem.measured, problem.unknown
    target, sign = folder / "fits.csv", folder / "fit.json"
    table = {} if overwrite else _earlier(target, sign, marks)
    ready = len(table.get("id", ()))
    write_text(sign, json.dumps(marks))
    for first in range(ready, measured.n, _BATCH):
        try:
            part = problem.solve(slice(first, first + _BATCH))
        except RunInterrupted:
            raise RunInterrupted(
                f"stopped after {first} of {measured.n} bodies, which are in {target}. The same command "
                "continues."
            ) from None
        table = {name: np.concatenate([table[name], part[name]]) for name in part} if table else part
        write_table(target, table)
        log.info("%d of %d bodies", len(table["id"]), measured.n)
    population, differences = _population(table, unknown)
    write_table(folder / "population.csv", population)
    if differences:
        write_table(folder / "differences.csv", differences)
    if lines := problem.lines(table):
        write_table(folder / "lines.csv", lines)
    return Fits(table, population, differences, lines, unknown, measured.shapes, folder)


def entries_of(measured: Measured, settings: Settings) -> dict[str, object]:
    """Return the entries of the settings that the file of measured bodies replaces: the viscosity.

    That of a fluid that varies in the case stays.
    """
    fluid, conditions = settings.fluid, measured.conditions
    if (
        conditions is None
        or not math.isfinite(conditions.viscosity)
        or isinstance(fluid.mu, VaryingViscosity)
    ):
        return {}
    log.info(
        "%s: the viscosity is %.4g Pa s, %s, in place of %.4g Pa s of the case.",
        measured.file, conditions.viscosity, conditions.origin, fluid.mu,
    )  # fmt: skip
    return {"constantProperties/mu": conditions.viscosity}


def _other_conditions(device: Device, measured: Measured) -> list[str]:
    """Return in words how the conditions of a measurement differ from those of the case."""
    conditions, job = measured.conditions, device.job
    if conditions is None:
        return []
    try:
        rate = inflow(job)
    except InputError:
        log.info("%s: the flow rate of the case is unknown, and not compared.", measured.file)
        rate = math.nan
    mu = job.cloud.medium.mu
    in_case = viscosity_at_rate(mu, wall_rate(conditions.flow_rate, conditions.width))
    # dclab's is the viscosity at a mean rate.
    allowed = 0.5 if isinstance(mu, VaryingViscosity) else _OTHER_DEVICE
    return [
        f"its {name} is {of_file:.4g} {unit}, that of the case {of_case:.4g} {unit}"
        for name, of_file, of_case, unit, most in (
            ("channel width", conditions.width, device.width, "m", _OTHER_DEVICE),
            ("flow rate", conditions.flow_rate, rate, "m3/s", _OTHER_DEVICE),
            ("viscosity", conditions.viscosity, in_case, "Pa s", allowed),
        )
        if abs(of_file / of_case - 1.0) > most
    ]


def _marks(job: Job, measured: Measured, *options: object) -> Fingerprint:
    """Return the fingerprint of everything that determines the results: that of a run, and the table."""
    texts = (
        array.tolist() for array in (measured.ids, measured.groups, measured.faults) if array is not None
    )
    sums = hashlib.sha256(repr([*texts]).encode())
    for name, column in sorted(measured.columns.items()):
        sums.update(name.encode() + column.tobytes())
    table = [[float(measured.n), float(int(sums.hexdigest()[:12], 16))]]
    return {"the table": table, "options": repr(options), **fingerprint(job.settings, job.cloud)}


def _earlier(target: Path, sign: Path, marks: Fingerprint) -> dict[str, NDArray[Any]]:
    """Return the table of the same fit that was stopped; empty if there is none."""
    if not target.exists() or not sign.exists():
        return {}
    with reading(sign, "is no description of a fit", "Start over: -overwrite."):
        earlier = json.loads(sign.read_text(encoding="utf-8"))
    if changed := changes(earlier, marks):
        log.info("The fit in %s is another one, and is replaced: %s", target.parent, changed[0])
        return {}
    return read_table(target, _TEXTS)


class _Problem:
    """Measured bodies in a device."""

    def __init__(self, device: Device, measured: Measured, unknown: tuple[str, ...]) -> None:
        self.device, self.measured, self.unknown = device, measured, unknown
        self.places, self.offsets = device.places(measured)
        device.pass_guides(float(np.nanmedian(self.offsets)))
        self.guide, self.release, self.ratio = device.lead_to(self.places)
        self.names = (*(("area",) if measured.size == "area" else ()), *measured.shapes)
        self.values = np.stack([measured.of(name) for name in self.names], axis=1)
        errors = np.stack([measured.of(f"{name}Error") for name in self.names], axis=1)
        self.has_errors = bool(np.isfinite(errors[:, -len(measured.shapes) :]).any())
        usual = [
            np.full(measured.n, _USUAL) if name == "angle"
            else (_EXACT if name == "area" else _USUAL) * np.abs(measured.of(name))
            for name in self.names
        ]  # fmt: skip
        self.errors = np.where(np.isfinite(errors), errors, np.maximum(np.stack(usual, axis=1), 1e-12))
        p = device.job.cloud.particles
        # Without viscosity or surface tension, those that would matter.
        relevant = {
            "viscosity": viscosity_at_rate(device.job.cloud.medium.mu, None),
            "surfaceTension": float(np.median(p.mu * p.R)),
        }
        properties = device.properties(p)
        self.scales = np.array([_median(properties[name]) or relevant[name] for name in unknown])
        self.bounded = np.isin(unknown, _BOUNDED)

    def solve(self, rows: slice) -> dict[str, NDArray[Any]]:
        """Return the table of some bodies."""
        batch = _Batch(self, rows)
        able = batch.able
        start, bounded = np.tile(self.bounded.astype(float), (len(able), 1)), self.bounded
        if batch.size_is_unknown:
            start, bounded = np.column_stack([start, np.log(batch.d[able])]), np.append(bounded, False)
        positive = np.array([name != "angle" for name in self.names])
        solution = gauss_newton(
            batch.predict, batch.values[able], batch.errors[able], start, positive, bounded
        )
        return batch.table(solution)

    def lines(self, table: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """Return areas and deformations of bodies of some sizes and values; see :class:`Fits`."""
        rows, name = np.flatnonzero(table["reason"] == ""), self.unknown[0]
        x = np.stack([table[axis][rows] for axis in "xyz"], axis=1)
        d, values = table["d"][rows], table[name][rows]
        if (
            {"area", "deformation"} - {*self.names}
            or len(rows) < 2
            or np.ptp(x, axis=0).max() > _NEAR * d.min()
            or values.min() <= 0.0
        ):
            return {}
        low, high = np.quantile(values, (0.05, 0.95))
        levels = [float(f"{level:.2g}") for level in np.geomspace(low, high, _LEVELS)]
        sizes, level = (
            a.ravel() for a in np.meshgrid(np.linspace(d.min(), d.max(), _SIZES), levels, indexing="ij")
        )
        one = np.full(len(sizes), rows[0])
        other = {key: np.full(len(sizes), np.median(table[key][rows])) for key in self.unknown[1:]}
        bodies = Bodies(self.guide[one], self.release[one], sizes, {name: level, **other})
        seen = self.device.follow(bodies, self.offsets[one])
        image = self.device.image(seen, sizes, ("area", "deformation"))
        passed = np.flatnonzero(seen.passed)
        order = passed[np.lexsort((sizes[passed], level[passed]))]
        return {
            "value": level[order],
            "area": image["area"][order],
            "deformation": image["deformation"][order],
        }


class _Batch:
    """Bodies that are fitted together."""

    def __init__(self, problem: _Problem, rows: slice) -> None:
        self._problem, self._measured = problem, problem.measured.take(rows)
        self._places, self._offsets = problem.places[rows], problem.offsets[rows]
        self._guide, self._ratio = problem.guide[rows], problem.ratio[rows]
        self._release = problem.release[rows].copy()
        self._arrival = problem.device.expected(self._places, self._guide, self._offsets)
        self.values, self.errors = problem.values[rows], problem.errors[rows]
        self.size_is_unknown = self._measured.size == "area"
        self.d = self._measured.diameters
        self._reason = self._faults()
        self._bullet = np.zeros(len(self.d))
        self.able = np.flatnonzero(self._reason == "")

    def _faults(self) -> NDArray[Any]:
        """Return why bodies are not fitted, (n,); empty texts for the others."""
        problem, reason = self._problem, np.full(len(self.d), "", dtype=object)
        device, shapes = problem.device, self.values[:, -len(problem.measured.shapes) :]
        missing = np.isfinite(shapes).sum(axis=1) < len(problem.unknown)
        curvature = device.curvature_number(self._arrival, np.nan_to_num(self.d))
        # The last one that holds is stored.
        reason[device.confinement(self._arrival, np.nan_to_num(self.d))[1]] = _WALLS
        if not device.job.cloud.models.has_quadratic:
            reason[curvature > _CURVED] = (
                f"the curvature number is above {_CURVED:g}: use shapeModel quadratic"
            )
        reason[np.isnan(curvature)] = "its place is outside the flow"
        reason[missing] = "fewer values than unknown properties"
        reason[~np.isfinite(self.d)] = "its size is missing"
        places = [column for name, column in self._measured.columns.items() if name in ("x", "y", "z")]
        unplaced = np.isnan([self._offsets, *places]).any(axis=0)
        reason[unplaced] = "its place is missing"
        faults = self._measured.faults
        return reason if faults is None else np.where(faults == "", reason, faults)

    def predict(
        self, some: NDArray[np.int64], theta: Floats, moves: bool
    ) -> tuple[Floats, NDArray[np.bool_]]:
        """Return predictions of the values; an estimate ``moves`` the release towards the measured place."""
        problem, rows = self._problem, self.able[some]
        properties = {
            name: problem.scales[k] * (theta[:, k] if problem.bounded[k] else np.exp(theta[:, k]))
            for k, name in enumerate(problem.unknown)
        }
        d = np.exp(theta[:, -1]) if self.size_is_unknown else self.d[rows]
        bodies = Bodies(self._guide[rows], self._release[rows], d, properties)
        seen = problem.device.follow(bodies, self._offsets[rows])
        image = problem.device.image(seen, d, (*problem.names, "bulletAmplitude"))
        if moves:
            self._arrival[rows], self._bullet[rows] = seen.x, image["bulletAmplitude"]
            self._release[rows] += self._ratio[rows, None] * np.nan_to_num(self._places[rows] - seen.x)
        return np.stack([image[name] for name in problem.names], axis=1), seen.passed

    def table(self, solution: Solution) -> dict[str, NDArray[Any]]:
        """Return the table of a solution."""
        from scipy.stats import chi2

        problem, able = self._problem, self.able
        deviations = (self.values[able] - solution.predicted) / self.errors[able]
        squares = np.nansum(deviations**2, axis=1)
        count = np.isfinite(self.values[able]).sum(axis=1)
        freedom = count - solution.theta.shape[1]
        apart = np.linalg.norm(np.nan_to_num(self._places - self._arrival)[able], axis=1)
        near = apart < _NEAR * self.d[able]
        reason = np.full(len(able), "", dtype=object)
        reason[~solution.converged] = "the steps do not converge"
        for k, name in enumerate(problem.unknown):
            reason[~(solution.spread[:, k] < WIDEST)] = f"its shape does not determine {name}"
        if problem.has_errors or not freedom.any():
            worst = np.argmax(np.nan_to_num(np.abs(deviations)), axis=1)
            for row in np.flatnonzero(squares > chi2.isf(_UNLIKELY, np.maximum(freedom, 1))):
                reason[row] = f"no value explains its {problem.names[worst[row]]}"
        d = self.d.copy()
        if self.size_is_unknown:
            d[able] = np.exp(solution.theta[:, -1])
        reason[problem.device.confinement(self._arrival[able], d[able])[1]] = _WALLS
        reason[self._bullet[able] > _BULLET] = f"its bullet amplitude is above {_BULLET:g}"
        reason[~(solution.valid & near)] = "no path of a body leads to its place"
        fitted = reason == ""
        scale = 1.0 if problem.has_errors else math.nan
        if not problem.has_errors and freedom[fitted].any():
            # Without errors the residuals of all bodies show them; exact solutions have no residual.
            scale = math.sqrt(float(squares[fitted].sum()) / float(freedom[fitted].sum()))
        theta = np.where(fitted[:, None], solution.theta, np.nan)
        half = _NORMAL * scale * solution.spread
        columns: dict[str, Floats] = {}
        for k, name in enumerate(problem.unknown):
            middle, unit = theta[:, k], np.maximum(theta[:, k], 1.0) if problem.bounded[k] else 1.0
            for ending, sign in (("", 0.0), ("Low", -1.0), ("High", 1.0)):
                end = middle + (sign * half[:, k] * unit if sign else 0.0)
                value = np.maximum(end, 0.0) if problem.bounded[k] else np.exp(end)
                columns[name + ending] = problem.scales[k] * value
        columns |= {f"{name}Predicted": solution.predicted[:, k] for k, name in enumerate(problem.names)}
        errors = self.errors[able] if problem.has_errors else np.full_like(self.errors[able], np.nan)
        columns |= {f"{name}Error": errors[:, k] for k, name in enumerate(problem.names)}
        columns["residual"] = np.sqrt(squares / np.maximum(count, 1))
        self._reason[able] = reason
        table: dict[str, NDArray[Any]] = {"id": self._measured.ids.astype(str)}
        if self._measured.groups is not None:
            table["group"] = self._measured.groups
        table |= dict(zip("xyz", self._arrival.T, strict=True))
        table |= {"d": d, **dict(zip(problem.names, self.values.T, strict=True))}
        table |= {name: spread(values, able, len(d)) for name, values in columns.items()}
        return {**table, "reason": self._reason.astype(str)}


def fault_of(fits: Fits, measured: Measured, job: Job) -> str:
    """Return why no body could be fitted; empty if one was."""
    if fits.fitted.any():
        return ""
    text = "; ".join(f"{count}: {reason}" for reason, count in fits.reasons.items())
    return f"{measured.file}: 0 of {measured.n} bodies are fitted ({text}).{_doubt_of_size(measured, job)}"


def _doubt_of_size(measured: Measured, job: Job) -> str:
    """Return how bodies differ in size from those of the case; empty if the same unit explains them."""
    d = measured.diameters[np.isfinite(measured.diameters)]
    ratio = float(np.median(d) / np.median(2.0 * job.cloud.particles.R)) if len(d) else 1.0
    if 1.0 / _OTHER_UNIT < ratio < _OTHER_UNIT:
        return ""
    more = f"{ratio:.3g} times larger" if ratio > 1.0 else f"{1.0 / ratio:.3g} times smaller"
    return f" By {measured.size} they are {more} than in the case: is its unit right?"


def _median(values: Floats) -> float:
    """Return the median; 0 for one that is zero to round-off."""
    median = float(np.median(values))
    return median if median > 1e-12 * float(np.abs(values).max(initial=0.0)) else 0.0


def _population(
    table: Mapping[str, NDArray[Any]], unknown: Sequence[str]
) -> tuple[dict[str, NDArray[Any]], dict[str, NDArray[Any]]]:
    """Return median and spread of each property and group with 95 % intervals, and differences of medians.

    The interval of the spread is by resampling. Values of 0 have no logarithm, and so no spread.
    """
    from scipy.stats import bootstrap

    groups = table.get("group", np.full(len(table["id"]), ""))
    rows, differences = [], []
    for name in unknown:
        medians = {}
        for group in np.unique(groups):
            values = table[name][np.isfinite(table[name]) & (table["reason"] == "") & (groups == group)]
            spread = low = high = math.nan
            logs = np.log(values) if (values > 0.0).all() else values[:0]
            if len(logs):
                spread = float(logs.std())
            if len(logs) > 1:
                low, high = bootstrap(
                    (logs,), np.std, n_resamples=_RESAMPLES, batch=_AT_ONCE, method="percentile", rng=0
                ).confidence_interval
            medians[group] = quantile(values)
            rows.append((name, group, len(values), *medians[group], spread, float(low), float(high)))
        differences += [
            (name, one, other, *difference(medians[one], medians[other]))
            for one, other in combinations(medians, 2)
        ]
    heads = (
        "property",
        "group",
        "bodies",
        "median",
        "medianLow",
        "medianHigh",
        "sdLog",
        "sdLogLow",
        "sdLogHigh",
    )
    population = {name: np.array(column) for name, column in zip(heads, zip(*rows, strict=True), strict=True)}
    if "group" not in table:
        del population["group"]
    names = ("property", "group", "other", "difference", "low", "high")
    columns = zip(names, zip(*differences, strict=True), strict=True) if differences else ()
    return population, {name: np.array(column) for name, column in columns}
