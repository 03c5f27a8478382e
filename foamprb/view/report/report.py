"""From the files of a run to its report."""

from __future__ import annotations

import html
import logging
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Status
from foamprb.errors import InputError
from foamprb.flow.read.source import Source, read_flow
from foamprb.memory import OutOfMemory
from foamprb.results.atomic import atomic_write
from foamprb.results.names import file_name
from foamprb.view.colours import DARK, LIGHT, written
from foamprb.view.geometry import Geometry, boundary
from foamprb.view.picture import picture, require_graphics
from foamprb.view.report import plots
from foamprb.view.report.deposits import Deposits, deposits
from foamprb.view.report.page import Section, figure, image, page, table
from foamprb.view.results import Run, Table, open_run
from foamprb.view.show import Request, make_scene, spread

__all__ = ["write_report"]

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

_PICTURE = (1600, 900)
_MOST_TIMES = 120
"""Times that are read for curves over all particles."""
_PATHS = 6


@dataclass(frozen=True)
class _Given:
    """What all sections draw from."""

    run: Run
    fates: Table
    geometry: Geometry | None
    paths: tuple[int, ...] | None
    kept: dict[str, plots.Plot]
    """The plots by the names of their files."""

    def figure(self, name: str, plot: plots.Plot, caption: str) -> str:
        self.kept[file_name(name)] = plot
        return figure(plot, caption)


def write_report(
    case: Path,
    output: Path | None = None,
    cloud: str | None = None,
    source: Source | None = None,
    paths: Sequence[int] | None = None,
) -> Path:
    """Write the report of a run, and its plots as files beside it, in the folder ``<report>Plots``.

    Parameters
    ----------
    case, cloud, source
        As of ``foamprb view``.
    output
        The page; by default ``report.html`` beside the results.
    paths
        Particles whose D is drawn over time; by default some of those that ``particleTracks`` followed.

    Returns
    -------
    The page.

    Raises
    ------
    InputError
        There is no run, its files are damaged, or it has not ended.
    OSError
        If a file cannot be written.
    """
    run = open_run(case, cloud, source.region if source else "")
    source = run.source(source)
    fates = run.fates()
    if fates is None:
        raise InputError(f"{run.folder}: no fates, the run has not ended. To go on: foamprb run -resume.")
    target = output or run.results.report
    given = _Given(run, fates, _geometry(case, source), tuple(paths) if paths else None, {})
    beside = target.parent / f"{target.stem}Plots"
    sections = [
        _scene(given, case, cloud, source, target),
        _fates(given),
        _deposition(given),
        _residence(given),
        _deformation(given),
        _exposure(given),
        _along_paths(given),
        _what(given),
    ]
    text = page(
        f"{case.resolve().name}: {run.name}",
        _subtitle(run),
        _cards(given),
        run.record.get("warnings", ()),
        [*(section for section in sections if section is not None), _files(given, target, beside)],
    )
    for name, plot in given.kept.items():
        for ending, data in ((".svg", plot.svg_file), (".png", plot.png)):
            with atomic_write(beside / f"{name}{ending}") as temporary:
                temporary.write_bytes(data)
    with atomic_write(target) as temporary:
        temporary.write_text(text, encoding="utf-8")
    log.info("%d particles, %d plots, %.1f MB: %s", len(given.fates["id"]), len(given.kept),
             len(text.encode()) / 1e6, target)  # fmt: skip
    return target


def _geometry(case: Path, source: Source) -> Geometry | None:
    try:
        return boundary(read_flow(case, "latestTime", source).mesh)
    except InputError as error:
        log.warning("No walls are shown: %s", error)
        return None


# ---------------------------------------------------------------------------------------------------------
# Sections


def _subtitle(run: Run) -> str:
    version = run.record.get("versions", {}).get("foamprb")
    made = f"foamprb {version}, " if version else ""
    return f"{made}{len(run.times)} written times, to {run.times[-1]:g} s"


