"""The cloud functions by name, and the functions of a run with their data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from foamprb.cloudfunctions.base import CloudFunction, Memory, ObservedCloud
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.field_sampling import FieldSampling
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.errors import InputError
from foamprb.results.tables import Column

__all__ = ["FUNCTIONS", "CloudFunctions"]

FUNCTIONS: dict[str, type[CloudFunction]] = {
    "deformabilityCytometry": DeformabilityCytometry,
    "fieldSampling": FieldSampling,
    "haemolysis": Haemolysis,
    "particleCollector": ParticleCollector,
    "particleHistogram": ParticleHistogram,
    "particleStatistics": ParticleStatistics,
    "particleTracks": ParticleTracks,
    "patchPostProcessing": PatchPostProcessing,
    "suspensionStress": SuspensionStress,
}
"""By the word that ``type`` selects."""


class CloudFunctions:
    """The cloud functions of a run with their data.

    Parameters
    ----------
    functions
        By their names.
    cloud
        The cloud at the start.

    Raises
    ------
    InputError
        If the cloud lacks a name in the entries of a function.
    """

    def __init__(self, functions: Mapping[str, CloudFunction], cloud: ObservedCloud) -> None:
        self.functions = dict(functions)
        self._cloud = cloud
        self._memory: dict[str, Memory] = {}
        for name, function in self.functions.items():
            try:
                self._memory[name] = function.begin(cloud)
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error

    def next_sample(self, last: int) -> int:
        """Return the step of the next sample, at most ``last``."""
        step = self._cloud.cloud.step
        return min([last, *((step // n + 1) * n for f in self.functions.values() if (n := f.interval) > 0)])

    def sample(self) -> None:
        """Let the functions that are due at the present step record a sample."""
        self._record_rebounds()
        step = self._cloud.cloud.step
        for name, function in self.functions.items():
            if function.interval and step % function.interval == 0:
                function.sample(self._memory[name], self._cloud)

    def write(self, folder: Path) -> None:
        """Let every function record a sample and write into a folder of its name."""
        self._record_rebounds()
        for name, function in self.functions.items():
            function.sample(self._memory[name], self._cloud)
            function.write(self._memory[name], self._cloud, folder / name)

    def fates(self) -> dict[str, Column]:
        """Return the columns that the functions add to ``fates``."""
        functions = self.functions.items()
        return {k: c for name, f in functions for k, c in f.fates(self._memory[name], self._cloud).items()}

    def state(self) -> Memory:
        """Return the data of all functions, by ``function/array``."""
        self._record_rebounds()
        return {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}

    def _record_rebounds(self) -> None:
        if self._cloud.cloud.models.rebounds and len(rows := self._cloud.cloud.take_rebounds()):
            for name, function in self.functions.items():
                function.record_rebounds(self._memory[name], self._cloud, rows)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Restore the data that :meth:`state` returned in an earlier run.

        Raises
        ------
        InputError
            If it belongs to other functions.
        """
        expected, found = sorted(self.state()), sorted(state)
        if expected != found:
            changed = ", ".join(sorted({key.split("/")[0] for key in {*expected} ^ {*found}}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            memory.update({key: state[f"{name}/{key}"].copy() for key in memory})
