"""Where soft micro-particles go in an OpenFOAM flow, and what shape they take.

The public names; everything else may change from one version to the next.

From a case to its results, as ``foamprb run`` goes:

    prepare             read a case and place its particles
    Job                 what ``prepare`` returns: the settings and the cloud of a run
    execute             advance a job's cloud to its end time and write the results
    open_run            the results of a run: tables, snapshots, paths
    open_runs           those of several runs, such as a study, as one table
    fit                 properties of bodies from their measured shapes
    Fits                what ``fit`` returns: a table of bodies, and of the population
    InputError          a mistake in the input; its message says where, and what is allowed
    RunStopped          a run that ended early; its message gives the reason, and how to continue

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
    drops               drops at rest, for the material ``drop``
    set_excess_area     make vesicles of them
    set_rest_shape      make ellipsoids at rest of them
    with_relaxation     solids with memory of them
    Particles           the arrays of all particles
    Status              what a particle is doing, or its fate: active, stuck, escaped, failed, ...
    Cloud               particles, the flow that carries them, and the models that act on them
    along_history       the shapes of bodies along given velocity gradients, without a mesh
    Medium              viscosity and density of the fluid, and gravity
    PowerLaw            a viscosity by the shear rate, for a medium: OpenFOAM's powerLaw
    CrossPowerLaw       OpenFOAM's model of that name
    BirdCarreau         another
    HerschelBulkley     one with a yield stress
    Casson              another
    read_medium         the medium of an OpenFOAM case
    Models              names of traction, drag, solid, wall test and integrator, and the forces
    Limits              how far a particle may be stretched, how large and how costly it may become
    FailedParticlesWarning  particles of a cloud failed: how many, and why
    ValidityWarning     steps are too long for a model
    Gravity             a force: weight less buoyancy
    PressureGradient    a force: pressure gradient of the undisturbed flow
    VirtualMass         a force: inertia of the fluid that a particle accelerates
    DuctLift            a force: lift by inertia of the fluid on neutral particles in a pipe or channel
    RectangularDuctLift  a force: the same in a rectangular duct
    FaxenCorrection     the mean over the body of a flow that is curved
    SaffmanMeiLift      lift by inertia of the fluid on a sphere that slips in shear
    WallLift            drift of a soft particle away from walls
    BrownianMotion      push by the fluid's molecules
    Swimming            self-propelled bodies
    Fates               limits at which bodies rupture or release their contents
    FateLimits          such limits: of a stretch, a stress or a dose
    StochasticDispersion  eddies of a turbulent flow, of random velocity
    GradientDispersion  eddy velocities down the gradient of k
    Stick               a patch that holds the particles that touch it
    Rebound             a patch from which particles bounce off
    Adhere              a patch to which particles stick by bonds that form and break
    Escape              a patch through which particles leave
    patch_interactions  the interaction of each patch of a flow
    context             prepare particles for measuring
    measure             shape, orientation, rotation and load of particles
    outline             the outlines of particles in a picture: area, perimeter, deformation

Models of users:

    add_drag            add a law of drag by the resistances of an ellipsoid
    add_force           add a force by a function of place, time and size
    add_surrounding     add a model that changes the flow around a particle
    add_cloud_function  add numbers of the cloud that are written at each write time
    Surrounding         base class of such a model
    extend              names for such models, a module
    select              a choice without a branch, for functions that are compiled
    add_material        add a solid by its energy
    Parameter           the third parameter of such a solid, its name and limits
    Material            a solid: its energy, the derivatives of it, and what the integrators need
    log_ratio           an accurate logarithm near 1, for energies
"""

import time
from importlib.metadata import version

import lazy_loader

started = time.perf_counter()
"""Start of the program, s, for the log."""

# Loading numba and VTK takes a second, which `foamprb -help` should not cost.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__version__ = version("foamprb")
