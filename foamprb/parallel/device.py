"""A cloud on a CUDA device: one thread carries one particle, with the same text as on the processor.

The loops of :mod:`foamprb.cloud.integrators` are compiled for blocks of one
lane, and each thread calls them with a block of its own. The particles stay in the device's memory from one
time of output to the next. This module needs numba-cuda; ``NUMBA_ENABLE_CUDASIM=1`` makes numba simulate a
device.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
from numba import cuda
from numpy.typing import NDArray

from foamprb.cloud.block import COUNTS, LABELS, ROWS, Medium, Scratch
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.executor import Executor
from foamprb.cloud.integrators.paper import track_block as track
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.motion import ACTIVE, PatchTable, longest_now
from foamprb.cloud.state import CHANGING, Particles
from foamprb.cloud.tracker import Outcome, Tracker, never
from foamprb.compile.link import is_compiled, link
from foamprb.errors import InputError

__all__ = ["Device", "device_name"]

log = logging.getLogger("foamprb")

_THREADS = 64
"""Threads of a block; few, as a particle takes all registers that a thread can have."""
_STEPS_PER_SORT = 100
_ZERO = np.zeros(2, dtype=np.int64)


def device_name() -> str:
    """Name of the device that a cloud uses.

    Raises
    ------
    InputError
        If there is none, or its driver cannot be used.
    """
    if not cuda.is_available():
        reason = str(cuda.cuda_error() or "").strip().partition("\n")[0].rstrip(":.")
        raise InputError(
            f"-device cuda: there is no CUDA device that can be used. {reason}".rstrip(". ") + "."
        )
    if cuda.config.ENABLE_CUDASIM:
        return "simulated by numba"
    name = cuda.get_current_device().name
    return name.decode() if isinstance(name, bytes) else str(name)


def track_each(
    flow: Any,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    rows: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    start: float,
    options: tuple[float, ...],
    bounds: LoopLimits,
    mended: NDArray[np.int64],
) -> None:
    """Carry the particles of some rows through ``steps`` steps.

    To ``mended`` are added the number of walks that were mended, and that of the particles that stay as they
    are since they may touch walls that are not listed.
    """
    i = cuda.grid(1)
    if i < rows.shape[0]:
        scratch = Scratch(
            cuda.local.array(ROWS, np.float64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array((9, 10), np.float64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            # Rebounds are not noted here.
            cuda.local.array((1, 1), np.float64),
            cuda.local.array(2, np.int64),
            bounds,
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.int64),
            # The one particle of a thread is never put aside, and no other takes its place.
            cuda.local.array(1, np.int64),
            cuda.local.array(1, np.float64),
            cuda.local.array((1, 1), np.float64),
            cuda.local.array((1, LABELS), np.int64),
            cuda.local.array(COUNTS, np.int64),
            cuda.local.array(1, np.float64),
            cuda.local.array(1, np.int64),
        )
        scratch.kept[0], scratch.fresh[0] = 0, 0.0
        scratch.noted[0] = scratch.noted[1] = 0
        scratch.stop[0] = scratch.outgrown[0] = 0
        # Not a slice of rows: that this has one element the compiler must see.
        members = cuda.local.array(1, np.int64)
        members[0] = rows[i]
        n = track(flow, patches, medium, p, members, step, steps, dt, start, scratch, *options)
        if n > 0:
            cuda.atomic.add(mended, 0, n)
        if scratch.outgrown[0] > 0:
            cuda.atomic.add(mended, 1, 1)


def find_longest(p: Particles, longest: NDArray[np.float64]) -> None:
    """Put the longest semi-axis of those particles that have not ended into ``longest``, m."""
    k = cuda.grid(1)
    if k < p.status.shape[0]:
        length = longest_now(p, k)
        # Most threads need not queue for the one place.
        if length > longest[0]:
            cuda.atomic.max(longest, 0, length)


class Device(Executor):
    """A CUDA device, which has the particles in its own memory.

    Of the cloud's arrays ``status`` is up to date after every :meth:`advance`, the others after
    :meth:`gather`. The device does not see what is changed in them after the first step, but a cloud may be
    given other particles.

    Work is queued on one stream, copies to the host on another, so that a copy does not wait for steps that
    were begun after it.

    Raises
    ------
    InputError
        If there is no device.
    """

    at_once = 10_000_000_000
    heeds_stop = False

    def __init__(self) -> None:
        self._name = device_name()

    def take(self, cloud: Cloud) -> None:
        """Compile for the models of a cloud; its particles are copied when they are first needed."""
        if cloud.models.rebounds:
            raise InputError(
                "-device cuda: patchPostProcessing of patches that particles bounce off needs threads "
                "of the processor; leave -device out, or those patches"
            )
        super().take(cloud)
        self._track, self._find_longest = kernels(cloud.tracker)
        self._work, self._back = cuda.stream(), cuda.stream()
        self._copies: list[tuple[NDArray[Any], Any]] = []
        self._table = self._copy(cloud.tracker.table)
        self._mended = cuda.to_device(_ZERO)
        self._held: Particles | None = None
        self._in_use: Any = None
        self._rows = np.empty(0, dtype=np.int64)
        self._steps_since_sort = 0
        self._longest = 0.0
        # Number of steps that were begun and not waited for.
        self._begun = 0
        # Whether the cloud's arrays are up to date, and whether copies of the device's arrays are under way.
        self._gathered, self._coming = True, False
        log.info("\nParticles on the CUDA device %s", self._name)

    @property
    def compiled(self) -> bool:
        """Whether the kernel is compiled."""
        return bool(cuda.config.ENABLE_CUDASIM) or is_compiled(self._track)

    def begin(self, steps: int) -> None:
        """Begin with steps; what :meth:`gather` brings is the state before them."""
        self._hold()
        self._keep()
        # What is wrong with the flow is said when the steps are due.
        with suppress(InputError):
            self._launch(*self._cloud.load_flow(steps))

    def advance(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:  # noqa: ARG002
        """Take steps, those that were begun if they are as many, and wait for them."""
        self._hold()
        if self._coming:
            self._back.synchronize()
            self._coming = False
        if self._begun != steps:
            self._go_back()
            # The steps are undone if a body outgrows the lists of walls.
            self._keep_here()
            self._launch(flow, steps)
        assert self._held is not None
        status = self._state.status.copy_to_host(self._buffers["status"], stream=self._work)
        mended = self._mended.copy_to_host(stream=self._work)
        self._work.synchronize()
        self._mended.copy_to_device(_ZERO)
        if mended[1]:
            # All come to the end together.
            self._begun = steps
            self._go_back()
            return Outcome(0, finished=False, outgrown=True)
        self._held.status[:] = status
        self._begun, self._gathered = 0, False
        return Outcome(int(mended[0]))

    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
        self._hold()
        if not self._begun:
            longest = cuda.to_device(np.zeros(1), stream=self._work)
            blocks = _blocks(self._cloud.particles.size)
            if blocks:
                self._find_longest[blocks, _THREADS, self._work](self._state, longest)
            found = longest.copy_to_host(stream=self._work)
            self._work.synchronize()
            self._longest = float(found[0])
        return self._longest

    def gather(self) -> None:
        """Put the state of every particle into the cloud's arrays, without the steps that were begun."""
        self._hold()
        if self._gathered:
            return
        if not self._coming:
            self._keep()
        self._back.synchronize()
        for name in CHANGING:
            getattr(self._held, name)[:] = self._buffers[name]
        self._gathered, self._coming = True, False

    def _hold(self) -> None:
        """Take over the cloud's particles, if they are not those that are held already."""
        p = self._cloud.particles
        if self._held is p:
            return
        size = sum(array.nbytes for array in p) + sum(getattr(p, name).nbytes for name in CHANGING)
        free = cuda.current_context().get_memory_info()[0]
        if size > free:
            raise InputError(
                f"-device cuda: {p.size} particles need {size / 1e9:.1f} GB of its memory, of which "
                f"{free / 1e9:.1f} GB are free."
            )
        self._work.synchronize()
        self._state: Any = Particles(*(cuda.to_device(np.ascontiguousarray(array)) for array in p))
        changing = {name: getattr(p, name) for name in CHANGING}
        self._kept = {name: cuda.device_array(array.shape, array.dtype) for name, array in changing.items()}
        self._buffers = {name: _pinned(array) for name, array in changing.items()}
        self._mended.copy_to_device(_ZERO)
        self._held, self._begun, self._gathered, self._coming = p, 0, True, False
        self._steps_since_sort = _STEPS_PER_SORT

    def _keep(self) -> None:
        """Keep a copy of the particles as they are, and begin to copy it to the host if it has not got it."""
        if self._begun:
            return
        self._keep_here()
        if not self._gathered:
            done = cuda.event()
            done.record(self._work)
            done.wait(self._back)
            for name, kept in self._kept.items():
                kept.copy_to_host(self._buffers[name], stream=self._back)
            self._coming = True

    def _keep_here(self) -> None:
        """Keep a copy of the particles on the device."""
        for name, kept in self._kept.items():
            kept.copy_to_device(getattr(self._state, name), stream=self._work)

    def _go_back(self) -> None:
        """Undo steps that were begun and are not to be taken."""
        if self._begun:
            for name, kept in self._kept.items():
                getattr(self._state, name).copy_to_device(kept, stream=self._work)
            self._work.synchronize()
            self._mended.copy_to_device(_ZERO)
            self._begun = 0

    def _launch(self, flow: Any, steps: int) -> None:
        """Begin to carry the particles through steps."""
        self._arrange(steps)
        tracker = self._cloud.tracker
        arrays, medium = self._copy((flow, tracker.medium))
        rows = cuda.to_device(self._rows, stream=self._work)
        if len(self._rows):
            self._track[_blocks(len(self._rows)), _THREADS, self._work](
                arrays, self._table, medium, self._state, rows,
                self._cloud.step, steps, tracker.dt, tracker.start, tracker.options, self._cloud.bounds,
                self._mended,
            )  # fmt: skip
        self._in_use = arrays, medium, rows
        self._begun = steps

    def _arrange(self, steps: int) -> None:
        """List the particles that move, now and then sorted, so that neighbours read the same cells."""
        status = self._cloud.particles.status
        if self._steps_since_sort >= _STEPS_PER_SORT:
            rows = np.flatnonzero(status <= ACTIVE)
            host = self._state.host.copy_to_host(stream=self._work)
            self._work.synchronize()
            self._rows = rows[np.lexsort((host[rows], status[rows]))]
            self._steps_since_sort = 0
        else:
            self._rows = self._rows[status[self._rows] <= ACTIVE]
        self._steps_since_sort += steps

    def _copy(self, value: Any) -> Any:
        """Return a tuple with its arrays on the device; those that the last call copied are there already."""
        known = self._copies
        self._copies = []
        return self._copy_with(value, known)

    def _copy_with(self, value: Any, known: list[tuple[NDArray[Any], Any]]) -> Any:
        if isinstance(value, np.ndarray):
            found = [there for array, there in known if array is value]
            there = found[0] if found else cuda.to_device(np.ascontiguousarray(value), stream=self._work)
            self._copies.append((value, there))
            return there
        if isinstance(value, tuple):
            items = [self._copy_with(item, known) for item in value]
            return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
        return value


def kernels(tracker: Tracker) -> tuple[Any, Any]:
    """Compile :func:`track_each` for the loop of a tracker, and :func:`find_longest`."""
    integrator = tracker.integrator
    own = {"track": integrator.track, "ROWS": tracker.layout.rows, "LANES": 1}
    bindings = tracker.bindings | own
    return link(track_each, bindings, tracker.separate, target="cuda"), link(find_longest, target="cuda")


def _blocks(n: int) -> int:
    """Number of blocks of threads for n particles."""
    return -(-n // _THREADS)


def _pinned(array: NDArray[Any]) -> NDArray[Any]:
    """Memory of the host for a copy of an array, to which the device can write while others work."""
    if array.size == 0 or cuda.config.ENABLE_CUDASIM:
        return np.empty_like(array)
    pinned: NDArray[Any] = cuda.pinned_array(array.shape, array.dtype)
    return pinned
