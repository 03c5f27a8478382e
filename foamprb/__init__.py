"""Where soft micro-particles go in an OpenFOAM flow, and what shape they take.

The public names; everything else may change from one version to the next.

From a case to its results, as ``foamprb run`` goes:

    prepare             read a case and place its particles
    Job                 what ``prepare`` returns: the settings and the cloud of a run
    execute             advance a job's cloud to its end time and write the results
    open_run            the results of a run: tables, snapshots, paths
    InputError          a mistake in the input; its message says where, and what is allowed
    RunStopped          a run that ended early; its message says why, and how to go on

Flows:

    read_case           the flow of an OpenFOAM case at one time
    read_series         that of a case at several times
    read_mesh_file      the flow of a file of VTK's or meshio's formats
    read_mesh_series    that of a file with several times
    Division            how the boundary of a mesh file without patches is divided
    SeriesFlow          a flow on a mesh at several times, from any function that knows it
    select_times        the times of a case that ``-time`` would select
    analytic            flows in closed form, a module

Particles in a flow:

    spheres             particles at rest, as many as there are positions
    set_rest_shape      make ellipsoids at rest of them
    Particles           the arrays of all particles
    Status              what a particle is doing: pending, active, stuck, escaped or failed
    Cloud               particles, the flow that carries them, and the models that act on them
    Medium              viscosity and density of the fluid, and gravity
    read_medium         the medium of an OpenFOAM case
    Models              names of traction, drag, solid, wall test and integrator, and the forces
    Limits              how far a particle may be stretched, how large and how costly it may become
    FailedParticlesWarning  particles of a cloud failed: how many, and why
    Gravity             a force: weight less buoyancy
    PressureGradient    a force: that of the undisturbed flow's pressure gradient
    VirtualMass         a force: that of the fluid that an accelerating particle accelerates
    FaxenCorrection     the mean over the body of a flow that is curved
    WallLift            what walls send back of a soft particle near them
    BrownianMotion      push by the fluid's molecules
    StochasticDispersion  eddies of a turbulent flow, of random velocity
    GradientDispersion  eddies that go from where they are strong to where they are weak
    Stick               a patch that holds the particles that touch it
    Rebound             one from which they bounce off
    Escape              one through which they leave
    context             prepare particles for measuring
    measure             shape, orientation, rotation and load of particles

Solids:

    add_material        add a solid by its energy
    Parameter           the third parameter of such a solid, its name and limits
    Material            a solid: its energy, the derivatives of it, and what the integrators need
    log_ratio           an accurate logarithm near 1, for energies
"""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from foamprb.body.material import Material, Parameter, add_material
    from foamprb.body.tensor import log_ratio
    from foamprb.cloud.block import Medium
    from foamprb.cloud.cloud import Cloud
    from foamprb.cloud.forces import Gravity, PressureGradient, VirtualMass
    from foamprb.cloud.limits import Limits
    from foamprb.cloud.measures import context, measure
    from foamprb.cloud.patches import Escape, Rebound, Stick
    from foamprb.cloud.state import Particles, Status, set_rest_shape, spheres
    from foamprb.cloud.surroundings.brownian import BrownianMotion
    from foamprb.cloud.surroundings.dispersion import GradientDispersion, StochasticDispersion
    from foamprb.cloud.surroundings.faxen import FaxenCorrection
    from foamprb.cloud.surroundings.wall_lift import WallLift
    from foamprb.cloud.tracker import Models
    from foamprb.errors import FailedParticlesWarning, InputError, RunStopped
    from foamprb.flow import analytic
    from foamprb.flow.read.case import select_times
    from foamprb.flow.read.division import Division
    from foamprb.flow.read.meshfile import read_mesh_file, read_mesh_series
    from foamprb.flow.read.openfoam import read_case
    from foamprb.flow.read.series import read_series
    from foamprb.flow.series import SeriesFlow
    from foamprb.run.job import Job, prepare
    from foamprb.run.loop import execute
    from foamprb.settings.fluid import read_medium
    from foamprb.view.results import open_run

__version__ = version("foamprb")

_HOMES = {
    "BrownianMotion": "foamprb.cloud.surroundings.brownian",
    "Cloud": "foamprb.cloud.cloud",
    "Division": "foamprb.flow.read.division",
    "Escape": "foamprb.cloud.patches",
    "FailedParticlesWarning": "foamprb.errors",
    "FaxenCorrection": "foamprb.cloud.surroundings.faxen",
    "GradientDispersion": "foamprb.cloud.surroundings.dispersion",
    "Gravity": "foamprb.cloud.forces",
    "InputError": "foamprb.errors",
    "Job": "foamprb.run.job",
    "Limits": "foamprb.cloud.limits",
    "Material": "foamprb.body.material",
    "Medium": "foamprb.cloud.block",
    "Models": "foamprb.cloud.tracker",
    "Parameter": "foamprb.body.material",
    "Particles": "foamprb.cloud.state",
    "PressureGradient": "foamprb.cloud.forces",
    "Rebound": "foamprb.cloud.patches",
    "RunStopped": "foamprb.errors",
    "SeriesFlow": "foamprb.flow.series",
    "Status": "foamprb.cloud.state",
    "Stick": "foamprb.cloud.patches",
    "StochasticDispersion": "foamprb.cloud.surroundings.dispersion",
    "VirtualMass": "foamprb.cloud.forces",
    "WallLift": "foamprb.cloud.surroundings.wall_lift",
    "add_material": "foamprb.body.material",
    "analytic": "foamprb.flow",
    "context": "foamprb.cloud.measures",
    "execute": "foamprb.run.loop",
    "log_ratio": "foamprb.body.tensor",
    "measure": "foamprb.cloud.measures",
    "open_run": "foamprb.view.results",
    "prepare": "foamprb.run.job",
    "read_case": "foamprb.flow.read.openfoam",
    "read_medium": "foamprb.settings.fluid",
    "read_mesh_file": "foamprb.flow.read.meshfile",
    "read_mesh_series": "foamprb.flow.read.meshfile",
    "read_series": "foamprb.flow.read.series",
    "select_times": "foamprb.flow.read.case",
    "set_rest_shape": "foamprb.cloud.state",
    "spheres": "foamprb.cloud.state",
}

__all__ = [
    "BrownianMotion",
    "Cloud",
    "Division",
    "Escape",
    "FailedParticlesWarning",
    "FaxenCorrection",
    "GradientDispersion",
    "Gravity",
    "InputError",
    "Job",
    "Limits",
    "Material",
    "Medium",
    "Models",
    "Parameter",
    "Particles",
    "PressureGradient",
    "Rebound",
    "RunStopped",
    "SeriesFlow",
    "Status",
    "Stick",
    "StochasticDispersion",
    "VirtualMass",
    "WallLift",
    "add_material",
    "analytic",
    "context",
    "execute",
    "log_ratio",
    "measure",
    "open_run",
    "prepare",
    "read_case",
    "read_medium",
    "read_mesh_file",
    "read_mesh_series",
    "read_series",
    "select_times",
    "set_rest_shape",
    "spheres",
]


def __getattr__(name: str) -> Any:
    # Loading numba and VTK takes a second that "foamprb -help" should not cost.
    if name not in _HOMES:
        raise AttributeError(f"module 'foamprb' has no attribute {name!r}")
    if name == "analytic":
        return import_module("foamprb.flow.analytic")
    return getattr(import_module(_HOMES[name]), name)
