"""Dictionaries that have no end, and includes that lead elsewhere, end in one message each."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from foamprb.dictionary.grammar import read_dictionary, read_dictionary_list
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError


def read(folder: Path, text: str) -> Dictionary:
    (folder / "dictionary").write_text(text)
    return read_dictionary(folder / "dictionary", folder)


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(InputError) as caught:
        read(folder, text)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_an_entry_that_names_itself_has_an_end(tmp_path: Path) -> None:
    assert "'$a' is not defined above" in refusal(tmp_path, "a $a;")
    assert "'$a' is not defined above" in refusal(tmp_path, "a { $a; }")
    root = read(tmp_path, "a 1; a $a $a; a $a $a;")
    assert root.entries["a"].text == "1 1 1 1"


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/urandom", "pipe", "folder"])
def test_what_is_no_file_is_not_included(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    assert refusal(tmp_path, f'#include "{name}"').endswith("cannot be included: is not a file.")
    assert read(tmp_path, f'#includeIfPresent "{name}" a 1;').entries.keys() == {"a"}
    with pytest.raises(InputError, match=r"pipe: is not a file \(case"):
        read_dictionary(tmp_path / "pipe", tmp_path)


def test_names_that_no_file_can_have(tmp_path: Path) -> None:
    assert "cannot be included" in refusal(tmp_path, '#include "a\0b"')
    assert "cannot be included" in refusal(tmp_path, f'#include "{"x" * 5000}"')
    assert read(tmp_path, '#includeIfPresent "a\0b" a 1;').entries.keys() == {"a"}
    assert read(tmp_path, f'#includeIfPresent "{"x" * 5000}" a 1;').entries.keys() == {"a"}


def test_includes_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "f0").write_text('#include "f1"')
    (tmp_path / "f1").write_text('#include "f0"')
    assert refusal(tmp_path, '#include "f0"') == "f1, line 1: '\"f0\"' includes itself."
    (tmp_path / "link").symlink_to(tmp_path / "dictionary")
    assert refusal(tmp_path, '#include "link"') == "dictionary, line 1: '\"link\"' includes itself."


@pytest.mark.parametrize("kind", ["plain", "link"])
def test_a_file_from_outside_that_is_no_dictionary_is_not_shown(tmp_path: Path, kind: str) -> None:
    """A case may come from anywhere, and its log go anywhere."""
    (tmp_path / "secrets").write_text("first\nuser:key:1234\n{")
    case = tmp_path / "case"
    case.mkdir()
    (case / "link").symlink_to(tmp_path / "secrets")
    (case / "dictionary").write_text(
        f'#include "{tmp_path}/secrets"' if kind == "plain" else '#include "link"'
    )
    with pytest.raises(InputError) as caught:
        read_dictionary(case / "dictionary", case)
    file = tmp_path / "secrets" if kind == "plain" else case / "link"
    assert str(caught.value) == f"{file}, line 1: the included file is not a dictionary."
    # What lies in the case, or was named by the user, is shown.
    (case / "own").write_text("first\nuser:key:1234\n{")
    (case / "dictionary").write_text('#include "own"')
    with pytest.raises(InputError, match="own, line 1: 'first' has no closing"):
        read_dictionary(case / "dictionary", case)
    with pytest.raises(InputError, match="line 1: 'first' has no closing"):
        read_dictionary(tmp_path / "secrets", case)


def test_a_number_of_entries_with_many_digits(tmp_path: Path) -> None:
    (tmp_path / "boundary").write_text("9" * 5000 + " ( a { b 1; } )")
    with pytest.raises(InputError, match="stands where a number and a list"):
        read_dictionary_list(tmp_path / "boundary", tmp_path)
