"""Writes a mesh and a velocity as an OpenFOAM case, in any of OpenFOAM's formats."""

from __future__ import annotations

import gzip
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mesh_shapes import block, box_patches

from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.read.field import VELOCITY_FIELD
from foamprb.flow.read.openfoam import Case, velocities

GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])


class Format(NamedTuple):
    """How numbers are written; sizes in bits."""

    binary: bool = False
    label: int = 32
    scalar: int = 64
    compressed: bool = False


ASCII = Format()


def header(kind: str, name: str, note: str = "", form: Format = ASCII) -> str:
    noted = f'note "{note}";' if note else ""
    arch = f'arch "LSB;label={form.label};scalar={form.scalar}";' if form.binary else ""
    style = "binary" if form.binary else "ascii"
    return f"FoamFile\n{{\nversion 2.0; format {style}; class {kind}; {arch} object {name}; {noted}\n}}\n"


def rows(values) -> str:
    return "\n".join("(" + " ".join(f"{x:.9g}" for x in row) + ")" for row in values)


def number_list(values, form: Format) -> bytes:
    """A list of labels, vectors or tensors with its length before it."""
    values = np.asarray(values)
    if form.binary:
        size = f"<i{form.label // 8}" if values.dtype.kind == "i" else f"<f{form.scalar // 8}"
        return f"{len(values)}\n(".encode() + values.astype(size).tobytes() + b")\n"
    body = "\n".join(map(str, values)) if values.ndim == 1 else rows(values)
    return f"{len(values)}\n(\n{body}\n)\n".encode()


def write_case(
    folder: Path,
    kind: str = "hexahedra",
    note: bool = True,
    perturbation: float = 0.2,
    form: Format = ASCII,
    times: tuple[str, ...] = ("0", "0.5", "1e1"),
    mesh: Mesh | None = None,
) -> Mesh:
    """A case on a mesh or a block of cells, its velocity linear; floor and sides are walls."""
    if mesh is None:
        shape = block(2, perturbation, kind)
        mesh = build_mesh(shape, box_patches(shape))
    poly = folder / "constant" / "polyMesh"
    poly.mkdir(parents=True)
    (folder / "system").mkdir()
    (folder / "system" / "controlDict").write_text(header("dictionary", "controlDict"))
    n = mesh.face_start[-1]
    faces = np.split(mesh.face_points, mesh.face_start[1:-1])
    counts = f"nPoints:{mesh.n_points}  nCells:{mesh.n_cells}  nFaces:{len(faces)}" if note else ""
    if form.binary:
        faces_body = number_list(mesh.face_start, form) + number_list(mesh.face_points, form)
        assert n == len(mesh.face_points)
    else:
        listed = "\n".join(f"{len(f)}({' '.join(map(str, f))})" for f in faces)
        faces_body = f"{len(faces)}\n(\n{listed}\n)\n".encode()
    lists = {
        "points": ("vectorField", number_list(mesh.points, form)),
        "faces": ("faceCompactList" if form.binary else "faceList", faces_body),
        "owner": ("labelList", number_list(mesh.owner, form)),
        "neighbour": ("labelList", number_list(mesh.neighbour, form)),
    }
    for name, (kind_of_list, body) in lists.items():
        save(poly / name, header(kind_of_list, name, counts, form).encode() + body, form)
    patches, values = "", b""
    for patch, first, last in zip(mesh.patches, mesh.patch_start[:-1], mesh.patch_start[1:], strict=True):
        patches += (
            f"    {patch.name} // a patch\n    {{ type {patch.type}; inGroups 1(some);"
            f" nFaces {last - first}; startFace {mesh.n_internal + first}; }}\n"
        )
        at = mesh.boundary_centres[first:last] @ GRADIENT.T
        values += f"{patch.name} {{ type fixedValue; value nonuniform List<vector> ".encode()
        values += number_list(at, form) + b";\n}\n"
    (poly / "boundary").write_text(
        header("polyBoundaryMesh", "boundary", form=form) + f"{len(mesh.patches)}\n(\n{patches})\n"
    )
    for time in times:
        (folder / time).mkdir()
        cells = number_list(mesh.centres @ GRADIENT.T, form)
        save(
            folder / time / "U",
            header("volVectorField", "U", form=form).encode() + b"dimensions [0 1 -1 0 0 0 0];\n"
            b"internalField nonuniform List<vector> " + cells + b";\n"
            b"boundaryField\n{\n" + values + b"}\n",
            form,
        )
        (folder / time / "p").write_text(
            header("volScalarField", "p") + "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\n"
            "boundaryField { floor { type none; } sides { type none; } lid { type none; } }\n"
        )
    return mesh


