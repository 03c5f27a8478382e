"""Who takes part in a run: this process alone, or several that :mod:`foamprb.parallel.ranks` brings together.

The run itself is in one process, and knows its team by two methods: one that shares out the particles, and
one that writes them.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Snapshot
from foamprb.cloud.measures import (
    MEASURES,
    Gradients,
    contexts,
    gradients,
    injected,
    measure,
    number_of_contexts,
)
from foamprb.cloud.state import Particles
from foamprb.errors import InputError
from foamprb.flow.base import Sampled
from foamprb.output.pvd import Series
from foamprb.output.vtk import Parts, PointCloud

log = logging.getLogger("foamprb")


@dataclass(frozen=True)
class View:
    """What it takes to report particles, besides their state and the flow."""

    names: Mapping[str, Sequence[str]]
    """For an array of codes, what the codes mean."""
    mu: float
    """Viscosity of the fluid, Pa s."""

    def parts(
        self,
        time: float,
        particles: Particles,
        flow: Sampled | Gradients,
        ids: NDArray[np.int64] | None = None,
    ) -> Parts:
        """The injected of some particles, with everything that is reported of them, as it is asked for.

        Parameters
        ----------
        time
            Time of the state, s.
        ids
            Their numbers in the whole cloud, if they are a part of it.
        """
        units = {name: m.unit for name, m in MEASURES.items()}

        def snapshots() -> Iterator[PointCloud]:
            for c in contexts(particles, flow, self.mu, time, ids):
                yield PointCloud(time, c.particles.x, measure(c), units, self.names)

        return Parts(time, number_of_contexts(len(injected(particles))), snapshots())


class Team(Protocol):
    """The processes of a run, as the one that leads it sees them."""

    @property
    def signals(self) -> Sequence[int]:
        """Signals, Ctrl-C for one, that the other processes have received."""

    def take(self, cloud: Cloud) -> None:
        """Share out the particles of a cloud that is ready to be advanced."""

    def begin_write(self, series: Series, cloud: Snapshot, view: View) -> Callable[[], object]:
        """Begin to write a cloud; what ends that, and lists the cloud, may be called in another thread.

        Both raise OSError if a file cannot be written.
        """


class Serial:
    """One process."""

    signals: Sequence[int] = ()

    def take(self, cloud: Cloud) -> None:
        """There is nobody to share with."""

    def begin_write(self, series: Series, cloud: Snapshot, view: View) -> Callable[[], object]:
        """Leave to the other thread all but looking at a flow that will have changed by then."""
        steady = cloud.flow.span == (-np.inf, np.inf)
        flow = cloud.flow if steady else gradients(cloud.particles, cloud.flow, cloud.time)
        return lambda: series.append(view.parts(cloud.time, cloud.particles, flow))


class OnDevice(Serial):
    """One process with a CUDA device, which carries the particles.

    Raises
    ------
    InputError
        If numba-cuda or a device that it can use is missing.
    """

    def __init__(self) -> None:
        if find_spec("numba_cuda") is None:
            raise InputError("-device cuda needs numba-cuda: pip install 'foamprb[cuda]'.")
        from foamprb.parallel.device import device_name

        self._name = device_name()

    def take(self, cloud: Cloud) -> None:
        """Hand all particles over to the device."""
        from foamprb.parallel.device import Device

        cloud.hand_over(Device(cloud))
        log.info("\nParticles on the CUDA device %s", self._name)
