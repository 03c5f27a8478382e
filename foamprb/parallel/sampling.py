"""Cloud functions whose data go with the particles, so that each process samples its own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from numpy.typing import NDArray

from foamprb.cloud.block import Medium
from foamprb.cloud.patches import Interaction
from foamprb.cloud.state import Particles
from foamprb.cloud.tracker import Tracker
from foamprb.cloudfunctions.base import (
    CloudFunction,
    CloudShare,
    Memory,
    ObservedCloud,
    events_of,
    memory_of,
)
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.flow.loaded import LoadedFlow

Observe: TypeAlias = Callable[[Any, Memory, ObservedCloud], None]
"""Lets a function observe particles: its data of them changes."""


@dataclass(frozen=True)
class Sampling:
    """Functions that sample the particles of each process."""

    functions: Mapping[str, CloudFunction]
    events: Memory
    """Empty tables of events by the names of their functions."""
    interactions: tuple[Interaction, ...]
    medium: Medium
    cloud_names: Mapping[str, Sequence[str]]

    @classmethod
    def of(cls, functions: CloudFunctions, medium: Medium) -> Sampling:
        """Return those of the functions of a cloud that can sample so."""
        cloud = functions.cloud
        names = functions.travelling
        return cls(
            {name: functions.functions[name] for name in names},
            functions.new_events(names),
            tuple(cloud.cloud.interactions),
            medium,
            cloud.names,
        )

    def names_of(self, kind: type) -> list[str]:
        """Return the names of the functions of a class."""
        return [name for name, function in self.functions.items() if isinstance(function, kind)]

    def cloud(self, p: Particles, flow: LoadedFlow, tracker: Tracker, time: float) -> ObservedCloud:
        """Return the cloud with some of its particles as functions observe it; see :meth:`observe`."""
        share: Any = CloudShare(self.interactions, flow, self.medium, tracker, time)
        return ObservedCloud(share, self.cloud_names, _seen=p)

    def observe(
        self,
        names: Iterable[str],
        memory: Mapping[str, NDArray[Any]],
        p: Particles,
        flow: LoadedFlow,
        tracker: Tracker,
        time: float,
        events: Memory,
        observe: Observe,
    ) -> Memory:
        """Let some functions observe particles; return the events so far by their names.

        Parameters
        ----------
        names
            The functions.
        memory
            What the functions remember of the particles, by ``function/array``; changed in place.
        p, flow, tracker, time
            The particles, the flow around them, the tracker of the cloud, and the time, s.
        events
            Events so far.
        observe
            Lets a function observe the particles.
        """
        cloud, found = self.cloud(p, flow, tracker, time), {}
        for name in names:
            function, known = self.functions[name], memory_of(memory, name)
            table = events_of(function)
            if table:
                known[table] = events.get(name, self.events[name])
            observe(function, known, cloud)
            if table:
                found[name] = known[table]
        return found
