import gzip
import json
import shutil
import textwrap
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista
from foam_writer import header
from numpy.typing import NDArray
from paths import ROOT
from pvpython import pvpython
from view_run import with_orientation

from foamprb.cloud.state import Status
from foamprb.results.folder import ResultsFolder
from foamprb.results.pvd import Series
from foamprb.results.vtk import PointCloud

SCRIPT = ROOT / "tools" / "paraview" / "show_cloud.py"
PIPE = ROOT / "cases" / "pipe"

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]

RADIUS = 2e-4
SHOWN = (Status.ACTIVE, Status.STUCK)
STATUSES = np.array(
    [Status.ACTIVE, Status.PENDING, Status.STUCK, Status.ESCAPED, Status.ACTIVE, Status.FAILED]
)


@pytest.fixture
def duct(tmp_path: Path) -> Path:
    """A duct of one cell, 8 × 1 × 1 mm, whose walls are the four long sides."""
    case = tmp_path / "duct"
    mesh = case / "constant" / "polyMesh"
    mesh.mkdir(parents=True)
    (case / "system").mkdir()
    corners = [(x, y, z) for z in (0, 1e-3) for y in (0, 1e-3) for x in (0, 8e-3)]
    faces = ["0 4 6 2", "1 3 7 5", "0 1 5 4", "2 6 7 3", "0 2 3 1", "4 5 7 6"]
    write_gzipped(mesh / "points", "vectorField", [f"({x} {y} {z})" for x, y, z in corners])
    write_gzipped(mesh / "faces", "faceList", [f"4({face})" for face in faces])
    write_gzipped(mesh / "owner", "labelList", ["0"] * 6)
    write_gzipped(mesh / "neighbour", "labelList", [])
    patches = {"inlet": ("patch", 1, 0), "outlet": ("patch", 1, 1), "wall": ("wall", 4, 2)}
    entries = [f"{k} {{ type {t}; nFaces {n}; startFace {start}; }}" for k, (t, n, start) in patches.items()]
    (mesh / "boundary").write_text(foam_list("polyBoundaryMesh", "boundary", entries))
    (case / "constant" / "g").write_text(
        header("uniformDimensionedVectorField", "g") + "value (0 -9.81 0);\n"
    )
    (case / "system" / "controlDict").write_text(
        header("dictionary", "controlDict") + "startTime 0; endTime 1; deltaT 1; writeInterval 1;\n"
    )
    return case


def foam_list(kind: str, name: str, entries: list[str]) -> str:
    return "\n".join([header(kind, name), str(len(entries)), "(", *entries, ")\n"])


def write_gzipped(path: Path, kind: str, entries: list[str]) -> None:
    with gzip.open(path.with_name(f"{path.name}.gz"), "wt") as file:
        file.write(foam_list(kind, path.name, entries))


def deformation_gradients(n: int) -> NDArray[Any]:
    """Rotations, stretches and shears without any symmetry, volume kept; shape (n, 3, 3)."""
    F: NDArray[Any] = np.eye(3) + 0.45 * np.random.default_rng(2).standard_normal((n, 3, 3))
    F[:, 0] *= np.sign(np.linalg.det(F))[:, None]
    F /= np.cbrt(np.linalg.det(F))[:, None, None]
    return F


def write_run(case: Path, radius: float = RADIUS) -> tuple[PointCloud, NDArray[Any]]:
    """Two times of a cloud of six bodies along a line; returns the last, and its F."""
    n = len(STATUSES)
    F = deformation_gradients(n)
    stretches = np.linalg.svd(F, compute_uv=False)
    series = Series(ResultsFolder(case / "postProcessing" / "softCloud", "softCloud"))
    for time in (0.1, 0.2):
        points = np.c_[np.linspace(1e-3, 6e-3, n) + 1e-3 * time, np.full(n, 5e-4), np.full(n, 5e-4)]
        snapshot = PointCloud(
            time,
            points,
            {
                # ParaView would take this one, alphabetically first, for the shape.
                "deformationGradient": F.reshape(n, 9),
                "glyph": (radius * F).transpose(0, 2, 1).reshape(n, 9),
                "d": np.full(n, 2 * radius),
                "taylorDeformation": (stretches[:, 0] - stretches[:, 2])
                / (stretches[:, 0] + stretches[:, 2]),
                "status": STATUSES.astype(np.int8),
            },
            {"d": "m"},
            {"status": tuple(status.name.lower() for status in Status)},
        )
        series.append(snapshot)
    return snapshot, F


