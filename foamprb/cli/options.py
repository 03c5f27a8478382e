"""Options that several commands share."""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from foamprb.errors import InputError

if TYPE_CHECKING:
    from argparse import _ArgumentGroup as Group

    from foamprb.flow.read.source import FlowSource


def add_case(parser: argparse.ArgumentParser) -> None:
    """Add the options ``-case`` and ``-region``."""
    _add_case(parser.add_argument_group("case"))


def _add_case(group: Group) -> None:
    group.add_argument("--case", type=Path, default=Path(), metavar="DIR", help="case folder [.]")
    group.add_argument("--region", default="", metavar="NAME", help="region of the mesh")


def add_cloud(parser: argparse.ArgumentParser) -> None:
    """Add the options ``-cloud`` and ``-results``."""
    group = parser.add_argument_group("results")
    group.add_argument("--cloud", metavar="NAME", help="the cloud [softCloud, or the only one]")
    group.add_argument(
        "--results", type=Path, metavar="DIR", help="-output of the run [postProcessing in the case]"
    )


def add_flow(parser: argparse.ArgumentParser) -> None:
    """Add the options of a case and its flow."""
    group = parser.add_argument_group("case and flow")
    _add_case(group)
    add = group.add_argument
    add("--decomposed", action="store_true", help="read the processor folders")
    add("--flow", type=Path, metavar="FILE", help="read the flow from a mesh file")
    add("--velocity", default="U", metavar="NAME", help="velocity field [U]")
    divided = group.add_mutually_exclusive_group()
    divided.add_argument(
        "--patchArray", default="", metavar="NAME", help="array of a mesh file with patch indices"
    )
    divided.add_argument(
        "--featureAngle",
        type=float,
        metavar="DEG",
        help="with a mesh file: split the boundary at edges sharper than DEG degrees, to separate inlet, "
        "outlet and walls",
    )
    add("--scale", type=float, metavar="S", help="lengths in a mesh file times S are m [1]")


def add_dictionary(parser: argparse.ArgumentParser) -> None:
    """Add the option ``-dict``."""
    parser.add_argument(
        "--dict",
        type=Path,
        metavar="FILE",
        help="settings, here or in the case [constant/softCloudProperties]",
    )


def dictionary_of(arguments: argparse.Namespace) -> Path | None:
    """Return the file of ``-dict``: relative to the working folder, or to the case if it is only there.

    Raises
    ------
    InputError
        If there is no such file.
    """
    file: Path | None = arguments.dict
    if file is None:
        return None
    if file.is_file():
        return file.absolute()
    if (arguments.case / file).is_file():
        return file
    raise InputError(f"-dict {file}: no such file, neither here nor in the case {arguments.case}.")


def add_cache(parser: argparse.ArgumentParser) -> None:
    """Add the option ``-cache``."""
    parser.add_argument(
        "--cache", type=Path, metavar="DIR", help="folder that keeps prepared flows of cases for later runs"
    )


def add_browser(parser: argparse.ArgumentParser) -> None:
    """Add the option ``-noBrowser``."""
    parser.add_argument("--noBrowser", action="store_true", help="write the page, do not open it")


def show_page(arguments: argparse.Namespace, page: Path) -> int:
    """Open a page unless ``-noBrowser`` forbids it or the output is no terminal; return the exit status 0."""
    from foamprb.view.show import open_in_browser

    if not arguments.noBrowser and sys.stdout.isatty():
        open_in_browser(page)
    return 0


def output_path(text: str) -> Path:
    """Return a file or folder of results, which may be absent; a device or a pipe would be replaced."""
    path = Path(text)
    if not text:
        raise argparse.ArgumentTypeError("the name is empty; that of a file or folder is needed")
    streams = path.parent.absolute() in (Path("/dev"), Path("/dev/fd"), Path("/proc/self/fd"))
    if streams or (path.exists() and not path.is_file() and not path.is_dir()):
        raise argparse.ArgumentTypeError(f"{text} is a device or a pipe; a file or folder is needed")
    return path


def fraction(text: str) -> float:
    """Return a number above 0 and below 1."""
    value = float(text)
    if not 0.0 < value < 1.0:
        raise argparse.ArgumentTypeError(f"{text}: a number above 0 and below 1 is needed")
    return value


def source_of(arguments: argparse.Namespace) -> FlowSource:
    """Return the source of the flow that the options of :func:`add_flow` select.

    Raises
    ------
    InputError
        If the feature angle or the scale is out of range.
    """
    from foamprb.flow.read.source import Division, FlowSource

    angle = arguments.featureAngle
    if angle is not None and not 0.0 < angle < 180.0:
        raise InputError(f"-featureAngle {angle:g}: an angle between 0 and 180 degrees is needed.")
    scale = arguments.scale
    if scale is not None and not 0.0 < scale < math.inf:
        raise InputError(f"-scale {scale:g}: a number above 0 is needed.")
    divided = arguments.patchArray or angle is not None
    return FlowSource(
        arguments.flow,
        arguments.region,
        arguments.velocity,
        Division(arguments.patchArray, angle) if divided else None,
        arguments.decomposed,
        scale=scale,
        cache=getattr(arguments, "cache", None),
    )
