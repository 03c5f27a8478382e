"""From the files of a run to its report."""

from __future__ import annotations

import html
import logging
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import NEAR
from foamprb.flow.read.flows import read_mesh
from foamprb.flow.read.source import FlowSource
from foamprb.results.atomic import atomic_write, refuse_other_kind
from foamprb.results.folder import TOUCHED, TRACERS, file_name
from foamprb.results.intervals import quantile, share
from foamprb.results.manifest import Manifest
from foamprb.results.reading import reading
from foamprb.results.record import RECORD_FORMAT
from foamprb.run.validity import COLUMNS, excesses, limits_of, warnings_of
from foamprb.view.bodies import Survey, survey
from foamprb.view.colours import DARK, LIGHT, number, with_interval, written
from foamprb.view.deposits import ends_of, painted, ways
from foamprb.view.geometry import Geometry, boundary
from foamprb.view.graphics import require_graphics
from foamprb.view.report import plots
from foamprb.view.report.page import PageSection, figure, grid, image, page, table
from foamprb.view.results import Run, Table, open_run
from foamprb.view.scene import Scene
from foamprb.view.show import DEFAULT_COLOUR, PAGE_BEGINS, Request, make_still, spread, title_of

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_PICTURE = (1600, 900)
_MOST_BODIES = 30_000
"""Largest number of bodies in the picture."""
_PATHS = _MOST_NAMED = 6
_MOST_WALLS = 6
"""Largest number of walls in the plot of the deposits."""


@dataclass(frozen=True)
class _Report:
    """Input of all sections, and the plots that they have made."""

    run: Run
    seen: Survey
    """D at all times."""
    fates: Table
    geometry: Geometry | None
    paths: tuple[int, ...] | None
    made: dict[str, plots.Plot]
    """By the names of their files."""

    @property
    def points(self) -> Table | None:
        """Fates of points of the fluid, if the run had ``tracers``."""
        return self.run.table(TRACERS) if TRACERS in self.run.tables else None

    def figure(self, name: str, plot: plots.Plot, caption: str) -> str:
        self.made[file_name(name)] = plot
        return figure(plot, caption)


def write_report(
    case: Path,
    output: Path | None = None,
    cloud: str | None = None,
    source: FlowSource | None = None,
    paths: Sequence[int] | None = None,
    results: Path | None = None,
) -> Path:
    """Write the report of a run, and its plots as files beside it, in the folder ``<report>Plots``.

    Parameters
    ----------
    case, cloud, source, results
        See ``foamprb view``.
    output
        The page; by default ``report.html`` beside the results.
    paths
        Particles whose D is plotted over time; by default a selection of the tracks of ``particleTracks``.
    """
    run = open_run(case, cloud, source.region if source else "", results)
    source = run.source(source)
    target = output or run.results.report
    refuse_other_kind(target, PAGE_BEGINS)
    fates = run.fates()
    if fates is None:
        raise InputError(f"{run.folder}: no fates, the run has not ended. To continue: foamprb run -resume.")
    geometry: Geometry | None = None
    body, on_walls, missing = "", "", _missing_record(run)
    seen = survey(run, DEFAULT_COLOUR, "")
    try:
        scene = make_still(Request(case, cloud, source, results=results), run, _MOST_BODIES, fates, seen)
        geometry = scene.geometry
        body = _drawn(scene)
        if len(scene.densities):
            on_walls = _drawn(replace(scene, painted=True))
    except InputError as error:
        missing.append(f"No picture: {error}")
        geometry = geometry or _geometry(case, source, fates)
    report = _Report(run, seen, fates, geometry, tuple(paths) if paths else None, {})
    beside = target.parent / f"{target.stem}Plots"
    with reading(run.folder, "is not as foamprb run wrote it", "Run the particles again: foamprb run."):
        sections = [
            _scene(report, body, target),
            _fates(report),
            _deposition(report, on_walls),
            _residence(report),
            _deformation(report),
            _exposure(report),
            _along_paths(report),
            _record(report),
        ]
        # The list of files includes the plots of all other sections.
        sections.append(_files(report, target, beside))
        text = page(
            f"{title_of(case)}: {run.name}",
            _subtitle(run),
            _cards(fates),
            [
                *dict.fromkeys([*run.record.get("warnings", ()), *_beyond(fates, run)]),
                *_leftovers(run),
                *missing,
            ],
            [section for section in sections if section is not None],
        )
    for name, plot in report.made.items():
        for ending, data in ((".svg", plot.svg_file), (".png", plot.png)):
            with atomic_write(beside / f"{name}{ending}") as temporary:
                temporary.write_bytes(data)
    with atomic_write(target) as temporary:
        temporary.write_text(text, encoding="utf-8")
    log.info("%d particles, %d plots, %.1f MB: %s", len(fates["id"]), len(report.made),
             len(text.encode()) / 1e6, target)  # fmt: skip
    return target


