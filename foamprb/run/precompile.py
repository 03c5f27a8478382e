"""Compilation before the code is wanted: of one run, and of all that most runs need.

Where the particle loop has never been compiled and there is a processor to spare, another process compiles it
while the first compiles some of its stages and reads the flow. Each finds in the cache what the other has
made; if the other process fails, or made what is not wanted, the first compiles.
"""

from __future__ import annotations

import atexit
import logging
import pickle
import subprocess
import sys
from contextlib import suppress
from typing import TYPE_CHECKING

from foamprb.cloud.executor import available_threads
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.state import empty, spheres
from foamprb.cloud.tracker import Models, Tracker
from foamprb.compile.cache import cache_directory

if TYPE_CHECKING:
    # The process that compiles should soon begin to.
    from foamprb.flow.meshflow import MeshFlow
    from foamprb.flow.series import SeriesFlow

__all__ = ["Precompiler", "compile_all"]

log = logging.getLogger("foamprb")


class Precompiler:
    """Another process that compiles a loop.

    Parameters
    ----------
    tracker
        What is to be compiled, as far as it can be known before the flow is.
    flow
        Which kind of flow it will be.
    """

    def __init__(self, tracker: Tracker, flow: type[MeshFlow] | type[SeriesFlow]) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        if tracker.compiled or available_threads() == 1:
            return
        self._process = subprocess.Popen(
            [sys.executable, "-m", "foamprb.run.precompile"],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(self.stop)
        assert self._process.stdin is not None
        # It may have ended already, if it cannot import what it needs.
        with suppress(BrokenPipeError), self._process.stdin as pipe:
            pickle.dump((tracker, flow), pipe)

    def __bool__(self) -> bool:
        """Whether there is such a process."""
        return self._process is not None

    def wait(self) -> None:
        """Wait until the process has ended."""
        if self._process is not None:
            self._process.wait()

    def stop(self) -> None:
        """End the process; what it has made so far stays in the cache."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()


def compile_all() -> None:
    """Compile what runs need that select nothing of their own: reading of meshes, all loops, the output.

    Steady and transient flows have loops of their own, and so has each integrator.
    """
    import numpy as np
    import pyvista

    from foamprb.cloud.block import Medium
    from foamprb.cloud.cloud import Cloud
    from foamprb.cloud.measures import context, measure
    from foamprb.cloud.patches import Stick
    from foamprb.flow.mesh.mesh import build_mesh
    from foamprb.flow.meshflow import MeshFlow
    from foamprb.flow.reconstruct import Reconstruction
    from foamprb.flow.series import SeriesFlow

    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = {pyvista.CellType.HEXAHEDRON: np.arange(8).reshape(1, 8)}
    mesh = build_mesh(pyvista.UnstructuredGrid(cells, np.array(corners, dtype=float)))
    nodes = Reconstruction(mesh)(np.zeros((1, 3)), np.zeros((len(mesh.boundary_centres), 3)))
    steady, transient = MeshFlow(mesh, *nodes), SeriesFlow(mesh, [0.0, 1.0], lambda _: nodes)
    flows: dict[str, MeshFlow | SeriesFlow] = {"steady": steady, "transient": transient}
    medium = Medium(1.0, 1.0, (0.0, 0.0, 0.0))
    for kind, flow in flows.items():
        for integrator in INTEGRATORS:
            log.info("Compiling the particle loop of integrationScheme %s in %s flows", integrator, kind)
            particle = spheres([(0.5, 0.5, 0.5)], d=1e-3, rho=1.0, mu=1.0)
            models = Models(integrator=integrator)
            cloud = Cloud(particle, flow, medium, [Stick()] * len(mesh.patches), 1e-3, models, threads=1)
            cloud.advance(1)
        measure(context(cloud.particles, flow, medium.mu, cloud.time))
    log.info("The code is kept in %s", cache_directory())


def main() -> None:
    """Compile what stands on the standard input."""
    tracker, flow = pickle.load(sys.stdin.buffer)
    tracker.compile_moves(flow.nothing())
    # With no particles nothing is done but to compile.
    tracker.advance(flow.nothing(), empty(0), 0, 0, 1)


if __name__ == "__main__":
    main()
