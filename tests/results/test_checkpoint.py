from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.errors import InputError
from foamprb.results.checkpoint import (
    VERSION,
    Checkpoint,
    Checkpoints,
    DamagedError,
    StoredCheckpoint,
    part_file,
    parts_of,
    write_checkpoint,
)


def checkpoint(time: float = 0.1) -> Checkpoint:
    random = np.random.default_rng(0)
    arrays = {
        "x": random.random((5, 3)),
        "status": np.arange(5, dtype=np.int8),
        "none": np.zeros((0, 9)),
        "number": np.array(3.5),
        "complex": np.array([0.0, complex(0.0, -0.0)]),
        "special": np.array([np.nan, -0.0, np.inf, 5e-324]),
    }
    return Checkpoint(time, {"step": 7, "series": [[0.1 + 0.2, "a b.vtp"]]}, arrays)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("whole") / "0.1.checkpoint"
    write_checkpoint(path, checkpoint())
    return path.read_bytes()


def test_round_trip_is_exact(tmp_path: Path) -> None:
    written = checkpoint(0.1 + 0.2)
    write_checkpoint(tmp_path / "a", written)
    read = StoredCheckpoint(tmp_path / "a", verify=True).read_all()
    assert read.time == written.time
    assert read.header == written.header
    assert read.arrays.keys() == written.arrays.keys()
    for name, array in written.arrays.items():
        assert read.arrays[name].dtype == array.dtype
        assert read.arrays[name].shape == array.shape
        assert read.arrays[name].tobytes() == array.tobytes()
        assert read.arrays[name].flags.writeable


@pytest.mark.parametrize(
    "array",
    [
        np.ones(4000),
        np.full((4000, 9), np.nan),
        np.tile(np.eye(3).ravel(), (4000, 1)),
        np.tile(np.float32([0.1, -0.0]), (4000, 1)),
        np.full(4000, -1, dtype=np.int32),
        np.broadcast_to(np.zeros(3), (4000, 3)),
    ],
)
def test_alike_rows_are_one_row_in_the_file(tmp_path: Path, array: np.ndarray) -> None:
    write_checkpoint(tmp_path / "a", Checkpoint(0.0, {}, {"a": array}))
    assert (tmp_path / "a").stat().st_size < 1000
    read = StoredCheckpoint(tmp_path / "a", verify=True).read_all().arrays["a"]
    assert (read.dtype, read.shape, read.tobytes()) == (array.dtype, array.shape, array.tobytes())
    assert read.flags.writeable


@pytest.mark.parametrize("row", [0, 1, 999, 1000, 2500, 3999])
def test_rows_that_differ_in_one_bit_are_all_in_the_file(tmp_path: Path, row: int) -> None:
    array = np.zeros((4000, 3))
    array[row, 2] = -0.0
    write_checkpoint(tmp_path / "a", Checkpoint(0.0, {}, {"a": array}))
    assert StoredCheckpoint(tmp_path / "a", verify=True).read_all().arrays["a"].tobytes() == array.tobytes()


