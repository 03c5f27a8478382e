"""``foamprb estimate``: orders of magnitude of all effects on a soft sphere."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from foamprb.errors import InputError

if TYPE_CHECKING:
    from foamprb.parallel.ranks import Ranks

PURPOSE = "estimate from a few numbers which effects matter to a particle"

_NUMBERS = (
    ("-d", "diameter", "D", "diameter, m", None),
    ("--rho0", "rho0", "RHO", "density of the particle, kg/m3", None),
    ("--mu", "mu", "MU", "viscosity of the fluid, Pa s", None),
    ("--rhoInf", "rhoInf", "RHO", "density of the fluid, kg/m3", None),
    ("--shearRate", "shearRate", "RATE", "shear rate of the flow at the particle, 1/s", None),
    ("--residenceTime", "residenceTime", "T", "residence time in the flow, s", None),
    ("--wallDistance", "wallDistance", "H", "distance of its centre from a wall, m [no wall]", math.inf),
    ("--temperature", "temperature", "T", "temperature, K [293.15]", 293.15),
    ("--gravity", "gravity", "G", "gravity, m/s2 [9.81]", 9.81),
    ("--epsilon", "epsilon", "EPS", "turbulent dissipation, m2/s3 [0, laminar]", 0.0),
)
_MAY_VANISH = ("gravity", "epsilon")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    for option, name, metavar, text, default in _NUMBERS:
        parser.add_argument(
            option, dest=name, type=float, metavar=metavar, help=text, default=default,
            required=default is None,
        )  # fmt: skip
    stiffness = parser.add_mutually_exclusive_group(required=True)
    stiffness.add_argument("--Ca", type=float, metavar="CA", help="capillary number, mu*rate/modulus")
    stiffness.add_argument(
        "--shearModulus", type=float, metavar="G", help="shear modulus of the particle, Pa"
    )


def execute(arguments: argparse.Namespace, _ranks: Ranks | None) -> int:
    """Execute the command; return the exit status."""
    print("\n".join(lines(arguments)))
    return 0


def lines(arguments: argparse.Namespace) -> list[str]:
    """Return the estimates, line by line.

    Raises
    ------
    InputError
        If a number is not positive.
    """
    # Slow imports, which other commands do not need.
    from foamprb.body.estimate import SoftSphere, Surroundings, estimate, shear_modulus
    from foamprb.body.turbulence import kolmogorov_length, kolmogorov_rate

    given = vars(arguments)
    for name in (*(name for _, name, *_ in _NUMBERS), "Ca", "shearModulus"):
        value = given[name]
        if value is not None and not (value > 0.0 or (value == 0.0 and name in _MAY_VANISH)):
            raise InputError(f"{name} is {value:g}. Allowed: a number > 0.")
    d, h = given["diameter"], given["wallDistance"]
    if h < 0.5 * d:
        raise InputError(f"wallDistance is {h:g}. Allowed: at least half the diameter, {0.5 * d:g}.")
    modulus = given["shearModulus"] or shear_modulus(given["Ca"], given["mu"], given["shearRate"])
    around = Surroundings(
        given["mu"], given["rhoInf"], given["shearRate"], h, given["temperature"], given["gravity"]
    )
    e = estimate(SoftSphere(d, given["rho0"], modulus), around, given["residenceTime"])
    facts = [
        ("shear modulus [Pa]", modulus, ""),
        ("capillary number", e.capillary_number, "below 1e-3 a rigid sphere suffices"),
        (
            "Reynolds number",
            e.reynolds_number,
            "above 0.01 to 0.1 fluid inertia causes lift, which is not modelled",
        ),
        ("Stokes number", e.stokes_number, "below 0.01 the particle follows the flow"),
        ("Peclet number", e.peclet_number, "below 10 BrownianMotion turns and moves it"),
        ("thermal strain", e.thermal_strain, "by Brownian motion of the shape"),
        ("settling speed [m/s]", e.settling_speed, ""),
        ("its Reynolds number", e.settling_reynolds_number, "above 0.1 it is slower: drag exceeds Stokes'"),
        ("lift speed [m/s]", e.lift_speed, "by the wall: wallLift"),
        ("diffusivity [m2/s]", e.diffusion_coefficient, ""),
        ("settling length [m]", e.settling_length, "in the residence time; so are the next two"),
        ("lift length [m]", e.lift_length, ""),
        ("diffusion length [m]", e.diffusion_length, ""),
        (
            "lift-off height [m]",
            e.lift_height,
            "where lift balances weight"
            if e.lift_height > 0.5 * d
            else "within the particle: it does not lift off",
        ),
    ]
    if given["epsilon"] > 0.0:
        nu = given["mu"] / given["rhoInf"]
        rate, length = kolmogorov_rate(given["epsilon"], nu), kolmogorov_length(given["epsilon"], nu)
        facts += [
            ("eddies' shear [1/s]", rate, "of the smallest eddies; not in dispersionModel"),
            ("their Ca", given["mu"] * rate / modulus, "below 1e-3 they do not deform the particle"),
            ("their size over d", length / d, "below 1 the particle is not small against them"),
        ]
    return [f"{name:22s} {value:<12.4g} {text}".rstrip() for name, value, text in facts]
