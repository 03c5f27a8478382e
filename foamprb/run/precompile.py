"""Compilation before the code is wanted: of one run, and of all that most runs need.

Where the particle loop has never been compiled and there is a processor to spare, another process compiles it
while the first compiles some of its parts and reads the flow. Each finds in the cache what the other has
made; if the other process fails, or made what is not wanted, the first compiles.
"""

from __future__ import annotations

import gc
import logging
import os
import pickle
import sys
from typing import TYPE_CHECKING

import numpy as np

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.measures import Gradients, context, measure
from foamprb.cloud.state import empty, spheres
from foamprb.cloud.tracker import Models, Tracker
from foamprb.compile.cache import cache_directory
from foamprb.compile.helper import Helper, available_threads

if TYPE_CHECKING:
    # The process that compiles should soon begin to.
    from foamprb.flow.meshflow import MeshFlow
    from foamprb.flow.series import SeriesFlow

__all__ = ["Precompiler", "compile_all"]

log = logging.getLogger("foamprb")


class Precompiler:
    """Another process that compiles a loop, and what this one does meanwhile.

    Parameters
    ----------
    tracker
        What is to be compiled, as far as it can be known before the flow is.
    flow
        Which kind of flow it will be.
    helper
        The process, if it has been started already.
    """

    def __init__(
        self, tracker: Tracker, flow: type[MeshFlow] | type[SeriesFlow], helper: Helper | None = None
    ) -> None:
        self._tracker, self._flow, self._helper = tracker, flow, helper
        if tracker.compiled or available_threads() == 1:
            self.stop()
            self._helper = None
            return
        self._helper = self._helper or Helper(__name__)
        self._helper.tell((tracker, flow))

    def __bool__(self) -> bool:
        """Whether there is such a process."""
        return self._helper is not None

    def help(self) -> None:
        """Compile in this process what the other comes to last, and what measures particles.

        With it, and with what reads a flow, there is about as much to compile as without it in the loop.
        """
        if self._helper is not None:
            self._tracker.compile_contact(self._flow.nothing())
            self._tracker.compile_stages()
            context(empty(0), Gradients(np.empty((0, 9))), 1.0, 0.0)

    def wait(self) -> None:
        """Wait until the process has ended."""
        if self._helper is not None:
            self._helper.wait()

    def stop(self) -> None:
        """End the process; what it has made so far stays in the cache."""
        if self._helper is not None:
            self._helper.stop()


def compile_all() -> None:
    """Compile what runs need that select nothing of their own: reading of meshes, all loops, the output.

    Steady and transient flows have loops of their own, and so has each integrator.
    """
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid

    from foamprb.cloud.block import Medium
    from foamprb.cloud.cloud import Cloud
    from foamprb.cloud.patches import Stick
    from foamprb.flow.mesh.mesh import build_mesh
    from foamprb.flow.meshflow import MeshFlow
    from foamprb.flow.reconstruct import Reconstruction
    from foamprb.flow.series import SeriesFlow

    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cube, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetData(numpy_to_vtk(np.array(corners, dtype=float), deep=True))
    cube.SetPoints(points)
    cube.InsertNextCell(VTK_HEXAHEDRON, 8, range(8))
    mesh = build_mesh(cube)
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
    # It lives for some seconds: to look for garbage, also at the end, would only keep the other waiting.
    gc.disable()
    tracker, flow = pickle.load(sys.stdin.buffer)
    tracker.compile_moves(flow.nothing())
    tracker.compile(flow.nothing())
    os._exit(0)


if __name__ == "__main__":
    main()
