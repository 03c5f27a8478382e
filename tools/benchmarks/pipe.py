"""Pipe of all measurements: O-grid meshes of any size in OpenFOAM's format, with the exact flow.

The pipe is 4.2 mm wide and 60 mm long, with the wall shear rate of the paper's (923.8 1/s); the velocity of
Poiseuille's flow is written at the means of the cells' vertices. No mesher and no solver is needed.
"""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

RADIUS, LENGTH, WALL_RATE = 2.1e-3, 0.06, 923.8
MEAN = WALL_RATE * RADIUS / 4
D, RHO_S = 5e-6, 2560.0
NU, RHO = 1.491e-5, 1.208

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


class Fluid(NamedTuple):
    """A fluid, and particles in it."""

    nu: float
    """m²/s."""
    rho: float
    """kg/m³."""
    rho_s: float
    """Density of the particles, kg/m³."""


AIR, WATER = Fluid(NU, RHO, RHO_S), Fluid(1e-6, 1000.0, 1050.0)
"""In air the particles' inertia counts; in water it does not, and the program chooses accordingly."""


class Size(NamedTuple):
    """A pipe along x and its mean velocity."""

    radius: float = RADIUS
    """m."""
    length: float = LENGTH
    """m."""
    mean: float = MEAN
    """m/s."""


SIZE = Size()
"""Of all measurements."""


class Grid(NamedTuple):
    """Cells on a quarter of the wall, from the inner square to the wall, and along the pipe."""

    side: int
    radial: int
    axial: int

    @property
    def cells(self) -> int:
        """Number of cells."""
        return (self.side**2 + 4 * self.side * self.radial) * self.axial


GRIDS = {
    "5k": Grid(8, 4, 26),
    "40k": Grid(16, 8, 52),
    "300k": Grid(32, 16, 104),
    "1M": Grid(48, 24, 152),
    "8M": Grid(96, 48, 290),
}
"""By the names that the parts use; the first two have 4 992 and 39 936 cells."""


class _Section(NamedTuple):
    """A cross-section: points (n, 2), quadrilaterals that turn from y to z, and their edges.

    An edge's points go round the first of its quadrilaterals; ``beyond`` is the other, −1 on the wall.
    """

    points: Floats
    quads: Ints
    edges: Ints
    quad: Ints
    beyond: Ints


def _section(side: int, radial: int, radius: float) -> _Section:
    t = np.linspace(-1.0, 1.0, side + 1)
    y, z = np.meshgrid(t, t, indexing="ij")
    # A square with bulging sides, its corners at half the radius.
    core = 0.4 * np.stack([y * np.sqrt(1.0 - z**2 / 4.0), z * np.sqrt(1.0 - y**2 / 4.0)], axis=-1)
    blocks = [core]
    for quarter, inner in enumerate((core[:, 0], core[-1, :], core[::-1, -1], core[0, ::-1])):
        angle = (2 * quarter - 3) * np.pi / 4 + np.linspace(0.0, np.pi / 2, side + 1)
        rim = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        s = np.linspace(0.0, 1.0, radial + 1)[None, :, None]
        blocks.append(inner[:, None] * (1.0 - s) + rim[:, None] * s)
    lists, offset = [], 0
    for part in blocks:
        m, n = part.shape[:2]
        i, j = np.meshgrid(np.arange(m - 1), np.arange(n - 1), indexing="ij")
        base = (offset + i * n + j).ravel()
        lists.append(np.stack([base, base + n, base + n + 1, base + 1], axis=1))
        offset += m * n
    flat = np.concatenate([part.reshape(-1, 2) for part in blocks])
    _, first, place = np.unique(np.round(flat, 9), axis=0, return_index=True, return_inverse=True)
    points = radius * flat[first]
    quads = place.reshape(-1)[np.concatenate(lists)].astype(np.int32)
    a, b = points[quads[:, 2]] - points[quads[:, 0]], points[quads[:, 3]] - points[quads[:, 1]]
    backwards = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] < 0.0
    quads[backwards] = quads[backwards][:, ::-1]

    edges = np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2)
    quad = np.repeat(np.arange(len(quads), dtype=np.int32), 4)
    key = edges.min(axis=1).astype(np.int64) * len(points) + edges.max(axis=1)
    order = np.argsort(key, kind="stable")
    begins = np.flatnonzero(np.diff(key[order], prepend=-1))
    paired = np.diff(begins, append=len(key)) == 2
    one = order[begins]
    beyond = np.full(len(one), -1, dtype=np.int32)
    beyond[paired] = quad[order[begins[paired] + 1]]
    return _Section(points, quads, edges[one], quad[one], beyond)


