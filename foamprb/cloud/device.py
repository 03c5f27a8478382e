"""A cloud on a CUDA device: one thread carries one particle, with the same text as on the processor.

The loops of :mod:`foamprb.cloud.advance` and :mod:`foamprb.cloud.adaptive` are compiled for blocks of one
lane, and each thread calls them with a block of its own. The particles stay in the device's memory from one
time of output to the next. This module needs numba-cuda; ``NUMBA_ENABLE_CUDASIM=1`` makes numba simulate a
device.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

import numpy as np
from numba import cuda
from numpy.typing import NDArray

from foamprb.body.tensor import principal_frame
from foamprb.cloud.advance import track_block as track
from foamprb.cloud.block import ROWS, Medium, Scratch
from foamprb.cloud.motion import ACTIVE, PatchTable
from foamprb.cloud.state import VARIABLES, Particles
from foamprb.compile import is_compiled, link
from foamprb.errors import InputError

__all__ = ["Device", "device_name"]

_THREADS = 64
"""Threads of a block; few, as a particle takes all registers that a thread can have."""
_STEPS_PER_SORT = 100
_CHANGING = tuple(name for name, variable in VARIABLES.items() if not variable.fixed)


def device_name() -> str:
    """Name of the device that a cloud uses.

    Raises
    ------
    InputError
        If there is none, or its driver cannot be used.
    """
    if not cuda.is_available():
        reason = str(cuda.cuda_error() or "none was found").strip().rstrip(":.")
        raise InputError(f"device cuda: there is no CUDA device that can be used ({reason})")
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
    mended: NDArray[np.int64],
) -> None:
    """Carry the particles of some rows through ``steps`` steps, and count the walks that were mended."""
    i = cuda.grid(1)
    if i < rows.shape[0]:
        scratch = Scratch(
            cuda.local.array(ROWS, np.float64),
            cuda.local.array(1, np.float64),
            cuda.local.array(1, np.int64),
            cuda.local.array((9, 10), np.float64),
        )
        # Not a slice of rows: that this has one element the compiler must see.
        members = cuda.local.array(1, np.int64)
        members[0] = rows[i]
        n = track(flow, patches, medium, p, members, step, steps, dt, start, scratch, *options)
        if n > 0:
            cuda.atomic.add(mended, 0, n)


def find_longest(p: Particles, longest: NDArray[np.float64]) -> None:
    """Put the longest semi-axis of those particles that have not ended into ``longest``, m."""
    k = cuda.grid(1)
    if k < p.status.shape[0] and p.status[k] <= ACTIVE:
        f = p.F
        F = (f[k, 0], f[k, 1], f[k, 2], f[k, 3], f[k, 4], f[k, 5], f[k, 6], f[k, 7], f[k, 8])
        _, stretches = principal_frame(F)
        length = p.R[k] * max(stretches[0], stretches[1], stretches[2])
        # Most threads need not queue for the one place.
        if length > longest[0]:
            cuda.atomic.max(longest, 0, length)


class Device:
    """Particles in the memory of a device, and what advances them there.

    Work is queued on one stream, copies to the host on another, so that a copy does not wait for the steps
    that were queued after it.

    Parameters
    ----------
    loop
        :func:`foamprb.cloud.advance.track_block` or its like.
    rows
        Rows of its block.
    bindings, separate
        As :func:`foamprb.compile.link` takes them.
    medium, patches
        As the loop takes them.
    options
        What the loop takes beyond the scratch memory.

    Raises
    ------
    InputError
        If there is no device.
    """

    def __init__(
        self,
        loop: Callable[..., int],
        rows: int,
        bindings: Mapping[str, Any],
        separate: Collection[Callable[..., Any]],
        medium: Medium,
        patches: PatchTable,
        options: tuple[float, ...],
    ) -> None:
        self.name = device_name()
        self._track, self._find_longest = kernels(loop, rows, bindings, separate)
        self._work, self._back = cuda.stream(), cuda.stream()
        self._copies: list[tuple[NDArray[Any], Any]] = []
        self._medium, self._options = medium, options
        self._patches = self._copy(patches)
        self._mended = cuda.to_device(np.zeros(1, dtype=np.int64))
        self._held: Particles | None = None
        self._rows = np.empty(0, dtype=np.int64)
        self._steps_since_sort = 0
        self._in_use: Any = None
        self._fresh = True
        """Whether the particles on the host are those on the device, but for the steps ahead."""
        self.ahead = 0
        """Number of steps that were started and of which the particles on the host know nothing yet."""

    @property
    def compiled(self) -> bool:
        """Whether the kernel is compiled."""
        return bool(cuda.config.ENABLE_CUDASIM) or is_compiled(self._track)

    def hold(self, p: Particles) -> None:
        """Take over the particles of the host, if they are not those that are held already.

        Raises
        ------
        InputError
            If they do not fit.
        """
        if self._held is p:
            return
        size = sum(array.nbytes for array in p) + sum(getattr(p, name).nbytes for name in _CHANGING)
        free = cuda.current_context().get_memory_info()[0]
        if size > free:
            raise InputError(
                f"device cuda: {p.size} particles need {size / 1e9:.1f} GB of its memory, of which "
                f"{free / 1e9:.1f} GB are free"
            )
        self._state: Any = Particles(*(cuda.to_device(np.ascontiguousarray(array)) for array in p))
        self._kept = {name: cuda.device_array_like(getattr(self._state, name)) for name in _CHANGING}
        self._buffers = {
            name: cuda.pinned_array(getattr(p, name).shape, getattr(p, name).dtype) for name in _CHANGING
        }
        self._held, self._fresh, self.ahead = p, True, 0
        self._steps_since_sort = _STEPS_PER_SORT

    def longest_semi_axis(self) -> float:
        """The longest semi-axis of the particles that have not ended, m; 0 if there are none."""
        self._go_back()
        longest = cuda.to_device(np.zeros(1), stream=self._work)
        n = len(self._state.R)
        self._find_longest[-(-n // _THREADS), _THREADS, self._work](self._state, longest)
        found = longest.copy_to_host(stream=self._work)
        self._work.synchronize()
        return float(found[0])

    def launch(self, flow: Any, step: int, steps: int, dt: float, start: float) -> None:
        """Start to carry the particles through ``steps`` steps, and do not wait.

        An array of the flow that is the same object as in the launch before is not copied again.
        """
        self._go_back()
        self._arrange(steps)
        arrays = self._copy(flow)
        rows = cuda.to_device(self._rows, stream=self._work)
        if len(self._rows):
            self._track[-(-len(self._rows) // _THREADS), _THREADS, self._work](
                arrays,
                self._patches,
                self._medium,
                self._state,
                rows,
                step,
                steps,
                dt,
                start,
                self._options,
                self._mended,
            )
        self._in_use = arrays, rows
        self.ahead = steps

    def finish(self) -> int:
        """Wait for the steps that were started; the held particles then know who has ended.

        Returns
        -------
        The number of walks that failed and were mended by the tree.
        """
        assert self._held is not None
        status = self._state.status.copy_to_host(self._buffers["status"], stream=self._work)
        mended = self._mended.copy_to_host(stream=self._work)
        self._work.synchronize()
        self._held.status[:] = status
        self._mended.copy_to_device(np.zeros(1, dtype=np.int64))
        self._fresh, self.ahead = False, 0
        return int(mended[0])

    def keep(self) -> None:
        """Start to copy the particles as they are to the host; work that is started later changes nothing."""
        if self.ahead:
            return
        for name, kept in self._kept.items():
            kept.copy_to_device(getattr(self._state, name), stream=self._work)
        if self._fresh:
            return
        done = cuda.event()
        done.record(self._work)
        done.wait(self._back)
        for name, kept in self._kept.items():
            kept.copy_to_host(self._buffers[name], stream=self._back)

    def deliver(self) -> None:
        """Wait for what :meth:`keep` has started, and put it into the particles of the host."""
        if self._fresh or self._held is None:
            return
        self._back.synchronize()
        for name in _CHANGING:
            getattr(self._held, name)[:] = self._buffers[name]
        self._fresh = True

    def _go_back(self) -> None:
        """Undo steps that were started ahead and shall not be taken."""
        if self.ahead:
            self._work.synchronize()
            for name, kept in self._kept.items():
                getattr(self._state, name).copy_to_device(kept, stream=self._work)
            self._mended.copy_to_device(np.zeros(1, dtype=np.int64))
            self.ahead = 0

    def _arrange(self, steps: int) -> None:
        """List the particles that move, now and then sorted, so that neighbours read the same cells."""
        assert self._held is not None
        status = self._held.status
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
        """The same with its arrays on the device."""
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


def kernels(
    loop: Callable[..., int],
    rows: int,
    bindings: Mapping[str, Any],
    separate: Collection[Callable[..., Any]],
) -> tuple[Any, Any]:
    """Compile :func:`track_each` for a loop, and :func:`find_longest`."""
    bound = {**bindings, "track": loop, "ROWS": rows, "LANES": 1}
    return link(track_each, bound, separate, target="cuda"), link(find_longest, target="cuda")
