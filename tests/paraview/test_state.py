"""The state that a run leaves beside its results, loaded by ParaView."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import pyvista
from PIL import Image
from pvpython import pvpython
from view_run import clouds, motion, with_orientation, write_run

from foamprb.results.folder import ResultsFolder
from foamprb.results.paraview_state import write_state
from foamprb.results.pvd import Series
from foamprb.results.vtk import PointCloud

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


def test_the_state_shows_every_body_at_the_last_time(tmp_path: Path) -> None:
    moved = motion(6, 3)
    folder = write_run(tmp_path, moved, mesh=False)
    write_state(folder / "softCloud.py", "softCloud")
    said = run_state(
        tmp_path,
        folder / "softCloud.py",
        f"simple.SaveData({str(tmp_path / 'bodies.vtp')!r}, simple.FindSource('bodies'))\n"
        f"simple.SaveScreenshot({str(tmp_path / 'shot.png')!r}, simple.GetActiveView())\n"
        "print('factor', simple.FindSource('bodies').ScaleFactor)\n"
        "print('said', simple.FindSource('enlargement').Text)\n",
    )
    factor = float(said.split("factor ")[1].split()[0])
    assert f"bodies drawn {factor:.3g} times larger" in said
    assert factor == pytest.approx(
        max(1.0, 0.01 * np.ptp(moved.x[-1], axis=0).max() / moved.radius.max()), rel=0.01
    )
    bodies = pyvista.read(tmp_path / "bodies.vtp").split_bodies()
    assert len(bodies) == 6
    middles = np.array([np.array(body.bounds).reshape(3, 2).mean(axis=1) for body in bodies])
    away = np.linalg.norm(middles[:, None] - moved.x[-1][None], axis=2).min(axis=1)
    assert away.max() < 0.2 * factor * moved.radius.max()
    assert (tmp_path / "shot.png").stat().st_size > 5000


def larger(cloud: PointCloud, factor: float) -> PointCloud:
    sized = {name: factor * cloud.arrays[name] for name in ("glyph", "semiAxes", "d")}
    return replace(cloud, arrays={**cloud.arrays, **sized})


def test_copies_of_one_sphere_look_as_the_bodies_do(tmp_path: Path) -> None:
    """Many bodies are drawn by the graphics card from their semi-axes and orientation."""
    series = Series(ResultsFolder(tmp_path / "run", "softCloud"))
    for cloud in clouds(motion(6, 3)):
        series.append(with_orientation(larger(cloud, 6.0)))
    state = tmp_path / "run/softCloud.py"
    bodies = []
    for many in (20000, 0):
        write_state(state, "softCloud")
        state.write_text(state.read_text().replace("MANY = 20000", f"MANY = {many}"))
        shot = tmp_path / f"{many}.png"
        drawn = run_state(
            tmp_path,
            state,
            "view = simple.GetActiveView()\n"
            "view.OrientationAxesVisibility = 0\n"
            "simple.Hide(simple.FindSource('enlargement'), view)\n"
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