def _leftovers(run: Run) -> Iterator[str]:
    """Yield a warning of files and tables in the folder that are not those of this run."""
    try:
        listed = Manifest.read(run.folder).files
    except InputError as error:
        yield str(error)
        return
    tables = [file for file in map(run.file, run.tables) if file not in listed]
    names = [str(file.relative_to(run.folder)) for file in (*run.results.leftovers(listed), *tables)]
    if listed and names:
        yield (
            f"{len(names)} files in {run.folder} are not of this run, as its manifest.json lacks them: "
            f"{', '.join(names[:_MOST_NAMED])}{', …' if len(names) > _MOST_NAMED else ''}. foamprb run "
            "-overwrite removes clouds, checkpoints and temporary files among them."
        )


def _missing_record(run: Run) -> list[str]:
    """Return why the page lacks the record of the run, if it does."""
    recorded = run.record.get("format") == RECORD_FORMAT
    return [] if recorded else ["No record: the run has no run.json, or one of another version of foamprb."]


def _geometry(case: Path, source: FlowSource, fates: Table) -> Geometry | None:
    try:
        return painted(boundary(read_mesh(case, "latestTime", source)), fates)
    except InputError as error:
        log.warning("No walls are shown: %s", error)
        return None


def _subtitle(run: Run) -> str:
    version = run.record.get("versions", {}).get("foamprb")
    made, end = f"foamprb {version}, " if version else "", float(run.times[-1])
    return f"{made}{len(run.times)} written times, to {written(end, 's', end)}"


def _cards(fates: Table) -> list[tuple[str, str]]:
    """Return the numbers at the top of the page, each with its meaning."""
    counts = {name: int((fates["fate"] == name).sum()) for name in plots.FATES}
    cards = [(f"{len(fates['id'])}", "injected")]
    cards += [
        (f"{count}", f"{name}, {share(count, sum(counts.values())).percent()}")
        for name, count in counts.items()
        if count
    ]
    D = fates.get("maxD", np.zeros(0))
    if np.isfinite(D).any():
        cards.append((number(np.nanmax(D), 3), "largest D on the paths"))
    return cards


def _drawn(scene: Scene) -> str:
    """Return the picture of a scene for light and dark pages; raise InputError if none can be drawn."""
    require_graphics()
    from foamprb.view.picture import images, png_of

    light, dark = map(png_of, images(scene, _PICTURE, (LIGHT, DARK)))
    time = float(scene.bodies.times[scene.first])
    caption = "Particles per area that stuck to the walls, as the mean over circles of about four."
    caption = (
        caption
        if scene.painted
        else (
            f"Bodies at {written(time, 's', time)}, drawn {number(scene.enlargement, 3)} times larger, "
            f"coloured by {scene.colour[0]}."
        )
    )
    return image(light, dark, caption)


def _scene(report: _Report, body: str, target: Path) -> PageSection | None:
    """Return the section of the picture, which ``body`` is, with a link to the interactive view."""
    live = report.run.results.page
    if live.exists():
        body += f'<p><a href="{_link(live, target)}">Interactive view</a> (foamprb view)</p>'
    elif body:
        body += "<p>foamprb view writes an interactive view.</p>"
    return PageSection("scene", "Bodies", body) if body else None


_ALWAYS = 4
"""Fates that the table shows if no particle has them, too."""