def test_bodies_are_the_unit_sphere_mapped_by_RF(duct: Path, tmp_path: Path) -> None:
    snapshot, F = write_run(duct)
    driver = tmp_path / "driver.py"
    driver.write_text(
        textwrap.dedent(f"""
            import sys
            sys.path.insert(0, {str(SCRIPT.parent)!r})
            from pathlib import Path
            from paraview import simple
            import show_cloud
            scene = show_cloud.show(Path({str(duct)!r}), time=0.2, scale=2.0)
            simple.SaveData({str(tmp_path / "bodies.vtp")!r}, scene.bodies)
            simple.SaveData({str(tmp_path / "walls.vtm")!r}, scene.walls)
            print("times", list(simple.GetTimeKeeper().TimestepValues))
        """)
    )
    done = pvpython(driver)
    assert done.returncode == 0, done.stderr
    assert "times [0.1, 0.2]" in done.stdout

    shown = np.isin(STATUSES, SHOWN)
    bodies = pyvista.read(tmp_path / "bodies.vtp")
    surfaces = np.asarray(bodies.points, dtype=float).reshape(shown.sum(), -1, 3)
    H = 2.0 * RADIUS * F[shown]
    offsets = surfaces - snapshot.points[shown, None]
    xi = np.einsum("nij,nkj->nki", np.linalg.inv(H), offsets)
    np.testing.assert_allclose(np.linalg.norm(xi, axis=2), 1.0, atol=1e-5)
    # ParaView's sphere begins with its poles: the material points ±e3 are where F carries them.
    np.testing.assert_allclose(offsets[:, 0], H[:, :, 2], atol=1e-5 * RADIUS * 10)
    np.testing.assert_allclose(offsets[:, 1], -H[:, :, 2], atol=1e-5 * RADIUS * 10)
    # Half the height of an ellipsoid along x is the length of the first row of its H.
    reach = np.linalg.norm(H[:, 0], axis=1)
    np.testing.assert_allclose(np.abs(offsets[:, :, 0]).max(axis=1), reach, rtol=0.02)

    colour = bodies.point_data["taylorDeformation"].reshape(shown.sum(), -1)
    expected = snapshot.arrays["taylorDeformation"][shown]
    np.testing.assert_allclose(colour, np.broadcast_to(expected[:, None], colour.shape), rtol=1e-6)

    walls = pyvista.read(tmp_path / "walls.vtm").combine()
    assert walls.n_cells == 4
    np.testing.assert_allclose(walls.bounds, (0, 8e-3, 0, 1e-3, 0, 1e-3), atol=1e-9)


def test_picture_shows_bodies_in_the_walls(duct: Path, tmp_path: Path) -> None:
    write_run(duct, radius=1.5e-4)
    picture = tmp_path / "out.png"
    done = pvpython(SCRIPT, duct, "--time", 0.1, "--screenshot", picture, "--size", "800x450")
    assert done.returncode == 0, done.stderr
    image = read_picture(picture)
    assert image.shape == (450, 800, 3)
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 500
    assert saturated(image[:350]).mean() > 0.005
    assert (image[225] < 250).all(axis=1).mean() > 0.3
    assert not list(duct.glob("*.foam"))


def test_scale_enlarges_bodies(duct: Path, tmp_path: Path) -> None:
    write_run(duct, radius=2e-5)
    shares = []
    for scale in (2, 6):
        picture = tmp_path / f"{scale}.png"
        done = pvpython(SCRIPT, duct, "--scale", scale, "--screenshot", picture, "--size", "800x450")
        assert done.returncode == 0, done.stderr
        shares.append(saturated(read_picture(picture)[:350]).mean())
    assert shares[1] > 5 * shares[0] > 0


def test_run_without_cloud_shows_the_walls_and_says_so(duct: Path, tmp_path: Path) -> None:
    picture = tmp_path / "out.png"
    done = pvpython(SCRIPT, duct, "--screenshot", picture, "--size", "400x300")
    assert done.returncode == 0, done.stderr
    assert "softCloud.pvd: no such file, so no particles are shown. Run foamprb first." in done.stdout
    image = read_picture(picture)
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 20
    assert not saturated(image).any()


