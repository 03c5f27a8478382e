"""Files of a run: snapshots, tables, checkpoints, and the manifest that lists them."""

from __future__ import annotations

import errno
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Snapshot, explain, is_shaped, regrouped
from foamprb.cloud.limits import Limits
from foamprb.cloud.measures import (
    MEASURES,
    PER_CONTEXT,
    WRITTEN,
    FlowSamples,
    as_slice,
    flow_samples,
    injected,
    number_of_contexts,
    released,
    shapes,
)
from foamprb.cloud.report import Contents, report
from foamprb.cloud.state import REASONS, Particles, Reason, Status
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import STATUS_NAMES
from foamprb.errors import InputError, RunStopped
from foamprb.flow.base import Sampled
from foamprb.flow.fields import columns_of
from foamprb.flow.timeline import Timeline
from foamprb.memory import OutOfMemory, ran_out
from foamprb.results.atomic import before_each_file, only_writer, remove_unfinished
from foamprb.results.background import Writer
from foamprb.results.checkpoint import PARTICLES, Checkpoints, StoredCheckpoint, part_file, parts_of
from foamprb.results.folder import FAILURES, FATES, TOUCHED, TRACERS
from foamprb.results.manifest import Manifest
from foamprb.results.pvd import Series, files_of, read_pvd, with_ending
from foamprb.results.tables import LONG, RECORDS, Column, Rows, rows_of, write_rows
from foamprb.results.vtk import Parts
from foamprb.run.description import write_record
from foamprb.run.job import Job
from foamprb.run.points import rows_of_points
from foamprb.run.restart import (
    Sums,
    checkpoint_of,
    fingerprint,
    refuse_changes,
    refuse_other_times,
    require_choice,
    require_header,
    restore,
    snapshots_until,
    sums_around,
    with_other_end,
)  # fmt: skip
from foamprb.run.validity import mode_of, path_values
from foamprb.settings.solution import StartFrom

log = logging.getLogger("foamprb")

HOW_TO_GO_ON = "To continue from the last checkpoint, add -resume."
_ROUND_OFF = 1e-6
"""Tolerance of times over the step."""
_ELSEWHERE = "The option -output DIR writes the results into another folder."


@contextmanager
def open_results(job: Job) -> Iterator[Results]:
    """Lock the folder of a run against other runs; on leaving, wait for unfinished writes.

    Raises
    ------
    InputError
        If another run writes there.
    RunStopped
        If results cannot be written, in place of the OSError; if memory runs out.
    """
    try:
        with only_writer(job.folder.path), Writer() as writer:
            yield Results(job, writer)
    except BrokenPipeError:
        # The reader of the log has gone.
        raise
    except Exception as error:
        reason = ran_out(error) or error
        if not isinstance(reason, OSError | OutOfMemory):
            raise
        how = f" {HOW_TO_GO_ON}" if any(job.folder.checkpoints.glob("*")) else ""
        if isinstance(reason, OSError) and reason.errno in (errno.EACCES, errno.EROFS):
            how += f" {_ELSEWHERE}"
        raise RunStopped(f"{str(reason).rstrip('.')}.{how}") from error