def _fates(report: _Report) -> PageSection | None:
    counts: dict[str, dict[str, int]] = {}
    for patch, fate in zip(report.fates["patch"].tolist(), report.fates["fate"].tolist(), strict=True):
        place = counts.setdefault(patch or "in the flow", {})
        place[fate] = place.get(fate, 0) + 1
    if not counts:
        return None
    sums = {place: sum(by_fate.values()) for place, by_fate in counts.items()}
    counts = {place: counts[place] for place in sorted(counts, key=lambda place: -sums[place])}
    total = sum(sums.values())
    met = {fate for by_fate in counts.values() for fate in by_fate}
    shown = [fate for k, fate in enumerate(plots.FATES) if k < _ALWAYS or fate in met]
    points, header = report.points, ["where", *shown, "share"]
    rows = [
        [place, *(by_fate.get(fate, 0) for fate in shown), share(sums[place], total).percent()]
        for place, by_fate in counts.items()
    ]
    if points is not None:
        header.append("share of points")
        for row in rows:
            at = int(np.count_nonzero(points["patch"] == ("" if row[0] == "in the flow" else row[0])))
            row.append(share(at, len(points["id"])).percent())
    caption = "Particles by place and fate; in parentheses the 95 % interval of the share, after Wilson"
    listed = table(caption, header, rows)
    drawn = report.figure("fates", plots.shares(counts), "Particles by patch and fate.")
    drawn += _origins(report)
    if said := stuck_at_release(report.fates, total):
        listed += f"<p>{said}</p>"
    return PageSection("fates", "Fates", grid(drawn, listed))


def stuck_at_release(fates: Mapping[str, Any], total: int) -> str:
    """Return how many of the stuck bodies never moved, and the share of the others; empty if none did."""
    stuck = fates["fate"] == "stuck"
    touched, n = int(np.count_nonzero(fates[TOUCHED])), int(stuck.sum())
    if touched == 0:
        return ""
    others = share(n - touched, total - touched).percent()
    return f"stuck {n}, of these {touched} touched at release; of the others {others}"


def _origins(report: _Report) -> str:
    fates = report.fates
    if "x0" not in fates:
        return ""
    x = np.stack([fates[key] for key in ("x0", "y0", "z0")], axis=1)
    if not np.ptp(x, axis=0).any():
        return ""
    return report.figure(
        "fatesByOrigin", plots.by_origin(x, fates["fate"]), "Places of release, coloured by fate."
    )


def _deposition(report: _Report, drawn: str) -> PageSection | None:
    """Return the section of the deposits, with a picture of their density."""
    fates, geometry = report.fates, report.geometry
    if geometry is None or "x1" not in fates:
        return None
    stuck = fates["fate"] == "stuck"
    patches = fates["patch"][stuck]
    walls = [(s, patches == s.name) for s in geometry.surfaces if (patches == s.name).any()]
    if not walls:
        return None
    rows = []
    for wall, here in walls:
        n, area = int(here.sum()), float(np.linalg.norm(wall.areas, axis=1).sum())
        largest = "" if wall.density is None else number(float(wall.density.max()))
        rows.append((wall.name, n, number(area), number(n / area), largest))
    header = ("wall", "particles", "area [m²]", "mean density [1/m²]", "largest density [1/m²]")
    listed = table("Deposits", header, rows)
    if "x0" in fates:
        starts = np.stack([fates[key] for key in ("x0", "y0", "z0")], axis=1)
        lengths, longest = ways(geometry, starts, ends_of(fates)[stuck])
        along = {wall.name: lengths[here] for wall, here in walls[:_MOST_WALLS]}
        caption = "Particles per length, over the shortest way along the walls from a place of release."
        listed += report.figure("deposits", plots.per_length(along, longest), caption)
    return PageSection("deposition", "Deposition on walls", listed + drawn)


def _by_fate(fates: NDArray[np.str_], values: Floats) -> dict[str, Floats]:
    return {fate: values[fates == fate] for fate in plots.FATES if (fates == fate).any()}


def _residence(report: _Report) -> PageSection | None:
    fates = report.fates
    ended = _by_fate(fates["fate"], fates["t1"] - fates["t0"])
    if not ended:
        return None
    rows = [
        (
            fate,
            len(times),
            written(float(np.quantile(times, 0.1)), "s", float(times.max())),
            with_interval(quantile(times), "s"),
            written(float(np.quantile(times, 0.9)), "s", float(times.max())),
        )
        for fate, times in ended.items()
    ]
    drawn = report.figure(
        "residenceTime",
        plots.histogram(ended, "residence time t", "s"),
        "Time from release to the end of each particle, or of the run.",
    )
    listed = table(
        "Time from release, by fate; in parentheses the 95 % interval of the median",
        ("fate", "particles", "1 in 10 below", "median", "9 in 10 below"),
        rows,
    )
    return PageSection("residence", "Residence time", grid(drawn, listed))


