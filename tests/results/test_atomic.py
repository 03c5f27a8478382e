import errno
import os
import re
from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.results.atomic import atomic_write, only_writer, remove_unfinished, write_text


def test_replaces_old_file(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    path.write_text("old")
    with atomic_write(path) as temporary:
        temporary.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"


def write_half(path: Path, error: type[BaseException]) -> None:
    with atomic_write(path) as temporary:
        temporary.write_text("ha")
        raise error


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_error_keeps_old_file(tmp_path: Path, error: type[BaseException]) -> None:
    path = tmp_path / "table.csv"
    path.write_text("old")
    with pytest.raises(error):
        write_half(path, error)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_was_moved_is_not_made_anew(tmp_path: Path) -> None:
    case = tmp_path / "case"
    (case / "results").mkdir(parents=True)
    case.rename(tmp_path / "elsewhere")
    with pytest.raises(FileNotFoundError, match=re.escape(str(case / "results"))):
        write_text(case / "results/file", "")
    assert not case.exists()


def test_two_writers_do_not_share_a_temporary_file(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    with atomic_write(path) as first, atomic_write(path) as second:
        first.write_text("first")
        second.write_text("second")
    assert path.read_text() == "first"
    assert list(tmp_path.iterdir()) == [path]


def test_file_has_the_permissions_of_any_new_file(tmp_path: Path) -> None:
    plain, path = tmp_path / "plain", tmp_path / "atomic"
    plain.touch()
    with atomic_write(path) as temporary:
        temporary.write_text("")
    assert path.stat().st_mode == plain.stat().st_mode


def test_remove_unfinished_takes_temporary_files_only(tmp_path: Path) -> None:
    kept = [
        tmp_path / name
        for name in ("a.pvd", ".a.pvd", ".a.pvd.0.tmp", "a.pvd.0123abcd.tmp", ".b.pvd.0123abcd.tmp")
    ]
    for file in (*kept, tmp_path / ".a.pvd.0123abcd.tmp"):
        file.touch()
    remove_unfinished([tmp_path / "a.pvd", tmp_path / "absent/a.pvd"])
    assert sorted(tmp_path.iterdir()) == sorted(kept)


def test_full_disk_names_the_file(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    with pytest.raises(OSError, match=r"No space left on device: '.*/table\.csv'"), atomic_write(path):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert list(tmp_path.iterdir()) == []


def test_a_folder_has_one_writer(tmp_path: Path) -> None:
    folder = tmp_path / "new"
    with only_writer(folder):
        with pytest.raises(InputError, match="another run is writing here"), only_writer(folder):
            pass
        assert list(folder.iterdir()) == []
    with only_writer(folder):
        pass
