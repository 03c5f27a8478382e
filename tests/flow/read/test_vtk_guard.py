"""The process that tries a file first: how long it may take, and what it touches."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
import pyvista
from mesh_shapes import block

from foamprb.flow.read import vtk_guard
from foamprb.flow.read.vtk_guard import read_vtk, require_survival, times_of


def test_a_file_has_twenty_seconds_and_one_for_each_megabyte(tmp_path):
    """Of files that name others the whole folder counts, but no more files than some thousands."""
    for name, size in (("a.vtu", 3_500_000), ("b.vtu", 1_200_000), ("parts/c.vtu", 2_000_000)):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        with path.open("wb") as file:
            file.truncate(size)
    assert vtk_guard._limit(tmp_path / "a.vtu") == 23
    assert vtk_guard._limit(tmp_path / "parts/c.vtu") == 22
    for suffix in (".vtm", ".pvd", ".pvtu"):
        (tmp_path / f"all{suffix}").touch()
        assert vtk_guard._limit(tmp_path / f"all{suffix}") == 26


def test_only_so_many_files_of_a_folder_count(tmp_path, monkeypatch):
    for k in range(4):
        with (tmp_path / f"{k}.vtu").open("wb") as file:
            file.truncate(1_000_000)
    (tmp_path / "all.vtm").touch()
    monkeypatch.setattr(vtk_guard, "_MOST_FILES", 2)
    assert vtk_guard._limit(tmp_path / "all.vtm") in (21, 22)


class Touched:
    """An array that knows whether it was summed."""

    def __init__(self):
        self.done = 0

    def sum(self):
        self.done += 1


class Part:
    def __init__(self):
        self.points = Touched()
        self.cell_data, self.point_data = {"a": Touched(), "b": Touched()}, {"c": Touched()}


def test_every_number_of_a_file_is_read():
    part = Part()
    vtk_guard._touch(part)
    arrays = (part.points, *part.cell_data.values(), *part.point_data.values())
    assert [array.done for array in arrays] == [1] * 4
    vtk_guard._touch(pyvista.MultiBlock({"a": block(1), "b": pyvista.MultiBlock({"c": pyvista.Line()})}))


@pytest.mark.parametrize("suffix", [".vtu", ".pvd"])
def test_files_with_and_without_times(suffix, tmp_path):
    for k in range(3):
        shape = block(1, 0.0)
        shape.cell_data["k"] = np.array([float(k)])
        shape.save(tmp_path / f"flow_{k}.vtu")
    if suffix == ".vtu":
        assert times_of(tmp_path / "flow_1.vtu") == []
        assert np.asarray(read_vtk(tmp_path / "flow_1.vtu").cell_data["k"]).tolist() == [1.0]
        require_survival(tmp_path / "flow_1.vtu")
        return
    sets = "".join(f'<DataSet timestep="{0.5 * k}" file="flow_{k}.vtu"/>' for k in range(3))
    path = tmp_path / "flow.pvd"
    path.write_text(
        f'<?xml version="1.0"?><VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>'
    )
    assert times_of(path) == [0.0, 0.5, 1.0]
    for step in range(3):
        data = read_vtk(path, step)
        [part] = data if isinstance(data, pyvista.MultiBlock) else [data]
        assert np.asarray(part.cell_data["k"]).tolist() == [float(step)]
        require_survival(path, step)


def test_nothing_is_left_of_the_process_that_reads_first(tmp_path):
    """Python's development mode tells of pipes and processes that a program leaves behind."""
    pyvista.Sphere().save(tmp_path / "sphere.vtp")
    read = (
        "from pathlib import Path; from foamprb.flow.read import vtk_guard;"
        "vtk_guard.require_survival(Path('sphere.vtp')); print(vtk_guard._server.pid)"
    )
    command = [sys.executable, "-W", "default::ResourceWarning", "-c", read]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    with pytest.raises(ProcessLookupError):
        os.kill(int(done.stdout), 0)


def test_modules_in_the_current_folder_are_not_imported(tmp_path, monkeypatch):
    """A foreign case may contain any file; helper processes do not import it."""
    pyvista.Sphere().save(tmp_path / "sphere.vtp")
    for name in ("numpy", "pyvista", "random", "foamprb"):
        (tmp_path / f"{name}.py").write_text(f"from pathlib import Path\nPath({name!r}).touch()\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(vtk_guard, "_server", None)
    require_survival(tmp_path / "sphere.vtp")
    vtk_guard._end(vtk_guard._server)
    assert not [name for name in ("numpy", "pyvista", "random", "foamprb") if (tmp_path / name).exists()]