SLOPE = np.array([2.0, -3.0, 0.5])
KINDS = {1: "Scalar", 3: "Vector", 6: "SymmTensor", 9: "Tensor"}


def put_linear(folder, mesh, name="T", at=SLOPE, begin=-1.0, dimensions="[0 0 0 1 0 0 0]"):
    """``begin`` + at · x, with values on all patches; ``at`` is (3,) or (components, 3)."""
    at = np.reshape(at, (-1, 3))
    kind = KINDS[len(at)]
    inner = kind[0].lower() + kind[1:]

    def listed(x):
        rows = (" ".join(f"{v:.17g}" for v in row) for row in begin + x @ at.T)
        text = " ".join(row if len(at) == 1 else f"({row})" for row in rows)
        return f"nonuniform List<{inner}> {len(x)}({text})"

    starts = mesh.patch_start
    patches = " ".join(
        f"{patch.name} {{ type empty; }}"
        if patch.type == "empty"
        else f"{patch.name} {{ type fixedValue; value {listed(mesh.boundary_centres[a:b])}; }}"
        for patch, a, b in zip(mesh.patches, starts, starts[1:], strict=False)
    )
    (folder / name).write_text(
        header(f"vol{kind}Field", name) + f"dimensions {dimensions}; "
        f"internalField {listed(mesh.centres)}; boundaryField {{ {patches} }}"
    )


def put_scalar(folder: Path, name: str, units: str, value: float) -> None:
    """Write a uniform field at a time; units are the first three exponents."""
    (folder / name).write_text(
        header("volScalarField", name) + f"dimensions [{units} 0 0 0 0]; internalField uniform {value}; "
        'boundaryField { ".*" { type zeroGradient; } }'
    )


def put_zones(case: Path, **zones) -> None:
    """Write zones of cells, by their names."""
    text = "".join(
        f"{name} {{ type cellZone; cellLabels List<label> {len(cells)}({' '.join(map(str, cells))}); }}\n"
        for name, cells in zones.items()
    )
    path = case / "constant/polyMesh/cellZones"
    path.write_text(header("regIOobject", path.name) + f"{len(zones)}\n(\n{text})\n")


def save(path: Path, content: bytes, form: Format) -> None:
    if form.compressed:
        path.with_name(path.name + ".gz").write_bytes(gzip.compress(content, mtime=0))
    else:
        path.write_bytes(content)


def plain(values) -> str:
    return "\n".join(map(str, values))


