"""cyclicACMI: faces that a mesh lists twice, as couples and as walls."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import beside, block, boundary

from foamprb.errors import InputError
from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.mesh.lists import take_lists
from foamprb.flow.mesh.mesh import assemble, build_mesh
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.field import VELOCITY_FIELD, FoamField, PatchField
from foamprb.flow.read.overlap import reduced
from foamprb.flow.read.polymesh import checked_poly


def overlapping_boxes():
    """Two unit cubes of 4 and of 5 cells a side, of which each covers half of a side of the other."""
    parts, patches = [block(4, 0.0), block(5, 0.0)], []
    parts[1].points += np.array([1.0, 0.5, 0.0])
    for part, own in zip(parts, "ab", strict=True):
        types = {own: "patch", f"{own}Sides": "wall"}
        patches += boundary(part, lambda x, own=own: own if abs(x[0] - 1.0) < 1e-9 else f"{own}Sides", types)
    return build_mesh(beside(parts), patches)


def listed_twice(mesh, **changes):
    """Return faces, owners, neighbours and patches of the mesh as OpenFOAM has them."""
    n, rows, patches = mesh.n_internal, [np.arange(mesh.n_internal)], []
    for k, patch in enumerate(mesh.patches):
        own = n + np.arange(*mesh.patch_start[k : k + 2])
        entries = {"nonOverlapPatch": f"{patch.name}Wall"} if len(patch.name) == 1 else {}
        for name, kind in ((patch.name, "cyclicACMI"), (f"{patch.name}Wall", "wall"))[: 1 + len(entries)]:
            start, other = sum(map(len, rows)), {"a": "b", "b": "a"}.get(name, "")
            kind = kind if entries else "wall"
            patches.append(PatchInfo(name, kind, len(own), start, other, Transform(), entries))
            rows.append(own)
    patches[0] = patches[0]._replace(**changes)
    at = np.concatenate(rows)
    start, lists = take_lists(mesh.face_start, mesh.face_points, at)
    arrays = start.astype(np.int32), lists, mesh.owner[at], mesh.neighbour
    return [Path("boundary")] * 5, mesh.points, *arrays, patches


def test_covered_faces_are_couples_and_the_others_walls():
    *given, patches = listed_twice(overlapping_boxes())
    poly = checked_poly(*given, patches)
    mesh, whole = assemble(poly, "mesh"), reduced(patches, poly.used)
    faces = dict(zip([p.name for p in mesh.patches], np.diff(mesh.patch_start), strict=True))
    assert [faces[name] for name in ("a", "aWall", "b", "bWall")] == [8, 8, 15, 10]
    assert [p.faces for p in whole] == list(faces.values())
    assert [p.kind for p in mesh.patches if len(p.name) == 1] == [PatchKind.PASSABLE] * 2
    y = mesh.boundary_centres[:, 1]
    for name, beyond in (("a", 0.5), ("bWall", 1.0)):
        k = list(faces).index(name)
        assert y[slice(*mesh.patch_start[k : k + 2])].min() > beyond
    # Fields have values on all faces of the file.
    entry = PatchField("cyclicACMI", fields={"value": np.arange(16.0)[:, None]})
    field = FoamField(Path("U"), VELOCITY_FIELD, np.zeros((1, 1)), {"a": entry}, VELOCITY_FIELD.dimensions[0])
    values = field.of(whole[0]).fields["value"][:, 0].astype(int)
    corners = given[1][given[3][given[2][patches[0].start + values][:, None] + np.arange(4)]]
    assert corners.mean(axis=1)[:, 1] == pytest.approx(y[:8])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"neighbour": "c"}, r"neighbourPatch of patch a is 'c'\. Did you|neighbourPatch of patch a is 'c'"),
        ({"entries": {}}, "nonOverlapPatch of patch a is ''"),
        ({"entries": {"nonOverlapPatch": "b"}}, "16 faces, its nonOverlapPatch b 25"),
        ({"transform": Transform("rotational")}, "patch a is of type cyclicACMI and rotational"),
    ],
)
def test_couples_that_cannot_be_sorted_are_named(changes, message):
    with pytest.raises(InputError, match=message):
        checked_poly(*listed_twice(overlapping_boxes(), **changes))
