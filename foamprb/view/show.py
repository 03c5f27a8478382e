"""From the folder of a case to its page, picture or film."""

from __future__ import annotations

import logging
import math
import os
import shutil
import subprocess
import webbrowser
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.flows import read_flow, read_mesh
from foamprb.flow.read.source import FlowSource
from foamprb.results.atomic import atomic_write, refuse_other_kind
from foamprb.results.record import Record
from foamprb.results.vtk import Tracks
from foamprb.settings.fluid import read_gravity
from foamprb.view.bodies import (
    FATE_COLUMNS,
    Bodies,
    Survey,
    fates_of,
    fields_of_fates,
    gather,
    require_array,
    stuck_at_end,
    survey,
)
from foamprb.view.colours import Style, number, written
from foamprb.view.deposits import painted
from foamprb.view.flowfield import FlowField, field_of
from foamprb.view.geometry import Geometry, boundary
from foamprb.view.graphics import has_display, require_graphics
from foamprb.view.page import Page
from foamprb.view.paraview import write_state
from foamprb.view.results import Run, Table, open_run
from foamprb.view.scene import (
    MOST_TRAILS,
    PERCENTILES,
    Scene,
    automatic_enlargement,
    box,
    camera_for,
    limits_of_values,
    main_direction,
    opening,
)

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

LATEST = "latestTime"
DEFAULT_COLOUR = "taylorDeformation"
_BYTES_PER_STATE = 8
"""Least size of a body at one time in a page."""
_SAMPLE = 1000
"""Bodies of the pages that tell the size of a larger one."""
MOST_DRAWN = 100_000
"""Largest number of bodies in a page or a picture, unless -bodies requests more."""
MOST_CELLS = 250_000
"""Largest number of cells of a mesh whose flow is read for streamlines."""
_MOST_TRAILING = 16
"""Largest number of earlier times that the trails of a picture need."""
_OF_FATES = (*FATE_COLUMNS, "x1", "y1", "z1")
"""Columns of ``fates`` that scenes need."""
_TIMES_TOLERANCE = 1e-9
PAGE_BEGINS = b"<!doctype html"


@dataclass(frozen=True)
class Request:
    """Options of a page or a picture."""

    case: Path
    cloud: str | None = None
    source: FlowSource | None = None
    """FlowSource of the geometry and of the flow on a plane."""
    flow_time: str = LATEST
    time: float | None = None
    """First time shown, or time of a picture, s; by default that of :func:`~foamprb.view.scene.opening`."""
    colour: str = DEFAULT_COLOUR
    range: tuple[float, float] | None = None
    enlargement: float | None = None
    slice: str | None = None
    bodies: int | None = None
    """Largest number of bodies; by default :data:`MOST_DRAWN`."""
    results: Path | None = None
    """Folder of the results instead of ``postProcessing`` in the case."""


def write_page(request: Request, path: Path | None, megabytes: float, version: str) -> Path:
    """Write the page of a run, in one step.

    Parameters
    ----------
    request
        Options of the page.
    path
        The file; by default ``<cloud>.html`` beside the results.
    megabytes
        Largest size. Times that do not fit are left out, evenly.
    version
        Version of foamprb.
    """
    if path is not None:
        refuse_other_kind(path, PAGE_BEGINS)
    page, run = _packed(request, megabytes, version)
    target = path or run.results.page
    size = 0
    with atomic_write(target) as temporary, temporary.open("wb") as file:
        for part in page.parts():
            size += file.write(part.encode("utf-8"))
    bodies = page.scene.bodies
    log.info("%d bodies at %d times, %.1f MB: %s", len(bodies.ids), len(bodies.times), size / 1e6, target)
    return target


