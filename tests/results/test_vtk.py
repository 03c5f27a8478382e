from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista
from clouds import cloud, in_parts
from hypothesis import given
from hypothesis import strategies as st
from limits import limit_of_file_size
from vtkmodules.vtkIOHDF import vtkHDFReader

from foamprb.errors import InputError
from foamprb.results.folder import ResultsFolder
from foamprb.results.pieces import XMLPPolyDataReader
from foamprb.results.pvd import Series, SnapshotFile, files_of, read_pvd
from foamprb.results.vtk import Parts, PointCloud, layout, write_pieces, write_snapshot, write_vtkhdf
from foamprb.results.vtk_check import is_sealed


def assert_equal(read: Any, written: PointCloud) -> None:
    """Compare a file with a cloud: points, a vertex per point, arrays with their types, and field data."""
    n = len(written.points)
    np.testing.assert_array_equal(read.points, written.points)
    np.testing.assert_array_equal(read.verts, np.c_[np.ones(n), np.arange(n)].ravel())
    assert set(read.point_data.keys()) == set(written.arrays)
    for name, array in written.arrays.items():
        np.testing.assert_array_equal(read.point_data[name], array)
        assert read.point_data[name].dtype == (np.int8 if array.dtype == np.bool_ else array.dtype)
    assert read.field_data["TimeValue"][0] == written.time
    assert list(read.field_data["units"]) == [f"{name} {unit}" for name, unit in written.units.items()]
    for name, meanings in written.names.items():
        assert list(read.field_data[f"{name}Names"]) == list(meanings)


@pytest.mark.parametrize("n", [0, 1, 4])
def test_snapshot_round_trip(tmp_path: Path, n: int) -> None:
    path, written = tmp_path / "cloud.vtp", cloud(0.1 + 0.2, n)
    write_snapshot(path, written)
    read = pyvista.read(path)

    assert read.points.dtype == np.float64
    assert read.field_data["TimeValue"].dtype == np.float64
    assert_equal(read, written)


def test_columns_of_a_transposed_array_keep_their_place(tmp_path: Path) -> None:
    F = np.arange(18.0).reshape(2, 3, 3)
    columns = F.transpose(2, 1, 0).reshape(9, 2).T
    write_snapshot(tmp_path / "cloud.vtp", PointCloud(0.0, np.zeros((2, 3)), {"glyph": columns}))
    np.testing.assert_array_equal(pyvista.read(tmp_path / "cloud.vtp").point_data["glyph"], columns)


