"""Velocities on patches: what the file says, or what OpenFOAM's boundary conditions make of the cells."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
import pytest
from foam_writer import header, read_fields, rows, write_case

from foamprb.errors import InputError
from foamprb.flow.read.openfoam import read_case

CELLS = re.compile(r"internalField .*?\)\s*;\n", re.DOTALL)


@pytest.fixture
def case(tmp_path):
    write_case(tmp_path, perturbation=0.2)
    return tmp_path


def set_patches(case, text, internal=None):
    """Give the velocity at the last time these entries for its patches, and other values at the cells."""
    path = case / "1e1/U"
    cells = CELLS.search(path.read_text())[0] if internal is None else f"internalField {internal};\n"
    head = header("volVectorField", "U") + "dimensions [0 1 -1 0 0 0 0];\n"
    path.write_text(f"{head}{cells}boundaryField\n{{\n{text}\n}}\n")


class Lid(NamedTuple):
    """The faces of the lid: their values, velocities of the cells behind them, normals, centres."""

    values: np.ndarray
    u: np.ndarray
    n: np.ndarray
    x: np.ndarray
    depth: np.ndarray

    def tangential(self):
        return self.u - self.along(self.u)

    def along(self, vectors):
        return np.sum(vectors * self.n, axis=1)[:, None] * self.n


def on_lid(case, entry, others="floor { type noSlip; } sides { type noSlip; }"):
    set_patches(case, f"{others} lid {{ {entry} }}")
    mesh, cells, boundary, _ = read_fields(case)
    index = [patch.name for patch in mesh.patches].index("lid")
    faces = slice(*mesh.patch_start[index : index + 2])
    normals = mesh.boundary_areas[faces] / np.linalg.norm(mesh.boundary_areas[faces], axis=1)[:, None]
    behind = cells[mesh.owner[mesh.n_internal :][faces]]
    away = mesh.boundary_centres[faces] - mesh.centres[mesh.owner[mesh.n_internal :][faces]]
    depth = np.sum(away * normals, axis=1)[:, None]
    return Lid(boundary[faces], behind, normals, mesh.boundary_centres[faces], depth)


def uniform(x, y, z):
    return lambda lid: np.tile([x, y, z], (len(lid.u), 1))


RULES = {
    "zeroGradient": ("type zeroGradient;", lambda lid: lid.u),
    "zeroGradient with another value": ("type zeroGradient; value uniform (9 9 9);", lambda lid: lid.u),
    "noSlip": ("type noSlip;", uniform(0.0, 0.0, 0.0)),
    "noSlip with a value": ("type noSlip; value uniform (1 2 3);", uniform(0.0, 0.0, 0.0)),
    "slip": ("type slip;", Lid.tangential),
    "partialSlip": (
        "type partialSlip; valueFraction uniform 0.25;",
        lambda lid: 0.75 * lid.tangential(),
    ),
    "partialSlip on a moving wall": (
        "type partialSlip; refValue uniform (4 0 8); valueFraction uniform 0.25;",
        lambda lid: uniform(1.0, 0.0, 2.0)(lid) + 0.75 * lid.tangential(),
    ),
    "fixedNormalSlip": (
        "type fixedNormalSlip; fixedValue uniform (1 2 3);",
        lambda lid: lid.along(uniform(1.0, 2.0, 3.0)(lid)) + lid.tangential(),
    ),
    "inletOutlet": ("type inletOutlet; inletValue uniform (1 2 3);", uniform(1.0, 2.0, 3.0)),
    "inletOutlet with its value": (
        "type inletOutlet; inletValue uniform (1 2 3); value uniform (4 5 6);",
        uniform(4.0, 5.0, 6.0),
    ),
    "outletInlet": ("type outletInlet; outletValue uniform (1 2 3);", uniform(1.0, 2.0, 3.0)),
    "uniformInletOutlet": ("type uniformInletOutlet; uniformInletValue (1 2 3);", uniform(1.0, 2.0, 3.0)),
    "freestream": ("type freestream; freestreamValue uniform (1 2 3);", uniform(1.0, 2.0, 3.0)),
    "freestreamVelocity": (
        "type freestreamVelocity; freestreamValue uniform (1 2 3);",
        uniform(1.0, 2.0, 3.0),
    ),
    "uniformFixedValue": (
        "type uniformFixedValue; uniformValue constant (1 2 3);",
        uniform(1.0, 2.0, 3.0),
    ),
    "uniformFixedValue, short": (
        "type uniformFixedValue; uniformValue (1 -2e1 3);",
        uniform(1.0, -20.0, 3.0),
    ),
    "surfaceNormalFixedValue": (
        "type surfaceNormalFixedValue; refValue uniform -10;",
        lambda lid: -10.0 * lid.n,
    ),
    "flowRateInletVelocity": (
        "type flowRateInletVelocity; volumetricFlowRate constant 0.5;",
        lambda lid: -0.5 * lid.n,
    ),
    "flowRateInletVelocity with a unit": (
        "type flowRateInletVelocity; volumetricFlowRate constant 500 [dm^3/s];",
        lambda lid: -0.5 * lid.n,
    ),
    "rotatingWallVelocity": (
        "type rotatingWallVelocity; origin (0 0 1); axis (0 0 2); omega 3;",
        lambda lid: 3.0 * np.column_stack([-lid.x[:, 1], lid.x[:, 0], 0.0 * lid.x[:, 0]]),
    ),
    "fixedGradient": (
        "type fixedGradient; gradient uniform (1 2 3); value uniform (9 9 9);",
        lambda lid: lid.u + [1.0, 2.0, 3.0] * lid.depth,
    ),
    "fixedGradient without a value": (
        "type fixedGradient; gradient uniform (1 2 3);",
        lambda lid: lid.u + [1.0, 2.0, 3.0] * lid.depth,
    ),
    "uniformFixedGradient": (
        "type uniformFixedGradient; uniformGradient constant (1 2 3);",
        lambda lid: lid.u + [1.0, 2.0, 3.0] * lid.depth,
    ),
    "a unit behind the value": (
        "type fixedValue; value uniform (1000 2000 3000) [mm/s];",
        uniform(1.0, 2.0, 3.0),
    ),
    "a unit before the values": (
        "type fixedValue; value [km s^-1] nonuniform List<vector> 4{(1 2 3)};",
        uniform(1e3, 2e3, 3e3),
    ),
    "a condition of a library": ("type mine; value uniform (1 2 3);", uniform(1.0, 2.0, 3.0)),
}


@pytest.mark.parametrize("name", RULES)
def test_a_condition_has_the_value_that_openfoam_computes(name, case):
    entry, expected = RULES[name]
    lid = on_lid(case, entry)
    assert np.abs(lid.u).min() > 0.1
    assert lid.values == pytest.approx(expected(lid), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    "name",
    """outletInlet uniformInletOutlet freestream freestreamVelocity uniformFixedValue
    flowRateInletVelocity rotatingWallVelocity""".split(),  # noqa: SIM905
)
def test_a_value_that_openfoam_wrote_comes_before_what_it_is_computed_from(name, case):
    lid = on_lid(case, f"{RULES[name][0]} value uniform (4 5 6);")
    assert lid.values == pytest.approx(uniform(4.0, 5.0, 6.0)(lid))


MISSING = {
    "fixedValue": ("type fixedValue;", r"patch lid is of type fixedValue and has no value\. Allowed: value"),
    "a typo": (
        "type noSlp;",
        r"patch lid is of type noSlp and has no value\. Allowed: value .*a list\. Did you mean noSlip\?",
    ),
    "a table": (
        "type uniformFixedValue; uniformValue table ((0 (0 0 0)) (1 (1 0 0)));",
        r"patch lid is of type uniformFixedValue and has no value, nor what OpenFOAM computes it from",
    ),
    "no inletValue": ("type inletOutlet;", r"of type inletOutlet and has no value, nor what OpenFOAM"),
    "no type": ("value uniform (0 0 0);", r"boundaryField/lid/type is missing"),
    "no vector": ("type fixedValue; value uniform 3;", r"lid/value is 'uniform 3'\. Allowed: uniform and"),
    "words": ("type fixedValue; value nonuniform;", r"lid/value is 'nonuniform'\. Allowed: uniform and a v"),
    "code": ("type fixedValue; value #calc;", r"lid/value is '#calc'\. Allowed"),
    "too few": (
        "type fixedValue; value nonuniform List<vector> 2((0 0 0) (0 0 1));",
        r"1e1/U: 2 values on patch lid, which has 4 faces",
    ),
    "not finite": (
        "type fixedValue; value nonuniform List<vector> 4((0 0 0) (0 inf 1) (0 0 0) (0 0 0));",
        r"1e1/U: 1 of 4 values are not finite .* the first is \(0 inf 1\) on patch lid, face 1\.",
    ),
    "a unit of another quantity": (
        "type fixedValue; value uniform (0 0 0) [mm];",
        r"lid/value is .uniform \(0 0 0\) \[mm\]., with the di",
    ),
    "a constant with another unit": (
        "type uniformFixedValue; uniformValue (0 0 0) [rpm];",
        r"patch lid has an entry whose dimensions cannot be read",
    ),
    "a symmetry on a plain patch": (
        "type symmetry;", r"on patch lid the field is of type symmetry, which a patch of type patch can",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MISSING)
def test_what_openfoam_would_refuse_is_refused(name, case):
    entry, message = MISSING[name]
    with pytest.raises(InputError, match=message):
        on_lid(case, entry)


def test_a_constraint_patch_needs_a_field_of_its_type(case):
    boundary = case / "constant/polyMesh/boundary"
    boundary.write_text(boundary.read_text().replace("type patch", "type symmetryPlane"))
    with pytest.raises(InputError, match=r"lid is of type symmetryPlane, so the field .* of type fixedV"):
        on_lid(case, "type fixedValue; value uniform (0 0 0);")
    assert not on_lid(case, "type symmetryPlane;").values.any()
    set_patches(case, "floor { type noSlip; } sides { type noSlip; }")
    read_case(case)


def test_an_entry_is_found_by_name_then_group_then_pattern(case):
    """The name counts before all, then the last group, then the last pattern."""
    value = "type fixedValue; value uniform"
    text = (
        f'"[fs].*" {{ {value} (1 0 0); }} some {{ {value} (2 0 0); }} wall {{ {value} (3 0 0); }}'
        f'".*" {{ {value} (4 0 0); }} floor {{ {value} (5 0 0); }}'
    )
    boundary = case / "constant/polyMesh/boundary"

    def found():
        mesh, _, values, _ = read_fields(case)
        return {p.name: values[f][0] for p, f in zip(mesh.patches, mesh.patch_start, strict=False)}

    # All are in the group "some"; a wall is in the group of its type as well.
    set_patches(case, text)
    assert found() == {"floor": 5.0, "sides": 3.0, "lid": 2.0}
    boundary.write_text(boundary.read_text().replace("inGroups 1(some);", ""))
    assert found() == {"floor": 5.0, "sides": 3.0, "lid": 4.0}
    set_patches(case, f'"[ls].*" {{ {value} (1 0 0); }} "(l|f).*" {{ {value} (4 0 0); }}')
    assert found() == {"floor": 4.0, "sides": 1.0, "lid": 4.0}


def test_macros_and_includes_of_a_tutorials_initial_field(case, monkeypatch):
    """As in simpleFoam's motorBike: values from another file, constraint types from OpenFOAM's."""
    monkeypatch.delenv("WM_PROJECT_DIR", raising=False)
    (case / "1e1/include").mkdir()
    (case / "1e1/include/initialConditions").write_text("flowVelocity (2 0 1);\n")
    (case / "1e1/include/fixedInlet").write_text("lid { type fixedValue; value $internalField; }\n")
    set_patches(
        case,
        '#includeEtc "caseDicts/setConstraintTypes"\n#include "include/fixedInlet"\n'
        "floor { type inletOutlet; inletValue uniform (0 0 0); value $internalField; }\n"
        '"s.*" { type slip; }',
        "uniform $flowVelocity",
    )
    path = case / "1e1/U"
    path.write_text(
        path.read_text().replace("dimensions", '#include "include/initialConditions"\ndimensions')
    )
    mesh, cells, boundary, _ = read_fields(case)
    assert np.array_equal(cells, np.tile([2.0, 0.0, 1.0], (8, 1)))
    first = dict(zip([p.name for p in mesh.patches], mesh.patch_start, strict=False))
    assert boundary[first["lid"]].tolist() == boundary[first["floor"]].tolist() == [2.0, 0.0, 1.0]


def test_values_of_the_cells_do_not_fit_a_patch(case):
    lists = f"nonuniform List<vector> 8(\n{rows(np.arange(24.0).reshape(8, 3))})"
    set_patches(
        case,
        "floor { type noSlip; } sides { type noSlip; } lid { type fixedValue; value $internalField; }",
        lists,
    )
    with pytest.raises(InputError, match="8 values on patch lid, which has 4 faces"):
        read_case(case)


@pytest.mark.parametrize(
    ("dimensions", "message"),
    [
        (
            "[1 -2 -1 0 0 0 0]",
            r"dimensions is \[1 -2 -1 0 0 0 0\], those of a momentum per vol",
        ),
        (
            "[0 3 -1 0 0 0 0]",
            r"a flux of volume \(phi\); this should be a velocity: \[0 1 -1 0 0",
        ),
        ("[0 1 -1]", r"dimensions is '\[0 1 -1\]'\. Allowed: \[0 1 -1 0 0 0 0\]"),
        (None, r"1e1/U: dimensions is missing\. Allowed: \[0 1 -1 0 0 0 0\]"),
    ],
)
def test_dimensions_must_be_those_of_a_velocity(dimensions, message, case):
    path = case / "1e1/U"
    line = "" if dimensions is None else f"dimensions {dimensions};"
    path.write_text(path.read_text().replace("dimensions [0 1 -1 0 0 0 0];", line))
    with pytest.raises(InputError, match=message):
        read_case(case)
