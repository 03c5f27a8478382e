"""``foamprb view``: a page, a picture or a film of the bodies."""

from __future__ import annotations

import argparse
import re
from importlib.metadata import version

from foamprb.cli.options import add_browser, add_cloud, add_flow, output_path, show_page, source_of
from foamprb.errors import InputError

PURPOSE = "show the bodies of a run: a page for any browser"
EXAMPLE = "view -case myCase -png picture.png"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cloud(parser)
    add = parser.add_argument
    add("--output", type=output_path, metavar="FILE", help="the page [postProcessing/CLOUD/CLOUD.html]")
    add_browser(parser)
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--png", type=output_path, metavar="FILE", help="write a picture, not the page")
    kind.add_argument(
        "--film", type=output_path, metavar="FILE", help="write a film, .mp4 or .gif, not the page"
    )
    add("--time", type=float, metavar="TIME", help="first time shown [the last, or that with most bodies]")
    add("--colour", "--color", default="taylorDeformation", metavar="ARRAY",
        help="array, or array:component, to colour by [taylorDeformation]")  # fmt: skip
    add("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
        help="limits of the colours [the 5th and the 95th percentile]")  # fmt: skip
    add("--enlargement", type=float, metavar="S", help="draw the bodies S times larger [automatic]")
    add("--slice", metavar="PLANE", help="show the flow on a plane: x, z=0.01 or '(point) (normal)'")
    add(
        "--flowTime",
        default="latestTime",
        metavar="TIME",
        help="with -slice: time of the drawn flow [latest]",
    )
    add("--bodies", type=int, metavar="N", help="at most N bodies, evenly spread [100000]")
    add("--maxSize", type=float, default=30.0, metavar="MB",
        help="largest page; times that do not fit are left out [30]")  # fmt: skip
    add("--size", default="1600x900", metavar="WxH",
        help="size of a picture or film, pixels [1600x900]")  # fmt: skip
    add("--dark", action="store_true", help="dark background of a picture or film")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.colours import DARK, LIGHT
    from foamprb.view.show import Request, film_of, picture_of, write_page

    request = Request(
        arguments.case,
        arguments.cloud,
        source_of(arguments),
        arguments.flowTime,
        arguments.time,
        arguments.colour,
        tuple(arguments.range) if arguments.range else None,
        arguments.enlargement,
        arguments.slice,
        arguments.bodies,
        arguments.results,
    )
    if path := arguments.png or arguments.film:
        write = picture_of if arguments.png else film_of
        write(request, path, read_size(arguments.size), DARK if arguments.dark else LIGHT)
        return 0
    path = write_page(request, arguments.output, arguments.maxSize, version("foamprb"))
    return show_page(arguments, path)


def read_size(text: str) -> tuple[int, int]:
    """Return width and height from a text like ``1600x900``.

    Raises
    ------
    InputError
        If the text has another form.
    """
    match = re.fullmatch(r"([1-9]\d{1,4})x([1-9]\d{1,4})", text)
    if not match:
        raise InputError(f"-size {text}: not a width and a height like 1600x900.")
    return int(match[1]), int(match[2])