@given(data=st.data())
def test_every_changed_byte_and_every_cut_shows(
    whole: bytes, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged"
    at = data.draw(st.integers(0, len(whole) - 1))
    changed = bytearray(whole)
    changed[at] ^= data.draw(st.integers(1, 255))
    for damaged in (bytes(changed), whole[:at], whole + b"\0"):
        path.write_bytes(damaged)
        with pytest.raises(DamagedError):
            StoredCheckpoint(path, verify=True).read_all()


def test_another_version_is_refused_by_its_number(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = Checkpoints(tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr("foamprb.results.checkpoint.VERSION", VERSION + 1)
        store.write(checkpoint())
    with pytest.raises(InputError, match=f"of format {VERSION + 1}; .* reads format {VERSION}"):
        store.latest()


def test_a_version_with_another_checksum_is_named(tmp_path: Path, whole: bytes) -> None:
    for number, message in ((VERSION - 1, f"format is {VERSION - 1}, not {VERSION}"), (VERSION, "checksum")):
        changed = whole.replace(b"checkpoint %d" % VERSION, b"checkpoint %d" % number)[:-4] + b"\0" * 32
        (tmp_path / "a").write_bytes(changed)
        with pytest.raises(DamagedError, match=message):
            StoredCheckpoint(tmp_path / "a", verify=True).read_all()


def in_parts(folder: Path, time: float = 0.1) -> tuple[Checkpoints, Path, Checkpoint]:
    """Write a checkpoint of whose first array two further processes have rows; return also the whole."""
    store, whole = Checkpoints(folder), checkpoint(time)
    file = store.file(time)
    rows = {first: {"x": whole.arrays["x"][first : first + 2]} for first in (1, 3)}
    parts = [(n, write_checkpoint(part_file(file, n), Checkpoint(time, {}, own))) for n, own in rows.items()]
    own = {**whole.arrays, "x": whole.arrays["x"][:1]}
    store.write(Checkpoint(time, {**whole.header, "parts": parts}, own))
    return store, file, whole


def test_parts_are_put_together(tmp_path: Path) -> None:
    _, file, whole = in_parts(tmp_path)
    found = StoredCheckpoint(file, verify=True).read_all().arrays
    assert list(found) == list(whole.arrays)
    for name, array in whole.arrays.items():
        assert found[name].tobytes() == array.tobytes()


def test_a_damaged_missing_or_foreign_part_damages_the_whole(tmp_path: Path) -> None:
    _, file, whole = in_parts(tmp_path)
    part = part_file(file, 3)
    content = part.read_bytes()
    other = Checkpoint(0.1, {}, {"x": whole.arrays["x"][:2]})
    for change, why in (
        (lambda: part.write_bytes(content[:-1]), r"in 0\.1\.checkpoint\.3 its contents do not match"),
        (lambda: write_checkpoint(part, other), r"0\.1\.checkpoint\.3 belongs to another checkpoint"),
        (part.unlink, r"0\.1\.checkpoint\.3 is missing"),
    ):
        change()
        with pytest.raises(DamagedError, match=why):
            StoredCheckpoint(file, verify=True).read_all()


def test_parts_go_with_their_checkpoint(tmp_path: Path) -> None:
    """Those of 2 s are not those of 2.5 s, nor an unfinished file."""
    for time in (2.5, 2.0, 3.0):
        store, _, _ = in_parts(tmp_path, time)
    names = {f"{time}.checkpoint{part}" for time in ("2.5", "3") for part in ("", ".1", ".3")}
    assert {file.name for file in tmp_path.iterdir()} == names
    unfinished = tmp_path / "3.checkpoint.x1.tmp"
    unfinished.touch()
    assert parts_of(store.file(3.0)) == [part_file(store.file(3.0), n) for n in (1, 3)]
    store.truncate(after=0.0)
    assert list(tmp_path.iterdir()) == [unfinished]


def test_the_last_two_are_kept(tmp_path: Path) -> None:
    store = Checkpoints(tmp_path / "new")
    assert store.latest() is None
    # In the order of their times, which is not that of their names.
    times = [1e-5, 0.5, 2.0, 10.0]
    for time in times:
        store.write(checkpoint(time))
    assert [file.name for file in store.files().values()] == ["2.checkpoint", "10.checkpoint"]
    found = store.latest()
    assert found is not None
    assert found.time == 10.0


def test_a_damaged_one_gives_way_to_the_one_before(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("foamprb.results.checkpoint.log.propagate", True)
    store = Checkpoints(tmp_path)
    for time in (0.1, 0.2):
        store.write(checkpoint(time))
    (tmp_path / "0.2.checkpoint").write_bytes(b"")
    found = store.latest()
    assert found is not None
    assert found.time == 0.1
    assert "0.2.checkpoint is damaged" in caplog.text
    assert list(store.files()) == [0.1]

    (tmp_path / "0.1.checkpoint").write_bytes(b"foamprb checkpoint 1\n")
    with pytest.raises(InputError, match=r"no intact checkpoint \(1 damaged\)"):
        store.latest()


def test_other_files_stay(tmp_path: Path) -> None:
    for name in ("notes.txt", "x.checkpoint"):
        (tmp_path / name).touch()
    store = Checkpoints(tmp_path)
    store.write(checkpoint())
    store.truncate(after=-1.0)
    assert {file.name for file in tmp_path.iterdir()} == {"notes.txt", "x.checkpoint"}
