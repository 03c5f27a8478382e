"""The state that a run leaves beside its results, loaded by ParaView."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import pyvista
from view_run import motion, write_run

from foamprb.output.paraview_state import write_state

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]


def test_the_state_shows_every_body_at_the_last_time(tmp_path: Path) -> None:
    moved = motion(6, 3)
    folder = write_run(tmp_path, moved, mesh=False)
    write_state(folder / "softCloud.py", "softCloud")
    driver = tmp_path / "driver.py"
    driver.write_text(
        f"import runpy; runpy.run_path({str(folder / 'softCloud.py')!r})\n"
        "from paraview import simple\n"
        f"simple.SaveData({str(tmp_path / 'bodies.vtp')!r}, simple.FindSource('bodies'))\n"
        f"simple.SaveScreenshot({str(tmp_path / 'shot.png')!r}, simple.GetActiveView())\n"
        "print('factor', simple.FindSource('bodies').ScaleFactor)\n"
        "print('said', simple.FindSource('enlargement').Text)\n"
    )
    display = ["xvfb-run", "-a"] if shutil.which("xvfb-run") else []
    for _ in range(5):
        done = subprocess.run(
            [*display, "pvpython", str(driver)], capture_output=True, text=True, timeout=240
        )
        # Now and then the first window aborts, the virtual display not being ready: no exit code of a script.
        if done.returncode in (0, 1, 2):
            break
    assert done.returncode == 0, done.stderr
    factor = float(done.stdout.split("factor ")[1].split()[0])
    assert f"bodies drawn {factor:.3g} times larger" in done.stdout
    assert factor == pytest.approx(
        max(1.0, 0.01 * np.ptp(moved.x[-1], axis=0).max() / moved.radius.max()), rel=0.01
    )
    bodies = pyvista.read(tmp_path / "bodies.vtp").split_bodies()
    assert len(bodies) == 6
    middles = np.array([np.array(body.bounds).reshape(3, 2).mean(axis=1) for body in bodies])
    away = np.linalg.norm(middles[:, None] - moved.x[-1][None], axis=2).min(axis=1)
    assert away.max() < 0.2 * factor * moved.radius.max()
    assert (tmp_path / "shot.png").stat().st_size > 5000
