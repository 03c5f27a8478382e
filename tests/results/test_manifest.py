from __future__ import annotations

import json
from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.results import atomic
from foamprb.results.manifest import Manifest


def files(folder: Path, *names: str) -> list[Path]:
    made = [folder / name for name in names]
    for file in made:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    return made


def test_expected_files_are_listed_by_relative_names(tmp_path: Path) -> None:
    expected = [tmp_path / name for name in ("a.vtp", "deep/er/b.csv", 'odd "näme"\n.vtp')]
    manifest = Manifest(tmp_path)
    manifest.expect(expected)
    assert Manifest.read(tmp_path).files == {*expected}
    assert json.loads(manifest.path.read_text())["files"] == sorted(
        str(file.relative_to(tmp_path)) for file in expected
    )
    # Whoever copies the folder copies the list with it.
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    manifest.path.rename(elsewhere / manifest.path.name)
    assert elsewhere / "a.vtp" in Manifest.read(elsewhere).files


def test_without_a_manifest_nothing_is_listed(tmp_path: Path) -> None:
    files(tmp_path, "a.vtp")
    assert Manifest.read(tmp_path).files == set()


def test_files_are_appended_to_the_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A list of 1000 files more costs a write of their names only; at any time it is JSON."""
    manifest = Manifest(tmp_path, [tmp_path / "a"])
    manifest.expect([tmp_path / "b"])
    monkeypatch.setattr(Path, "replace", None)
    for time in range(3):
        pieces = {tmp_path / f"{time}/{rank}.vtp" for rank in range(1000)}
        size = manifest.path.stat().st_size
        manifest.expect([tmp_path / "b", *pieces])
        assert manifest.path.stat().st_size - size < 20 * 1000
        assert len(json.loads(manifest.path.read_text())["files"]) == 2 + 1000 * (time + 1)
        assert pieces < Manifest.read(tmp_path).files


def test_settling_drops_missing_files(tmp_path: Path) -> None:
    manifest = Manifest(tmp_path)
    a, b, c, d = (tmp_path / name for name in "abcd")
    manifest.expect([a, b])
    manifest.expect([c])
    a.touch()
    c.touch()
    manifest.settle([d])
    assert Manifest.read(tmp_path).files == {a, c, d}
    assert manifest.path.read_text() == '{\n "format": 1,\n "files": [\n  "a"\n ,"c"\n ,"d"\n ]\n}\n'


@pytest.mark.parametrize("n", range(1, 40))
def test_a_killed_process_leaves_the_list_before_it(tmp_path: Path, n: int) -> None:
    """The text of an append may end anywhere."""
    manifest = Manifest(tmp_path)
    manifest.expect([tmp_path / "first"])
    before = manifest.path.read_bytes()
    manifest.expect([tmp_path / "second", tmp_path / "third"])
    after = manifest.path.read_bytes()
    place = len(before) - len("\n ]\n}\n") + n
    manifest.path.write_bytes(after[:place] + before[place:])
    names = {file.name for file in Manifest.read(tmp_path).files}
    assert {"first"} <= names <= {"first", "second", "third"}


def test_a_failed_write_keeps_the_list_before_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    manifest = Manifest(tmp_path)
    manifest.expect(files(tmp_path, "a"))

    def fail(*_: object) -> None:
        raise OSError("no space")

    monkeypatch.setattr(atomic, "_flush", fail)
    with pytest.raises(OSError, match="no space"):
        manifest.expect([tmp_path / "b"])
    assert Manifest.read(tmp_path).files == {tmp_path / "a"}


def test_removal_takes_listed_files_and_emptied_folders_only(tmp_path: Path) -> None:
    listed = files(tmp_path, "a.vtp", "pieces/0.vtp", "pieces/1.vtp", "tracks/tracks.vtp", "gone/x")
    (own,) = files(tmp_path, "tracks/notes.txt")
    listed[-1].unlink()
    manifest = Manifest(tmp_path, listed)
    manifest.remove(listed)
    assert manifest.files == set()
    assert {*tmp_path.rglob("*")} == {own, own.parent}
    assert tmp_path.is_dir()


DAMAGES = {
    "empty": lambda _: "",
    "cut short": lambda text: text[: len(text) // 2],
    "no name": lambda text: text.replace('"a.vtp"', "1"),
    "another format": lambda text: text.replace('"format": 1', '"format": 2'),
    "no list": lambda _: "[]",
    "nested without end": lambda _: "[" * 100_000,
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_manifest_is_one_message(tmp_path: Path, damage: str) -> None:
    manifest = Manifest(tmp_path)
    manifest.expect([tmp_path / "a.vtp", tmp_path / "b.vtp"])
    manifest.path.write_text(DAMAGES[damage](manifest.path.read_text()))
    with pytest.raises(InputError, match=r"manifest\.json is damaged: "):
        Manifest.read(tmp_path)


@pytest.mark.parametrize("name", ["../other", "/etc/passwd", "a/../../b", "."])
def test_manifest_lists_no_file_outside_its_folder(tmp_path: Path, name: str) -> None:
    content = {"format": 1, "files": [name]}
    Manifest(tmp_path).path.write_text(json.dumps(content))
    with pytest.raises(InputError, match="which is not in its folder"):
        Manifest.read(tmp_path)


@pytest.mark.parametrize("name", ["x/thesis.tex", "deep/x/thesis.tex"])
def test_nothing_beneath_a_link_is_listed(tmp_path: Path, name: str) -> None:
    """Else a downloaded case could name files elsewhere, which the next run would remove."""
    folder, elsewhere = tmp_path / "run", tmp_path / "elsewhere"
    files(elsewhere, "thesis.tex")
    link = folder / Path(name).parent
    link.parent.mkdir(parents=True)
    link.symlink_to(elsewhere)
    content = {"format": 1, "files": [name]}
    Manifest(folder).path.write_text(json.dumps(content))
    with pytest.raises(InputError, match=f"the folder '{Path(name).parent}' is a link"):
        Manifest.read(folder)
    with pytest.raises(InputError, match="results would be written elsewhere"):
        Manifest(folder).expect([folder / name])
    assert (elsewhere / "thesis.tex").exists()
