"""``foamprb estimate``: orders of magnitude of all effects on a soft sphere."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, TypeAlias

from foamprb.errors import InputError

if TYPE_CHECKING:
    from foamprb.body.estimate import AcrossForces

Fact: TypeAlias = tuple[str, float, str]
"""Name, value and remark of a line."""

PURPOSE = "estimate from a few numbers which effects matter to a particle"
EXAMPLE = "estimate -d 5e-6 -rho0 1050 -Ca 0.1 -mu 1e-3 -rhoInf 1000 -shearRate 100 -residenceTime 1"

_NUMBERS = (
    ("-d", "diameter", "D", "diameter, m", None),
    ("--rho0", "rho0", "RHO", "density of the particle, kg/m3", None),
    ("--mu", "mu", "MU", "viscosity of the fluid at this shear rate, Pa s", None),
    ("--rhoInf", "rhoInf", "RHO", "density of the fluid, kg/m3", None),
    ("--shearRate", "shearRate", "RATE", "shear rate of the flow at the particle, 1/s", None),
    ("--residenceTime", "residenceTime", "T", "residence time in the flow, s", None),
    ("--wallDistance", "wallDistance", "H", "distance of its centre from a wall, m [no wall]", math.inf),
    ("--channelWidth", "channelWidth", "W", "distance of the walls of a plane channel, m", math.inf),
    ("--temperature", "temperature", "T", "temperature, K [293.15]", 293.15),
    ("--gravity", "gravity", "G", "gravity, m/s2 [9.81]", 9.81),
)
_MAY_VANISH = ("gravity",)
_STIFFNESS = (
    ("--Ca", "Ca", "CA", "capillary number, mu*rate/modulus"),
    ("--shearModulus", "shearModulus", "G", "shear modulus of the particle, Pa"),
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    for option, name, metavar, text, default in _NUMBERS:
        parser.add_argument(
            option, dest=name, type=float, metavar=metavar, help=text, default=default,
            required=default is None,
        )  # fmt: skip
    stiffness = parser.add_mutually_exclusive_group(required=True)
    for option, name, metavar, text in _STIFFNESS:
        stiffness.add_argument(option, dest=name, type=float, metavar=metavar, help=text)


def execute(arguments: argparse.Namespace) -> int:
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
    from foamprb.body.bonds import force_on_held_sphere
    from foamprb.body.estimate import SoftSphere, Surroundings, across_forces, estimate, shear_modulus

    entries = vars(arguments)
    names = (*(name for _, name, *_ in _NUMBERS), *(name for _, name, *_ in _STIFFNESS))
    for name in names:
        value = entries[name]
        if value is not None and not (value > 0.0 or (value == 0.0 and name in _MAY_VANISH)):
            raise InputError(f"{name} is {value:g}. Allowed: a number > 0.")
    d, h, width = entries["diameter"], entries["wallDistance"], entries["channelWidth"]
    if h < 0.5 * d:
        raise InputError(f"wallDistance is {h:g}. Allowed: at least half the diameter, {0.5 * d:g}.")
    if width < math.inf and not h < 0.5 * width:
        raise InputError(f"wallDistance is {h:g}. Allowed: less than half of channelWidth, {0.5 * width:g}.")
    around = Surroundings(
        entries["mu"], entries["rhoInf"], entries["shearRate"], h, entries["temperature"], entries["gravity"]
    )
    modulus = entries["shearModulus"] or shear_modulus(entries["Ca"], entries["mu"], entries["shearRate"])
    sphere = SoftSphere(d, entries["rho0"], modulus)
    e = estimate(sphere, around, entries["residenceTime"])
    lift_off = "within the particle: it does not lift off"
    facts = [
        ("shear modulus [Pa]", modulus, ""),
        ("capillary number", e.capillary_number, "below 1e-3 a rigid sphere suffices"),
        ("shear stress [Pa]", entries["mu"] * entries["shearRate"], "of the fluid"),
        ("Reynolds number", e.reynolds_number, "above 0.01 to 0.1 fluid inertia lifts: see -channelWidth"),
        ("Stokes number", e.stokes_number, "below 0.01 the particle follows the flow"),
        ("Peclet number", e.peclet_number, "below 10 BrownianMotion turns and moves it"),
        ("settling speed [m/s]", e.settling_speed, ""),
        ("its Reynolds number", e.settling_reynolds_number, "above 0.1 it is slower: drag exceeds Stokes'"),
        ("diffusivity [m2/s]", e.diffusion_coefficient, ""),
        ("settling length [m]", e.settling_length, "in the residence time; so is the next"),
        ("diffusion length [m]", e.diffusion_length, ""),
        ("thermal strain", e.thermal_strain, "by Brownian motion of the shape"),
        (
            "turning [1/s]",
            0.75 * e.diffusion_coefficient / (0.5 * d) ** 2,
            "rotational diffusivity; a swimmer keeps its direction for half of the inverse",
        ),
        (
            "force if stuck [N]",
            force_on_held_sphere(0.5 * d, entries["shearRate"], entries["mu"]),
            "of this shear on a sphere at a wall, and on its bonds: adhere",
        ),
        ("lift speed [m/s]", e.lift_speed, "by the wall: wallLift"),
        ("lift length [m]", e.lift_length, "in the residence time"),
        (
            "lift-off height [m]",
            e.lift_height,
            "where lift balances weight" if e.lift_height > 0.5 * d else lift_off,
        ),
    ]
    facts += _across(across_forces(sphere, around, width))
    return [f"{name:22s} {value:<12.4g} {text}".rstrip() for name, value, text in facts]


def _across(forces: AcrossForces) -> list[Fact]:
    """Return the forces across the flow and which is the largest."""
    texts = {
        "duct_lift": ("inertial lift [N]", "of a neutral rigid sphere: ductLift; away from the wall"),
        "wall_lift": ("wall lift [N]", "of the soft particle: wallLift; away from the wall"),
        "slip_lift": ("slip lift [N]", "if it settles along the flow: SaffmanMeiLiftForce"),
        "weight": ("weight [N]", "less buoyancy"),
    }
    values = {name: value for name, value in forces._asdict().items() if value}
    largest = max(values, key=lambda name: abs(values[name]), default="")
    return [
        (texts[name][0], value, texts[name][1] + ("; the largest" if name == largest else ""))
        for name, value in values.items()
    ]
