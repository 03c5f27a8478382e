"""Writing a snapshot of a million particles, against the disk and the compressors alone."""

from __future__ import annotations

import os
import shutil
import tempfile
import zlib
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOCore import vtkLZ4DataCompressor

import foamprb
from benchmarks import pipe
from benchmarks.records import MEGA, Options, Row, interleaved, rows, wall_of
from foamprb.cloud.measures import context
from foamprb.cloud.measures import measure as measures
from foamprb.output.vtk import Snapshot, write_snapshot

_SAMPLE = 64 << 20


def _to_disk(path: Path, data: bytes) -> None:
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _lz4(data: bytes) -> int:
    packed = vtkLZ4DataCompressor().Compress(np.frombuffer(data, dtype=np.uint8), len(data))
    return int(packed.GetNumberOfValues())


def measure(options: Options) -> list[Row]:
    """Megabytes of a snapshot's arrays that go in a second of wall time, by each way."""
    n, repeats = (50_000, 2) if options.quick else (1_000_000, 5)
    flow = foamprb.read_case(pipe.case("40k"))
    cloud = pipe.soft_cloud(flow, n, 2e-5)
    cloud.advance(5)

    def measured() -> Snapshot:
        c = context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time)
        return Snapshot(cloud.time, c.particles.x, measures(c))

    snapshot = measured()
    arrays = [snapshot.points, *snapshot.arrays.values()]
    total = sum(array.nbytes for array in arrays)
    raw = b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)
    # Every array in its share, as the compressors meet them.
    part = b"".join(a[: max(1, len(a) * _SAMPLE // max(total, _SAMPLE))].tobytes() for a in arrays)
    folder = Path(tempfile.mkdtemp(dir=pipe.scratch_folder()))
    try:
        times = interleaved(
            {
                "measures": lambda: wall_of(measured) / total,
                "snapshot to file": lambda: (
                    wall_of(lambda: write_snapshot(folder / "a.vtp", snapshot)) / total
                ),
                "disk, with fsync": lambda: wall_of(lambda: _to_disk(folder / "raw", raw)) / total,
                "lz4 alone": lambda: wall_of(lambda: _lz4(part)) / len(part),
                "zlib -1 alone": lambda: wall_of(lambda: zlib.compress(part, 1)) / len(part),
            },
            repeats,
        )
        size = (folder / "a.vtp").stat().st_size
    finally:
        shutil.rmtree(folder)
    found = rows("output", "throughput", {name: 1.0 / t / MEGA for name, t in times.items()}, "MB/s", n)
    found += rows("output", "time of a snapshot", {name: t * total for name, t in times.items()}, "s", n)
    found += rows(
        "output", "size of a snapshot", {"arrays": total / n, "file": size / n}, "bytes/particle", n
    )
    packed = {"lz4": _lz4(part) / len(part), "zlib -1": len(zlib.compress(part, 1)) / len(part)}
    return found + rows("output", "size after compression", packed, "")
