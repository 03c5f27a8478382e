"""The state that a run leaves beside its results, loaded by ParaView."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import pyvista
from paths import ROOT
from PIL import Image
from pvpython import pvpython
from view_run import clouds, modes, motion, with_orientation, write_run

from foamprb.cli import main
from foamprb.cloud.measures import WRITTEN
from foamprb.results.folder import ResultsFolder
from foamprb.results.pvd import Series
from foamprb.results.vtk import PointCloud, Tracks, write_tracks
from foamprb.view.colours import LIGHT, rgb
from foamprb.view.paraview import write_state
from foamprb.view.results import open_run
from foamprb.view.show import Request, make_scene
from foamprb.view.surfaces import bulges

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]


def run_state(folder: Path, state: Path, more: str) -> str:
    """Load a state without a display, then do more; what is printed."""
    driver = folder / "driver.py"
    driver.write_text(f"import runpy; runpy.run_path({str(state)!r})\nfrom paraview import simple\n{more}")
    done = pvpython(driver)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="xvfb-run is not on PATH")
def test_the_command_shows_the_bodies_of_the_busiest_time(tmp_path, monkeypatch) -> None:
    """ParaView runs the state without ``__file__``; some bodies leave before the last time."""
    moved = motion(6, 4)
    folder = write_run(tmp_path / "case", moved)
    (folder / "t").mkdir()
    write_tracks(
        folder / "t/tracks.vtp",
        Tracks(moved.x[:, 0], np.array([0, 4]), {"time": moved.times}, {"origId": np.zeros(1)}),
    )
    program = tmp_path / "paraview"
    program.write_text(
        f"""#!/bin/sh
