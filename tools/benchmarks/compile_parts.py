"""Gain of each part of ``foamprb/compile/internals.py``: compilation and speed of a loop without it.

Each measurement is a process of its own with an empty cache, on one core, that compiles the particle loop of
a steady flow on a mesh and then carries particles. The table has user CPU seconds of the compilation and µs
of a particle-step, medians of repeats taken in turns, for: all parts, all but one of them, and none.

    python tools/benchmarks/compile_parts.py -repeats 5 -integrator stokes
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from foamprb.compile.internals import PARTS, SWITCH

ROOT = Path(__file__).resolve().parents[2]
ALL, NONE = "all parts", "no part"


def measure(integrator: str) -> tuple[float, float]:
    """Measure the CPU seconds to compile a loop, and µs per particle-step."""
    import numpy as np
    import pyvista

    import foamprb
    from foamprb.flow.mesh.mesh import build_mesh
    from foamprb.flow.meshflow import MeshFlow

    grid = pyvista.StructuredGrid(*np.meshgrid(*3 * [np.linspace(0.0, 1.0, 9)], indexing="ij"))
    mesh = build_mesh(grid.cast_to_unstructured_grid())
    l = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    flow = MeshFlow(mesh, mesh.nodes @ l.T, np.broadcast_to(l, (len(mesh.nodes), 3, 3)))
    x = np.random.default_rng(0).uniform(0.3, 0.7, (3200, 3))
    p = foamprb.spheres(x, d=1e-4, rho=1000.0, mu=1.0)
    medium = foamprb.Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    p.host[:] = flow.locate(x)
    models = foamprb.Models(integrator=integrator)
    cloud = foamprb.Cloud(p, flow, medium, [foamprb.Stick()] * len(mesh.patches), 1e-4, models, threads=1)
    start = os.times().user
    cloud.advance(1)
    compilation, steps = os.times().user - start, 50
    start = time.process_time()
    cloud.advance(steps)
    return compilation, 1e6 * (time.process_time() - start) / (steps * len(x))


def measured(integrator: str, without: str) -> tuple[float, float]:
    """Run :func:`measure` in its own process without some parts."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH", ""))))
        environment = {**os.environ, "FOAMPRB_CACHE_DIR": folder, SWITCH: without, "PYTHONPATH": path}
        command = [sys.executable, __file__, "-serve", "-integrator", integrator]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)
    compilation, step = json.loads(done.stdout)
    return compilation, step


def main() -> None:
    """Measure in turns, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-repeats", type=int, default=5, metavar="N", help="of each measurement [5]")
    parser.add_argument("-integrator", default="stokes", metavar="NAME", help="whose loop [stokes]")
    parser.add_argument("-serve", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.serve:
        print(json.dumps(measure(options.integrator)))
        return
    without = {ALL: "0", NONE: "1"} | {f"without {name}": name for name in PARTS}
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in without}
    for _ in range(options.repeats):
        for name, switch in without.items():
            found[name].append(measured(options.integrator, switch))
    print("| | compilation, s | more | step, µs |\n|---|---|---|---|")
    best = statistics.median(compilation for compilation, _ in found[ALL])
    for name, pairs in found.items():
        compilation, step = (statistics.median(values) for values in zip(*pairs, strict=True))
        print(f"| {name} | {compilation:.2f} | {compilation - best:+.2f} | {step:.3f} |")


if __name__ == "__main__":
    main()
