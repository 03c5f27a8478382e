"""From the folder of a case to what a person looks at."""

from __future__ import annotations

import logging
import math
import shutil
import subprocess
import webbrowser
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.read.source import Source, read_flow
from foamprb.results.atomic import atomic_write
from foamprb.view.bodies import fates_of, fields_of_fates, gather, require_array
from foamprb.view.colours import DARK, LIGHT
from foamprb.view.geometry import Geometry, Slice, boundary, cut, read_plane
from foamprb.view.page import Page
from foamprb.view.picture import film, has_display, picture, require_display, require_graphics, window
from foamprb.view.results import Run, open_run
from foamprb.view.scene import (
    PERCENTILES,
    Scene,
    automatic_enlargement,
    box,
    busiest,
    camera_for,
    gravity,
)

log = logging.getLogger("foamprb")

LATEST = "latestTime"
DEFAULT_COLOUR = "taylorDeformation"
ORDER = ("taylorDeformation", "shearRate", "U", "Ca", "t0", "t1", "d", "rho", "age", "capillaryNumber",
         "angularVelocity", "J", "semiAxes", "stresslet")  # fmt: skip
"""Arrays in the order in which they get room in a page."""

_BYTES_PER_STATE = 8
"""Fewest that a body at a time has ever taken in a page."""
_TIMES_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Request:
    """What a user asks to see."""

    case: Path
    cloud: str | None = None
    source: Source | None = None
    """Where the geometry and the flow of a plane come from."""
    flow_time: str = LATEST
    time: float | None = None
    """Time that is shown first, or in a picture, s; by default the one with most bodies."""
    colour: str = DEFAULT_COLOUR
    range: tuple[float, float] | None = None
    enlargement: float | None = None
    slice: str | None = None
    bodies: int | None = None
    """Most bodies."""
    percentiles: tuple[float, float] = PERCENTILES
    """Between which of all values the colours range, without a range."""


def write_page(request: Request, path: Path | None, megabytes: float, version: str) -> Path:
    """Write the page of a run, in one step.

    Parameters
    ----------
    request
        What is asked for.
    path
        The file; by default ``<cloud>.html`` beside the results.
    megabytes
        Size that it is to stay below: arrays are left out, and then times, evenly.
    version
        Of foamprb.

    Returns
    -------
    The file.

    Raises
    ------
    InputError
        As :func:`make_scene`; or not even one time fits.
    OSError
        If the file cannot be written.
    """
    if not megabytes >= 1.0:
        raise InputError(f"-maxSize {megabytes:g}: at least 1 (MB) is needed.")
    most = int(megabytes * 1e6)
    run = _run_of(request)
    everything = len(run.entries)
    known = len(run.cloud(-1, ("origId",)).points)
    known = min(known, request.bodies or known)
    fitting = max(1, math.ceil(most / max(1, known * _BYTES_PER_STATE)))
    scene = make_scene(request, run, spread(everything, fitting))
    page = Page(scene, most, ORDER, version)
    while page.needed > most and len(scene.bodies.times) > 1:
        m = len(scene.bodies.times)
        scene = _thinned(scene, spread(m, max(1, min(m - 1, int(0.98 * m * most / page.needed)))))
        page = Page(scene, most, ORDER, version)
    if page.needed > most:
        log.warning("-maxSize %g: even one time takes %.1f MB. -bodies N takes fewer bodies.", megabytes,
                    page.needed / 1e6)  # fmt: skip
    m = len(scene.bodies.times)
    if m < everything:
        log.warning(
            "%d of %d times fit in %g MB, evenly spread. -maxSize allows more.", m, everything, megabytes
        )
    if page.left_out:
        log.warning(
            "%s: left out, there is no room in %g MB. -maxSize allows more.",
            ", ".join(page.left_out),
            megabytes,
        )
    target = path or run.results.page
    text = page.write().encode("utf-8")
    with atomic_write(target) as temporary:
        temporary.write_bytes(text)
    log.info("%d bodies at %d times, %.1f MB: %s", len(scene.bodies.ids), m, len(text) / 1e6, target)
    return target