def write_mesh(folder: Path, grid: Grid, size: Size = SIZE) -> Floats:
    """Write ``constant/polyMesh`` in binary; return the means of the cells' vertices, (n_cells, 3)."""
    s = _section(grid.side, grid.radial, size.radius)
    n_points, n_quads, layers = len(s.points), len(s.quads), np.arange(grid.axial, dtype=np.int32)
    x = np.linspace(0.0, size.length, grid.axial + 1)
    points = np.empty((grid.axial + 1, n_points, 3))
    points[:, :, 0], points[:, :, 1:] = x[:, None], s.points

    def at(lists: Ints, stations: Any) -> Ints:
        return (lists[None] + n_points * np.asarray(stations, dtype=np.int32)[:, None, None]).reshape(
            -1, lists.shape[1]
        )

    def cells(quads: Ints, stations: Any) -> Ints:
        return (quads[None] + n_quads * np.asarray(stations, dtype=np.int32)[:, None]).ravel()

    def sides(rows: Any) -> Ints:
        low, high = at(s.edges[rows], layers), at(s.edges[rows], layers + 1)
        return np.concatenate([low, high[:, ::-1]], axis=1)

    every, inner, wall = np.arange(n_quads, dtype=np.int32), s.beyond >= 0, s.beyond < 0
    faces = np.concatenate([at(s.quads, layers[1:]), sides(inner)])
    owner = np.concatenate([cells(every, layers[:-1]), cells(s.quad[inner], layers)])
    neighbour = np.concatenate([cells(every, layers[1:]), cells(s.beyond[inner], layers)])
    # Round the cell with the lower number, as OpenFOAM wants it.
    swapped = owner > neighbour
    faces[swapped] = faces[swapped][:, ::-1]
    owner, neighbour = np.minimum(owner, neighbour), np.maximum(owner, neighbour)
    order = np.lexsort((neighbour, owner))
    patches = {
        "inlet": (at(s.quads, [0])[:, ::-1], cells(every, [0])),
        "outlet": (at(s.quads, [grid.axial]), cells(every, [grid.axial - 1])),
        "wall": (sides(wall), cells(s.quad[wall], layers)),
    }
    faces = np.concatenate([faces[order], *(f for f, _ in patches.values())])
    owner = np.concatenate([owner[order], *(c for _, c in patches.values())])
    neighbour = neighbour[order]

    poly = folder / "constant" / "polyMesh"
    poly.mkdir(parents=True, exist_ok=True)
    note = (
        f"nPoints:{points.size // 3}  nCells:{grid.cells}  nFaces:{len(owner)}  "
        f"nInternalFaces:{len(neighbour)}"
    )
    _write(poly / "points", "vectorField", [points.reshape(-1, 3)])
    _write(poly / "faces", "faceCompactList", [4 * np.arange(len(faces) + 1, dtype=np.int32), faces.ravel()])
    _write(poly / "owner", "labelList", [owner], note)
    _write(poly / "neighbour", "labelList", [neighbour], note)
    start, text = len(neighbour), ""
    for name, (of_patch, _) in patches.items():
        kind = "wall" if name == "wall" else "patch"
        text += f"    {name} {{ type {kind}; nFaces {len(of_patch)}; startFace {start}; }}\n"
        start += len(of_patch)
    header = _header("polyBoundaryMesh", "boundary", binary=False)
    (poly / "boundary").write_text(f"{header}{len(patches)}\n(\n{text})\n")
    middle = 0.5 * (x[1:] + x[:-1])
    centres = np.empty((grid.axial, n_quads, 3))
    centres[:, :, 0], centres[:, :, 1:] = middle[:, None], s.points[s.quads].mean(axis=1)
    return centres.reshape(-1, 3)