def _packed(request: Request, megabytes: float, version: str) -> tuple[Page, Run]:
    """Return a page of a limited size, and its run; see :func:`write_page`."""
    if not megabytes >= 1.0:
        raise InputError(f"-maxSize {megabytes:g}: at least 1 (MB) is needed.")
    most = int(megabytes * 1e6)
    run = _run_of(request)
    background = _background(request, run, drawn=False)
    written, released = len(run.entries), len(run.cloud(-1, ("origId",)).points)
    n_bodies = min(released, request.bodies or MOST_DRAWN)

    def pack(m: int, n: int) -> Page:
        scene = background.scene(gather(run, spread(written, m), n))
        notes = [f"{len(scene.bodies.ids)} of {released} bodies are shown."] if n_bodies < released else []
        notes += [f"{m} of {written} times are shown."] if m < written else []
        return Page(scene, version, notes)

    m = max(1, min(written, most // max(1, n_bodies * _BYTES_PER_STATE)))
    for _ in range(2 if n_bodies > 4 * _SAMPLE and m > 1 else 0):
        # Pages of few bodies tell what a body takes at times so far apart, and what all take together.
        few, more = (pack(m, n).size for n in (_SAMPLE, 2 * _SAMPLE))
        of_all = n_bodies * max(1, more - few) / _SAMPLE
        m = max(1, min(m, int(0.98 * m * (most - 2 * few + more) / of_all)))
    size = (page := pack(m, n_bodies)).size
    while size > most and m > 1:
        m = max(1, min(m - 1, int(0.98 * m * most / size)))
        # Memory for one page, not for two.
        del page
        size = (page := pack(m, n_bodies)).size
    if n_bodies < released and request.bodies is None:
        log.warning("%d of %d bodies, evenly spread. -bodies N takes another number.", n_bodies, released)
    if page.size > most:
        log.warning("-maxSize %g: even one time takes %.1f MB. -bodies N takes fewer bodies.", megabytes,
                    page.size / 1e6)  # fmt: skip
    if m < written:
        log.warning(
            "%d of %d times fit in %g MB, evenly spread. -maxSize allows more.", m, written, megabytes
        )
    return page, run


def spread(count: int, most: int) -> list[int]:
    """Return at most ``most`` of the integers below ``count``, evenly spread, with the last one."""
    if count <= most:
        return list(range(count))
    return sorted({count - 1 - (k * count) // most for k in range(most)})


@dataclass(frozen=True)
class _Background:
    """Everything of a scene but its bodies."""

    request: Request
    run: Run
    colour: tuple[str, str]
    fates: Table | None
    geometry: Geometry | None
    flowfield: FlowField | None
    paths: Tracks | None
    flow: Floats
    gravity: Floats
    groups: str
    stuck: int
    """Number of bodies on walls at the last written time."""

    def read(self, frames: Sequence[int], *, drawn: bool) -> Scene:
        """Return the scene of some times; see :func:`make_scene`."""
        arrays = (self.colour[0], "patch", "U") if drawn else None
        return self.scene(gather(self.run, frames, self.request.bodies, arrays))

    def scene(self, bodies: Bodies) -> Scene:
        """Return the scene of some bodies."""
        request, geometry, g = self.request, self.geometry, self.gravity
        if self.fates is not None:
            bodies.fields.update(fields_of_fates(bodies, self.fates))
        first, time = opening(bodies.shown.sum(axis=1), self.stuck), request.time
        if time is not None:
            first = int(np.argmin(np.abs(bodies.times - time)))
            if not math.isclose(bodies.times[first], time, rel_tol=_TIMES_TOLERANCE, abs_tol=1e-15):
                log.warning("-time %g s was not written; the nearest is %g s.", time, bodies.times[first])
        corners, end = box(geometry, bodies), float(self.run.times[-1])
        later = self.stuck and bodies.times[first] < end
        deposits = f"{self.stuck} on walls at {written(end, 's', end)}" if later else ""
        return Scene(
            title=title_of(request.case),
            subtitle=self.run.name,
            bodies=bodies,
            fate=fates_of(bodies, self.run, self.fates),
            geometry=geometry,
            flowfield=self.flowfield,
            paths=self.paths,
            camera=camera_for(geometry, bodies, first, g),
            enlargement=request.enlargement or automatic_enlargement(bodies, corners[1] - corners[0]),
            colour=self.colour,
            range=request.range,
            first=first,
            flow=self.flow,
            gravity=g / (float(np.linalg.norm(g)) or 1.0),
            groups=", ".join(filter(None, (self.groups, deposits))),
        )


def make_scene(request: Request, run: Run, frames: Sequence[int], *, drawn: bool = False) -> Scene:
    """Read bodies, geometry and flow, and arrange them for drawing.

    Parameters
    ----------
    request
        Options of the page or picture.
    run
        Results of the cloud.
    frames
        Indices of the times.
    drawn
        Read no other arrays than the one to colour by.

    Raises
    ------
    InputError
        If files are missing or damaged, an array is unknown, the plane is not valid, or a number is out of
        range.
    """
    return _background(request, run, drawn=drawn).read(frames, drawn=drawn)


def make_still(
    request: Request,
    run: Run,
    most: int = MOST_DRAWN,
    fates: Table | None = None,
    seen: Survey | None = None,
) -> Scene:
    """Return the scene of one time, by default the opening one; its colours span all times.

    Without ``request.bodies`` it has at most ``most`` bodies, evenly spread over their numbers. The ``fates``
    of the run are read unless they are given, as are the values of all times.
    """
    name, part = require_array(run, request.colour)
    shown, values, _ = seen or survey(run, name, part)
    frame = opening(shown, stuck_at_end(run)) if request.time is None else run.nearest(request.time)
    if request.bodies is None and shown[frame] > most:
        request = replace(request, bodies=most)
        log.info("The picture has %d of %d bodies.", most, shown[frame])
    background = _background(request, run, drawn=True, fates=fates)
    scene = background.read([frame], drawn=True)
    if len(before := _trailing(run, frame, scene)) > 1:
        background = replace(background, request=replace(request, time=float(run.times[frame])))
        later = background.read(before, drawn=True)
        scene = replace(later, camera=scene.camera, enlargement=scene.enlargement)
    if values is None or not len(values):
        return scene
    return replace(
        scene,
        range=request.range or limits_of_values(values, PERCENTILES),
        known_extremes=(float(values.min()), float(values.max())),
    )


def _trailing(run: Run, frame: int, scene: Scene) -> list[int]:
    """Return the indices of the times that the trails of a picture need."""
    if not scene.trail or len(scene.bodies.ids) > MOST_TRAILS:
        return [frame]
    first = int(np.searchsorted(run.times, run.times[frame] - scene.trail, side="right")) - 1
    return list(range(max(0, first, frame - _MOST_TRAILING), frame + 1))


def _background(request: Request, run: Run, *, drawn: bool, fates: Table | None = None) -> _Background:
    if request.bodies is not None and request.bodies < 1:
        raise InputError(f"-bodies {request.bodies}: a number >= 1 is needed.")
    if request.enlargement is not None and not 0.0 < request.enlargement < math.inf:
        raise InputError(f"-enlargement {request.enlargement:g}: a number > 0 is needed.")
    if request.range is not None and not request.range[0] < request.range[1]:
        raise InputError(
            f"-range {request.range[0]:g} {request.range[1]:g}: the second must be the larger one."
        )
    colour = require_array(run, request.colour)
    fates = fates or run.fates(_OF_FATES)
    geometry, field = _surroundings(request, run, drawn=drawn)
    g = np.zeros(3)
    with suppress(InputError):
        g = np.array(read_gravity(request.case, run.results.region))
    try:
        record = run.record
    except InputError as error:
        log.warning("The direction of the flow is not shown: %s", error)
        record = Record()
    direction = main_direction(record.get("flow", {}).get("direction"))
    return _Background(
        request,
        run,
        colour,
        fates,
        geometry if fates is None or geometry is None else painted(geometry, fates),
        field,
        run.paths(),
        direction,
        g,
        groups_of(record),
        stuck_at_end(run),
    )


def groups_of(record: Record) -> str:
    """Return Ca, the particle Reynolds number and the fluid of a run, as far as its record has them."""
    parts, models = [], [dict[str, Any](injection) for injection in record.get("injections", ())]
    for label, key in (("Ca", "capillary"), ("Re", "reynolds")):
        values = [value for model in models for value in model.get(key, ()) if value is not None]
        ends = dict.fromkeys(number(value, 3) for value in (min(values), max(values))) if values else ()
        parts += [f"{label} {' to '.join(ends)}"] if ends else []
    fluid = record.get("fluid", {})
    if isinstance(mu := fluid.get("mu"), int | float):
        parts.append(f"fluid {number(1e3 * mu, 3)} mPa s")
    parts += [f"{number(fluid['rho'])} kg/m³"] if fluid.get("rho") else []
    return ", ".join(parts)


def title_of(case: Path) -> str:
    """Return the name of a case as text; it need not be valid UTF-8."""
    return os.fsencode(case.resolve().name).decode(errors="replace")


def _run_of(request: Request) -> Run:
    region = request.source.region if request.source else ""
    return open_run(request.case, request.cloud, region, request.results)


def _surroundings(request: Request, run: Run, *, drawn: bool) -> tuple[Geometry | None, FlowField | None]:
    """Return the geometry, and the flow unless the mesh is large and no plane is requested."""
    # The correction that keeps volume is invisible.
    source = replace(run.source(request.source), balanced=False)

    def read() -> MeshFlow:
        return read_flow(request.case, request.flow_time, source)

    flow = None
    try:
        if request.slice is None and source.file is None:
            mesh = read_mesh(request.case, request.flow_time, source)
        else:
            flow = read()
            mesh = flow.mesh
    except InputError as error:
        has_source = request.source not in (None, FlowSource())
        if has_source or request.slice is not None or request.flow_time != LATEST:
            raise
        hint = " -case names the case." if request.case == request.results else ""
        log.warning("No geometry is shown: %s%s", error, hint)
        return None, None
    geometry = boundary(mesh)
    if flow is None and mesh.n_cells > MOST_CELLS:
        log.info("%d cells: no streamlines are shown. -slice x shows them, and a plane.", mesh.n_cells)
    elif flow is None:
        del mesh
        try:
            flow = read()
        except InputError as error:
            log.info("No streamlines are shown: %s", error)
    return geometry, None if flow is None else field_of(flow, request.slice, drawn=drawn)


def picture_of(request: Request, path: Path, size: tuple[int, int], style: Style) -> None:
    """Write a picture of one time."""
    refuse_other_kind(path, b"\x89PNG")
    require_graphics()
    from foamprb.view.picture import picture

    scene = make_still(request, _run_of(request))
    picture(scene, path, size, style)
    log.info("%d bodies: %s", len(scene.bodies.ids), path)


def film_of(request: Request, path: Path, size: tuple[int, int], style: Style) -> None:
    """Write a film of all times."""
    refuse_other_kind(path, b"GIF8", b"\0\0\0")
    require_graphics()
    from foamprb.view.picture import film

    run = _run_of(request)
    request = replace(request, bodies=request.bodies or MOST_DRAWN)
    scene = make_scene(request, run, range(len(run.entries)), drawn=True)
    film(scene, path, size, style)
    log.info("%d bodies: %s", len(scene.bodies.ids), path)


def start_paraview(case: Path, cloud: str | None, region: str, results: Path | None = None) -> int:
    """Write a state file of the scene, and start ParaView with it; return the exit status."""
    request = Request(case, cloud, FlowSource(region=region) if region else None, results=results)
    run = _run_of(request)
    write_state(run.results, make_still(request, run))
    state = run.results.state
    log.info("State: %s", state)
    program = shutil.which("paraview")
    if program is None:
        raise InputError("no paraview on PATH. On Debian: apt-get install paraview python3-paraview.")
    if not has_display():
        raise InputError(f"no display for ParaView. On a virtual display: xvfb-run -a pvpython {state}.")
    return subprocess.run([program, f"--script={state.resolve()}"], check=False).returncode


def open_in_browser(path: Path) -> bool:
    """Open a page in the user's browser if there is a display; return whether it was opened."""
    return has_display() and webbrowser.open(path.resolve().as_uri())