class Results:
    """Writer of a run's files; call :meth:`begin` before the other methods.

    The manifest lists a file before it is written. Methods that write raise OSError if a file cannot be
    written, now or at the time before.

    Parameters
    ----------
    job
        The run.
    writer
        The thread that writes while the particles advance.
    """

    def __init__(self, job: Job, writer: Writer) -> None:
        self._job, self._writer = job, writer
        self._contents = _contents_of(job)
        self._series = Series(job.folder)
        self.finished = False
        """Whether the run had ended before."""
        self._manifest = Manifest(job.folder.path)
        names = (FATES, FAILURES, TRACERS)
        self._fates, self._failures, self._tracers = (job.folder.table(name) for name in names)
        self._records = self._fates.with_suffix(RECORDS)
        self._last = self._fates, self._records, self._failures
        """Files of the end of a run."""
        self._snapshot: Snapshot | None = None
        self._around: Sequence[Sums] = ()

    def begin(self, start_from: StartFrom | None) -> None:
        """Set the cloud to its start or to a checkpoint, and remove an earlier run's files of later times.

        See :func:`foamprb.run.loop.execute` for its errors.

        Parameters
        ----------
        start_from
            See :func:`foamprb.run.loop.execute`.
        """
        job = self._job
        self._fingerprint = fingerprint(job.settings, job.cloud)
        self._checkpoints = Checkpoints(job.folder.checkpoints)
        require_choice(job.folder, start_from)
        checkpoint = self._checkpoints.latest(self._continues) if start_from == "latestTime" else None
        if checkpoint is not None:
            self.finished = self._is_finished(checkpoint)
            self._resume(checkpoint)
            return
        if start_from == "latestTime":
            log.info("No checkpoint in %s: beginning at the start time", self._checkpoints.folder)
        self._start_over(overwrite=start_from == "startTime")

    def write_start(self) -> None:
        """Write the snapshot of the start time, with the particles released then; no-op after a restart."""
        cloud = self._job.cloud
        if cloud.step > 0 or self._series.entries:
            return
        # The flow of the first step.
        cloud.load_flow(1)
        file = with_ending(self._series.next(cloud.time), ".vtp")
        self._manifest.expect([self._job.folder.pvd, file])
        due = (
            released(p, cloud.flow, cloud.time)
            for p in regrouped(cloud.map_by_id(_due_at, cloud.time), PER_CONTEXT)
        )
        n = sum(cloud.map_ranks(_number_due, cloud.time))
        clouds = (part for p in due for part in self._report(p, cloud.flow, cloud.time, p.number).snapshots)
        self._series.append(Parts(cloud.time, number_of_contexts(n), clouds))

    def check(self) -> None:
        """Raise OSError if the thread could not write a file."""
        self._writer.check()

    def store_between(self, first: int, last: int) -> None:
        """Let the steps from ``first`` to ``last`` store the state at the write times between these."""
        cloud = self._job.cloud
        times = [cloud.time_of(step) for step in self._job.writes(first, last - 1)]
        cloud.store_at(times, self._contents.of_rates)

    def write(self, steps: Sequence[int]) -> None:
        """Write snapshots of the ends of some steps, tables of the cloud functions, and a checkpoint.

        Snapshots and checkpoint are written from a copy while the cloud advances. Tables and checkpoint are
        those of the present time.
        """
        cloud = self._ready()
        self._snapshot = snapshot = cloud.snapshot(self._snapshot)
        with before_each_file(self._manifest.expect_table):
            self._job.functions.write(self._job.folder.path)
        memory = {name: array.copy() for name, array in self._job.functions.state().items()}
        times = [cloud.time_of(step) for step in steps]
        stems = {time: self._series.next(time, ahead) for ahead, time in enumerate(times)}
        pieces = {time: cloud.comm.piece_files(stem) for time, stem in stems.items()}
        files = [file for time, stem in stems.items() for file in pieces[time] or [with_ending(stem, ".vtp")]]
        expected = [self._job.folder.pvd, *files, *self._checkpoint_files(now=True)]
        self._manifest.expect(expected)
        begun = [
            self._begin_pieces(stem, time) if pieces[time] else self._begin_cloud(snapshot, time)
            for time, stem in stems.items()
        ]
        cloud.store_at(())
        parts = self._write_parts()
        self._writer.submit(partial(self._end_write, begun, snapshot, memory, parts))

    def save(self) -> None:
        """Write only a checkpoint, for a run that is stopped between two write times."""
        cloud = self._ready()
        self._manifest.settle(self._checkpoint_files(now=True))
        # Particles that are ahead of the others have passed write times.
        memory = {**self._job.functions.state(), **cloud.stored}
        self._write_checkpoint(cloud, memory, self._write_parts(), cloud.comm.rank.moments.times)

    def end(self, warnings: Sequence[str] = (), points: Cloud | None = None) -> None:
        """Write ``fates``, ``failed`` if a particle failed, ``tracers``, and warnings into the record.

        ``fates`` has a row per injected particle, and marks a finished run: it takes its name after the last
        snapshot and checkpoint.
        """
        cloud = self._job.cloud
        counts = cloud.counts()
        failed, injected = counts[Status.FAILED] > 0, sum(counts.values()) - counts[Status.PENDING]
        long = injected if injected > LONG else 0

        def finish() -> None:
            self._writer.finish()
            if warnings:
                description = self._job.description
                all_warnings = [*description["warnings"], *warnings]
                write_record(self._job.folder.record, {**description, "warnings": all_warnings})
            tables = {self._fates: True, self._records: long, self._failures: failed}
            tables |= {self._tracers: points is not None}
            self._manifest.settle([table for table, written in tables.items() if written])
            if points is not None:
                write_rows(self._tracers, points.map_by_id(rows_of_points, self._job.patch_names))
            if failed:
                write_rows(self._failures, cloud.map_by_id(_failures_of, cloud.models, cloud.limits))

        rho, quadratic = self._job.settings.fluid.rho, mode_of(cloud.models)
        given = self._job.patch_names, rho, quadratic, long > 0
        write_rows(self._fates, self._job.functions.with_fates(_fates_of, *given), finish, long)

    def _ready(self) -> Cloud:
        """Return the cloud, after earlier writes have ended."""
        self._writer.finish()
        cloud = self._job.cloud
        self._around = sums_around(cloud.flow, cloud.time)
        return cloud

    def _begin_cloud(self, snapshot: Snapshot, time: float) -> Callable[[], object]:
        """Return a function that writes and lists a snapshot of a time, s, while the cloud advances."""
        cloud, flow = self._job.cloud, snapshot.flow
        in_flow = self._contents.of_flow or len(columns_of(flow)) > 0
        if in_flow:
            cloud.publish(time)
        p = cloud.comm.rank.at_instant(time, in_flow, snapshot.particles)
        # A transient flow may have gone on to other times by then.
        mu, steady = cloud.medium.mu, flow.span == (-np.inf, np.inf)
        seen = flow if steady else flow_samples(p, flow, time, mu, self._contents.arrays)
        points = self._report(p, seen, time)
        return lambda: self._series.append(points)

    def _report(
        self,
        particles: Particles,
        flow: Sampled | FlowSamples,
        time: float,
        ids: NDArray[np.int64] | None = None,
    ) -> Parts:
        """Return a cloud with the arrays of the run, see :func:`foamprb.cloud.report.report`."""
        return report(particles, flow, self._job.cloud.medium.mu, time, self._contents, ids)

    def _begin_pieces(self, stem: Path, time: float) -> Callable[[], object]:
        """Let all ranks write their pieces of a time, s; return a function that lists them."""
        cloud = self._job.cloud
        cloud.publish(time)
        list_pieces = cloud.comm.write_pieces(stem, time, self._contents)
        return lambda: self._series.add(time, list_pieces())

    def _end_write(
        self,
        snapshots: Sequence[Callable[[], object]],
        snapshot: Snapshot,
        memory: Mapping[str, NDArray[Any]],
        parts: Sequence[tuple[int, str]],
    ) -> None:
        for write_snapshot in snapshots:
            write_snapshot()
        self._write_checkpoint(snapshot, memory, parts)

    def _write_parts(self) -> list[tuple[int, str]]:
        """Let several ranks write their parts of the checkpoint; return these."""
        cloud = self._job.cloud
        return cloud.comm.write_parts(self._checkpoints.file(cloud.time), cloud.time)

    def _write_checkpoint(
        self,
        cloud: Cloud | Snapshot,
        memory: Mapping[str, NDArray[Any]],
        parts: Sequence[tuple[int, str]],
        stored: Sequence[float] = (),
    ) -> None:
        entries = self._series.entries
        entries_of_run = self._fingerprint, parts, self._around, stored, self._ends_within_a_stretch(cloud)
        self._checkpoints.write(checkpoint_of(cloud, memory, entries, *entries_of_run))

    def _checkpoint_files(self, *, now: bool = False) -> list[Path]:
        """Return the checkpoint files on disk, with ``now`` also the files of the present time."""
        files = [f for file in self._checkpoints.files().values() for f in (file, *parts_of(file))]
        if now:
            file, cloud = self._checkpoints.file(self._job.cloud.time), self._job.cloud
            files += [file, *(part_file(file, first) for first in cloud.comm.parts)]
        return files

    def _start_over(self, overwrite: bool) -> None:
        """Remove the files that an earlier run has listed, and write the description of this one.

        On request, remove also files with names of a run that no list has.
        """
        folder = self._job.folder.path
        remedy = f"The files of the earlier run are unknown: remove or rename {folder} to start over."
        try:
            manifest = Manifest.read(folder)
        except InputError as error:
            raise InputError(f"{error} {remedy}") from error
        leftovers = self._job.folder.leftovers(manifest.files) if overwrite and manifest.files else []
        unlisted = [file for file in self._checkpoints.files().values() if file not in manifest.files]
        if unlisted and not leftovers:
            raise InputError(f"{manifest.path} does not list {unlisted[0].relative_to(folder)}. {remedy}")
        if self._job.folder.pvd.exists():
            try:
                read_pvd(self._job.folder.pvd)
            except InputError as error:
                log.warning("%s It is replaced.", error)
        remove_unfinished({*manifest.files, manifest.path, *self._last})
        # Checkpoints first: after an interrupted removal they would resemble an unfinished run.
        files = sorted(manifest.files)
        checkpoints = [file for file in files if file.parent == self._checkpoints.folder]
        lists = [file for file in (self._job.folder.pvd, *self._last) if file in manifest.files]
        manifest.remove([*checkpoints, *leftovers, *lists, *files, manifest.path])
        self._manifest.expect([self._job.folder.record])
        write_record(self._job.folder.record, self._job.description)

    def _is_at_step(self, checkpoint: StoredCheckpoint) -> bool:
        """Return whether a step of this run ends at a checkpoint; the last step of an earlier run may."""
        require_header(checkpoint)
        cloud = self._job.cloud
        return abs(cloud.time_of(checkpoint.header["step"]) - checkpoint.time) <= _ROUND_OFF * cloud.dt

    def _continues(self, checkpoint: StoredCheckpoint) -> bool:
        """Return whether a checkpoint is not of the end of a shorter run, whose last steps may be shorter."""
        if not self._is_at_step(checkpoint):
            return False
        return checkpoint.header["step"] >= self._job.steps or not checkpoint.header["ended"]

    def _ends_within_a_stretch(self, cloud: Cloud | Snapshot) -> bool:
        """Return whether the run ends where the steps of a longer one need not."""
        flow: Any = cloud.flow
        at_time = isinstance(flow, Timeline) and any(
            abs(time - cloud.time) <= _ROUND_OFF * self._job.cloud.dt for time in flow.times_until(cloud.time)
        )
        return cloud.step >= self._job.steps and cloud.step % cloud.stretch_steps != 0 and not at_time

    def _is_finished(self, checkpoint: StoredCheckpoint) -> bool:
        """Return whether the run has ended at a checkpoint, and has written its tables."""
        status = checkpoint.read(f"{PARTICLES}status")
        cloud = self._job.cloud
        moving = np.isin(status, cloud.tracker.movable).any() or cloud.size + cloud.late > len(status)
        ended = checkpoint.header["step"] >= self._job.steps or not moving
        return ended and self._fates.exists()

    def _resume(self, checkpoint: StoredCheckpoint) -> None:
        """Restore a checkpoint, and remove the files of later times."""
        job = self._job
        # Before the particles are restored from the checkpoint.
        description = job.description
        where = f"{job.folder.path}: cannot continue from t = {checkpoint.time:.12g} s"
        marks = with_other_end(self._fingerprint, job.settings, job.cloud, checkpoint)
        refuse_changes(checkpoint, marks, where)
        end = job.settings.solution.endTime
        if checkpoint.time > end + _ROUND_OFF * job.cloud.dt:
            raise InputError(
                f"{where}: endTime is {end:g}. Allowed: {checkpoint.time:.12g} or more; or start over: "
                "-overwrite, or startFrom startTime."
            )
        if not self._is_at_step(checkpoint):
            raise InputError(
                f"{where}: the run before has ended there, and no step of deltaT = {job.cloud.dt:g} s does. "
                "Restore its endTime, or start over: -overwrite, or startFrom startTime."
            )
        refuse_other_times(checkpoint, job.cloud.flow, where)
        entries = snapshots_until(checkpoint, self._job.folder.pvd, where)
        restore(job.cloud, job.functions, checkpoint, self._contents.of_rates, where)
        if self.finished:
            log.info("The run has ended at t = %.12g s: there is nothing to continue.", job.cloud.time)
            return
        log.info(
            "Continuing from the checkpoint at t = %.12g s in %s", job.cloud.time, self._checkpoints.folder
        )
        try:
            manifest = Manifest.read(job.folder.path)
        except InputError as error:
            log.warning("%s It is rebuilt; files of later times may remain.", error)
            manifest = Manifest(job.folder.path)
        remove_unfinished({*manifest.files, manifest.path, *self._last})
        manifest.remove(f for f in self._last if f in manifest.files)
        self._series.relist(entries)
        write_record(job.folder.record, description)
        snapshots = [file for entry in entries for file in files_of(job.folder.path / entry.file)]
        functions = [job.folder.path / name for name in job.functions.functions]
        tables = [file for file in manifest.files if any(folder in file.parents for folder in functions)]
        remaining = {
            self._job.folder.record,
            self._job.folder.pvd,
            *snapshots,
            *tables,
            *self._checkpoint_files(),
        }
        manifest.remove(sorted(manifest.files - remaining))
        self._manifest = Manifest(job.folder.path, (file for file in remaining if file.exists()))