def write_case(folder: Path, grid: Grid, size: Size = SIZE) -> Path:
    """Write a case that OpenFOAM and foamprb run: mesh, and U at time 0; particles are left to others."""
    centres = write_mesh(folder, grid, size)
    s = _section(grid.side, grid.radial, size.radius)
    (folder / "0").mkdir(exist_ok=True)
    (folder / "system").mkdir(exist_ok=True)
    ends = _list(poiseuille(np.pad(s.points[s.quads].mean(axis=1), ((0, 0), (1, 0))), size))
    with (folder / "0" / "U").open("wb") as file:
        file.write(_header("volVectorField", "U").encode())
        file.write(b"dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> ")
        file.write(_list(poiseuille(centres, size)) + b";\nboundaryField\n{\n")
        for patch in (b"inlet", b"outlet"):
            file.write(patch + b" { type fixedValue; value nonuniform List<vector> " + ends + b"; }\n")
        file.write(b"wall { type noSlip; }\n}\n")
    write_dictionaries(folder, NU, RHO)
    write_control(folder, 1e-4, 1.0)
    return folder


def write_dictionaries(folder: Path, nu: float, rho: float, g: float = 9.81) -> None:
    """Write what parcels want of a case beside mesh, U and ``controlDict``.

    Parameters
    ----------
    nu, rho, g
        Of the fluid, m²/s and kg/m³, and gravity against y, m/s².
    """
    _dictionary(
        folder / "constant" / "transportProperties", f"transportModel Newtonian; nu {nu:g}; rhoInf {rho:g};"
    )
    _dictionary(folder / "constant" / "turbulenceProperties", "simulationType laminar;")
    gravity = f"dimensions [0 1 -2 0 0 0 0]; value (0 {-g:g} 0);"
    _dictionary(folder / "constant" / "g", gravity, "uniformDimensionedVectorField")
    _dictionary(
        folder / "system" / "fvSchemes",
        "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default none; } "
        "laplacianSchemes { default none; } interpolationSchemes { default linear; } "
        "snGradSchemes { default corrected; }",
    )
    _dictionary(folder / "system" / "fvSolution", "solvers {}")


def poiseuille(x: Floats, size: Size = SIZE) -> Floats:
    """Return the velocity at the points (n, 3), m/s."""
    u = np.zeros_like(x)
    u[:, 0] = 2.0 * size.mean * (1.0 - (x[:, 1] ** 2 + x[:, 2] ** 2) / size.radius**2)
    return u


def write_control(folder: Path, dt: float, end: float, interval: int = 1_000_000) -> None:
    """Write OpenFOAM's ``controlDict`` of a run that writes every so many steps, by default nothing."""
    _dictionary(
        folder / "system" / "controlDict",
        "application icoUncoupledKinematicParcelFoam; startFrom startTime; startTime 0; stopAt endTime; "
        f"endTime {end:.12g}; deltaT {dt:.12g}; writeControl timeStep; writeInterval {interval}; "
        "writeFormat ascii; writePrecision 14; timeFormat general; timePrecision 9; runTimeModifiable false;",
    )


def write_positions(path: Path, x: Floats) -> None:
    """Write positions (n, 3) as OpenFOAM's ``manualInjection`` reads them."""
    with path.open("w") as file:
        file.write(_header("vectorField", path.name, binary=False) + "(\n")
        file.writelines(f"({a!r} {b!r} {c!r})\n" for a, b, c in x.tolist())
        file.write(")\n")


PATCHES = 'wall { type stick; } "(inlet|outlet)" { type escape; }'
"""What the patches do with particles."""


