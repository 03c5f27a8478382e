"""Particle-steps per second on a CUDA device, and how near they come to what its arithmetic and memory allow.

    cd tools && python -m benchmarks.device [-quick] [-n 1000000] [-steps 300]

Where there is no device nothing is timed: the kernels are compiled for one of compute capability 9.0, which
needs the wheels of the CUDA toolkit but no GPU, and ``ptxas``, if it is there (pip install nvidia-cuda-nvcc),
says how many registers and how much memory a thread takes.
"""

from __future__ import annotations

import argparse
import math
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.profile import FLOW_STAGES
from benchmarks.roofline import operations_by_stage
from benchmarks.tracker import STEP
from foamprb.errors import InputError

CAPABILITY = (9, 0)
_CHAINS, _LENGTH = 8, 1024
_NODE, _INDICES = 128, 16
"""Bytes of a node, and of the indices of a tetrahedron's nodes or neighbours."""


class Ceilings(NamedTuple):
    """What a device can do, as kernels that do nothing else find it."""

    operations: float
    """Additions and multiplications per second, of doubles."""
    bytes: float
    """Read and written per second."""


def flows() -> dict[str, Any]:
    """A pipe in closed form, and the same on a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = foamprb.read_case(pipe.cache_folder(Path(folder), "40k"))
    return {
        "closed form": foamprb.analytic.pipe(pipe.RADIUS, pipe.MEAN, pipe.LENGTH),
        "mesh of 40k cells": mesh,
    }


def bytes_of_step(integrator: str, flow: str) -> int:
    """Least number of bytes of the flow that a particle-step reads; what is in registers costs nothing."""
    samples = FLOW_STAGES["paper" if integrator == "paper" else "stokes"]["sample"]
    return samples * (4 * _NODE + 2 * _INDICES) if flow != "closed form" else 0


def ceilings() -> Ceilings:
    """Measure a device."""
    from numba import cuda

    @cuda.jit  # type: ignore[untyped-decorator]
    def multiply_add(out, b, c):
        x0 = x1 = x2 = x3 = x4 = x5 = x6 = x7 = float(cuda.grid(1))
        for _ in range(_LENGTH):
            x0, x1, x2, x3 = x0 * b + c, x1 * b + c, x2 * b + c, x3 * b + c
            x4, x5, x6, x7 = x4 * b + c, x5 * b + c, x6 * b + c, x7 * b + c
        out[cuda.grid(1)] = x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7

    @cuda.jit  # type: ignore[untyped-decorator]
    def copy(a, b):
        i = cuda.grid(1)
        if i < a.shape[0]:
            b[i] = a[i]

    threads, blocks = 256, 16_384
    n = threads * blocks
    out = cuda.device_array(n)
    spent = _best(lambda: multiply_add[blocks, threads](out, 0.5, 0.25), 10)
    a, b = cuda.to_device(np.zeros(8 * n)), cuda.device_array(8 * n)
    copied = _best(lambda: copy[8 * blocks, threads](a, b), 10)
    return Ceilings(2.0 * _CHAINS * _LENGTH * n / spent, 2.0 * a.nbytes / copied)


def _best(run: Any, times: int) -> float:
    """Seconds of the fastest of some runs of a kernel, after one that compiles it."""
    from numba import cuda

    best = math.inf
    for _ in range(times + 1):
        start = time.perf_counter()
        run()
        cuda.synchronize()
        best = min(best, time.perf_counter() - start)
    return best


def measure(n: int, steps: int, repeats: int) -> None:
    """Time the loops and print a table."""
    from foamprb.parallel.device import Device, device_name

    limits = ceilings()
    print(f"{device_name()}: {limits.operations / 1e12:.2f} TFLOP/s, {limits.bytes / 1e12:.2f} TB/s")
    print(f"{n} particles, {steps} steps, the best of {repeats}; a division counts as one operation")
    print(f"{'flow':20s}{'integrator':12s}{'particle-steps/s':>18s}{'of FP64':>10s}{'of memory':>10s}")
    for name, flow in flows().items():
        for integrator in STEP:
            cloud = pipe.soft_cloud(flow, n, STEP["paper"], integrator)
            cloud.hand_over(Device())
            cloud.advance(10)
            best = 0.0
            for _ in range(repeats):
                cloud.gather()
                before, start = pipe.particle_steps(cloud), time.perf_counter()
                cloud.advance(steps)
                spent = time.perf_counter() - start
                cloud.gather()
                best = max(best, (pipe.particle_steps(cloud) - before) / spent)
            arithmetic = "-"
            if integrator in FLOW_STAGES:
                done = sum(count.total() for count in operations_by_stage(integrator).values())
                arithmetic = f"{done * best / limits.operations:.1%}"
            memory = bytes_of_step(integrator, name) * best / limits.bytes
            print(f"{name:20s}{integrator:12s}{best:18.4g}{arithmetic:>10s}{memory:>10.1%}")


@contextmanager
def as_if_on(capability: tuple[int, int]) -> Iterator[None]:
    """Let numba-cuda compile for a device that is not there."""
    import numba.cuda.dispatcher as dispatcher

    class Absent:
        compute_capability = capability

    found = dispatcher.get_current_device
    dispatcher.get_current_device = lambda: Absent
    try:
        yield
    finally:
        dispatcher.get_current_device = found


def ptx_of(cloud: Any, capability: tuple[int, int] = CAPABILITY) -> str:
    """Assembly text of the kernel that carries a cloud's particles."""
    import numba
    from numba import cuda

    from foamprb.parallel.device import kernels

    tracker = cloud.tracker
    arguments = (
        cloud.flow_arrays(), tracker.table, tracker.medium, cloud.particles, np.zeros(1, dtype=np.int64),
        0, 1, tracker.dt, tracker.start, tracker.options, np.zeros(1, dtype=np.int64),
    )  # fmt: skip
    kernel, _ = kernels(tracker)
    with as_if_on(capability):
        text, _ = cuda.compile_ptx(
            kernel.py_func, tuple(numba.typeof(argument) for argument in arguments), cc=capability
        )
    return str(text)


