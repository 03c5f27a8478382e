"""Commands ``foamprb view``, ``report`` and ``export``: their options, and the calls that they make."""

from __future__ import annotations

import argparse
import logging
import re
import sys
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from foamprb.errors import InputError

if TYPE_CHECKING:
    from foamprb.flow.read.source import Source

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``foamprb view``, besides the options of the flow."""
    add = parser.add_argument
    add("--cloud", metavar="NAME", help="the cloud [softCloud, or the only one]")
    add("--output", type=Path, metavar="FILE", help="the page [postProcessing/CLOUD/CLOUD.html]")
    add("--noBrowser", action="store_true", help="write the page, do not open it")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--png", type=Path, metavar="FILE", help="write a picture, not the page")
    kind.add_argument("--film", type=Path, metavar="FILE", help="write a film, .mp4 or .gif, not the page")
    kind.add_argument("--window", action="store_true", help="open a window of VTK, write no file")
    add("--time", type=float, metavar="TIME", help="first time shown [the time with most bodies]")
    add("--colour", "--color", default="taylorDeformation", metavar="ARRAY",
        help="array, or array:component, to colour by [taylorDeformation]")  # fmt: skip
    ranges = parser.add_mutually_exclusive_group()
    ranges.add_argument(
        "--range", type=float, nargs=2, metavar=("LOW", "HIGH"), help="limits of the colours [-percentiles]"
    )
    ranges.add_argument(
        "--percentiles", type=float, nargs=2, metavar=("LOW", "HIGH"), default=[1.0, 99.0],
        help="percentiles of all values, as limits of the colours [1 99]; 0 100: all values",
    )  # fmt: skip
    add("--enlargement", type=float, metavar="S", help="draw the bodies S times larger [automatic]")
    add("--slice", metavar="PLANE", help="show the flow on a plane: x, z=0.01 or '(point) (normal)'")
    add("--flowTime", default="latestTime", metavar="TIME", help="time of the flow on the plane [latest]")
    add("--bodies", type=int, metavar="N", help="at most N bodies, evenly spread [all]")
    add("--maxSize", type=float, default=30.0, metavar="MB",
        help="largest page; arrays and times that do not fit are left out [30]")  # fmt: skip
    add("--size", default="1600x900", metavar="WxH",
        help="size of a picture, film or window, pixels [1600x900]")  # fmt: skip
    add("--dark", action="store_true", help="dark background of a picture, film or window")


def declare_export(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``foamprb export``, besides the options of the flow."""
    add = parser.add_argument
    add("kind", choices=("openfoam", "vtkhdf", "ovito"), help="format of the files")
    add("--cloud", metavar="NAME", help="the cloud [softCloud, or the only one]")
    add("--output", type=Path, metavar="PATH", help="file or folder [postProcessing/CLOUD/...]")
    add("--flowTime", default="latestTime", metavar="TIME", help="time of the flow with the mesh [latest]")


def export(arguments: argparse.Namespace, source: Source) -> int:
    """Write the files of another program; return the exit status."""
    from foamprb.view.export import export as write

    target = write(
        arguments.kind, arguments.case, arguments.cloud, source, arguments.flowTime, arguments.output
    )
    log.info("Written: %s", target)
    return 0


def view(arguments: argparse.Namespace, source: Source) -> int:
    """Write a page, a picture or a film, or open a window; return the exit status."""
    from foamprb.view.show import Request, open_in_browser, picture_of, write_page

    request = Request(
        arguments.case,
        arguments.cloud,
        source,
        arguments.flowTime,
        arguments.time,
        arguments.colour,
        tuple(arguments.range) if arguments.range else None,
        arguments.enlargement,
        arguments.slice,
        arguments.bodies,
        tuple(arguments.percentiles),
    )
    if arguments.png or arguments.film or arguments.window:
        picture_of(request, arguments.png, arguments.film, read_size(arguments.size), arguments.dark)
        return 0
    path = write_page(request, arguments.output, arguments.maxSize, version("foamprb"))
    if not arguments.noBrowser and sys.stdout.isatty():
        open_in_browser(path)
    return 0


def declare_report(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``foamprb report``, besides the options of the flow."""
    add = parser.add_argument
    add("--cloud", metavar="NAME", help="the cloud [softCloud, or the only one]")
    add("--output", type=Path, metavar="FILE", help="the page [postProcessing/CLOUD/report.html]")
    add("--paths", metavar="IDS", help="particles whose D is plotted over time, 3,17,20 [a selection]")
    add("--noBrowser", action="store_true", help="write the page, do not open it")


def report(arguments: argparse.Namespace, source: Source) -> int:
    """Write a report; return the exit status."""
    from foamprb.view.report.report import write_report
    from foamprb.view.show import open_in_browser

    words = (arguments.paths or "").replace(",", " ").split()
    if not all(word.isascii() and word.isdigit() for word in words):
        raise InputError(f"-paths {arguments.paths}: numbers of particles are needed, such as 3,17,20.")
    target = write_report(arguments.case, arguments.output, arguments.cloud, source, [int(w) for w in words])
    if not arguments.noBrowser and sys.stdout.isatty():
        open_in_browser(target)
    return 0


def read_size(text: str) -> tuple[int, int]:
    """Return width and height from a text like ``1600x900``.

    Raises
    ------
    InputError
        If the text has another form.
    """
    found = re.fullmatch(r"([1-9]\d{1,4})x([1-9]\d{1,4})", text)
    if not found:
        raise InputError(f"-size {text}: not a width and a height like 1600x900.")
    return int(found[1]), int(found[2])