_LARGEST_ERROR = 0.01
"""Largest error of a position in single precision over the smallest radius of a body."""


def _contents_of(job: Job) -> Contents:
    """Return the arrays of the files of a run."""
    solution, cloud = job.settings.solution, job.cloud
    of_models = [name for model in cloud.models.surroundings for name in model.measures]
    # Of spheres the reader derives it from glyph.
    of_shapes = ["deformationGradient"] if any(cloud.map_ranks(is_shaped)) else []
    names = {
        "status": STATUS_NAMES,
        "reason": tuple(REASONS[reason] for reason in Reason),
        "patch": job.patch_names,
        "injector": job.injector_names,
    }
    requested = {*WRITTEN, *solution.writeFields, *of_models, *of_shapes}
    single = solution.writePrecision == "single"
    farthest = max(float(np.abs(end).max()) for end in cloud.flow.bounds)
    error = 0.5 * np.finfo(np.float32).eps * farthest
    single_places = single and bool(error <= _LARGEST_ERROR * min(cloud.map_ranks(_smallest_radius)))
    return Contents(tuple(name for name in MEASURES if name in requested), names, single, single_places)


def _smallest_radius(p: Particles) -> float:
    return float(p.R.min(initial=np.inf))


def _number_due(p: Particles, time: float) -> int:
    """Return the number of particles that are in the flow at a time, s, or appear then."""
    return int(np.count_nonzero((p.status != Status.PENDING) | (p.t0 <= time)))