def write_parcels(
    folder: Path,
    x: Floats,
    d: float = D,
    rho: float = RHO_S,
    patches: str = PATCHES,
    interpolation: str = "cellPoint",
    integration: str = "Euler",
    functions: str = "",
) -> None:
    """Write OpenFOAM's ``kinematicCloudProperties``: rigid point spheres at the positions (n, 3).

    Parameters
    ----------
    d, rho
        Their diameter, m, and density, kg/m³.
    patches
        As :data:`PATCHES`.
    interpolation, integration
        Of the fluid's velocity, and of the parcel's in time.
    functions
        Cloud functions.
    """
    write_positions(folder / "constant" / "kinematicCloudPositions", x)
    _dictionary(
        folder / "constant" / "kinematicCloudProperties",
        "solution { active true; coupled false; transient yes; cellValueSourceCorrection off; maxCo 0.3; "
        f"interpolationSchemes {{ rho cell; U {interpolation}; mu cell; }} "
        f"integrationSchemes {{ U {integration}; }} }}\n"
        f"constantProperties {{ rho0 {rho:g}; }}\n"
        "subModels { particleForces { sphereDrag; gravity; } injectionModels { model1 { "
        "type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0; U0 (0 0 0); "
        'positionsFile "kinematicCloudPositions"; ignoreOutOfBounds true; '
        f"sizeDistribution {{ type fixedValue; fixedValueDistribution {{ value {d:g}; }} }} }} }}\n"
        "dispersionModel none; patchInteractionModel localInteraction; localInteractionCoeffs { patches ( "
        f"{patches} ); }}\n"
        "heatTransferModel none; surfaceFilmModel none; collisionModel none; "
        f"stochasticCollisionModel none; }}\ncloudFunctions {{ {functions} }}",
    )


def write_soft_cloud(folder: Path, n: int, dt: float, steps: int, writes: int, scheme: str = "paper") -> None:
    """Write ``softCloudProperties``: n particles enter by the inlet, evenly during the first nine tenths."""
    end = steps * dt
    _write_properties(
        folder / "constant" / "softCloudProperties",
        f"deltaT {dt:g}; endTime {end:.9g}; writeInterval {end / writes:.9g}; "
        f"integrationSchemes {{ shape {scheme}; }}",
        AIR,
        0.05,
        f"inlet {{ type patchInjection; patch inlet; parcelsPerSecond {n / (0.9 * end):.9g}; "
        f"duration {0.9 * end:.9g};",
    )


def write_default_cloud(
    folder: Path,
    cloud: str,
    Ca: float,
    dt: float,
    steps: int,
    fluid: Fluid = AIR,
    more: str = "",
    forces: str = "",
    functions: str = "",
    places: str = "softCloudPositions",
) -> Path:
    """Write the properties of a cloud without entries that have a default; return the file.

    Parameters
    ----------
    more, forces, functions
        Further entries of ``solution``, ``particleForces`` and ``cloudFunctions``.
    places
        File of positions.
    """
    end, path = steps * dt, folder / "constant" / f"{cloud}Properties"
    _write_properties(
        path,
        f"deltaT {dt:g}; endTime {end:.9g}; writeInterval {end:.9g}; {more}",
        fluid,
        fluid.rho * fluid.nu * WALL_RATE / Ca,
        f'all {{ type manualInjection; SOI 0; U0 (0 0 0); positionsFile "{places}"; ignoreOutOfBounds true;',
        forces,
        functions,
    )
    return path


def _write_properties(
    path: Path,
    solution: str,
    fluid: Fluid,
    modulus: float,
    injection: str,
    forces: str = "",
    functions: str = "",
) -> None:
    """Write the properties of a cloud of soft particles, by entries of its dictionaries."""
    _dictionary(
        path,
        f"solution {{ {solution} }}\n"
        f"constantProperties {{ rho0 {fluid.rho_s}; rhoInf {fluid.rho}; nu {fluid.nu}; "
        f"solid {{ type neoHooke; poissonsRatio 0.499; shearModulus {modulus:.9g}; }} }}\n"
        f"subModels {{ particleForces {{ ellipsoidDrag; gravity; {forces} }} injectionModels {{ {injection} "
        f"sizeDistribution {{ type fixedValue; fixedValueDistribution {{ value {D}; }} }} }} }}\n"
        f"patchInteractionModel localInteraction; localInteractionCoeffs {{ patches ( {PATCHES} ); }} }}\n"
        f"cloudFunctions {{ {functions} }}",
    )


