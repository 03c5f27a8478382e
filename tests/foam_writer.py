"""Writes a mesh and a velocity as an OpenFOAM case, in any of OpenFOAM's formats."""

from __future__ import annotations

import gzip
from pathlib import Path
from typing import NamedTuple

import numpy as np
from test_flow_shapes import block, box_patches

from foamprb.flow.mesh import Mesh, build_mesh

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
) -> Mesh:
    """A case on a block of cells, its velocity linear; floor and sides are walls."""
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


def save(path: Path, content: bytes, form: Format) -> None:
    if form.compressed:
        path.with_name(path.name + ".gz").write_bytes(gzip.compress(content, mtime=0))
    else:
        path.write_bytes(content)