def spread(count: int, most: int) -> list[int]:
    """At most so many of the numbers below ``count``, evenly spread, the last one among them."""
    if count <= most:
        return list(range(count))
    return sorted({count - 1 - (k * count) // most for k in range(most)})


def _thinned(scene: Scene, frames: Sequence[int]) -> Scene:
    chosen = np.array(frames)
    first = int(np.argmin(np.abs(chosen - scene.first)))
    return replace(scene, bodies=scene.bodies.at(chosen), first=first)


def make_scene(request: Request, run: Run, frames: Sequence[int]) -> Scene:
    """Read and arrange what is shown.

    Parameters
    ----------
    request
        What is asked for.
    run
        Its results.
    frames
        Indices of the times.

    Raises
    ------
    InputError
        Files are missing or damaged, an array is unknown, the plane is none, or a number makes no sense.
    """
    if request.bodies is not None and request.bodies < 1:
        raise InputError(f"-bodies {request.bodies}: a number >= 1 is needed.")
    if request.enlargement is not None and not 0.0 < request.enlargement < math.inf:
        raise InputError(f"-enlargement {request.enlargement:g}: a number > 0 is needed.")
    if request.range is not None and not request.range[0] < request.range[1]:
        raise InputError(
            f"-range {request.range[0]:g} {request.range[1]:g}: the second must be the larger one."
        )
    low, high = request.percentiles
    if not 0.0 <= low < high <= 100.0:
        raise InputError(
            f"-percentiles {low:g} {high:g}: two numbers from 0 to 100 are needed, the second the larger one."
        )
    colour = require_array(run, request.colour)
    bodies = gather(run, frames, request.bodies)
    fates = run.fates()
    if fates is not None:
        bodies.fields.update(fields_of_fates(bodies, fates))
    geometry, plane = _surroundings(request, run)
    first = busiest(bodies) if request.time is None else int(np.argmin(np.abs(bodies.times - request.time)))
    if request.time is not None and not math.isclose(
        bodies.times[first], request.time, rel_tol=_TIMES_TOLERANCE, abs_tol=1e-15
    ):
        log.warning("-time %g s was not written; the nearest is %g s.", request.time, bodies.times[first])
    corners = box(geometry, bodies)
    return Scene(
        title=request.case.resolve().name,
        subtitle=run.name,
        bodies=bodies,
        fate=fates_of(bodies, run, fates),
        geometry=geometry,
        slice=plane,
        paths=run.paths(),
        camera=camera_for(geometry, bodies, first, gravity(request.case, run.results.region)),
        enlargement=request.enlargement or automatic_enlargement(bodies, corners[1] - corners[0]),
        colour=colour,
        range=request.range,
        first=first,
        percentiles=request.percentiles,
    )


def _run_of(request: Request) -> Run:
    return open_run(request.case, request.cloud, request.source.region if request.source else "")


def _surroundings(request: Request, run: Run) -> tuple[Geometry | None, Slice | None]:
    """The geometry, and the plane through the flow if it is asked for."""
    try:
        flow = read_flow(request.case, request.flow_time, run.source(request.source))
    except InputError as error:
        asked = (
            request.slice is not None or request.flow_time != LATEST or request.source not in (None, Source())
        )
        if asked:
            raise
        log.warning("No geometry is shown: %s", error)
        return None, None
    plane = None
    if request.slice is not None:
        plane = cut(flow, *read_plane(request.slice, *flow.bounds))
    return boundary(flow.mesh), plane


def picture_of(
    request: Request, png: Path | None, movie: Path | None, size: tuple[int, int], dark: bool
) -> None:
    """Write a picture or a film; without either, show a window.

    Raises
    ------
    InputError
        As :func:`make_scene` and the functions of :mod:`foamprb.view.picture`.
    OSError
        If the file cannot be written.
    """
    style = DARK if dark else LIGHT
    if png is None and movie is None:
        require_display()
    require_graphics()
    run = _run_of(request)
    scene = make_scene(request, run, range(len(run.entries)))
    if png is not None:
        picture(scene, png, size, style)
    elif movie is not None:
        film(scene, movie, size, style)
    else:
        window(scene, size, style)
        return
    log.info("%d bodies: %s", len(scene.bodies.ids), png or movie)


def start_paraview(case: Path, cloud: str | None, region: str) -> int:
    """Start ParaView with the state that a run has left beside its results; the exit status.

    Raises
    ------
    InputError
        ParaView is not on PATH, there is no display, or no run has left a state.
    """
    run = open_run(case, cloud, region)
    state = run.results.state
    if not state.exists():
        raise InputError(f"{state}: missing; runs of older versions left none. To make it: foamprb run.")
    program = shutil.which("paraview")
    if program is None:
        raise InputError("no paraview on PATH. On Debian: apt-get install paraview python3-paraview.")
    if not has_display():
        raise InputError(f"there is no display for ParaView; pvpython runs {state} without one.")
    return subprocess.run([program, f"--script={state.resolve()}"], check=False).returncode


def open_in_browser(path: Path) -> bool:
    """Show a page in the user's browser, if there is a display; whether it was done."""
    return has_display() and webbrowser.open(path.resolve().as_uri())