cat >> "${{1#--script=}}" << 'END'
simple.SaveData({str(tmp_path / "bodies.vtp")!r}, bodies)
simple.SaveScreenshot({str(tmp_path / "shot.png")!r}, view, ImageResolution=[600, 450])
import os
os._exit(7)
END
exec xvfb-run -a {shutil.which("paraview")} --dr "$1"
"""
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setattr("foamprb.view.show.has_display", lambda: True)
    assert main(["paraview", "-case", str(tmp_path / "case")]) == 7
    scene = make_scene(Request(tmp_path / "case"), open_run(tmp_path / "case"), range(4))
    assert (
        f"TIME = {moved.times[2]}\nENLARGEMENT = {scene.enlargement}\n"
        in (folder / "softCloud.py").read_text()
    )
    shown = scene.bodies.shown[scene.first]
    # Each body is the unit sphere under R F, enlarged. Its first points are the poles ±e3 of the material.
    places = scene.bodies.x[scene.first, shown]
    surfaces = np.asarray(pyvista.read(tmp_path / "bodies.vtp").points, dtype=float).reshape(
        shown.sum(), -1, 3
    )
    offsets = surfaces - places[:, None]
    H = scene.enlargement * scene.bodies.radius[shown, None, None] * scene.bodies.F[scene.first, shown]
    on_sphere = np.einsum("nij,nkj->nki", np.linalg.inv(H), offsets)
    np.testing.assert_allclose(np.linalg.norm(on_sphere, axis=2), 1.0, atol=1e-3)
    np.testing.assert_allclose(offsets[:, 0], H[:, :, 2], atol=1e-5)
    np.testing.assert_allclose(offsets[:, 1], -H[:, :, 2], atol=1e-5)
    picture = np.asarray(Image.open(tmp_path / "shot.png").convert("RGB"), dtype=float)
    coloured = np.ptp(picture[:330, :400], axis=2) > 60.0
    assert 0.001 < coloured.mean() < 0.5


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="xvfb-run is not on PATH")
def test_the_picture_of_the_page_has_a_title_a_bar_and_marks(tmp_path: Path) -> None:
    """The lines of docs/view.md: letters of 14 points, the bar at the right, deposits in their colour."""
    case = tmp_path / ("a_case_with_a_long_name_" * 6)
    folder = write_run(case, motion(6, 4))
    run = open_run(case)
    write_state(run.results, make_scene(Request(case), run, range(4)))
    state = folder / "softCloud.py"
    # Body 1 is stuck at the last time.
    state.write_text(re.sub(r"(?m)^TIME = .*", f"TIME = {motion(6, 4).times[-1]}", state.read_text()))
    (lines,) = re.findall(
        r"```python\n(view\.ViewSize.*?)```", (ROOT / "docs/view.md").read_text(), re.DOTALL
    )
    shot = tmp_path / "softCloud.png"
    run_state(tmp_path, state, f"view = simple.GetActiveView()\n{lines}".replace("softCloud.png", str(shot)))
    picture = np.asarray(Image.open(shot).convert("RGB"), dtype=float)
    assert picture.shape == (900, 1600, 3)
    rows, columns = np.nonzero(picture[:200, :800].sum(axis=2) < 200.0)
    assert np.ptp(rows) < 80
    assert columns.max() < 700
    assert np.ptp(picture[270:630, 1430:1470], axis=2).max() > 60.0
    # The near wall before it, of an opacity of 0.1, changes the colour by up to 21 of 255.
    assert (np.abs(picture - rgb(LIGHT.deposit)).max(axis=2) < 25.0).sum() > 100


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="xvfb-run is not on PATH")
def test_quadratic_modes_are_drawn_true(tmp_path: Path) -> None:
    B = modes(6, 3, 0.2)
    folder = write_run(tmp_path / "case", motion(6, 3), B=B)
    run = open_run(tmp_path / "case")
    scene = make_scene(Request(tmp_path / "case"), run, range(3))
    write_state(run.results, scene)
    saved = tmp_path / "bodies.vtp"
    run_state(
        tmp_path, folder / "softCloud.py", f"simple.SaveData({str(saved)!r}, simple.FindSource('bodies'))"
    )
    bodies, shown = scene.bodies, scene.bodies.shown[scene.first]
    surface = pyvista.read(saved)
    assert {"taylorDeformation", "origId"} <= set(surface.point_data.keys())
    n = int(shown.sum())
    offsets = (
        np.asarray(surface.points, dtype=float).reshape(n, -1, 3) - bodies.x[scene.first, shown][:, None]
    )
    F, mode = bodies.F[scene.first, shown].astype(float), bodies.B[scene.first, shown]
    X = np.asarray(pyvista.Sphere(radius=1.0, theta_resolution=24, phi_resolution=24).points, dtype=float)
    expected = X @ F.swapaxes(1, 2) + np.einsum("nijk,vj,vk->nvi", bulges(F, mode), X, X)
    size = scene.enlargement * bodies.radius[shown, None, None]
    np.testing.assert_allclose(offsets, size * expected, atol=1e-5 * size.max())


def larger(cloud: PointCloud, factor: float) -> PointCloud:
    sized = {name: factor * cloud.arrays[name] for name in ("glyph", "semiAxes", "d")}
    return replace(cloud, arrays={**cloud.arrays, **sized})


@pytest.mark.parametrize("of_file", [(), ("semiAxes", "orientation", "taylorDeformation")])
def test_copies_of_one_sphere_look_as_the_bodies_do(tmp_path: Path, of_file: tuple[str, ...]) -> None:
    """Many bodies are drawn by the graphics card from their semi-axes and orientation, written or not."""
    folder = tmp_path / "run/postProcessing/softCloud"
    folder.mkdir(parents=True)
    series = Series(ResultsFolder(folder, "softCloud"))
    for cloud in clouds(motion(6, 3)):
        cloud = with_orientation(larger(cloud, 6.0))
        names = (*WRITTEN, *of_file)
        series.append(replace(cloud, arrays={n: a for n, a in cloud.arrays.items() if n in names}))
    state = folder / "softCloud.py"
    bodies = []
    for many in (20000, 0):
        run = open_run(tmp_path / "run")
        write_state(run.results, make_scene(Request(tmp_path / "run"), run, range(3)))
        state.write_text(state.read_text().replace("MANY = 20000", f"MANY = {many}"))
        shot = tmp_path / f"{many}.png"
        drawn = run_state(
            tmp_path,
            state,
            "view = simple.GetActiveView()\n"
            "view.OrientationAxesVisibility = 0\n"
            "for name in ('title', 'enlargement'):\n"
            "    simple.Hide(simple.FindSource(name), view)\n"
            "for source in simple.GetSources().values():\n"
            "    if simple.GetDisplayProperties(source, view).Visibility:\n"
            "        simple.GetDisplayProperties(source, view).SetScalarBarVisibility(view, False)\n"
            "view.CameraPosition, view.CameraFocalPoint = [0.5, 0.5, 2.6], [0.5, 0.5, 0.5]\n"
            "view.CameraViewUp = [0, 1, 0]\n"
            f"simple.SaveScreenshot({str(shot)!r}, view, ImageResolution=[600, 450])\n"
            "print('tensor glyphs', simple.FindSource('bodies') is not None)\n",
        )
        assert f"tensor glyphs {many > 0}" in drawn
        picture = np.asarray(Image.open(shot).convert("RGB"), dtype=float)
        bodies.append(np.abs(picture - picture[0, 0]).max(axis=2) > 20.0)
    one, other = bodies
    assert 0.02 < one.mean() < 0.8
    assert (one & other).sum() > 0.97 * (one | other).sum()