def _cards(given: _Given) -> list[tuple[str, str]]:
    fates = given.fates
    names, counts = np.unique(fates["fate"], return_counts=True)
    found = dict(zip(names.tolist(), counts.tolist(), strict=True))
    cards = [(f"{len(fates['id']) - found.get('pending', 0)}", "injected")]
    cards += [(f"{found[name]}", name) for name in plots.FATES if name in found]
    if "D" in fates:
        D = fates["D"][np.isfinite(fates["D"]) & (fates["fate"] != "pending")]
        if len(D):
            cards.append((f"{np.median(D):.3g}", "median D at the end"))
    return cards


def _scene(given: _Given, case: Path, cloud: str | None, source: Source, target: Path) -> Section:
    live = given.run.results.page
    body = ""
    try:
        require_graphics()
        scene = make_scene(Request(case, cloud, source), given.run, range(len(given.run.entries)))
        drawn = []
        with tempfile.TemporaryDirectory() as folder:
            for name, style in (("light", LIGHT), ("dark", DARK)):
                picture(scene, Path(folder) / f"{name}.png", _PICTURE, style)
                drawn.append((Path(folder) / f"{name}.png").read_bytes())
        time = scene.bodies.times[scene.first]
        caption = (
            f"Bodies at {time:g} s, {scene.enlargement:.3g} times as large as they are, coloured by "
            f"{scene.colour[0]}."
        )
        body = image(drawn[0], drawn[1], caption)
    except (InputError, OutOfMemory) as error:
        body = f"<p>No picture: {html.escape(str(error))}</p>"
    if live.exists():
        body += f'<p><a href="{_link(live, target)}">The same, to turn, play and ask</a> (foamprb view).</p>'
    else:
        body += "<p>foamprb view writes a page of it, to turn, play and ask.</p>"
    return Section("scene", "The bodies", body)


def _fates(given: _Given) -> Section:
    fates = given.fates
    counts: dict[str, dict[str, int]] = {}
    for patch, fate in zip(fates["patch"].tolist(), fates["fate"].tolist(), strict=True):
        if fate != "pending":
            place = counts.setdefault(patch or "in the flow", {})
            place[fate] = place.get(fate, 0) + 1
    counts = dict(sorted(counts.items(), key=lambda item: -sum(item[1].values())))
    total = max(1, sum(sum(own.values()) for own in counts.values()))
    rows = [
        (place, *(own.get(fate, 0) for fate in plots.FATES), f"{100 * sum(own.values()) / total:.1f} %")
        for place, own in counts.items()
    ]
    listed = table("Particles by where they ended, and how", ("where", *plots.FATES, "share"), rows)
    drawn = given.figure("fates", plots.shares(counts), "Particles by patch and fate.") if counts else ""
    return Section("fates", "Fates", f'<div class="grid">{drawn}{listed}</div>')


def _deposition(given: _Given) -> Section | None:
    fates, geometry = given.fates, given.geometry
    stuck = fates["fate"] == "stuck"
    if geometry is None or not stuck.any():
        return None
    x = np.stack([fates[key] for key in ("x1", "y1", "z1")], axis=1) if "x1" in fates else None
    if x is None:
        return None
    walls: dict[str, Deposits] = {}
    for surface in geometry.surfaces:
        here = stuck & (fates["patch"] == surface.name)
        if here.any():
            walls[surface.name] = deposits(surface, x[here])
    if not walls:
        return None
    body = table(
        "Deposits",
        ("wall", "particles", "area [m²]", "mean density [1/m²]", "largest density [1/m²]"),
        [
            (
                name,
                own.number,
                f"{own.area:.4g}",
                f"{own.number / own.area:.4g}",
                f"{np.nanmax(own.density):.4g}",
            )
            for name, own in walls.items()
        ],
    )
    drawn = given.figure(
        "depositsOnGeometry",
        plots.on_geometry(geometry, walls),
        "Particles per area on the walls, in bins of about eight particles; edges of the geometry are lines.",
    )
    for name, own in sorted(walls.items(), key=lambda item: -item[1].number)[:6]:
        how = "unrolled about its axis" if own.across[1] == "around" else "in its plane"
        drawn += given.figure(
            f"deposits-{name}", plots.unrolled(own), f"{name}, {how}: particles per area; dots are particles."
        )
    return Section("deposition", "Deposition on walls", f'{body}<div class="grid">{drawn}</div>')