def _deformation(report: _Report) -> PageSection | None:
    run, fates = report.run, report.fates
    drawn = ""
    if "D" in fates:
        drawn += report.figure(
            "deformation",
            plots.histogram(_by_fate(fates["fate"], fates["D"]), "D = (a − c)/(a + c)", "1"),
            "Taylor's deformation D of the longest and the shortest semi-axis, at the end of each particle.",
        )
    if "maxD" in fates:
        drawn += report.figure(
            "largestDeformation",
            plots.histogram(_by_fate(fates["fate"], fates["maxD"]), "largest D", "1"),
            "The largest D on the path of each particle.",
        )
        drawn += _largest(report)
    t, (low, middle, high) = run.times, report.seen.quantiles.T
    if len(t) > 1 and np.isfinite(middle).any():
        drawn += report.figure(
            "deformationOverTime",
            plots.curves([("median", t, middle)], ("time t", "s"), ("D", "1"), (t, low, high)),
            "D of the moving particles over time: the median, and the range of nine in ten.",
        )
    return PageSection("deformation", "Deformation", grid(drawn)) if drawn else None


def _beyond(fates: Table, run: Run) -> list[str]:
    """Return warnings of particles beyond the limits of the model."""
    if "maxD" not in fates:
        return []
    material = run.record.get("models", {}).get("solid", "")
    return warnings_of(len(fates["id"]), excesses(fates["id"], fates, material), material)


def _largest(report: _Report) -> str:
    """Return a table of the largest values on the paths, with the shares beyond the limits of the model."""
    fates, models = report.fates, report.run.record.get("models", {})
    limits, affine = limits_of(models.get("solid", "")), models.get("shape") == "affine"
    rows = []
    for name, text in COLUMNS.items():
        values, limit = fates[name][np.isfinite(fates[name])], limits.get(name)
        if not len(values):
            continue
        part = share(int(np.count_nonzero(values > (limit or np.inf))), len(values)).percent()
        beyond = f"{part} beyond {number(limit)}" if limit else ""
        title = f"steady {text}" if affine and name == "maxBulletAmplitude" else text
        rows.append((title, *(number(q, 3) for q in np.quantile(values, (0.5, 0.99, 1.0)).tolist()), beyond))
    gap = fates["minGap"]
    if (gap < NEAR).any():
        gap = np.minimum(gap, NEAR)
        near = f"{share(int(np.count_nonzero(gap < NEAR)), len(gap)).percent()} below {number(NEAR)}"
        ends = np.quantile(gap, (0.5, 0.01, 0.0)).tolist()
        rows.append(("smallest gap/radius", *(number(q, 3) for q in ends), near))
    return table("Largest values on the paths", ("of", "median", "1 in 100 beyond", "extreme", "share"), rows)


def _exposure(report: _Report) -> PageSection | None:
    tables = [name for name in report.run.tables if name.endswith("/exposure")]
    if not tables:
        return None
    exposure = report.run.table(tables[0])
    shear = report.figure(
        "shearExposure",
        plots.histogram(_by_fate(exposure["fate"], exposure["shearExposure"]), "shear exposure ∫γ̇ dt", "1"),
        "The fluid's shear rate at each particle, integrated over time.",
    )
    deformation = report.figure(
        "maxDeformation",
        plots.histogram(_by_fate(exposure["fate"], exposure["maxDeformation"]), "largest D", "1"),
        "The largest deformation of each particle on its path.",
    )
    return PageSection("shear", "Shear exposure", grid(shear, deformation))


def _along_paths(report: _Report) -> PageSection | None:
    paths = report.run.paths(("taylorDeformation", "shearRate"))
    if paths is None:
        if report.paths:
            raise InputError("-paths: the run did not have the cloud function particleTracks.")
        return None
    ids = paths.tracks["origId"]
    # A path through a coupled patch has several parts.
    tracked = np.unique(ids)
    numbers = report.paths or [int(tracked[k]) for k in spread(len(tracked), _PATHS)]
    if missing := [one for one in numbers if one not in ids]:
        raise InputError(
            f"-paths: particleTracks has no path of particle {missing[0]}; it has {len(tracked)} paths, "
            f"among them of {', '.join(map(str, tracked[:5]))}."
        )
    lines, rates = [], []
    for one in numbers:
        rows = np.repeat(ids == one, np.diff(paths.start))
        t, D, rate = (values[rows] for values in paths.values.values())
        lines.append((f"particle {one}", t - t[0], D))
        rates.append((f"particle {one}", t - t[0], rate))
    which = "chosen by -paths" if report.paths else "evenly spread over their numbers; -paths chooses others"
    x = ("time since release t", "s")
    D_plot, rate_plot = plots.curves(lines, x, ("D", "1")), plots.curves(rates, x, ("γ̇", "1/s"))
    drawn = report.figure("deformationAlongPaths", D_plot, f"D of single particles, {which}.")
    drawn += report.figure("shearAlongPaths", rate_plot, "The fluid's shear rate at the same particles.")
    return PageSection("paths", "Deformation along paths", grid(drawn))