def test_full_disk_is_an_error_and_keeps_the_old_file(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cloud.vtp"
    path.write_text("old")
    with limit_of_file_size(20_000), pytest.raises(OSError, match=r"cloud\.vtp: VTK could not write"):
        write_snapshot(path, cloud(n=20_000))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
    assert capfd.readouterr().err == ""


def test_series_lists_exact_times_in_order(tmp_path: Path) -> None:
    series = Series(ResultsFolder(tmp_path / "softCloud", "softCloud"))
    times = [0.0, 0.1, 0.1 + 0.2, 1e-7 + 0.5]
    files = [series.append(cloud(time)) for time in times]
    assert [file.name for file in files] == [f"softCloud_{i:06d}.vtp" for i in range(4)]

    reader = pyvista.get_reader(series.folder.pvd)
    assert reader.time_values == times
    reader.set_active_time_value(times[2])
    assert reader.read()[0].field_data["TimeValue"][0] == times[2]
    assert series.entries == read_pvd(series.folder.pvd)


def test_series_refuses_to_go_back(tmp_path: Path) -> None:
    series = Series(ResultsFolder(tmp_path, "softCloud"))
    series.append(cloud(0.1))
    for time in (0.1, 0.05, np.nan):
        with pytest.raises(ValueError, match=r"does not follow 0\.1 s"):
            series.append(cloud(time))


def test_series_goes_on_after_the_entries_that_it_is_given(tmp_path: Path) -> None:
    old = Series(ResultsFolder(tmp_path, "softCloud"))
    for time in (0.1, 0.2, 0.3, 0.4):
        old.append(cloud(time))

    series = Series(ResultsFolder(tmp_path, "softCloud"))
    series.relist(old.entries[:2])
    assert [entry.time for entry in read_pvd(series.folder.pvd)] == [0.1, 0.2]
    series.append(cloud(0.3))
    assert series.entries == read_pvd(series.folder.pvd) == old.entries[:3]
    assert series.entries[-1] == SnapshotFile(0.3, "softCloud_000002.vtp")


def test_series_without_entries_has_no_list(tmp_path: Path) -> None:
    series = Series(ResultsFolder(tmp_path, "softCloud"))
    series.relist(())
    series.append(cloud(0.0))
    series.relist(())
    assert not series.folder.pvd.exists()
    assert series.append(cloud(0.0)).name == "softCloud_000000.vtp"


def test_name_of_a_series_may_have_dots(tmp_path: Path) -> None:
    series = Series(ResultsFolder(tmp_path, "soft.cloud"))
    names = [series.append(cloud(time)).name for time in (0.1, 0.2)]
    assert names == ["soft.cloud_000000.vtp", "soft.cloud_000001.vtp"]


def test_crash_between_cloud_and_list_keeps_the_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    series = Series(ResultsFolder(tmp_path, "softCloud"))
    series.append(cloud(0.1))
    before = series.folder.pvd.read_bytes()
    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_text", fail)
        with pytest.raises(OSError, match="no space"):
            series.append(cloud(0.2))
    assert series.folder.pvd.read_bytes() == before
    series.append(cloud(0.2))
    assert [entry.time for entry in read_pvd(series.folder.pvd)] == [0.1, 0.2]


@pytest.mark.parametrize("text", ["", "<VTKFile>", '<a><DataSet file="x.vtp"/></a>', "\x00"])
def test_broken_list_is_one_clear_message(tmp_path: Path, text: str) -> None:
    (tmp_path / "softCloud.pvd").write_text(text)
    with pytest.raises(InputError, match=r"softCloud.pvd is no list of VTK files: .*\.$"):
        read_pvd(tmp_path / "softCloud.pvd")


@pytest.mark.parametrize("file", ["../other.vtp", "/etc/x.vtp", "a/b.vtp", "notes.txt"])
def test_list_may_not_name_files_elsewhere(tmp_path: Path, file: str) -> None:
    (tmp_path / "softCloud.pvd").write_text(f'<a><DataSet timestep="0" file="{file}"/></a>')
    with pytest.raises(InputError, match=r"not a \.vtp or \.pvtp file in its own folder"):
        read_pvd(tmp_path / "softCloud.pvd")


@given(times=st.lists(st.floats(0, 1e9), unique=True, min_size=1, max_size=4))
def test_times_round_trip_exactly(tmp_path_factory: pytest.TempPathFactory, times: list[float]) -> None:
    series = Series(ResultsFolder(tmp_path_factory.mktemp("series"), 'a "name" & <more>'))
    for time in sorted(times):
        series.append(PointCloud(time, np.zeros((0, 3))))
    assert [entry.time for entry in read_pvd(series.folder.pvd)] == sorted(times)


def fail(*_: object, **__: object) -> None:
    raise OSError("no space")


def in_pieces(folder: Path, sizes: tuple[int, ...]) -> tuple[PointCloud, Path]:
    """A cloud, and the file of its pieces of so many particles each."""
    whole, first = cloud(n=sum(sizes)), 0
    path, pieces = folder / "cloud_000000.pvtp", []
    for i, n in enumerate(sizes):
        rows = slice(first, first + n)
        arrays = {name: array[rows] for name, array in whole.arrays.items()}
        pieces.append(folder / "cloud_000000" / f"{i}.vtp")
        part = PointCloud(whole.time, whole.points[rows], arrays, whole.units, whole.names)
        write_snapshot(pieces[-1], part)
        first += n
    write_pieces(path, layout(whole), pieces)
    return whole, path


@pytest.mark.parametrize("sizes", [(3, 2), (4, 1, 7), (0,), (1,)])
def test_a_cloud_in_parts_is_one_file(tmp_path: Path, sizes: tuple[int, ...]) -> None:
    whole = cloud(n=sum(sizes))
    found = write_snapshot(tmp_path / "cloud.vtp", in_parts(whole, sizes))
    assert found == layout(whole)
    read = pyvista.read(tmp_path / "cloud.vtp")
    assert_equal(read, whole)


@pytest.mark.parametrize("good", [0, 1, 2])
def test_error_in_a_part_keeps_the_old_file(
    tmp_path: Path, good: int, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cloud.vtp"
    path.write_text("old")

    def parts() -> Iterator[PointCloud]:
        yield from [cloud()] * good
        raise InputError("the flow ends")

    with pytest.raises(InputError, match="the flow ends"):
        write_snapshot(path, Parts(0.1, 3, parts()))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("sizes", [(3, 2), (0, 4, 1), (0,)])
def test_pieces_are_one_cloud(tmp_path: Path, sizes: tuple[int, ...]) -> None:
    whole, path = in_pieces(tmp_path, sizes)
    read = XMLPPolyDataReader(path).read()
    assert_equal(read, whole)
    assert [file.name for file in files_of(path)] == [path.name, *(f"{i}.vtp" for i in range(len(sizes)))]


def test_a_series_goes_on_in_pieces_and_back(tmp_path: Path) -> None:
    series = Series(ResultsFolder(tmp_path, "cloud"))
    series.append(cloud(0.1))
    for time in (0.2, 0.3):
        stem = series.next(time)
        write_snapshot(stem / "0.vtp", cloud(time))
        write_pieces(stem.with_suffix(".pvtp"), layout(cloud(time)), [stem / "0.vtp"])
        series.add(time, stem.with_suffix(".pvtp"))
    kept = series.entries[:2]
    series = Series(ResultsFolder(tmp_path, "cloud"))
    series.relist(kept)
    assert series.append(cloud(0.3)).name == "cloud_000002.vtp"
    assert [entry.file for entry in read_pvd(series.folder.pvd)] == [
        "cloud_000000.vtp",
        "cloud_000001.pvtp",
        "cloud_000002.vtp",
    ]


def test_each_time_has_its_own_cloud_of_its_own_size(tmp_path: Path, random: np.random.Generator) -> None:
    clouds = [
        PointCloud(time, random.random((n, 3)), {"d": random.random(n)})
        for time, n in ((0.5, 2), (1.0, 0), (1.25, 7))
    ]
    write_vtkhdf(tmp_path / "a.vtkhdf", [each.time for each in clouds], clouds.__getitem__)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]
    reader = vtkHDFReader()
    reader.SetFileName(str(tmp_path / "a.vtkhdf"))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS())
    assert times == (0.5, 1.0, 1.25)
    for time, written in zip(times, clouds, strict=True):
        reader.UpdateTimeStep(time)
        found = pyvista.wrap(reader.GetOutputDataObject(0))
        assert found.n_points == len(written.points)
        if len(written.points):
            np.testing.assert_array_equal(found.points, written.points)
            np.testing.assert_array_equal(found.point_data["d"], written.arrays["d"])