def _by_fate(given: _Given, values: Floats) -> dict[str, Floats]:
    fates = given.fates["fate"]
    return {fate: values[fates == fate] for fate in plots.FATES if (fates == fate).any()}


def _residence(given: _Given) -> Section:
    fates = given.fates
    time = np.asarray(fates["t1"] - fates["t0"], dtype=float)
    ended = _by_fate(given, time)
    rows = [
        (
            fate,
            len(own),
            *(written(float(q), "s", float(own.max())) for q in np.quantile(own, (0.1, 0.5, 0.9))),
        )
        for fate, own in ended.items()
    ]
    drawn = given.figure(
        "residenceTime",
        plots.histogram(ended, "residence time t", "s", plots.FATES),
        "Time from release to the end of each particle, or of the run.",
    )
    listed = table("Residence time", ("fate", "particles", "1 in 10 below", "median", "9 in 10 below"), rows)
    return Section("residence", "Residence time", f'<div class="grid">{drawn}{listed}</div>')


def _deformation(given: _Given) -> Section | None:
    run, fates = given.run, given.fates
    drawn = ""
    if "D" in fates:
        drawn += given.figure(
            "deformation",
            plots.histogram(_by_fate(given, fates["D"]), "D = (a − c)/(a + c)", "1", plots.FATES),
            "Taylor's deformation D of the longest and the shortest semi-axis, at the end of each particle.",
        )
    chosen = spread(len(run.times), _MOST_TIMES)
    quantiles = []
    for index in chosen:
        arrays = run.cloud(index, ("taylorDeformation", "status")).arrays
        D = arrays["taylorDeformation"][arrays["status"] == Status.ACTIVE]
        quantiles.append(np.quantile(D, (0.05, 0.5, 0.95)) if len(D) else np.full(3, np.nan))
    if len(chosen) > 1 and np.isfinite(quantiles).any():
        t, (low, middle, high) = run.times[chosen], np.transpose(quantiles)
        drawn += given.figure(
            "deformationOverTime",
            plots.curves([("median", t, middle)], ("time t", "s"), ("D", "1"), (t, low, high)),
            "D of the particles that move, over time: the median, and between which nine in ten lie.",
        )
    return Section("deformation", "Deformation", f'<div class="grid">{drawn}</div>') if drawn else None


def _exposure(given: _Given) -> Section:
    found = [name for name in given.run.tables if name.endswith("/exposure")]
    if not found:
        text = "<p>The run had no cloudFunction particleHistogram, which sums γ̇ over time.</p>"
        return Section("shear", "Shear exposure", text)
    own = given.run.table(found[0])
    groups = {
        fate: own["shearExposure"][own["fate"] == fate] for fate in plots.FATES if (own["fate"] == fate).any()
    }
    drawn = given.figure(
        "shearExposure",
        plots.histogram(groups, "shear exposure ∫γ̇ dt", "1", plots.FATES),
        "The shear rate of the fluid at each particle, summed over its time: what a body has been through.",
    )
    peak = {fate: own["maxDeformation"][own["fate"] == fate] for fate in groups}
    drawn += given.figure(
        "maxDeformation",
        plots.histogram(peak, "largest D", "1", plots.FATES),
        "The largest deformation of each particle on its way.",
    )
    return Section("shear", "Shear exposure", f'<div class="grid">{drawn}</div>')


def _along_paths(given: _Given) -> Section:
    paths = given.run.paths(("taylorDeformation", "shearRate"))
    title = "Deformation along paths"
    if paths is None:
        text = "<p>The run had no cloudFunction particleTracks, which writes paths.</p>"
        return Section("paths", title, text)
    ids = paths.tracks["origId"]
    if given.paths is None:
        chosen = [int(ids[k]) for k in spread(len(ids), _PATHS)]
    else:
        missing = [number for number in given.paths if number not in ids]
        if missing:
            raise InputError(
                f"-paths: particleTracks did not follow particle {missing[0]}; it followed {len(ids)}, among "
                f"them {', '.join(map(str, ids[:5]))}."
            )
        chosen = list(given.paths)
    lines, rates = [], []
    for number in chosen:
        k = int(np.flatnonzero(ids == number)[0])
        t, D, rate = (values[paths.start[k] : paths.start[k + 1]] for values in paths.values.values())
        lines.append((f"particle {number}", t - t[0], D))
        rates.append((f"particle {number}", t - t[0], rate))
    which = "-paths chose them" if given.paths else "evenly spread over their numbers; -paths chooses others"
    drawn = given.figure(
        "deformationAlongPaths",
        plots.curves(lines, ("time since release t", "s"), ("D", "1")),
        f"D of single particles, {which}.",
    )
    drawn += given.figure(
        "shearAlongPaths",
        plots.curves(rates, ("time since release t", "s"), ("γ̇", "1/s")),
        "The fluid's shear rate at the same particles.",
    )
    return Section("paths", title, f'<div class="grid">{drawn}</div>')