def decompose(case: Path, mesh: Mesh, part_of: np.ndarray, times: tuple[str, ...]) -> None:
    """Cut a case of :func:`write_case` as decomposePar does, each cell going to the part of its number."""
    faces = np.split(mesh.face_points, mesh.face_start[1:-1])
    owner, neighbour = mesh.owner, mesh.neighbour
    for part in range(part_of.max() + 1):
        cells = np.flatnonzero(part_of == part)
        cell_in = {cell: i for i, cell in enumerate(cells)}
        own = part_of[owner] == part
        other = np.zeros(len(owner), dtype=bool)
        other[: len(neighbour)] = part_of[neighbour] == part
        inner = np.flatnonzero(own & other)
        patches = [
            np.flatnonzero(own[first:last]) + first
            for first, last in zip(
                mesh.n_internal + mesh.patch_start[:-1], mesh.n_internal + mesh.patch_start[1:], strict=True
            )
        ]
        beyond = np.where(own[: len(neighbour)], part_of[neighbour], part_of[owner[: len(neighbour)]])
        between = {
            to: np.flatnonzero((own ^ other)[: len(neighbour)] & (beyond == to))
            for to in range(part_of.max() + 1)
        }
        between = {to: ids for to, ids in between.items() if len(ids)}
        kept = np.concatenate([inner, *patches, *between.values()])
        turned = ~own[kept]
        lists = [
            faces[f] if not turn else np.r_[faces[f][:1], faces[f][:0:-1]]
            for f, turn in zip(kept, turned, strict=True)
        ]
        points = np.unique(np.concatenate([np.empty(0, dtype=int), *lists]))
        point_in = {point: i for i, point in enumerate(points)}
        local = [[point_in[p] for p in face] for face in lists]
        folder = case / f"processor{part}"
        poly = folder / "constant/polyMesh"
        poly.mkdir(parents=True)
        owners = [cell_in[neighbour[f] if turn else owner[f]] for f, turn in zip(kept, turned, strict=True)]
        files = {
            "points": ("vectorField", rows(mesh.points[points]), len(points)),
            "faces": ("faceList", "\n".join(f"{len(f)}({' '.join(map(str, f))})" for f in local), len(kept)),
            "owner": ("labelList", plain(owners), len(kept)),
            "neighbour": ("labelList", plain([cell_in[neighbour[f]] for f in inner]), len(inner)),
            "pointProcAddressing": ("labelList", plain(points), len(points)),
            "faceProcAddressing": ("labelList", plain(np.where(turned, -1, 1) * (kept + 1)), len(kept)),
            "cellProcAddressing": ("labelList", plain(cells), len(cells)),
            "boundaryProcAddressing": (
                "labelList",
                plain([*range(len(patches)), *[-1] * len(between)]),
                len(patches) + len(between),
            ),
        }
        for name, (kind, body, count) in files.items():
            (poly / name).write_text(header(kind, name) + f"{count}\n(\n{body}\n)\n")
        text, start = "", len(inner)
        blocks = [
            *(
                (patch.name, f"type {patch.type};", ids)
                for patch, ids in zip(mesh.patches, patches, strict=True)
            ),
            *(
                (f"procBoundary{part}to{to}", f"type processor; myProcNo {part}; neighbProcNo {to};", ids)
                for to, ids in between.items()
            ),
        ]
        for name, entries, ids in blocks:
            text += f"{name} {{ {entries} inGroups 1(some); nFaces {len(ids)}; startFace {start}; }}\n"
            start += len(ids)
        (poly / "boundary").write_text(
            header("polyBoundaryMesh", "boundary") + f"{len(blocks)}\n(\n{text})\n"
        )
        values = "".join(
            f"procBoundary{part}to{to} {{ type processor; value uniform (1 2 3); }}\n" for to in between
        )
        for patch, ids in zip(mesh.patches, patches, strict=True):
            at = mesh.boundary_centres[ids - mesh.n_internal] @ GRADIENT.T
            value = (
                f"nonuniform List<vector> {len(at)}\n(\n{rows(at)}\n)"
                if len(at)
                else "nonuniform List<vector> 0()"
            )
            values += f"{patch.name} {{ type fixedValue; coefficients {{ a (1 2); }} value {value};\n}}\n"
        for time in times:
            (folder / time).mkdir()
            (folder / time / "U").write_text(
                header("volVectorField", "U") + "dimensions [0 1 -1 0 0 0 0];\n"
                f"internalField nonuniform List<vector> {len(cells)}\n(\n"
                f"{rows(mesh.centres[cells] @ GRADIENT.T)}\n);\n"
                f"// of the part\nboundaryField\n{{\n{values}}}\n"
            )


def read_fields(case, time="latestTime", region=""):
    """Return the mesh, the velocity at its cells and boundary faces, and the name of the time."""
    opened = Case(case, region)
    name = opened.select_time(time)
    whole = opened.mesh(name)
    return whole.mesh, *velocities(opened.field(name, "U", VELOCITY_FIELD), whole), name