def test_time_that_was_not_written_and_nobody_in_the_flow(duct: Path, tmp_path: Path) -> None:
    Series(ResultsFolder(duct / "postProcessing" / "softCloud", "softCloud")).append(
        PointCloud(
            0.0,
            np.zeros((2, 3)),
            {
                "d": np.full(2, 1e-5),
                "glyph": np.zeros((2, 9)),
                "taylorDeformation": np.zeros(2),
                "status": np.full(2, Status.PENDING, dtype=np.int8),
            },
        )
    )
    done = pvpython(SCRIPT, duct, "--time", 0.05, "--screenshot", tmp_path / "out.png", "--size", "400x300")
    assert done.returncode == 0, done.stderr
    assert "Time 0.05 s was not written; the nearest is 0 s." in done.stdout
    assert "ERR" not in done.stderr
    assert (tmp_path / "out.png").is_file()


def test_pipe_of_the_cases(tmp_path: Path) -> None:
    case = tmp_path / "pipe"
    shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing"))
    write_run(case, radius=2.5e-6)
    picture = tmp_path / "out.png"
    done = pvpython(SCRIPT, case, "--screenshot", picture, "--size", "800x450")
    assert done.returncode == 0, done.stderr
    assert saturated(read_picture(picture)[:350]).mean() > 0.001


def test_copies_of_one_sphere_look_as_the_bodies_do(duct: Path, tmp_path: Path) -> None:
    cloud, _ = write_run(duct, radius=5e-5)
    cloud = with_orientation(replace(cloud, arrays=cloud.arrays | {"semiAxes": 5e-5 * semi_axes(cloud)}))
    series = Series(ResultsFolder(duct / "postProcessing" / "softCloud", "softCloud"))
    series.append(cloud)
    found = []
    for options in ((), ("--copies",)):
        picture = tmp_path / f"out{len(found)}.png"
        done = pvpython(SCRIPT, duct, "--screenshot", picture, "--size", "800x450", *options)
        assert done.returncode == 0, done.stderr
        found.append(saturated(read_picture(picture)[:350]))
    assert found[0].mean() > 0.002
    assert (found[0] & found[1]).sum() > 0.95 * (found[0] | found[1]).sum()


def semi_axes(cloud: PointCloud) -> NDArray[Any]:
    """Relative to the radius at rest, in falling order."""
    return np.linalg.svd(cloud.arrays["deformationGradient"].reshape(-1, 3, 3), compute_uv=False)


CAMERA = """
import json, sys
sys.path.insert(0, {folder!r})
from pathlib import Path
import numpy as np
from paraview import simple
import show_cloud
view = simple.CreateView("RenderView")
view.ViewSize = [800, 450]
show_cloud.show(Path({case!r}), camera=show_cloud.Camera({direction!r}, {zoom!r}))
print(json.dumps(dict(
    parallel=view.CameraParallelProjection, scale=view.CameraParallelScale, angle=view.CameraViewAngle,
    focus=list(view.CameraFocalPoint), position=list(view.CameraPosition), up=list(view.CameraViewUp),
    ticks=[show_cloud.ticks(10.0**k * n) for k in (-5, 0, 2) for n in range(1, 10)])))
"""


def camera_of(case: Path, driver: Path, direction: Any = None, zoom: float = 1.0) -> dict[str, Any]:
    driver.write_text(
        CAMERA.format(folder=str(SCRIPT.parent), case=str(case), direction=direction, zoom=zoom)
    )
    done = pvpython(driver)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def in_picture(camera: dict[str, Any], points: NDArray[Any]) -> NDArray[Any]:
    """Places of points in a picture of 16:9, −1 to 1 from left to right and from below; shape (n, 2)."""
    focus, position, up = (np.array(camera[name]) for name in ("focus", "position", "up"))
    towards = (position - focus) / np.linalg.norm(position - focus)
    up = up - (up @ towards) * towards
    up /= np.linalg.norm(up)
    half = np.full(len(points), camera["scale"])
    if not camera["parallel"]:
        half = ((position - points) @ towards) * np.tan(np.radians(camera["angle"] / 2))
    places: NDArray[Any] = np.column_stack(
        [(points - focus) @ np.cross(up, towards) / (16 / 9), (points - focus) @ up]
    )
    return places / half[:, None]


CORNERS = np.array([(x, y, z) for x in (0, 8e-3) for y in (0, 1e-3) for z in (0, 1e-3)])


