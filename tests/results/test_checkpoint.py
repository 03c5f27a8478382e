import json
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
    path = tmp_path_factory.mktemp("whole") / "0.1.npz"
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
def test_every_changed_byte_and_every_cut_shows_or_changes_nothing(
    whole: bytes, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged"
    at = data.draw(st.integers(0, len(whole) - 1))
    changed = bytearray(whole)
    changed[at] ^= data.draw(st.integers(1, 255))
    for damaged in (bytes(changed), whole[:at]):
        path.write_bytes(damaged)
        try:
            found = StoredCheckpoint(path, verify=True).read_all()
        except DamagedError:
            continue
        # A date in the archive, for example.
        assert len(damaged) == len(whole)
        assert (found.time, found.header) == (checkpoint().time, checkpoint().header)
        assert bytes_of(found) == bytes_of(checkpoint())


def bytes_of(found: Checkpoint) -> dict[str, tuple[str, tuple[int, ...], bytes]]:
    return {name: (array.dtype.str, array.shape, array.tobytes()) for name, array in found.arrays.items()}


def test_every_changed_value_shows(tmp_path: Path, whole: bytes) -> None:
    x = checkpoint().arrays["x"].tobytes()
    start = whole.index(x)
    for at in range(start, start + len(x), 8):
        (tmp_path / "a").write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
        with pytest.raises(DamagedError, match="does not match its checksums"):
            StoredCheckpoint(tmp_path / "a", verify=True)


def test_numpy_reads_the_arrays(tmp_path: Path) -> None:
    written = checkpoint()
    write_checkpoint(tmp_path / "a.npz", written)
    with np.load(tmp_path / "a.npz") as arrays:
        assert json.loads(arrays["header"].tobytes())["step"] == 7
        for name, array in written.arrays.items():
            assert arrays[name].tobytes() == array.tobytes()


def test_equal_states_have_equal_bytes(tmp_path: Path, whole: bytes) -> None:
    write_checkpoint(tmp_path / "a", checkpoint())
    assert (tmp_path / "a").read_bytes() == whole


def test_another_version_is_refused_by_its_number(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = Checkpoints(tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr("foamprb.results.checkpoint.VERSION", VERSION + 1)
        store.write(checkpoint())
    with pytest.raises(InputError, match=f"of format {VERSION + 1}; .* reads format {VERSION}"):
        store.latest()


def test_a_file_of_format_13_is_refused_by_its_number(tmp_path: Path) -> None:
    (tmp_path / "0.1.checkpoint").write_bytes(b"foamprb checkpoint 13\n" + bytes(100))
    message = r"0\.1\.checkpoint: a checkpoint of format 13; .* or start over: -overwrite"
    with pytest.raises(InputError, match=message):
        Checkpoints(tmp_path).latest()


def test_compressed_arrays_are_refused(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "a.npz", x=np.zeros(10))
    with pytest.raises(DamagedError, match="it is compressed"):
        StoredCheckpoint(tmp_path / "a.npz", verify=True)


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
        (lambda: part.write_bytes(content[:-1]), r"in 0\.1\.npz\.3 it is incomplete"),
        (lambda: write_checkpoint(part, other), r"0\.1\.npz\.3 belongs to another checkpoint"),
        (part.unlink, r"0\.1\.npz\.3 is missing"),
    ):
        change()
        with pytest.raises(DamagedError, match=why):
            StoredCheckpoint(file, verify=True).read_all()


def test_parts_go_with_their_checkpoint(tmp_path: Path) -> None:
    """Those of 2 s are not those of 2.5 s, nor an unfinished file."""
    for time in (2.5, 2.0, 3.0):
        store, _, _ = in_parts(tmp_path, time)
    names = {f"{time}.npz{part}" for time in ("2.5", "3") for part in ("", ".1", ".3")}
    assert {file.name for file in tmp_path.iterdir()} == names
    unfinished = tmp_path / "3.npz.x1.tmp"
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
    assert [file.name for file in store.files().values()] == ["2.npz", "10.npz"]
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
    (tmp_path / "0.2.npz").write_bytes(b"")
    found = store.latest()
    assert found is not None
    assert found.time == 0.1
    assert "0.2.npz is damaged" in caplog.text
    assert list(store.files()) == [0.1]

    (tmp_path / "0.1.npz").write_bytes(b"PK")
    with pytest.raises(InputError, match=r"no intact checkpoint \(1 damaged\)"):
        store.latest()


def test_other_files_stay(tmp_path: Path) -> None:
    for name in ("notes.txt", "x.npz"):
        (tmp_path / name).touch()
    store = Checkpoints(tmp_path)
    store.write(checkpoint())
    store.truncate(after=-1.0)
    assert {file.name for file in tmp_path.iterdir()} == {"notes.txt", "x.npz"}