def _due_at(p: Particles, time: float) -> Particles:
    return p.take(np.flatnonzero((p.status != Status.PENDING) | (p.t0 <= time)))


def _fates_of(
    p: Particles,
    further: Mapping[str, Column],
    patch_names: Sequence[str],
    rho: float,
    quadratic: bool | None,
    with_records: bool,
) -> Rows:
    """Return rows of ``fates`` for the particles that were injected; ``further`` are columns of functions.

    For ``rho`` and ``quadratic`` see :func:`foamprb.run.validity.path_values`.
    """
    here = as_slice(injected(p))
    p, further = p.take(here), {name: np.asarray(column)[here] for name, column in further.items()}
    kind: Any = str if with_records else object
    fates = np.array(STATUS_NAMES, dtype=kind)
    # The last name belongs to the code −1.
    patches = np.array((*patch_names, ""), dtype=kind)
    axes, D = shapes(p)
    return rows_of(
        {
            "id": p.number, "d": 2.0 * p.R, "rho": p.rho, "Ca": p.Ca,
            "t0": p.t0, "x0": p.x0[:, 0], "y0": p.x0[:, 1], "z0": p.x0[:, 2],
            "t1": p.t, "x1": p.x[:, 0], "y1": p.x[:, 1], "z1": p.x[:, 2],
            "fate": fates[p.status], "patch": patches[p.patch], TOUCHED: p.touched.astype(np.int8),
            "a": axes[:, 0], "b": axes[:, 1], "c": axes[:, 2], "D": D,
            **path_values(p, rho, quadratic, D), **further,
        },
        with_records,
    )  # fmt: skip


def _failures_of(p: Particles, models: Models, limits: Limits) -> Rows:
    """Return the rows of ``failed``."""
    p = p.take(np.flatnonzero(p.status == Status.FAILED))
    columns: dict[str, Column] = {
        "id": p.number,
        "t": p.t,
        "x": p.x[:, 0],
        "y": p.x[:, 1],
        "z": p.x[:, 2],
        "reason": [explain(r, models, limits) for r in p.reason],
    }
    return rows_of(columns)