def test_failed_vtkhdf_file_keeps_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.vtkhdf"
    path.write_text("before")

    def broken(index: int) -> PointCloud:
        if index:
            raise InputError("damaged")
        return PointCloud(0.0, np.zeros((2, 3)), {"d": np.ones(2)})

    with pytest.raises(InputError, match="damaged"):
        write_vtkhdf(path, [0.0, 1.0], broken)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]
    assert path.read_text() == "before"
    with pytest.raises(OSError, match=r"a\.vtkhdf"):
        write_vtkhdf(tmp_path / "a.vtkhdf/no/b.vtkhdf", [0.0], broken)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]


def test_a_changed_byte_changes_the_checksum(tmp_path: Path) -> None:
    """VTK crashed on a wrong number of texts, on texts without an end and on blocks that do not unpack."""
    path = tmp_path / "cloud.vtp"
    write_snapshot(path, in_parts(cloud(0.1, 7), (3, 4)))
    assert is_sealed(path)
    text = path.read_bytes()
    for at in (0, text.index(b"NumberOfPoints"), text.index(b"<AppendedData") + 40, len(text) - 40):
        path.write_bytes(text[:at] + bytes([text[at] ^ 1]) + text[at + 1 :])
        with pytest.raises(ValueError, match="checksum"):
            is_sealed(path)
    path.write_bytes(text[:-100])
    assert not is_sealed(path)
