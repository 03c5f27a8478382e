"""Writing a snapshot of a million particles, against the disk and the compressors alone."""

from __future__ import annotations

import os
import shutil
import tempfile
import zlib
from collections import deque
from pathlib import Path

import numpy as np
import pyvista
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import foamprb
from benchmarks import pipe
from benchmarks.records import MEGA, Options, Row, interleaved, rows, wall_of
from foamprb.cloud.report import report
from foamprb.results.vtk import Parts, write_snapshot

COMPRESSORS = ("None", "LZ4", "ZLib")


def _to_disk(path: Path, data: bytes) -> None:
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _vtk_writes(path: Path, data: pyvista.PolyData, compressor: str) -> None:
    """Return the time of VTK's writer alone, without flushing."""
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    writer.SetFileName(str(path))
    writer.Write()


def measure(options: Options) -> list[Row]:
    """Measure the throughput of a snapshot's arrays, MB per second of wall time, by each way."""
    n, repeats = (50_000, 2) if options.quick else (1_000_000, 5)
    flow = foamprb.read_case(pipe.case("40k"))
    cloud = pipe.soft_cloud(flow, n, 2e-5)
    cloud.advance(5)

    def parts() -> Parts:
        return report(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time, {})

    snapshots = list(parts().snapshots)
    arrays = {
        name: np.concatenate([np.ascontiguousarray(snapshot.arrays[name]) for snapshot in snapshots])
        for name in snapshots[0].arrays
    }
    points = np.concatenate([snapshot.points for snapshot in snapshots])
    raw = b"".join(array.tobytes() for array in (points, *arrays.values()))
    total = len(raw)
    data = pyvista.PolyData(points)
    data.point_data.update({k: a.astype(np.int8) if a.dtype == bool else a for k, a in arrays.items()})
    folder = Path(tempfile.mkdtemp(dir=pipe.scratch_folder()))
    contestants = {
        "measures": lambda: deque(parts().snapshots, maxlen=0),
        "snapshot to file": lambda: write_snapshot(
            folder / "foamprb.vtp", Parts(cloud.time, len(snapshots), iter(snapshots))
        ),
        "measures and file": lambda: write_snapshot(folder / "foamprb.vtp", parts()),
        "copy of what changes": lambda: cloud.particles.copy_changing(names=cloud.tracker.changing),
        "disk, with fsync": lambda: _to_disk(folder / "raw", raw),
        "zlib alone, level 1": lambda: zlib.compress(raw, 1),
    }
    for name in COMPRESSORS:
        contestants[f"VTK, {name}"] = lambda name=name: _vtk_writes(folder / f"{name}.vtp", data, name)

    def timed(contestant) -> float:
        # Else who flushes first waits for the files of those before.
        os.sync()
        return wall_of(contestant)

    try:
        times = interleaved({k: lambda c=c: timed(c) for k, c in contestants.items()}, repeats)
        sizes = {name: (folder / f"{name}.vtp").stat().st_size for name in ("foamprb", *COMPRESSORS)}
    finally:
        shutil.rmtree(folder)
    table = rows("output", "throughput", {name: total / t / MEGA for name, t in times.items()}, "MB/s", n)
    table += rows("output", "time of a snapshot", times, "s", n)
    table += rows("output", "size of a snapshot", {"arrays": total / n}, "bytes/particle", n)
    files = {f"file, {name}": size / n for name, size in sizes.items()}
    return table + rows("output", "size of a snapshot", files, "bytes/particle", n)
