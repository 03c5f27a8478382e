"""Public names and their modules; ``__init__.py`` imports each when it is first used."""

from . import extend as extend
from .body.drag import add_drag as add_drag
from .body.material import Material as Material
from .body.material import Parameter as Parameter
from .body.material import add_material as add_material
from .body.tensor import (
    log_ratio as log_ratio,
)
from .body.tensor import (
    select as select,
)
from .cloud.block import Medium as Medium
from .cloud.cloud import Cloud as Cloud
from .cloud.forces import (
    DuctLift as DuctLift,
)
from .cloud.forces import (
    Gravity as Gravity,
)
from .cloud.forces import (
    PressureGradient as PressureGradient,
)
from .cloud.forces import (
    RectangularDuctLift as RectangularDuctLift,
)
from .cloud.forces import (
    VirtualMass as VirtualMass,
)
from .cloud.forces import (
    add_force as add_force,
)
from .cloud.histories import along_history as along_history
from .cloud.limits import Limits as Limits
from .cloud.measures import context as context
from .cloud.measures import measure as measure
from .cloud.patches import Adhere as Adhere
from .cloud.patches import Escape as Escape
from .cloud.patches import Rebound as Rebound
from .cloud.patches import Stick as Stick
from .cloud.state import (
    Particles as Particles,
)
from .cloud.state import (
    Status as Status,
)
from .cloud.state import (
    drops as drops,
)
from .cloud.state import (
    set_excess_area as set_excess_area,
)
from .cloud.state import (
    set_rest_shape as set_rest_shape,
)
from .cloud.state import (
    spheres as spheres,
)
from .cloud.state import (
    with_relaxation as with_relaxation,
)
from .cloud.surroundings.base import Surrounding as Surrounding
from .cloud.surroundings.brownian import BrownianMotion as BrownianMotion
from .cloud.surroundings.dispersion import (
    GradientDispersion as GradientDispersion,
)
from .cloud.surroundings.dispersion import (
    StochasticDispersion as StochasticDispersion,
)
from .cloud.surroundings.fates import (
    FateLimits as FateLimits,
)
from .cloud.surroundings.fates import (
    Fates as Fates,
)
from .cloud.surroundings.faxen import FaxenCorrection as FaxenCorrection
from .cloud.surroundings.registry import add_surrounding as add_surrounding
from .cloud.surroundings.saffman_mei import SaffmanMeiLift as SaffmanMeiLift
from .cloud.surroundings.swimming import Swimming as Swimming
from .cloud.surroundings.wall_lift import WallLift as WallLift
from .cloud.tracker import Models as Models
from .cloud.viscosity import (
    BirdCarreau as BirdCarreau,
)
from .cloud.viscosity import (
    Casson as Casson,
)
from .cloud.viscosity import (
    CrossPowerLaw as CrossPowerLaw,
)
from .cloud.viscosity import (
    HerschelBulkley as HerschelBulkley,
)
from .cloud.viscosity import (
    PowerLaw as PowerLaw,
)
from .cloudfunctions.deformability_cytometry import outline as outline
from .cloudfunctions.user import add_cloud_function as add_cloud_function
from .errors import (
    FailedParticlesWarning as FailedParticlesWarning,
)
from .errors import (
    InputError as InputError,
)
from .errors import (
    RunStopped as RunStopped,
)
from .errors import (
    ValidityWarning as ValidityWarning,
)
from .flow import analytic as analytic
from .flow.read.case import select_times as select_times
from .flow.read.meshfile import read_mesh_file as read_mesh_file
from .flow.read.meshfile import read_mesh_series as read_mesh_series
from .flow.read.openfoam import read_case as read_case
from .flow.read.openfoam import read_series as read_series
from .flow.read.source import Division as Division
from .flow.series import SeriesFlow as SeriesFlow
from .run.fit import Fits as Fits
from .run.fit import fit as fit
from .run.job import Job as Job
from .run.job import prepare as prepare
from .run.loop import execute as execute
from .settings.fluid import read_medium as read_medium
from .settings.patches import patch_interactions as patch_interactions
from .view.notebook import open_run as open_run
from .view.runs import open_runs as open_runs

__all__ = [
    "BirdCarreau",
    "BrownianMotion",
    "Casson",
    "Cloud",
    "CrossPowerLaw",
    "Division",
    "DuctLift",
    "Escape",
    "FailedParticlesWarning",
    "FaxenCorrection",
    "Fits",
    "GradientDispersion",
    "Gravity",
    "HerschelBulkley",
    "InputError",
    "Job",
    "Limits",
    "Material",
    "Medium",
    "Models",
    "Parameter",
    "Particles",
    "PowerLaw",
    "PressureGradient",
    "Rebound",
    "RectangularDuctLift",
    "RunStopped",
    "SaffmanMeiLift",
    "SeriesFlow",
    "Status",
    "Stick",
    "StochasticDispersion",
    "Surrounding",
    "ValidityWarning",
    "VirtualMass",
    "WallLift",
    "add_cloud_function",
    "add_drag",
    "add_force",
    "add_material",
    "add_surrounding",
    "along_history",
    "analytic",
    "context",
    "drops",
    "execute",
    "extend",
    "fit",
    "log_ratio",
    "measure",
    "open_run",
    "open_runs",
    "outline",
    "patch_interactions",
    "prepare",
    "read_case",
    "read_medium",
    "read_mesh_file",
    "read_mesh_series",
    "read_series",
    "select",
    "select_times",
    "set_excess_area",
    "set_rest_shape",
    "spheres",
    "with_relaxation",
]
started: float
__version__: str
