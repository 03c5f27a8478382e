"""The page for developers: the changes that it shows, applied to a copy of the package, do what it says."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from paths import ROOT
from pipe_case import copy_of_pipe, edit

PAGE = ROOT / "docs/development.md"

LINE = """
        line
        {
            type circleInjection; origin (0.01 -0.001 0); e1 (0 0.001 0); e2 (0 0 0); parcels 5;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 5e-06; } }
        }
    }
"""
SCRIPT = """
import json, sys
import numpy as np, pyvista
import foamprb
from foamprb.body.material import MATERIALS
from foamprb.cli import main
case = sys.argv[1]
assert main(["run", "-case", case, "-threads", "1"]) == 0
cloud = pyvista.read(case + "/postProcessing/softCloud/softCloud_000002.vtp")
flow = foamprb.read_case(case)
points = np.asarray(cloud.points)
u, _ = flow.sample(points, flow.locate(points), 0.0)
early = pyvista.read(case + "/postProcessing/softCloud/softCloud_000001.vtp")
solid, h = MATERIALS["fung"], 1e-6
arguments = np.array([3.2, 3.3, 1.05])
energy = lambda x: solid.energy(*x, 1.0, 5.0, 2.0)
rates = [(energy(arguments + h * e) - energy(arguments - h * e)) / (2 * h) for e in np.eye(3)]
print(json.dumps(dict(
    package=foamprb.__file__, id=cloud["origId"].tolist(), points=points.tolist(),
    slip=(cloud["U"] - u).tolist(), before=early["U"].tolist(),
    ratio=cloud["aspectRatio"].tolist(), axes=cloud["semiAxes"].tolist(),
    derivatives=list(solid.derivatives(*arguments, 1.0, 5.0, 2.0)), rates=rates)))
"""


@pytest.fixture(scope="module")
def changed(tmp_path_factory):
    """A copy of the package with every change of the page."""
    if shutil.which("git") is None:
        pytest.skip("git is not on PATH")
    folder = tmp_path_factory.mktemp("changed")
    shutil.copytree(ROOT / "foamprb", folder / "foamprb", ignore=shutil.ignore_patterns("__pycache__"))
    changes = re.findall(r"```diff\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(changes) == 7
    for change in changes:
        subprocess.run(["git", "apply", "-"], input=change, text=True, cwd=folder, check=True)
    return folder


def test_changes_of_the_page_for_developers_work(changed: Path, tmp_path: Path) -> None:
    case = copy_of_pipe(tmp_path)
    edit(case, r"endTime\s+\S+;", "endTime 0.002;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.001;")
    edit(case, r"shape\s+paper;", "shape stokesTwo;")
    edit(case, r"deltaT\s", "writeFields (aspectRatio semiAxes); writePrecision double; deltaT ")
    edit(case, r"type\s+neoHooke;", "type fung; stiffening 2;")
    edit(case, r"\bgravity;", "uniformForce { ax 1000; } electrophoresis { vz 0.01; start 0.0015; }")
    edit(case, r"\nonePoint\n\{[\s\S]*?\n\}\n", "")
    edit(case, r"\n    injectionModels\n    \{[\s\S]*?\n    \}\n", f"\n    injectionModels\n    {{{LINE}\n")
    edit(case, r"cloudFunctions\s*\{\s*\}", "cloudFunctions { box { type cloudExtent; } }")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(changed), *sys.path])}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(case)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    log, _, last = done.stdout.strip().rpartition("\n")
    found = json.loads(last)
    assert found["package"] == str(changed / "foamprb/__init__.py")

    # The injection model: five particles, evenly on its circle.
    assert found["id"] == list(range(5))
    y = [point[1] for point in found["points"]]
    assert y == pytest.approx([0.001 * math.cos(0.4 * math.pi * k) - 0.001 for k in range(5)], abs=2e-5)
    # The force: in Stokes flow it makes a sphere move by m a/(6πμR) relative to the fluid; these are nearly
    # spheres, but for those at the edge.
    drift = 2560 * 5e-6**2 / (18 * 1.208 * 1.491e-5) * 1000
    # And the field of the surroundings, which is switched on between the last two clouds.
    assert found["slip"][0] == pytest.approx([drift, 0, 0.01], rel=1e-3, abs=1e-3 * drift)
    assert found["before"][0][2] == pytest.approx(0.0, abs=1e-4)
    # The output array.
    assert found["ratio"] == pytest.approx([a / c for a, _, c in found["axes"]], rel=1e-12)
    assert max(found["ratio"]) > 1.1
    # The solid: its derivatives are those of its energy.
    assert "Selecting solid fung" in log
    assert found["derivatives"] == pytest.approx(found["rates"], rel=1e-6, abs=1e-6)
    assert "Selecting integrationScheme stokesTwo: without inertia, second order" in log
    # The cloud function.
    table = (case / "postProcessing/softCloud/box/extent.csv").read_text().splitlines()
    assert table[0] == "time,xMin,yMin,zMin,xMax,yMax,zMax"
    last_row = [float(x) for x in table[-1].split(",")]
    assert last_row[0] == pytest.approx(0.002)
    assert last_row[1:] == pytest.approx(
        [f(point[k] for point in found["points"]) for f in (min, max) for k in range(3)], rel=1e-12
    )