def test_a_plane_is_seen_from_above_and_whole(duct: Path, tmp_path: Path) -> None:
    patches = {
        "inlet": ("patch", 1, 0),
        "outlet": ("patch", 1, 1),
        "wall": ("wall", 2, 2),
        "frontAndBack": ("empty", 2, 4),
    }
    entries = [f"{k} {{ type {t}; nFaces {n}; startFace {start}; }}" for k, (t, n, start) in patches.items()]
    boundary = duct / "constant" / "polyMesh" / "boundary"
    boundary.write_text(foam_list("polyBoundaryMesh", "boundary", entries))
    write_run(duct)
    camera = camera_of(duct, tmp_path / "driver.py")
    assert camera["parallel"] == 1
    towards = np.subtract(camera["position"], camera["focus"])
    np.testing.assert_allclose(towards / np.linalg.norm(towards), (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(camera["up"], (0, 1, 0), atol=1e-12)
    # Not cut off, and 94 % of the width.
    places = in_picture(camera, CORNERS)
    assert np.ptp(places[:, 0]) == pytest.approx(2 * 0.94, rel=1e-6)
    assert abs(places).max() < 1.0


@pytest.mark.parametrize(
    ("direction", "zoom"), [(None, 1.0), ((1.0, 1.0, 2.0), 1.0), ((0.0, -1.0, 0.0), 2.0)]
)
def test_a_tilted_duct_fills_the_picture_and_is_not_cut_off(
    duct: Path, tmp_path: Path, direction: Any, zoom: float
) -> None:
    c, s = np.cos(0.6), np.sin(0.6)
    corners = CORNERS * (0.4, 1, 1)
    tilted = corners @ np.array([(c, s, 0), (-s, c, 0), (0, 0, 1)])
    order = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    write_gzipped(
        duct / "constant" / "polyMesh" / "points",
        "vectorField",
        ["({:.9g} {:.9g} {:.9g})".format(*tilted[4 * x + 2 * y + z]) for x, y, z in order],
    )
    (duct / "constant" / "g").write_text(
        header("uniformDimensionedVectorField", "g") + "value (0 0 -9.81);\n"
    )
    write_run(duct)
    camera = camera_of(duct, tmp_path / "driver.py", direction, zoom)
    assert camera["parallel"] == 0
    # Of the width 94 %, or of the height 72 %, where captions need the rest.
    filled = (abs(in_picture(camera, tilted)) / (0.94, 0.72)).max()
    assert filled == pytest.approx(1.0, abs=1e-3) if zoom == 1.0 else filled > 1.5
    towards = np.subtract(camera["position"], camera["focus"])
    towards /= np.linalg.norm(towards)
    if direction is None:
        # From the side of its own long axis, turned by 32 degrees and raised by 6.
        axis = tilted[4] - tilted[0]
        along = abs(towards @ axis) / np.linalg.norm(axis)
        assert along == pytest.approx(np.sin(np.radians(32)) * np.cos(np.radians(6)), abs=1e-3)
    else:
        np.testing.assert_allclose(towards, direction / np.linalg.norm(direction), atol=1e-12)
    for top, numbers in zip(
        [10.0**k * n for k in (-5, 0, 2) for n in range(1, 10)], camera["ticks"], strict=True
    ):
        assert 3 <= len(numbers) <= 6
        assert 0.8 * top <= max(numbers) <= top * (1 + 1e-12)


@pytest.mark.parametrize("options", [("--view", "0,0,0"), ("--view", "up"), ("--zoom", "-1")])
def test_a_view_that_is_none_is_refused(duct: Path, options: tuple[str, str]) -> None:
    done = pvpython(SCRIPT, duct, "=".join(options))
    assert done.returncode == 2
    assert f"'{options[1]}' is not" in done.stderr


def read_picture(path: Path) -> NDArray[Any]:
    """Red, green and blue of each pixel, from the top; shape (height, width, 3)."""
    image = pyvista.read(path)
    width, height, _ = image.dimensions
    pixels: NDArray[Any] = image.point_data.active_scalars
    return pixels.reshape(height, width, -1)[::-1, :, :3]


def saturated(image: NDArray[Any]) -> NDArray[Any]:
    """Pixels of the colour map; walls, paper and ink are nearly grey."""
    result: NDArray[Any] = np.ptp(image.astype(int), axis=2) > 60
    return result
