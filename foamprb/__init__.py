"""Where soft micro-particles go in an OpenFOAM flow, and what shape they take."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from foamprb.body.material import Parameter, add_material
    from foamprb.cloud.block import Medium
    from foamprb.cloud.cloud import Cloud
    from foamprb.cloud.forces.gravity import Gravity
    from foamprb.cloud.forces.pressure_gradient import PressureGradient
    from foamprb.cloud.forces.virtual_mass import VirtualMass
    from foamprb.cloud.measures import context, measure
    from foamprb.cloud.patches import Escape, Rebound, Stick
    from foamprb.cloud.state import Particles, Status, set_rest_shape, spheres
    from foamprb.cloud.tracker import Models
    from foamprb.errors import InputError, RunStopped
    from foamprb.flow import analytic
    from foamprb.flow.read.meshfile import read_mesh_file
    from foamprb.flow.read.openfoam import read_case
    from foamprb.flow.series import read_series
    from foamprb.run.job import execute, prepare

__version__ = version("foamprb")

_HOMES = {
    "Cloud": "foamprb.cloud.cloud",
    "Escape": "foamprb.cloud.patches",
    "Gravity": "foamprb.cloud.forces.gravity",
    "InputError": "foamprb.errors",
    "Medium": "foamprb.cloud.block",
    "Models": "foamprb.cloud.tracker",
    "Parameter": "foamprb.body.material",
    "Particles": "foamprb.cloud.state",
    "PressureGradient": "foamprb.cloud.forces.pressure_gradient",
    "Rebound": "foamprb.cloud.patches",
    "RunStopped": "foamprb.errors",
    "Status": "foamprb.cloud.state",
    "Stick": "foamprb.cloud.patches",
    "VirtualMass": "foamprb.cloud.forces.virtual_mass",
    "add_material": "foamprb.body.material",
    "analytic": "foamprb.flow",
    "context": "foamprb.cloud.measures",
    "execute": "foamprb.run.job",
    "measure": "foamprb.cloud.measures",
    "prepare": "foamprb.run.job",
    "read_case": "foamprb.flow.read.openfoam",
    "read_mesh_file": "foamprb.flow.read.meshfile",
    "read_series": "foamprb.flow.series",
    "set_rest_shape": "foamprb.cloud.state",
    "spheres": "foamprb.cloud.state",
}

__all__ = [
    "Cloud",
    "Escape",
    "Gravity",
    "InputError",
    "Medium",
    "Models",
    "Parameter",
    "Particles",
    "PressureGradient",
    "Rebound",
    "RunStopped",
    "Status",
    "Stick",
    "VirtualMass",
    "add_material",
    "analytic",
    "context",
    "execute",
    "measure",
    "prepare",
    "read_case",
    "read_mesh_file",
    "read_series",
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
