"""``foamprb lut``: a table by which dclab finds moduli."""

from __future__ import annotations

import argparse
import logging
import math
from pathlib import Path

from foamprb.cli.fit import add_device, read_device
from foamprb.cli.options import add_cache, add_flow, output_path
from foamprb.errors import InputError

PURPOSE = "write a table of moduli over area and deformation, for dclab"
EXAMPLE = "lut -diameters 6e-6 16e-6 -moduli 200 5000 -plane x=1e-3"

log = logging.getLogger("foamprb")

_LARGE = 1e-3
"""Diameter, m, from which a number is probably one of another unit."""


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cache(parser)
    add = parser.add_argument
    ends = ("LOW", "HIGH")
    add("--diameters", type=float, nargs=2, required=True, metavar=ends, help="of the bodies, m")
    add("--moduli", type=float, nargs=2, required=True, metavar=ends, help="shear moduli, Pa")
    add("--number", type=int, default=24, metavar="N", help="diameters, and moduli [24]")
    add_device(parser)
    add("--channelWidth", type=float, metavar="W", help="m [the smallest width of the flow]")
    add("--flowRate", type=float, metavar="Q", help="m3/s [through the openings]")
    add("--identifier", metavar="NAME", help="name of the table in dclab [foamprb-CLOUD]")
    add("--output", type=output_path, default=Path("lut.txt"), metavar="FILE", help="the table [lut.txt]")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.run.lut import compute_lut, write_lut

    for name in ("diameters", "moduli"):
        low, high = getattr(arguments, name)
        if not 0.0 < low < high < math.inf:
            raise InputError(f"-{name} {low:g} {high:g}: two numbers > 0 are needed, the smaller one first.")
    low, high = arguments.diameters
    if high >= _LARGE:
        raise InputError(
            f"-diameters {low:g} {high:g}: are metres meant? Bodies in a cytometer are smaller than "
            f"{_LARGE:g} m: diameters of {low:g} to {high:g} um are -diameters {low:g}e-6 {high:g}e-6."
        )
    for name in ("channelWidth", "flowRate"):
        value = getattr(arguments, name)
        if value is not None and not 0.0 < value < math.inf:
            raise InputError(f"-{name} {value:g}: a number > 0 is needed.")
    if not 2 <= arguments.number <= 200:
        raise InputError(f"-number {arguments.number}: an integer from 2 to 200 is needed.")
    job = read_device(arguments)
    lut = compute_lut(
        job, tuple(arguments.diameters), tuple(arguments.moduli), arguments.number, arguments.plane,
        arguments.view, arguments.channelWidth, arguments.flowRate,
    )  # fmt: skip
    identifier = arguments.identifier or f"foamprb-{job.settings.name}"
    write_lut(lut, arguments.output, identifier)
    log.info(
        "%d rows: channel %.4g um, %.4g uL/s, %.4g mPa s", len(lut.area), 1e6 * lut.width,
        1e9 * lut.flow_rate, 1e3 * lut.viscosity,
    )  # fmt: skip
    log.info("Table %s: %s", identifier, arguments.output)
    return 0
