"""Errors of fates: the particles that end elsewhere with finer steps or with other gradients of the flow."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.integrators.paper import PAPER
from foamprb.cloud.state import Status
from foamprb.flow.meshflow import MeshFlow
from foamprb.results.intervals import share
from foamprb.run.job import Job, assemble
from foamprb.run.loop import follow

__all__ = ["Change", "estimate_errors", "log_errors"]

log = logging.getLogger("foamprb")

_MOST_LISTED = 20


class Change(NamedTuple):
    """Fates of the same particles in a run and in another with one change."""

    what: str
    """The change."""
    before: NDArray[np.str_]
    """Fates in the run, ``"stuck: wall"``, (n,)."""
    after: NDArray[np.str_]
    """The same in the other run."""

    @property
    def changed(self) -> NDArray[np.int64]:
        """Numbers of the particles that end elsewhere."""
        return np.flatnonzero(self.before != self.after)


def estimate_errors(job: Job) -> Iterator[Change]:
    """Repeat a run that has ended, in memory: with half the error of a step, and with other gradients.

    Parameters
    ----------
    job
        The run; its flow is used again, and its results stay as they are.

    Yields
    ------
    The changes of the fates by half of ``tolerance`` (with ``paper``, of ``deltaT``); then, in a steady flow
    on a mesh, by a ∇u larger and smaller by its relative jump between cells.
    """
    solution, flow = job.settings.solution, job.cloud.flow
    before = _fates(job)
    if job.cloud.models.integrator == PAPER.name:
        what, finer = "half of deltaT", replace(solution, deltaT=0.5 * solution.deltaT)
    else:
        schemes = solution.integrationSchemes
        tolerance, share_of_mesh = 0.5 * schemes.tolerance, 0.5 * schemes.roughnessShare
        schemes = replace(schemes, tolerance=tolerance, roughnessShare=share_of_mesh)
        what, finer = "half of tolerance", replace(solution, integrationSchemes=schemes)
    runs = [(what, replace(job.settings, solution=finer), flow)]
    if type(flow) is MeshFlow:
        runs += [
            (f"grad U {word} by its jumps between cells, same U", job.settings, flow.with_jumps(sign))
            for word, sign in (("larger", 1.0), ("smaller", -1.0))
        ]
    for what, settings, around in runs:
        other = assemble(settings, flow, job.cloud.threads)
        # Stiffness by the shear rate at the release stays as it is.
        cloud = replace(other.cloud, flow=around)
        follow(cloud, other)
        yield Change(what, before, _fates(replace(other, cloud=cloud)))


def _fates(job: Job) -> NDArray[np.str_]:
    """Return where each particle ended, in the order of their numbers."""
    p = job.cloud.particles
    patches = np.array([*(f": {name}" for name in job.patch_names), ""])
    # Only these have ended on a patch.
    at_patch = np.isin(p.status, (Status.STUCK, Status.ESCAPED))
    words = np.array([status.name.lower() for status in Status])[p.status]
    return np.char.add(words, np.where(at_patch, patches[p.patch], ""))


def log_errors(changes: Iterator[Change]) -> None:
    """Log the changes of the fates: how many, from where to where, and of which particles."""
    log.info("\nErrors of the fates")
    for change in changes:
        rows, n = change.changed, len(change.before)
        log.info(
            "    %s: %d of %d particles end elsewhere, %s",
            change.what,
            len(rows),
            n,
            share(len(rows), n).percent(),
        )
        kinds = Counter(zip(change.before[rows].tolist(), change.after[rows].tolist(), strict=True))
        for (before, after), count in kinds.most_common():
            log.info("        %-40s %10d", f"{before} -> {after}", count)
        if len(rows):
            more = f" and {len(rows) - _MOST_LISTED} more" if len(rows) > _MOST_LISTED else ""
            log.info("        particles %s%s", ", ".join(map(str, rows[:_MOST_LISTED])), more)