def _what(given: _Given) -> Section:
    record = given.run.record
    if not record:
        text = "<p>The run left no run.json: it was made by an older version of foamprb.</p>"
        return Section("run", "What was run", text)
    fluid, models, time, mesh = (record[key] for key in ("fluid", "models", "time", "mesh"))
    g = " ".join(f"{c:g}" for c in fluid["gravity"])
    facts = [
        ("versions", ", ".join(f"{name} {number}" for name, number in record["versions"].items())),
        ("mesh", ", ".join(f"{n} {what}" for what, n in mesh.items()) or "none"),
        ("flow", "changes in time" if time["transient"] else "steady"),
        ("fluid", f"ρ = {fluid['rho']:g} kg/m³, ν = {fluid['nu']:g} m²/s, g = ({g}) m/s²"),
        ("time", f"{time['start']:g} to {time['end']:g} s, {time['steps']} steps of {time['deltaT']:g} s"),
        ("solid", models["solid"]),
        ("traction, drag", f"{models['traction']}, {models['drag']}"),
        ("other forces", _named(models["forces"]) or "none"),
        ("surroundings", _named(models["surroundings"] | models["dispersion"]) or "none"),
        ("integrator of the shape", models["integrator"]),
        ("patches", ", ".join(f"{p['name']} ({p['type']}): {p['interaction']}" for p in record["patches"])),
        ("functions", ", ".join(f"{name} ({kind})" for name, kind in record["functions"].items()) or "none"),
    ]
    body = table("The run", ("", ""), facts, numbers=False)
    names = {"shear_rate": "γ̇ [1/s]", "capillary": "Ca", "reynolds": "Re", "stokes": "shape Stokes number",
             "size": "size/cell"}  # fmt: skip
    rows = [
        (
            own["name"],
            own["type"],
            own["particles"],
            *(
                "–".join("?" if end is None else f"{end:.3g}" for end in own[key]) if key in own else ""
                for key in names
            ),
        )
        for own in record["injections"]
    ]
    body += table("Injection models, at release", ("name", "type", "particles", *names.values()), rows)
    text = record["settings"]["text"]
    if text:
        name = html.escape(record["settings"]["file"])
        body += f"<details><summary>{name}, as it was</summary><pre>{html.escape(text)}</pre></details>"
    return Section("run", "What was run", body)


def _named(models: Mapping[str, str]) -> str:
    return ", ".join(f"{name} {entries}".rstrip() for name, entries in models.items())


def _files(given: _Given, target: Path, beside: Path) -> Section:
    results = given.run.results
    shown = [results.pvd, *map(given.run.file, given.run.tables)]
    shown += [path for path in (results.record, results.page, results.tracks) if path and path.exists()]
    items = [
        f'<li><a href="{_link(path, target)}">{html.escape(str(path.relative_to(results.path)))}</a></li>'
        for path in shown
    ]
    items += [
        f"<li>{html.escape(plot)}: "
        + ", ".join(
            f'<a href="{_link(beside / (plot + ending), target)}">{ending[1:].upper()}</a>'
            for ending in (".svg", ".png")
        )
        + "</li>"
        for plot in given.kept
    ]
    return Section("files", "Files", f"<ul>{''.join(items)}</ul>")


def _link(path: Path, target: Path) -> str:
    """The way from the page to a file."""
    return quote(Path(os.path.relpath(path.resolve(), target.resolve().parent)).as_posix())
