"""A case with a damaged file ends in one message, or in a run on a sound mesh."""

from __future__ import annotations

import re

import numpy as np
import pytest
from foam_writer import ASCII, Format, write_case
from hypothesis import given
from hypothesis import strategies as st

from foamprb import prepare
from foamprb.errors import InputError

FORMS = {"ascii": ASCII, "binary": Format(binary=True), "gzip": Format(compressed=True)}
MESH = tuple(f"constant/polyMesh/{name}" for name in ("points", "faces", "owner", "neighbour", "boundary"))
SETTINGS = """
FoamFile { version 2.0; format ascii; class dictionary; object softCloudProperties; }
solution { deltaT 1e-4; endTime 1; integrationSchemes { shape paper; } }
constantProperties
{
    rho0 1000; rhoInf 1.2;
    solid { type neoHooke; poissonsRatio 0.499; Ca 0.1; referenceShearRate 10; }
}
subModels
{
    particleForces { ellipsoidDrag { type oberbeck; } gravity; }
    injectionModels
    {
        points
        {
            type manualInjection; positionsFile "positions"; U0 (0 0 0);
            sizeDistribution { type fixedValue; fixedValueDistribution { value 1e-3; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches ( ".*" { type rebound; e 1; mu 0; } ); }
}
"""
WORDS = (b"", b"0", b"-1", b"7", b"1e308", b"nan", b"99999999999", b";", b"{", b"(", b")", b"x", b"$y")


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """A sound case in each form, with the number of its cells, points and boundary faces."""
    found = {}
    for name, form in FORMS.items():
        case = tmp_path_factory.mktemp("damaged") / name
        mesh = write_case(case, form=form, times=("1",))
        (case / "constant/softCloudProperties").write_text(SETTINGS)
        (case / "constant/positions").write_text("(\n(0.3 0.4 0.5)\n(0.7 0.2 0.9)\n)\n")
        (case / "constant/g").write_text("FoamFile { class uniformDimensionedVectorField; object g; }\n"
                                         "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 -9.81);\n")  # fmt: skip
        (case / "constant/transportProperties").write_text(
            "FoamFile { class dictionary; object transportProperties; }\nnu 1e-5;\n"
        )
        found[name] = case, (mesh.n_cells, mesh.n_points, len(mesh.boundary_centres))
    return found


def cut(data, at, _):
    return data[: int(at * len(data))]


def flip(data, at, number):
    changed = bytearray(data)
    changed[int(at * (len(data) - 1))] ^= 1 << number % 8
    return bytes(changed)


def replace(data, at, number):
    """Put another word in the place of one."""
    words = [match.span() for match in re.finditer(rb"[^\s(){};]+", data)]
    begin, end = words[int(at * (len(words) - 1))]
    return data[:begin] + WORDS[number % len(WORDS)] + data[end:]


def drop(data, at, number):
    """Remove some bytes."""
    begin = int(at * len(data))
    return data[:begin] + data[begin + number :]


@given(
    st.sampled_from(sorted(FORMS)),
    st.sampled_from((*MESH, "1/U", "constant/softCloudProperties", "constant/positions", "constant/g")),
    st.sampled_from((cut, flip, replace, drop)),
    st.floats(0.0, 1.0),
    st.integers(1, 1000),
)
def test_a_damaged_file_ends_in_a_message_or_a_sound_run(cases, form, name, damage, at, number):
    case, sizes = cases[form]
    file = case / name if (case / name).exists() else case / f"{name}.gz"
    sound = file.read_bytes()
    file.write_bytes(damage(sound, at, number))
    try:
        job = prepare(case, threads=1)
    except InputError:
        return
    finally:
        file.write_bytes(sound)
    cloud, mesh = job.cloud, job.cloud.flow.mesh
    assert (mesh.n_cells, mesh.n_points, len(mesh.boundary_centres)) == sizes
    assert (mesh.volumes > 0.0).all()
    a, b, c, d = (mesh.nodes[mesh.tets[:, k]] for k in range(4))
    filled = np.einsum("ti,ti->", b - a, np.cross(c - a, d - a)) / 6.0
    a, b, c = (mesh.nodes[mesh.triangles[:, k]] for k in range(3))
    enclosed = np.einsum("ti,ti->", a, np.cross(b, c)) / 6.0
    assert abs(filled - enclosed) <= 1e-9 * np.ptp(mesh.points, axis=0).prod()
    assert np.isfinite(cloud.flow.arrays(0.0).nodes).all()
    assert sum(cloud.particles.counts().values()) == cloud.particles.size