def _jumps(medians: Sequence[float | None]) -> str:
    """Return the median differences of ∇u between neighbouring cells as text."""
    names = ("differs by", "at walls by")
    shown = [f"{name} {100.0 * jump:.2g} %" for name, jump in zip(names, medians, strict=False) if jump]
    return ", ".join(shown) + " (median)" if shown else "not known"


def _record(report: _Report) -> PageSection | None:
    record = report.run.record
    if record.get("format") != RECORD_FORMAT:
        return None
    fluid, models, time, mesh = record["fluid"], record["models"], record["time"], record["mesh"]
    nu = _range(fluid["nu"]) if isinstance(fluid["nu"], list) else number(fluid["nu"])
    g = " ".join(number(c) for c in fluid["gravity"])
    facts = [
        ("versions", ", ".join(f"{name} {number}" for name, number in record["versions"].items())),
        ("mesh", ", ".join(f"{n} {part}" for part, n in mesh.items()) or "none"),
        ("flow", "changes in time" if time["transient"] else "steady"),
        ("∇u between cells", _jumps(record["flow"].get("gradientJump") or ())),
        ("fluid", f"ρ = {number(fluid['rho'])} kg/m³, ν = {nu} m²/s, g = ({g}) m/s²"),
        (
            "time",
            f"{number(time['start'])} to {number(time['end'])} s, {time['steps']} steps of "
            f"{number(time['deltaT'])} s",
        ),
        ("solid", models["solid"]),
        ("shape", models.get("shape", "affine")),
        ("traction, drag", f"{models['traction']}, {models['drag']}"),
        ("other forces", _named(models["forces"])),
        ("surroundings", _named(models["surroundings"] | models["dispersion"])),
        ("integrator of the shape", models["integrator"]),
        ("patches", ", ".join(f"{p['name']} ({p['type']}): {p['interaction']}" for p in record["patches"])),
        ("functions", ", ".join(f"{name} ({kind})" for name, kind in record["functions"].items()) or "none"),
    ]
    body = table("Settings", ("setting", "value"), facts, numbers=False)
    groups = {"shear_rate": "γ̇ [1/s]", "capillary": "Ca", "reynolds": "Re", "stokes": "shape Stokes number",
              "size": "size/cell"}  # fmt: skip
    models_of = [dict[str, Any](model) for model in record["injections"]]
    rows = [
        (model["name"], model["type"], model["particles"], *(_range(model.get(key, ())) for key in groups))
        for model in models_of
    ]
    body += table("Injection models, at release", ("name", "type", "particles", *groups.values()), rows)
    if text := record["settings"]["text"]:
        name = html.escape(record["settings"]["file"])
        body += f"<details><summary>{name} of the run</summary><pre>{html.escape(text)}</pre></details>"
    return PageSection("run", "Record", body)


def _named(models: Mapping[str, str]) -> str:
    return ", ".join(f"{name} {entries}".rstrip() for name, entries in models.items()) or "none"


def _range(ends: Sequence[float | None]) -> str:
    return "–".join("?" if end is None else number(end, 3) for end in ends)


def _files(report: _Report, target: Path, beside: Path) -> PageSection:
    results = report.run.results
    shown = [results.pvd, *map(report.run.file, report.run.tables)]
    shown += [path for path in (results.record, results.page, results.tracks) if path and path.exists()]
    items = [_anchor(path, target, path.relative_to(results.path).as_posix()) for path in shown]
    for name in report.made:
        links = [_anchor(beside / f"{name}.{kind}", target, kind.upper()) for kind in ("svg", "png")]
        items.append(f"{html.escape(name)}: {', '.join(links)}")
    return PageSection("files", "Files", f"<ul>{''.join(f'<li>{item}</li>' for item in items)}</ul>")


def _anchor(path: Path, target: Path, text: str) -> str:
    return f'<a href="{_link(path, target)}">{html.escape(text)}</a>'


def _link(path: Path, target: Path) -> str:
    """Return the address of a file relative to the page."""
    return quote(Path(os.path.relpath(path.resolve(), target.resolve().parent)).as_posix())