def ptxas() -> Path | None:
    """The assembler of NVIDIA's wheels."""
    spec = find_spec("nvidia")
    places = spec.submodule_search_locations if spec and spec.submodule_search_locations else []
    return next((file for place in places for file in Path(place).glob("*/bin/ptxas")), None)


def resources(text: str, capability: tuple[int, int] = CAPABILITY) -> str:
    """What ``ptxas`` says that a thread of the kernel takes."""
    program = ptxas()
    if program is None:
        return "ptxas is not there"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "kernel.ptx"
        file.write_text(text)
        architecture = "sm_{}{}".format(*capability)
        command = [program, "-v", f"-arch={architecture}", file, "-o", file.with_suffix(".cubin")]
        said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    entry = said[said.index("Compiling entry function") :]
    registers = re.search(r"Used (\d+) registers", entry)
    frame = re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", entry)
    if registers is None or frame is None:
        return said
    return f"{registers[1]} registers, {frame[1]} B of local memory, spills {frame[2]} B and {frame[3]} B"


def compile_only() -> None:
    """Compile the kernels and print what a thread takes."""
    for name, flow in flows().items():
        for integrator in STEP:
            text = ptx_of(pipe.soft_cloud(flow, 1, STEP[integrator], integrator))
            doubles = len(re.findall(r"^\s+(?:add|sub|mul|fma|div|sqrt)\S*\.f64", text, re.MULTILINE))
            print(f"{name:20s}{integrator:12s}{doubles:6d} instructions on doubles, {resources(text)}")


def main() -> int:
    """Measure if there is a device, else compile; the exit status is 1 if neither can be done."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-n", type=int, default=1_000_000, help="number of particles")
    parser.add_argument("-steps", type=int, default=300)
    parser.add_argument("-quick", action="store_true", help="few particles and steps: to see that all works")
    parsed = parser.parse_args()
    if find_spec("numba_cuda") is None:
        print("numba-cuda is missing: pip install 'foamprb[cuda]'", file=sys.stderr)
        return 1
    from foamprb.parallel.device import device_name

    try:
        device_name()
    except InputError as error:
        print("{}\nNothing is timed; the kernels for compute capability {}.{}:".format(error, *CAPABILITY))
        compile_only()
        return 0
    if parsed.quick:
        measure(1000, 10, 1)
    else:
        measure(parsed.n, parsed.steps, 3)
    return 0


if __name__ == "__main__":
    sys.exit(main())