def positions(n: int, reach: float = 0.95, inner: float = 0.0) -> Floats:
    """Return places evenly over the first third of the pipe, from ``inner`` to ``reach`` radii, (n, 3)."""
    random = np.random.default_rng(0)
    r = RADIUS * np.sqrt(inner**2 + (reach**2 - inner**2) * random.random(n))
    angle = 2.0 * np.pi * random.random(n)
    x = LENGTH / 3.0 * (0.01 + 0.99 * random.random(n))
    return np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)


def places_in(mesh: Any, n: int) -> Floats:
    """Return random places in a mesh, as often as there is volume, (n, 3)."""
    random, corners = np.random.default_rng(0), mesh.nodes[mesh.tets]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    rows = random.choice(len(volumes), n, p=volumes / volumes.sum())
    places: Floats = np.einsum("nk,nki->ni", random.dirichlet(np.ones(4), n), corners[rows])
    return places


def soft_cloud(
    flow: Any, n: int, dt: float, integrator: str = "paper", threads: int = 1, fluid: Fluid = AIR
) -> Any:
    """Return n active particles of Ca 0.5 at the wall that move with the flow, in steps of a fixed size."""
    import foamprb

    x = positions(n)
    medium = foamprb.Medium(fluid.rho * fluid.nu, fluid.rho, (0.0, -9.81, 0.0))
    particles = foamprb.spheres(x, d=D, rho=fluid.rho_s, mu=medium.mu * WALL_RATE / 0.5)
    particles.v[:] = poiseuille(x)
    walls = [foamprb.Stick() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    models = foamprb.Models(integrator=integrator, tolerance=np.inf)
    return foamprb.Cloud(particles, flow, medium, walls, dt, models, threads)


def particle_steps(cloud: Any) -> float:
    """Return the number of particle-steps of size Δt that a cloud has taken."""
    p = cloud.particles
    return float((p.t - p.t0).sum() / cloud.dt)


def cost(cloud: Any, steps: int) -> float:
    """Advance a cloud, and return CPU µs per particle-step."""
    before, start = particle_steps(cloud), time.process_time()
    cloud.advance(steps)
    return 1e6 * (time.process_time() - start) / (particle_steps(cloud) - before)


def scratch_folder() -> Path:
    """Return the folder of the cases, ``$FOAMPRB_BENCHMARK_DIR``; the main process makes and removes it."""
    return Path(os.environ["FOAMPRB_BENCHMARK_DIR"])


def case(grid: str) -> Path:
    """Return the case of one of :data:`GRIDS`, written once."""
    folder = scratch_folder() / grid
    if not (folder / "0" / "U").exists():
        write_case(folder, GRIDS[grid])
    return folder


def transient_case(grid: str, interval: float, count: int) -> Path:
    """Return the case of one of :data:`GRIDS` with so many times of the same U, an interval (s) apart."""
    steady = case(grid)
    folder = steady.with_name(f"{grid}_transient")
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "constant").mkdir(parents=True)
    for name in ("system", "constant/polyMesh"):
        (folder / name).symlink_to(steady / name)
    for k in range(count):
        (folder / f"{k * interval:.6g}").mkdir()
        (folder / f"{k * interval:.6g}" / "U").symlink_to(steady / "0" / "U")
    write_dictionaries(folder, NU, RHO)
    return folder


def _header(kind: str, name: str, note: str = "", binary: bool = True) -> str:
    form = 'format binary;\n    arch "LSB;label=32;scalar=64"' if binary else "format ascii"
    noted = f'    note "{note}";\n' if note else ""
    return f"FoamFile\n{{\n    version 2.0;\n    {form};\n    class {kind};\n{noted}    object {name};\n}}\n"


def _dictionary(path: Path, text: str, kind: str = "dictionary") -> None:
    path.write_text(_header(kind, path.name, binary=False) + text + "\n")


def _list(values: NDArray[Any]) -> bytes:
    return f"{len(values)}\n(".encode() + values.tobytes() + b")"


def _write(path: Path, kind: str, lists: list[NDArray[Any]], note: str = "") -> None:
    with path.open("wb") as file:
        file.write(_header(kind, path.name, note).encode())
        for values in lists:
            file.write(b"\n" + f"{len(values)}\n(".encode())
            file.write(np.ascontiguousarray(values).data)
            file.write(b")\n")
