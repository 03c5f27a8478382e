"""Warnings of what a case says of its flow that particles will not feel."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import decompose, header, write_case

from foamprb.errors import InputError
from foamprb.flow.base import Caveat
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.openfoam import read_case, read_series, steady_flow
from foamprb.flow.read.source import FlowSource


@pytest.fixture
def case(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    return tmp_path


def caveats_of(flow):
    # The linear velocity goes across walls, of which a warning has a test of its own.
    return [note for note in flow.notes if isinstance(note, Caveat) and "across its faces" not in note]


def caveats(case, **options):
    return [str(note) for note in caveats_of(read_case(case, **options))]


def move(case):
    """Give a time points of its own."""
    (case / "0.5/polyMesh").mkdir()
    shutil.copy(case / "constant/polyMesh/points", case / "0.5/polyMesh/points")


def put(path, text, kind="dictionary"):
    path.parent.mkdir(exist_ok=True)
    path.write_text(header(kind, path.name) + text)


def scalars(values):
    return "nonuniform List<scalar> {}({})".format(len(values), " ".join(map(str, values)))


def rho(values):
    boundary = '".*" { type calculated; value uniform 1; }'
    return f"dimensions [1 -3 0 0 0 0 0]; internalField {values}; boundaryField {{ {boundary} }}"


MRF = "rotor { cellZone rotor; active yes; omega 100; } other { active no; }"
POROUS = "filter { type explicitPorositySource; cellZone filter; } heat { type scalarSemiImplicitSource; }"
PORES = "bed { type DarcyForchheimer; cellZone bed; }"
MOTION = "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolver displacementLaplacian;"
NUT = "dimensions [0 2 -1 0 0 0 0]; internalField uniform 1e-5; boundaryField {}"
CASES = {
    "rotating zones": (("constant/MRFProperties", MRF), r"rotating zones \(MRFProperties: rotor\), but"),
    "zones that cannot be read": (("constant/MRFProperties", "rotor {"), r"MRFProperties: which cannot be"),
    "a rotating frame": (("constant/SRFProperties", "SRFModel rpm;"), r"a rotating frame \(SRFProperties\)"),
    "porous zones": (("constant/fvOptions", POROUS), r"porous zones \(filter\): particles go through"),
    "porous zones elsewhere": (("system/fvOptions", POROUS), r"porous zones \(filter\)"),
    "porous zones of old": (("constant/porosityProperties", PORES), r"porous zones \(bed\)"),
    "a mean flow": (("1e1/nut", NUT, "volScalarField"), r"turbulent one \(there is nut\): particles"),
    "a density": (
        ("1e1/rho", rho(scalars(range(1, 9))), "volScalarField"),
        r"the fluid's density is from 1 to 8 kg/m3 \(there is rho\), but to particles it is constant, rhoInf",
    ),
    "a mesh that moves": (("constant/dynamicMeshDict", MOTION), r"moves \(dynamicMotionSolverFvMesh\)"),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_one_warning_for_what_particles_do_not_feel(name, case):
    assert caveats(case) == []
    file, words = CASES[name]
    put(case / file[0], *file[1:])
    if name == "a mesh that moves":
        # A dictionary alone moves nothing.
        assert caveats(case) == []
        move(case)
    (found,) = caveats(case)
    assert re.search(words, found)


def test_an_instant_of_an_unsteady_flow_tells_how_much_it_changed(case):
    put(case / "system/fvSchemes", "ddtSchemes { default Euler; }")
    assert caveats(case) == []
    (found,) = caveats(case, time=0.5)
    assert "right if it is steady by then" in found
    for time in ("0.01", "0.02"):
        shutil.copytree(case / "0.5", case / time)
    (found,) = caveats(case, time=0.02)
    # The fluid has not crossed the box.
    assert "changed by 0 % since 0.01 s" in found
    text = (case / "1e1/U").read_text()
    (case / "0.5/U").write_text(re.sub(r"\((\S+) (\S+) (\S+)\)", r"(0 0 0)", text))
    (found,) = caveats(case)
    assert "is used as a steady flow, of one instant: its velocity changed by 100 % since 0.5 s" in found
    assert "set transient true" in found


NOTHING = {
    "iterations": ("system/fvSchemes", "ddtSchemes { default steadyState; }"),
    "no zone is active": ("constant/MRFProperties", "rotor { active false; }"),
    "no source is porous": ("constant/fvOptions", "heat { type scalarSemiImplicitSource; }"),
    "laminar": ("1e1/nut", NUT.replace("1e-5", "0"), "volScalarField"),
    "a constant density": ("1e1/rho", rho("uniform 1000"), "volScalarField"),
    "a liquid that is hardly compressed": ("1e1/rho", rho(scalars(range(1000, 1032, 4))), "volScalarField"),
    "a mesh at rest": ("constant/dynamicMeshDict", "dynamicFvMesh staticFvMesh;"),
}


@pytest.mark.parametrize("name", NOTHING)
def test_no_warning_where_it_would_say_nothing(name, case):
    file = NOTHING[name]
    put(case / file[0], *file[1:])
    assert caveats(case) == []


def test_the_absolute_velocity_of_a_rotating_frame_is_refused(case):
    put(case / "constant/SRFProperties", "SRFModel rpm;")
    shutil.copy(case / "1e1/U", case / "1e1/Urel")
    with pytest.raises(InputError, match=r"Allowed: -velocity Urel"):
        read_case(case)
    assert "a rotating frame" in caveats(case, velocity="Urel")[0]


def test_the_hint_about_eddies_names_the_fields_of_the_case(case):
    put(case / "1e1/nut", NUT, "volScalarField")
    assert "The case does not have k and epsilon or omega" in caveats(case)[0]
    for name in ("k", "omega"):
        put(case / "1e1" / name, NUT, "volScalarField")
    assert "stochasticDispersionRAS adds the dispersion, from k and omega." in caveats(case)[0]


def test_the_files_of_a_region_go_before_those_of_the_case(case):
    put(case / "constant/MRFProperties", "whole { }")
    for folder in (case / "constant", case / "1e1"):
        (folder / "air").mkdir()
        for path in [p for p in folder.iterdir() if p.name not in ("air", "MRFProperties")]:
            path.rename(folder / "air" / path.name)
    assert "MRFProperties: whole" in caveats(case, region="air")[0]
    put(case / "constant/air/MRFProperties", MRF)
    assert "MRFProperties: rotor" in caveats(case, region="air")[0]


def test_points_of_a_time_are_a_mesh_that_moves(case):
    (case / "1e1/polyMesh").mkdir()
    shutil.copy(case / "constant/polyMesh/points", case / "1e1/polyMesh/points")
    (found,) = caveats(case)
    assert "the mesh moves (points at this time)" in found
    # The mesh of a generator that writes a time has faces there, too.
    shutil.copytree(case / "constant/polyMesh", case / "1e1/polyMesh", dirs_exist_ok=True)
    assert caveats(case) == []


@pytest.mark.parametrize("kind", ["dynamicFvMesh dynamicRefineFvMesh;", "topoChanger { type refiner; }"])
def test_a_mesh_that_is_refined_does_not_move(case, kind):
    put(case / "constant/dynamicMeshDict", kind)
    assert caveats(case) == []


def test_a_series_warns_once_and_of_its_own_times(case):
    put(case / "1e1/nut", NUT, "volScalarField")
    put(case / "constant/dynamicMeshDict", MOTION)
    (found,) = caveats_of(read_series(case))
    assert "there is nut" in found


def test_a_decomposed_case_warns_alike(tmp_path):
    mesh = write_case(tmp_path)
    decompose(tmp_path, mesh, np.arange(mesh.n_cells) % 2, ("0", "0.5", "1e1"))
    put(tmp_path / "constant/MRFProperties", MRF)
    put(tmp_path / "processor0/1e1/nut", NUT, "volScalarField")
    found = caveats_of(steady_flow(DecomposedCase(tmp_path), "latestTime", FlowSource()))
    assert len(found) == 2
    assert "MRFProperties: rotor" in found[0]


def fluxes(case, floor, lid, dimensions="[0 3 -1 0 0 0 0]"):
    put(
        case / "1e1/phi",
        f"dimensions {dimensions}; internalField uniform 0; boundaryField {{ floor {{ type calculated; "
        f"value {scalars([floor / 4] * 4)}; }} lid {{ type calculated; value uniform {lid / 4}; }} "
        "sides { type calculated; value uniform 0; } }",
        "surfaceScalarField",
    )


def test_fluid_that_is_lost_is_counted_by_phi(case):
    fluxes(case, -2.0, 2.0)
    assert caveats(case) == []
    fluxes(case, -2.0, 1.5)
    (found,) = caveats(case)
    assert "does not conserve volume: 2 m3/s enter and 1.5 m3/s leave (from phi)" in found
    # On a mesh that moves phi is relative to it.
    shutil.copy(case / "1e1/phi", case / "1e1/meshPhi")
    fluxes(case, 0.0, -1.5)
    assert "2 m3/s enter and 0 m3/s leave (from phi + meshPhi)" in caveats(case)[0]
    fluxes(case, 0.0, 0.5)
    assert caveats(case) == []
    fluxes(case, -2.0, 3.0, "[1 0 -1 0 0 0 0]")
    (found,) = caveats(case)
    assert "does not conserve mass: 2 kg/s enter and 3 kg/s leave (from phi)" in found


def test_a_balance_is_judged_where_it_can_be(case):
    """By the flux of the relative velocity; not of a tank that empties, nor of one of several phases."""
    text = (case / "1e1/U").read_text()
    (case / "1e1/Urel").write_text(text)
    lid = "lid { type fixedValue; value uniform (0 0 0.5); }"
    (case / "1e1/U.air").write_text(re.sub(r"lid \{.*?\}", lid, text, flags=re.DOTALL))
    fluxes(case, -2.0, 1.5)
    assert "(from phi)" in caveats(case, velocity="Urel")[0]
    assert caveats(case, velocity="U.air") == []
    put(case / "system/fvSchemes", "ddtSchemes { default Euler; }")
    assert "conserve volume" in caveats(case)[0]
    fluxes(case, 0.0, 2.0, "[1 0 -1 0 0 0 0]")
    assert caveats(case) == []


def test_fates_are_worthless_where_half_of_the_fluid_is_lost(case):
    for outflow, fault in ((1.01, ""), (0.99, "unbalanced")):
        fluxes(case, -2.0, outflow)
        (caveat,) = caveats_of(read_case(case))
        assert caveat.fault == fault


def test_phases_are_one_fluid_to_particles(case):
    boundary = 'boundaryField { ".*" { type zeroGradient; } }'
    put(case / "1e1/alpha.water", f"dimensions []; internalField uniform 1; {boundary}", "volScalarField")
    assert caveats(case) == []
    values = scalars([0, 1] * 4)
    put(case / "1e1/alpha.water", f"dimensions []; internalField {values}; {boundary}", "volScalarField")
    (found,) = caveats(case)
    assert "several phases (alpha.water)" in found
    values = scalars([0] * 7 + [0.007])
    put(case / "1e1/alpha.water", f"dimensions []; internalField {values}; {boundary}", "volScalarField")
    assert caveats(case) == []


def test_a_mixture_is_offered_for_two_phases(case):
    """That their densities differ needs no second warning."""
    put(case / "1e1/rho", rho(scalars(range(1, 9))), "volScalarField")
    for names in ("alpha.air, alpha.water", "alpha.air, alpha.oil, alpha.water"):
        for name in names.split(", "):
            values = f"internalField {scalars([0, 1] * 4)}; boundaryField {{}}"
            put(case / "1e1" / name, f"dimensions []; {values}", "volScalarField")
        (caveat,) = caveats(case)
        assert f"several phases ({names})" in caveat
        assert ("solution/mixture true" in caveat) == ("oil" not in names)


def test_phi_of_another_numbering_is_a_fault(tmp_path):
    """Of a uniform flow, whose phi is exact, with the fluxes of the inner faces in another order."""
    mesh = write_case(tmp_path, perturbation=0.0)
    corners = mesh.points[mesh.face_points].reshape(-1, 4, 3)
    phi = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])[:, 0] / 2.0
    for order, faults in ((slice(None), []), (slice(None, None, -1), ["unbalanced"])):
        outer = phi[mesh.n_internal :]
        boundary = "".join(
            f"{p.name} {{ type calculated; value {scalars(outer[a:b])}; }}"
            for p, a, b in zip(mesh.patches, mesh.patch_start, mesh.patch_start[1:], strict=False)
        )
        inner = scalars(phi[: mesh.n_internal][order])
        text = f"dimensions [0 3 -1 0 0 0 0]; internalField {inner}; boundaryField {{ {boundary} }}"
        put(tmp_path / "1e1/phi", text, "surfaceScalarField")
        found = [
            note for note in read_case(tmp_path).notes if isinstance(note, Caveat) and "phi makes" in note
        ]
        assert [note.fault for note in found] == faults


def test_times_in_degrees_are_no_seconds(case):
    """Of an engine, whose first times are negative; one of them is a flow."""
    shutil.copytree(case / "0.5", case / "-180")
    assert read_case(case, "-180").mesh.n_cells == 8
    for name, text in (
        ("constant/engineGeometry", "rpm 1500;"),
        ("system/controlDict", "userTime { type engine; }"),
    ):
        put(case / name, text)
        with pytest.raises(InputError, match="-180 to 1e1 are degrees of an engine's crank"):
            read_series(case)
        (case / name).unlink()
    assert read_series(case).span == (-180.0, 10.0)


def test_a_flow_that_no_solver_made_is_told(case):
    for name in ("0.5", "1e1"):
        shutil.rmtree(case / name)
    (note,) = (note for note in read_case(case).notes if "time 0" in note)
    assert not isinstance(note, Caveat)
    text = (case / "0/U").read_text()
    rest = re.sub(
        r"internalField.*?boundaryField",
        "internalField uniform (0 0 0); boundaryField",
        text,
        flags=re.DOTALL,
    )
    (case / "0/U").write_text(rest)
    assert "the flow is that of time 0" in caveats(case)[0]
    (case / "2").mkdir()
    (case / "2/U").write_text(text)
    (found,) = caveats_of(read_series(case))
    assert "at time 0, the first of the flow, the fluid is at rest, and until 2 s" in found


def test_round_off_in_a_closed_domain_is_no_loss(case):
    fluxes(case, -1e-17, 2e-17)
    assert caveats(case) == []


def test_fluid_that_is_lost_is_counted_by_the_velocity(case):
    """Without phi, or with one that is no flux."""
    velocity = case / "1e1/U"
    text = velocity.read_text()
    walls = "floor { type fixedValue; value uniform (0 0 3); } sides { type noSlip; }"
    head = text[: text.index("boundaryField")]
    velocity.write_text(
        f"{head}boundaryField {{ {walls} lid {{ type fixedValue; value uniform (0 0 1); }} }}"
    )
    for dimensions in (None, "[0 1 -1 0 0 0 0]"):
        if dimensions:
            fluxes(case, 0.0, 0.0, dimensions)
        (found,) = (note for note in caveats(case) if "conserve" in note)
        assert "does not conserve volume: 3 m3/s enter and 1 m3/s leave (from U on the patches)" in found
    # What a compressible fluid's mass does, its volume does not tell.
    put(case / "1e1/rho", rho(scalars(range(1, 9))), "volScalarField")
    assert [note for note in caveats(case) if "conserve" in note] == []


def test_a_flux_that_is_not_there_for_a_patch_is_taken_from_the_velocity(case):
    """As where phi has a value too few, or is broken; an empty patch needs none."""
    fluxes(case, -2.0, 1.5)
    path = case / "1e1/phi"
    text = path.read_text()
    assert "from phi" in caveats(case)[0]
    for old, new in (
        ("value uniform 0; }", "}"),
        ("nonuniform List<scalar> 4(-0.5 -0.5 -0.5 -0.5)", "nonuniform List<scalar> 3(-0.5 -0.5 -0.5)"),
        ("internalField", "internalFeld"),
    ):
        assert old in text
        path.write_text(text.replace(old, new))
        # The velocity is linear, and conserves volume.
        assert [note for note in caveats(case) if "from phi" in note] == []


def test_a_motion_that_cannot_be_read_is_one(case):
    put(case / "constant/dynamicMeshDict", "dynamicFvMesh {")
    move(case)
    (found,) = caveats(case)
    assert "the mesh moves (dynamicMeshDict), but is read at one time" in found
    put(case / "constant/dynamicMeshDict", "motion yes;")
    (found,) = caveats(case)
    assert "the mesh moves (dynamicMeshDict)" in found


def test_a_density_that_cannot_be_read_is_none(case):
    put(case / "1e1/rho", rho("uniform one"), "volScalarField")
    assert caveats(case) == []


@pytest.mark.parametrize(("share", "warned"), [(0.9e-3, False), (1.1e-3, True)])
def test_a_loss_counts_from_a_thousandth_of_the_flux(case, share, warned):
    for inflow, outflow in ((2.0, 2.0 * (1.0 - share)), (2.0 * (1.0 - share), 2.0)):
        fluxes(case, -inflow, outflow)
        assert bool(caveats(case)) == warned


@pytest.mark.parametrize("text", ["0", "0.0", "0.00", "1e-9"])
def test_a_field_of_zeros_is_none(case, text):
    put(case / "1e1/k", f"dimensions [0 2 -2 0 0 0 0]; internalField uniform {text}; boundaryField {{}}")
    assert bool(caveats(case)) == (text == "1e-9")
    put(case / "1e1/nut", NUT.replace("1e-5", "0"), "volScalarField")
    assert caveats(case) == []
